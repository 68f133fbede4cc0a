#pragma once
/// @file
/// Names of enumeration values: one table for each enumeration, used by documents, rows of the store and
/// queries.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "solver/model/analysis.h"
#include "solver/result.h"

namespace snapthrough::api {

/// A name in documents, and its value.
template <class E>
struct Named {
  std::string_view name;
  E value;
};

inline constexpr Named<AnalysisType> kAnalysisTypes[] = {{"buckling", AnalysisType::buckling},
                                                         {"critical", AnalysisType::critical},
                                                         {"path", AnalysisType::path},
                                                         {"static", AnalysisType::static_},
                                                         {"vibration", AnalysisType::vibration}};
inline constexpr Named<CriticalType> kCriticalTypes[] = {
    {"bifurcation", CriticalType::bifurcation}, {"limit_max", CriticalType::limit_max},
    {"limit_min", CriticalType::limit_min},     {"broken_bifurcation", CriticalType::broken_bifurcation},
    {"flutter", CriticalType::flutter},         {"capacity", CriticalType::capacity}};
inline constexpr Named<CriticalCause> kCriticalCauses[] = {{"smooth", CriticalCause::smooth},
                                                           {"contact", CriticalCause::contact},
                                                           {"massless", CriticalCause::massless}};

inline constexpr Named<NoDerivative> kNoDerivatives[] = {
    {"breaks_bifurcation", NoDerivative::breaks_bifurcation},
    {"contact", NoDerivative::contact},
    {"multiple", NoDerivative::multiple},
    {"unsymmetric", NoDerivative::unsymmetric},
    {"not_differentiable", NoDerivative::not_differentiable},
    {"not_found", NoDerivative::not_found}};

inline constexpr Named<BifurcationKind> kBifurcationKinds[] = {
    {"asymmetric", BifurcationKind::asymmetric},
    {"stable_symmetric", BifurcationKind::stable_symmetric},
    {"unstable_symmetric", BifurcationKind::unstable_symmetric}};

/// States that a request selects by a name.
inline constexpr Named<StateOutput> kStateOutputs[] = {
    {"none", StateOutput::none}, {"critical", StateOutput::critical}, {"all", StateOutput::all}};

inline constexpr Named<Fibre> kFibres[] = {{"left", Fibre::left}, {"right", Fibre::right}};

/// Table of the names of an enumeration.
template <class E>
inline constexpr auto kNamesOf = nullptr;
template <>
inline constexpr const auto& kNamesOf<CriticalType> = kCriticalTypes;
template <>
inline constexpr const auto& kNamesOf<CriticalCause> = kCriticalCauses;
template <>
inline constexpr const auto& kNamesOf<NoDerivative> = kNoDerivatives;
template <>
inline constexpr const auto& kNamesOf<BifurcationKind> = kBifurcationKinds;
template <>
inline constexpr const auto& kNamesOf<Fibre> = kFibres;

/// Returns the name of a value. @throws std::invalid_argument when the table lacks the value
template <class E, std::size_t n>
[[nodiscard]] constexpr std::string_view name_of(const Named<E> (&table)[n], E value) {
  for (const Named<E>& row : table) {
    if (row.value == value) {
      return row.name;
    }
  }
  throw std::invalid_argument("an enumeration has a value without a name");
}

/// Returns the value with a name; nullopt when the table lacks the name.
template <class E, std::size_t n>
[[nodiscard]] constexpr std::optional<E> value_of(const Named<E> (&table)[n], std::string_view name) {
  const auto* row =
      std::find_if(std::begin(table), std::end(table), [&](const Named<E>& one) { return one.name == name; });
  return row == std::end(table) ? std::nullopt : std::optional<E>(row->value);
}

/// Returns the largest value of a table.
template <class E, std::size_t n>
[[nodiscard]] constexpr E last_of(const Named<E> (&table)[n]) {
  return std::max_element(std::begin(table), std::end(table),
                          [](const Named<E>& a, const Named<E>& b) { return a.value < b.value; })
      ->value;
}

/// Returns all names for a message: "a, b, c".
template <class E, std::size_t n>
[[nodiscard]] std::string names_in(const Named<E> (&table)[n]) {
  std::string all;
  for (const Named<E>& row : table) {
    all.append(all.empty() ? "" : ", ").append(row.name);
  }
  return all;
}

}  // namespace snapthrough::api
