#pragma once
/// @file
/// Tables of fields: one line for each member of a type. What writes, reads, sends or stores the type follows
/// its table. The tables of a result are in api/result_fields.h.

#include <cstddef>
#include <functional>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace snapthrough::api {

/// What is special about a field; several traits are joined by |.
enum Trait : unsigned {
  kPlain = 0,
  kCount = 1,      ///< a negative number means not counted; documents have null then
  kIfAny = 2,      ///< absent from documents where it is empty
  kKey = 4,        ///< the id of the object; a list of such objects is a JSON object by id
  kInternal = 8,   ///< documents do not have it
  kNoColumn = 16,  ///< CSV tables do not have it
  kSent = 32,      ///< a runner sends it to the service beside the result document
  /// A runner sends it, and stores keep it in the JSON column `fields` of the object's row. Fields that have
  /// a column of their own in the stores are only kSent.
  kStored = kSent | 64
};

/// @brief A field of a document: its name and what gives its value.
/// @tparam Get a pointer to a member, or a function of the object
template <unsigned traits, class Get>
struct Field {
  std::string_view name;
  Get get;

  [[nodiscard]] static constexpr bool is(unsigned trait) { return (traits & trait) == trait; }
};

/// Type of a field that a visitor takes by reference. Its traits are constants:
/// FieldOf<decltype(one)>::is(kKey); clang 16 takes one.is(kKey) for no constant.
template <class Reference>
using FieldOf = std::remove_cvref_t<Reference>;

template <unsigned traits = kPlain, class Get>
[[nodiscard]] constexpr Field<traits, Get> field(std::string_view name, Get get) {
  return {name, get};
}

/// A member that documents do not have.
template <class Get>
[[nodiscard]] constexpr Field<kInternal, Get> internal(Get get) {
  return {"", get};
}

/// The fields of a type as a std::tuple of Field, in the order of the published schema; nullptr: no table.
template <class T>
inline constexpr auto kFields = nullptr;

template <class T>
inline constexpr bool kHasFields = !std::is_same_v<const std::nullptr_t, decltype(kFields<T>)>;

/// Calls visit(field) for each field of T in the order of the table.
template <class T, class Visit>
constexpr void for_each_field(const Visit& visit) {
  std::apply([&](const auto&... one) { (visit(one), ...); }, kFields<T>);
}

/// Type of the value that a field of T has.
template <class T, class AnyField>
using ValueOf = std::remove_cvref_t<std::invoke_result_t<decltype(AnyField::get), const T&>>;

/// Whether the objects of a list of T are named by one of their fields.
template <class T>
[[nodiscard]] constexpr bool has_key() {
  bool found = false;
  if constexpr (kHasFields<T>) for_each_field<T>([&](const auto& one) { found = found || one.is(kKey); });
  return found;
}

/// Converts to every type, for counting the members of an aggregate.
struct AnyValue {
  template <class T>
  operator T() const noexcept;  // NOLINT(google-explicit-constructor)
};

/// How many members an aggregate has: as many as it can be initialised with.
template <class T, class... Values>
[[nodiscard]] consteval std::size_t member_count() {
  if constexpr (requires { T{Values{}..., AnyValue{}}; }) {
    return member_count<T, Values..., AnyValue>();
  } else {
    return sizeof...(Values);
  }
}

/// Whether the table of T has a line for every member of T.
template <class T>
[[nodiscard]] consteval bool has_every_member() {
  std::size_t members = 0;
  for_each_field<T>([&](const auto& one) { members += std::is_member_object_pointer_v<decltype(one.get)>; });
  return members == member_count<T>();
}

}  // namespace snapthrough::api
