#pragma once
/// @file
/// Places in the request, and rules that several fields share.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "solver/model/finding.h"
#include "solver/model/pointer.h"

namespace snapthrough::checks {

/// @brief Place in the request for findings: `model / "members" / 3 / "section"`. Keys are kept by reference.
class Place {
 public:
  Place(PointerPath path, std::vector<Finding>& findings) : path_(std::move(path)), findings_(&findings) {}

  /// Member `key` of the object at this place.
  [[nodiscard]] Place operator/(std::string_view key) const { return {path_.with(key), *findings_}; }
  /// Element `index` of the array at this place.
  [[nodiscard]] Place operator/(std::size_t index) const { return {path_.with(index), *findings_}; }

  void report(std::string_view code, std::string detail) const;

  /// Last token of the pointer, which names the field in messages.
  [[nodiscard]] std::string name() const;

 private:
  PointerPath path_;
  std::vector<Finding>* findings_;
};

/// Shortest decimal representation of a number.
[[nodiscard]] std::string text(double value);
/// Id in quotes, shortened if very long.
[[nodiscard]] std::string in_quotes(std::string_view id);
/// Number of code points of a UTF-8 text.
[[nodiscard]] std::size_t characters(std::string_view text);

// Each function returns whether its rule holds, and reports a finding if not. NaN breaks every rule.
bool require_finite(const Place& place, double value);
bool require_positive(const Place& place, double value);
bool require_not_negative(const Place& place, double value);
/// Requires lo <= value <= hi.
bool require_between(const Place& place, double value, double lo, double hi);
bool require_between(const Place& place, int value, int lo, int hi);
/// Requires a fraction in [0, 1] that exceeds the one before it.
/// @param previous the fraction before; below -kMinRelativeChord for the first one
bool require_next_fraction(const Place& place, double fraction, double previous);
/// Requires two finite components that are not both zero.
bool require_direction(const Place& place, const std::array<double, 2>& direction);
/// Requires 0 <= range[0] < range[1] <= 1.
bool require_fractions(const Place& place, const std::array<double, 2>& range);
/// Requires finite range[0] < range[1].
bool require_interval(const Place& place, const std::array<double, 2>& range);
bool require_count(const Place& place, std::size_t count, std::size_t max);

/// Ids of one kind ("node", ...), with their positions.
class Ids {
 public:
  explicit Ids(std::string kind) : kind_(std::move(kind)) {}

  /// Adds an id; reports ids that are empty, too long, contain control characters, or exist already.
  void add(const Place& place, std::string_view id);
  /// Reports an unknown id.
  bool require(const Place& place, std::string_view id) const;
  [[nodiscard]] bool contains(std::string_view id) const { return first_.contains(std::string(id)); }
  /// Position of the object in its list. @pre the id exists
  [[nodiscard]] std::size_t index(std::string_view id) const { return first_.at(std::string(id)); }

 private:
  std::string kind_;
  std::size_t added_ = 0;
  std::unordered_map<std::string, std::size_t> first_;
};

}  // namespace snapthrough::checks
