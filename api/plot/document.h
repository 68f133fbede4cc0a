#pragma once
/// @file
/// Reader of unchecked JSON documents; an invalid value throws PlotError with the value's JSON Pointer.

#include <array>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/pointer.h"

namespace snapthrough::api::plot {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  ///< absent or null number

/// @brief A JSON value with its JSON Pointer. Refers to the document, which must outlive the Field.
///
/// A reader throws PlotError for a value of another type. Numbers must be finite and at most 1e100 in size,
/// so that no product of two overflows; numbers below 1e-100 in size read as zero.
class Field {
 public:
  explicit Field(const nlohmann::json& value, PointerPath place = PointerPath())
      : value_(&value), place_(std::move(place)) {}

  [[nodiscard]] const nlohmann::json& json() const { return *value_; }
  [[nodiscard]] std::string pointer() const { return place_.text(); }
  [[noreturn]] void fail(const std::string& rule) const;

  /// Returns a member of an object. @throws PlotError when the member is absent
  [[nodiscard]] Field at(std::string_view key) const;
  /// Returns a member of an object; nullopt when the member is absent or null.
  [[nodiscard]] std::optional<Field> find(std::string_view key) const;
  /// Returns an item of a list; polls WorkLimit. @pre index < size()
  [[nodiscard]] Field item(std::size_t index) const;
  /// Returns the number of items of a list.
  [[nodiscard]] std::size_t size() const;

  /// Returns name and value of each member of an object, sorted by name.
  [[nodiscard]] std::vector<std::pair<std::string, Field>> members() const;

  [[nodiscard]] double number() const;
  /// Returns number(), or kNone for null.
  [[nodiscard]] double number_or_none() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool flag() const;
  [[nodiscard]] std::size_t index() const;
  [[nodiscard]] std::vector<double> numbers() const;
  [[nodiscard]] std::vector<double> numbers_or_none() const;
  /// Returns numbers(). @throws PlotError when the list does not have `count` items
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;
  /// Returns numbers(). @throws PlotError when an item is less than the item before it
  [[nodiscard]] std::vector<double> increasing() const;

 private:
  void need_object() const;
  const nlohmann::json* value_;
  PointerPath place_;
};

/// Returns the number of a member of an object, or `otherwise` when the member is absent or null.
[[nodiscard]] double number_or(const Field& object, std::string_view key, double otherwise);
/// Returns the text of a member of an object, or `otherwise` when the member is absent or null.
[[nodiscard]] std::string text_or(const Field& object, std::string_view key, std::string_view otherwise);

/// Returns the optional `range` of an object, two increasing fractions of a member's length; all of it when
/// absent.
[[nodiscard]] std::array<double, 2> range_or_all(const Field& object);

}  // namespace snapthrough::api::plot
