#pragma once
/// @file
/// Group codes and entities of ASCII drawings (DXF).

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/finding.h"

namespace snapthrough::api::convert {

/// A group: a code that says what the value means, on two lines of the file.
struct Group {
  int code = 0;
  std::string_view value;  ///< without blanks at its ends
  std::size_t line = 0;    ///< line of the value
};

/// Groups from a code 0 to the next.
struct Entity {
  std::string_view type;  ///< such as "LINE"
  std::size_t line = 0;   ///< line of the type
  std::vector<Group> groups;

  /// Returns the first value of a code, or a default.
  [[nodiscard]] std::string_view text(int code, std::string_view otherwise) const;
  /// Returns the first number of a code, or a default; reports a value that is no number.
  double number(int code, std::optional<double> otherwise, std::vector<Finding>& findings) const;
};

/// Returns a finding at a line of the file.
[[nodiscard]] Finding finding_at(std::size_t line, std::string_view code, std::string detail);

/// Returns the number of a group that is at most kMaxMagnitude; reports others and returns 0.
double number_of(const Group& group, std::vector<Finding>& findings);

/// @brief Returns the entities of the section ENTITIES. The text must outlive them.
///
/// Reports binary drawings, text that is not UTF-8, lines that are no groups, and a missing or unfinished
/// section.
[[nodiscard]] std::vector<Entity> read_entities(std::string_view text, std::vector<Finding>& findings);

}  // namespace snapthrough::api::convert
