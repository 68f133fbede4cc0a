#pragma once
/// @file
/// Reading of documents that nobody has checked: each value knows where it stands, and a wrong one is a
/// PlotError with its pointer.

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/pointer.h"

namespace snapthrough::api::plot {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  ///< a value that is not there

/// @brief A value of a document. Refers to the document, which must outlive it.
///
/// Numbers are finite and at most 1e100 in size, so that no product of two of them overflows; those below
/// 1e-100 are read as zero.
class Field {
 public:
  explicit Field(const nlohmann::json& value, PointerPath place = PointerPath())
      : value_(&value), place_(std::move(place)) {}

  [[nodiscard]] const nlohmann::json& json() const { return *value_; }
  [[nodiscard]] std::string pointer() const { return place_.text(); }
  [[noreturn]] void fail(const std::string& rule) const;

  /// A member of an object, which must be there.
  [[nodiscard]] Field at(std::string_view key) const;
  /// A member of an object; nothing where it is absent or null.
  [[nodiscard]] std::optional<Field> find(std::string_view key) const;
  /// An item of a list. @pre index < size()
  [[nodiscard]] Field item(std::size_t index) const;
  /// Number of items of a list.
  [[nodiscard]] std::size_t size() const;

  /// Members of an object, in the order of their names.
  [[nodiscard]] std::vector<std::pair<std::string, Field>> members() const;

  [[nodiscard]] double number() const;
  /// kNone where it is null.
  [[nodiscard]] double number_or_none() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool flag() const;
  [[nodiscard]] std::size_t index() const;
  [[nodiscard]] std::vector<double> numbers() const;
  [[nodiscard]] std::vector<double> numbers_or_none() const;
  /// numbers() of a list that must have so many.
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;
  /// numbers() that must not decrease.
  [[nodiscard]] std::vector<double> increasing() const;

 private:
  void need_object() const;
  const nlohmann::json* value_;
  PointerPath place_;
};

/// The member's number, or what stands for it where it is absent.
[[nodiscard]] double number_or(const Field& object, std::string_view key, double otherwise);
/// The text of a member of an object, or a default where the object has no such member.
[[nodiscard]] std::string text_or(const Field& object, std::string_view key, std::string_view otherwise);

}  // namespace snapthrough::api::plot
