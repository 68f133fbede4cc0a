#include "api/value.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "api/api.h"
#include "api/request_schema.h"
#include "solver/check/check_place.h"
#include "solver/model/pointer.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api {

namespace {

using checks::in_quotes;

/// Returns the Levenshtein distance: least number of inserted, deleted and replaced bytes between two texts.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string join(std::span<const std::string_view> names) {
  std::string all;
  for (const std::string_view name : names) {
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  return all;
}

/// Returns '; did you mean "x"?', or the list of names when `nearest` is empty.
std::string suggest(std::string_view nearest, std::span<const std::string_view> names) {
  return nearest.empty() ? "; known here: " + join(names) : "; did you mean " + in_quotes(nearest) + "?";
}

/// Returns "a, b and c".
std::string join_with_and(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return all;
}

/// Returns the objects that have a field; empty for more than three, whose list would not help.
std::vector<std::string> owners_of(const std::string& field, const std::string& pointer) {
  constexpr std::size_t kMost = 3;
  auto owners = objects_with_field(field, pointer);
  return owners.size() > kMost ? std::vector<std::string>() : owners;
}

}  // namespace

std::string_view nearest_name(std::string_view written, std::span<const std::string_view> names) {
  constexpr std::size_t kLongest = 40;
  constexpr std::size_t kMostLetters = 2;  // largest edit distance to a suggested name
  std::string_view best;
  std::size_t best_distance = kMostLetters + 1;
  if (written.size() > kLongest) {
    return best;
  }
  for (const std::string_view name : names) {
    if (name.size() > written.size() && name.starts_with(written) && name[written.size()] == '_') {
      return name;  // `written` is the first words of `name`
    }
    const std::size_t distance = edit_distance(written, name);
    if (distance < best_distance && 2 * distance < written.size()) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::vector<Finding> Report::listed() const {
  std::vector<Finding> all = findings_;
  if (is_cut()) {
    all.push_back({"", "too_many_findings", std::to_string(left_out_) + " more findings are not listed"});
  }
  return all;
}

void Report::add_finding(Finding finding) {
  if (findings_.size() < kMaxFindings) {
    findings_.push_back(std::move(finding));
  } else {
    ++left_out_;
  }
}

void Report::mark_unreadable(const std::string& pointer) {
  if (is_cut()) {
    return;  // findings that follow from it would not be listed
  }
  unreadable_.insert(pointer);
  for (std::size_t end = pointer.rfind('/'); end != std::string::npos && end > 0;
       end = pointer.rfind('/', end - 1)) {
    if (!above_unreadable_.insert(pointer.substr(0, end)).second) {
      break;
    }
  }
}

void Report::add(const std::string& pointer, std::string_view code, std::string detail) {
  add_finding({pointer, std::string(code), std::move(detail)});
  mark_unreadable(pointer);
}

void Report::add_unknown_field(const std::string& pointer, const std::string& meant, std::string detail) {
  add_finding({pointer, "unknown_field", std::move(detail)});
  if (!meant.empty()) {
    mark_unreadable(meant);
  }
}

bool Report::covers(const std::string& pointer) const {
  if (above_unreadable_.contains(pointer) || unreadable_.contains(pointer) || unreadable_.contains("")) {
    return true;
  }
  for (std::size_t end = pointer.rfind('/'); end != std::string::npos && end > 0;
       end = pointer.rfind('/', end - 1)) {
    if (unreadable_.contains(pointer.substr(0, end))) {
      return true;
    }
  }
  return false;
}

bool Value::is_object() const { return json_->is_object(); }
bool Value::is_array() const { return json_->is_array(); }
bool Value::is_string() const { return json_->is_string(); }
bool Value::is_number() const { return json_->is_number(); }
std::size_t Value::size() const { return json_->size(); }

Value Value::item(std::size_t i) const {
  WorkLimit::poll();
  return {(*json_)[i], path_.with(i), *report_};
}

std::optional<Value> Value::member(std::string_view key) const {
  const auto found = json_->find(key);
  if (found == json_->end()) {
    return std::nullopt;
  }
  return Value(*found, path_.with(found.key()), *report_);  // the key belongs to the document
}

std::vector<std::string> Value::keys() const {
  std::vector<std::string> result;
  for (const auto& member : json_->items()) {
    result.push_back(member.key());
  }
  return result;
}

void Value::report_type(std::string_view expected) const {
  report("wrong_type", "expected " + std::string(expected) + ", got " + json_->type_name());
}

void read(const Value& value, std::string& out) {
  if (value.is_string()) {
    out = value.json().get_ref<const std::string&>();
  } else {
    value.report_type("a string");
  }
}

void read(const Value& value, double& out) {
  set_unread(out);
  if (!value.is_number()) {
    value.report_type("a number");
  } else if (const double number = value.json().get<double>(); std::isfinite(number)) {
    out = number;
  } else {
    value.report("out_of_range", "the number must be finite");
  }
}

void read(const Value& value, bool& out) {
  if (value.json().is_boolean()) {
    out = value.json().get<bool>();
  } else {
    value.report_type("true or false");
  }
}

void read(const Value& value, int& out) {
  if (!value.is_number()) {
    value.report_type("an integer");
    return;
  }
  const double number = value.json().get<double>();  // exact up to 2^53, monotonic beyond
  if (!(std::floor(number) == number)) {
    value.report("wrong_type", "expected an integer, got " + checks::text(number));
  } else if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max()) {
    value.report("out_of_range", "the integer " + checks::text(number) + " is too large");
  } else {
    out = static_cast<int>(number);
  }
}

void read(const Value& value, std::array<double, 2>& out) {
  set_unread(out);
  if (!value.is_array() || value.size() != 2) {
    const std::string got =
        value.is_array() ? std::to_string(value.size()) + " elements" : value.json().type_name();
    value.report("wrong_type", "expected an array of two numbers, got " + got);
    return;
  }
  read(value.item(0), out[0]);
  read(value.item(1), out[1]);
}

std::optional<std::size_t> read_choice(const Value& value, std::span<const std::string_view> names) {
  if (!value.is_string()) {
    value.report_type("one of " + join(names));
    return std::nullopt;
  }
  const auto& written = value.json().get_ref<const std::string&>();
  const auto found = std::find(names.begin(), names.end(), written);
  if (found == names.end()) {
    value.report("unknown_value",
                 in_quotes(written) + " is not allowed here" + suggest(nearest_name(written, names), names));
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - names.begin());
}

Object::Object(const Value& value) : value_(value), readable_(value.is_object()) {
  if (!readable_) {
    value.report_type("an object");
  }
}

std::optional<Value> Object::find(std::string_view key) {
  known_.push_back(key);
  return readable_ ? value_.member(key) : std::nullopt;
}

std::optional<Value> Object::find_required(std::string_view key) {
  auto found = find(key);
  if (readable_ && !found) {
    value_.document_report().add(value_.pointer() + "/" + escape_pointer_token(key), "missing_field",
                                 std::string(key) + " is required");
  }
  return found;
}

void Object::finish() const {
  if (!readable_) {
    return;
  }
  for (const auto& member : value_.json().items()) {
    const std::string& key = member.key();
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) {
      continue;
    }
    std::string_view nearest = nearest_name(key, known_);
    // A field of other objects is reported as misplaced, unless its name begins a field name of this object.
    const auto owners =
        nearest.starts_with(key) ? std::vector<std::string>() : owners_of(key, value_.pointer());
    if (!owners.empty()) {
      nearest = "";
    }
    const std::string hint = owners.empty()
                                 ? suggest(nearest, known_)
                                 : "; " + in_quotes(key) + " is a field of " + join_with_and(owners);
    value_.document_report().add_unknown_field(
        value_.pointer() + "/" + escape_pointer_token(key),
        nearest.empty() ? "" : value_.pointer() + "/" + std::string(nearest),
        "unknown field " + in_quotes(key) + hint);
  }
}

}  // namespace snapthrough::api
