#include "server/jobs/envelope.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/api.h"
#include "api/json_text.h"
#include "server/jobs/callback.h"
#include "solver/model/pointer.h"

namespace snapthrough::server {
namespace {

using nlohmann::json;

constexpr std::string_view kSpace = " \t\r\n";

/// Index after the value that begins at `at`. @pre the text is valid JSON
std::size_t end_of_value(std::string_view text, std::size_t at) {
  int depth = 0;
  bool in_string = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (in_string) {
      at += c == '\\' ? 1 : 0;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      if (depth == 0) {
        return at;
      }
      --depth;
    } else if (depth == 0 && c == ',') {
      return at;
    }
  }
  return at;
}

/// Text of the value of a member. @pre the text is a valid JSON object that has the member
std::string_view member_text(std::string_view text, std::string_view member) {
  std::size_t at = text.find('{') + 1;
  while (at < text.size()) {
    const std::size_t name = text.find('"', at);
    std::size_t name_end = name + 1;
    while (text[name_end] != '"') {
      name_end += text[name_end] == '\\' ? 2 : 1;
    }
    const std::size_t value = text.find_first_not_of(kSpace, text.find(':', name_end) + 1);
    const std::size_t end = end_of_value(text, value);
    // Names may have escapes, so they are compared after parsing.
    if (json::parse(text.substr(name, name_end + 1 - name)).get_ref<const std::string&>() == member) {
      const std::string_view found = text.substr(value, end - value);
      return found.substr(0, found.find_last_not_of(kSpace) + 1);
    }
    at = end + 1;
  }
  return {};
}

void check_text(const json& value, const std::string& pointer, std::size_t least, std::size_t most,
                std::vector<Finding>& findings) {
  if (!value.is_string()) {
    findings.push_back({pointer, "wrong_type", "expected a string"});
    return;
  }
  const std::size_t size = characters(value.get_ref<const std::string&>());
  if (size < least || size > most) {
    findings.push_back({pointer, "out_of_range",
                        "expected " + std::to_string(least) + " to " + std::to_string(most) +
                            " characters, got " + std::to_string(size)});
  }
}

void read_metadata(const json& value, Envelope& envelope) {
  std::vector<Finding>& findings = envelope.findings;
  if (!value.is_object()) {
    findings.push_back({"/metadata", "wrong_type", "expected an object of strings"});
    return;
  }
  if (value.size() > kMostMetadata) {
    findings.push_back({"/metadata", "too_many",
                        "expected at most " + std::to_string(kMostMetadata) + " members, got " +
                            std::to_string(value.size())});
    return;
  }
  for (const auto& [name, text] : value.items()) {
    const std::string pointer = "/metadata/" + escape_pointer_token(name);
    check_text(name, pointer, 1, kLongestMetadataName, findings);
    check_text(text, pointer, 0, kLongestMetadataValue, findings);
  }
  envelope.annotations.metadata = value.empty() ? "" : value.dump();
}

void read_callback(const json& value, const std::vector<std::string>& hosts, Envelope& envelope) {
  if (!value.is_string()) {
    envelope.findings.push_back({"/callback", "wrong_type", "expected a string"});
    return;
  }
  envelope.annotations.callback = value.get<std::string>();
  if (const auto finding = check_callback(envelope.annotations.callback, hosts)) {
    envelope.findings.push_back(*finding);
  }
}

/// Reads a member of an envelope other than the document.
void read_member(const std::string& name, const json& value, std::string_view member,
                 const std::vector<std::string>& callback_hosts, Envelope& envelope) {
  if (name == "label") {
    check_text(value, "/label", 1, kLongestLabel, envelope.findings);
    envelope.annotations.label = value.is_string() ? value.get<std::string>() : "";
  } else if (name == "metadata") {
    read_metadata(value, envelope);
  } else if (name == "callback") {
    read_callback(value, callback_hosts, envelope);
  } else {
    envelope.findings.push_back(
        {"/" + escape_pointer_token(name), "unknown_field",
         "beside \"" + std::string(member) + "\" there may be label, metadata and callback"});
  }
}

}  // namespace

Envelope open_envelope(std::string_view text, std::string_view member, const JobLimits& limits) {
  Envelope envelope;
  api::ParsedText parsed = api::parse_json(text, {.keys = limits.json_keys});
  if (parsed.document == nullptr) {
    envelope.malformed = true;
    envelope.findings = std::move(parsed.findings);
    return envelope;
  }
  envelope.text = text;
  if (!parsed.document->is_object() || !parsed.document->contains(member)) {
    envelope.document = std::move(parsed.document);
    return envelope;
  }
  for (const auto& [name, value] : parsed.document->items()) {
    if (envelope.findings.size() >= api::kMaxFindings) {
      envelope.findings.push_back(
          {"", "too_many_findings", "further members of the envelope are not listed"});
      break;
    }
    if (name != member) {
      read_member(name, value, member, limits.callback_hosts, envelope);
    }
  }
  envelope.pointer = "/" + std::string(member);
  envelope.text = member_text(text, member);
  envelope.document = std::make_shared<const json>(std::move(parsed.document->at(std::string(member))));
  return envelope;
}

std::vector<Finding> in_envelope(const Envelope& envelope, std::vector<Finding> findings) {
  for (Finding& finding : findings) {
    finding.pointer.insert(0, envelope.pointer);
  }
  findings.insert(findings.begin(), envelope.findings.begin(), envelope.findings.end());
  return findings;
}

}  // namespace snapthrough::server
