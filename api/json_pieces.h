#pragma once
/// @file
/// One member of a JSON document that comes in pieces, without the rest of it in memory.

#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace snapthrough::api {

/// What is taken of the member.
enum class JsonPart { value, elements };

/// @brief Cuts the text of one member, or of each element of its array, out of a JSON object.
/// @pre the pieces together are valid JSON; names of members at the top have no escapes
class JsonPieces {
 public:
  JsonPieces(std::string member, JsonPart part) : member_(std::move(member)), level_(level_of(part)) {}

  void append(std::string_view piece);
  /// The next value that is complete, or nothing yet.
  [[nodiscard]] std::optional<std::string> next();
  /// Memory that is kept, about.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  /// Depth of brackets at which values are separated.
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
  bool wanted_ = false;  ///< within the member
  std::string name_;     ///< the last text at the top
  std::string value_;    ///< what is known of the next value
  std::deque<std::string> complete_;
};

}  // namespace snapthrough::api
