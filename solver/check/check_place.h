#pragma once
/// @file
/// The vocabulary of the checks: a place in the request, and the rules that many fields share.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "solver/check/check.h"
#include "solver/model/finding.h"
#include "solver/model/pointer.h"

namespace snapthrough::checks {

/// @brief A place in the request document that findings can be reported at. A small value, made on the way
/// down: `model / "members" / 3 / "section"`. Keys are referred to.
class Place {
 public:
  Place(PointerPath path, std::vector<Finding>& findings) : path_(std::move(path)), findings_(&findings) {}

  /// The member `key` of the object here.
  [[nodiscard]] Place operator/(std::string_view key) const { return {path_.with(key), *findings_}; }
  /// The element `index` of the array here.
  [[nodiscard]] Place operator/(std::size_t index) const { return {path_.with(index), *findings_}; }

  void report(std::string_view code, std::string detail) const;

  /// Last token of the pointer: how details name the field.
  [[nodiscard]] std::string name() const;

 private:
  PointerPath path_;
  std::vector<Finding>* findings_;
};

/// Shortest decimal form of a number.
[[nodiscard]] std::string text(double value);
/// An id in quotes, shortened when it is very long.
[[nodiscard]] std::string in_quotes(std::string_view id);

// Each reports when its rule is broken (NaN breaks every rule) and tells whether it holds.
bool require_finite(const Place& place, double value);
bool require_positive(const Place& place, double value);
bool require_not_negative(const Place& place, double value);
/// lo <= value <= hi
bool require_between(const Place& place, double value, double lo, double hi);
bool require_between(const Place& place, int value, int lo, int hi);
/// Two finite components that are not both zero.
bool require_direction(const Place& place, const std::array<double, 2>& direction);
/// 0 <= range[0] < range[1] <= 1
bool require_fractions(const Place& place, const std::array<double, 2>& range);
/// Finite, range[0] < range[1]
bool require_interval(const Place& place, const std::array<double, 2>& range);
bool require_count(const Place& place, std::size_t count, std::size_t max);

/// The ids of one kind ("node", ...) and where each was first used.
class Ids {
 public:
  explicit Ids(std::string kind) : kind_(std::move(kind)) {}

  /// Adds an id; reports one that is empty, too long, holds control characters or is there already.
  void add(const Place& place, std::string_view id);
  /// Reports an id that is not there.
  bool require(const Place& place, std::string_view id) const;
  [[nodiscard]] bool contains(std::string_view id) const { return first_.contains(std::string(id)); }
  /// Position of the entity in its list; the id must be there.
  [[nodiscard]] std::size_t index(std::string_view id) const { return first_.at(std::string(id)); }

 private:
  std::string kind_;
  std::size_t added_ = 0;
  std::unordered_map<std::string, std::size_t> first_;
};

}  // namespace snapthrough::checks
