#include "api/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "solver/model/pointer.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

/// Number of duplicate keys after which reading stops.
constexpr std::size_t kMaxDuplicates = 100;

/// Returns line, column and byte of a position. `byte` counts from 1; past the end means truncated text.
std::string describe_position(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t last_break = before.rfind('\n');
  const std::size_t column = before.size() - (last_break == std::string_view::npos ? 0 : last_break + 1) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column) + " (byte " +
         std::to_string(byte) + ")";
}

/// Returns the parser's message without internal codes, in printable ASCII, at most 300 characters.
std::string clean_message(std::string_view message) {
  constexpr std::size_t kMaxLength = 300;
  const auto drop_through = [&message](std::string_view mark) {
    if (const std::size_t at = message.find(mark); at != std::string_view::npos) {
      message.remove_prefix(at + mark.size());
    }
  };
  drop_through("] ");
  if (message.starts_with("parse error at ")) {
    drop_through(": ");
  }
  std::string cleaned(message.substr(0, kMaxLength));
  std::replace_if(
      cleaned.begin(), cleaned.end(), [](char c) { return c < 0x20 || c > 0x7E; }, '?');
  return cleaned;
}

/// Builds a document from parser events and stops at the limits. Nesting uses heap memory, not stack.
class DocumentBuilder {
 public:
  DocumentBuilder(std::string_view text, const ParseLimits& limits) : text_(text), limits_(limits) {}

  // Event handlers with the signatures of nlohmann::json::sax_parse; false stops the parser.
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(Json::number_integer_t value) { return add(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name);
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error);
  /// Refuses the text for the byte zero at an index: the parser takes it for the end of the text.
  void refuse_zero_byte(std::size_t index) {
    report("malformed", describe_position(text_, index + 1) + ": a byte zero, which is not in JSON");
  }

  ParsedText take();

 private:
  /// An incomplete array or object, and the key of its next member.
  struct Open {
    Json* container;
    std::string key;
  };

  bool add(Json value) { return place(std::move(value)) != nullptr; }
  bool open(Json container);
  bool close() {
    open_.pop_back();
    return true;
  }
  Json* place(Json value);
  void report(std::string_view code, std::string detail) {
    findings_.push_back({pointer(), std::string(code), std::move(detail)});
  }
  [[nodiscard]] std::string pointer() const;

  std::string_view text_;
  ParseLimits limits_;
  std::shared_ptr<Json> root_ = std::make_shared<Json>();
  std::vector<Open> open_;
  std::vector<Finding> findings_;
  std::size_t values_ = 0;
  std::size_t keys_ = 0;
};

std::string DocumentBuilder::pointer() const {
  std::string result;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const Open& in = open_[i];
    const std::size_t open_child = i + 1 < open_.size() ? 1 : 0;  // an open child is in its array already
    result += '/';
    result += in.container->is_array() ? std::to_string(in.container->size() - open_child)
                                       : escape_pointer_token(in.key);
  }
  return result;
}

Json* DocumentBuilder::place(Json value) {
  if (++values_ > limits_.values) {
    report("too_many_values", "a document has at most " + std::to_string(limits_.values) + " values");
    return nullptr;
  }
  if (open_.empty()) {
    *root_ = std::move(value);
    return root_.get();
  }
  const Open& in = open_.back();
  if (in.container->is_array()) {
    in.container->push_back(std::move(value));
    return &in.container->back();
  }
  Json& slot = (*in.container)[in.key];
  slot = std::move(value);
  return &slot;
}

bool DocumentBuilder::open(Json container) {
  if (open_.size() >= static_cast<std::size_t>(limits_.depth)) {
    report("too_deep", "arrays and objects are nested more than " + std::to_string(limits_.depth) + " deep");
    return false;
  }
  Json* const placed = place(std::move(container));
  if (placed != nullptr) {
    open_.push_back({placed, {}});
  }
  return placed != nullptr;
}

bool DocumentBuilder::key(std::string& name) {
  open_.back().key = name;
  if (++keys_ > limits_.keys) {
    report("too_many_keys", "a document has at most " + std::to_string(limits_.keys) + " keys (json_keys)");
    return false;
  }
  if (open_.back().container->contains(name)) {
    report("duplicate_key", "the key is there twice in one object");
  }
  return findings_.size() < kMaxDuplicates;
}

bool DocumentBuilder::parse_error(std::size_t position, const std::string&, const Json::exception& error) {
  report("malformed", describe_position(text_, position) + ": " + clean_message(error.what()));
  return false;
}

ParsedText DocumentBuilder::take() {
  if (!findings_.empty()) {
    return {nullptr, std::move(findings_)};
  }
  return {std::move(root_), {}};
}

}  // namespace

ParsedText parse_json(std::string_view text, const ParseLimits& limits) {
  DocumentBuilder builder(text, limits);
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    builder.refuse_zero_byte(zero);
  } else {
    Json::sax_parse(text.begin(), text.end(), &builder);
  }
  return builder.take();
}

}  // namespace snapthrough::api
