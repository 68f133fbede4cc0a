#include "api/convert/dxf_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/convert/text.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::convert {

namespace {

/// Reads groups one after the other.
class GroupReader {
 public:
  GroupReader(std::string_view text, std::vector<Finding>& findings) : text_(text), findings_(findings) {}

  /// Reads the next group; nullopt at the end of the text and after a finding.
  std::optional<Group> next() {
    WorkLimit::poll();
    const std::optional<std::string_view> code_text = next_line();
    if (!code_text || (code_text->empty() && text_.empty())) {
      return std::nullopt;
    }
    const std::optional<int> code = parse_integer(*code_text);
    if (!code) {
      findings_.push_back(
          finding_at(line_, "malformed", "expected a group code, got " + checks::in_quotes(*code_text)));
      return std::nullopt;
    }
    const std::optional<std::string_view> value = next_line();
    if (!value) {
      findings_.push_back(finding_at(line_, "malformed", "the value of the group code is missing"));
      return std::nullopt;
    }
    return Group{*code, *value, line_};
  }

  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::optional<std::string_view> next_line() {
    if (text_.empty()) {
      return std::nullopt;
    }
    const std::size_t end = text_.find('\n');
    const std::string_view line = trimmed(text_.substr(0, end));
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++line_;
    return line;
  }

  std::string_view text_;
  std::vector<Finding>& findings_;
  std::size_t line_ = 0;
};

/// Reads up to the beginning of the section ENTITIES; returns whether it is there.
bool find_section(GroupReader& reader) {
  bool section_begins = false;
  while (const auto group = reader.next()) {
    if (section_begins && group->code == 2 && group->value == "ENTITIES") {
      return true;
    }
    section_begins = group->code == 0 && group->value == "SECTION";
  }
  return false;
}

}  // namespace

Finding finding_at(std::size_t line, std::string_view code, std::string detail) {
  return {"line " + std::to_string(line), std::string(code), std::move(detail)};
}

double number_of(const Group& group, std::vector<Finding>& findings) {
  const std::optional<double> value = parse_number(group.value);
  if (!value || !(std::abs(*value) <= kMaxMagnitude)) {
    findings.push_back(finding_at(group.line, "wrong_type",
                                  "expected a finite number of at most " + checks::text(kMaxMagnitude) +
                                      " for group code " + std::to_string(group.code) + ", got " +
                                      checks::in_quotes(group.value)));
    return 0.0;
  }
  return *value;
}

std::string_view Entity::text(int code, std::string_view otherwise) const {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [code](const Group& group) { return group.code == code; });
  return found == groups.end() ? otherwise : found->value;
}

double Entity::number(int code, std::optional<double> otherwise, std::vector<Finding>& findings) const {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [code](const Group& group) { return group.code == code; });
  if (found != groups.end()) {
    return number_of(*found, findings);
  }
  if (!otherwise) {
    findings.push_back(
        finding_at(line, "missing_field", std::string(type) + " needs group code " + std::to_string(code)));
  }
  return otherwise.value_or(0.0);
}

std::vector<Entity> read_entities(std::string_view text, std::vector<Finding>& findings) {
  if (text.starts_with("AutoCAD Binary DXF")) {
    findings.push_back(finding_at(1, "malformed", "the drawing must be ASCII DXF, not binary DXF"));
    return {};
  }
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  if (!is_utf8(text)) {
    findings.push_back(
        finding_at(1, "malformed", "the drawing must be text in UTF-8, as DXF 2007 and later versions are"));
    return {};
  }
  GroupReader reader(text, findings);
  std::vector<Entity> entities;
  if (!find_section(reader)) {
    if (findings.empty()) {
      findings.push_back(finding_at(reader.line(), "malformed", "the drawing has no section ENTITIES"));
    }
    return {};
  }
  while (auto group = reader.next()) {
    if (group->code == 0 && group->value == "ENDSEC") {
      return entities;
    }
    if (group->code == 0) {
      entities.push_back({group->value, group->line, {}});
    } else if (!entities.empty()) {
      entities.back().groups.push_back(*group);
    }
  }
  if (findings.empty()) {
    findings.push_back(finding_at(reader.line(), "malformed", "the section ENTITIES does not end"));
  }
  return {};
}

}  // namespace snapthrough::api::convert
