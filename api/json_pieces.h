#pragma once
/// @file
/// Extracts one member of a JSON document that arrives in pieces, without holding the rest in memory.

#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::api {

/// Extract the member's whole value, or each element of its array.
enum class JsonPart { value, elements };

/// @brief Extracts the text of one member of a JSON object, or of each element of the member's array.
/// @pre the pieces together are valid JSON, and names of the object's members contain no escapes
class JsonPieces {
 public:
  JsonPieces(std::string member, JsonPart part) : member_(std::move(member)), level_(level_of(part)) {}

  void append(std::string_view piece);
  /// Returns the next complete value; nullopt until it is complete.
  [[nodiscard]] std::optional<std::string> next();
  /// Returns the approximate memory in use, in bytes.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  /// Returns the nesting depth at which values are separated.
  static int level_of(JsonPart part) { return part == JsonPart::value ? 1 : 2; }
  [[nodiscard]] bool inside() const { return wanted_ && depth_ >= level_; }
  void take(char c);
  void take_in_string(char c);
  void keep(char c);
  void complete();

  const std::string member_;
  const int level_;
  int depth_ = 0;
  bool in_string_ = false;
  bool escaped_ = false;
  bool wanted_ = false;  ///< the read position is inside the member
  std::string name_;     ///< last text at depth 1
  std::string value_;    ///< incomplete text of the next value
  std::deque<std::string> complete_;
};

}  // namespace snapthrough::api
