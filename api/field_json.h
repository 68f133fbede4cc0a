#pragma once
/// @file
/// Values of tables of fields as JSON. For sources alone: it includes the whole JSON library.

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "api/fields.h"
#include "api/names.h"
#include "solver/result.h"

namespace snapthrough::api {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;

template <class T>
[[nodiscard]] nlohmann::json field_json(const T& value);

/// Whether a document leaves a field out because it is kIfAny and empty.
template <class AnyField, class T>
[[nodiscard]] bool is_left_out(const AnyField& /*field*/, const T& value) {
  if constexpr (!AnyField::is(kIfAny)) {
    return false;
  } else if constexpr (kIsVector<T>) {
    return value.empty();
  } else {
    return !value.has_value();
  }
}

/// Every field of an object.
struct All {
  bool operator()(std::string_view /*name*/) const { return true; }
};

/// @brief A JSON object with the fields of T's table, without internal ones and the key.
/// @param wanted whether to write the field of that name
template <class T, class Wanted = All>
[[nodiscard]] nlohmann::json object_json(const T& object, const Wanted& wanted = {}) {
  nlohmann::json json = nlohmann::json::object();
  for_each_field<T>([&](const auto& one) {
    if constexpr (!FieldOf<decltype(one)>::is(kInternal) && !FieldOf<decltype(one)>::is(kKey)) {
      if (!wanted(one.name)) return;
      const auto& value = std::invoke(one.get, object);
      if (is_left_out(one, value)) return;
      if constexpr (FieldOf<decltype(one)>::is(kCount)) {
        json.emplace(one.name, value < 0 ? nlohmann::json(nullptr) : nlohmann::json(value));
      } else {
        json.emplace(one.name, field_json(value));
      }
    }
  });
  return json;
}

inline const std::vector<double>& value_of_id(const NamedSeries& one) { return one.values; }
inline double value_of_id(const NamedValue& one) { return one.value; }

/// A list: a JSON object by id where its elements have a key or are named, else an array.
template <class T>
[[nodiscard]] nlohmann::json list_json(const std::vector<T>& list) {
  if constexpr (requires(const T& one) { value_of_id(one); }) {
    nlohmann::json json = nlohmann::json::object();
    for (const T& one : list) json[one.id] = value_of_id(one);
    return json;
  } else if constexpr (has_key<T>()) {
    nlohmann::json json = nlohmann::json::object();
    for (const T& one : list) {
      for_each_field<T>([&](const auto& field) {
        if constexpr (FieldOf<decltype(field)>::is(kKey))
          json[std::invoke(field.get, one)] = object_json(one);
      });
    }
    return json;
  } else {
    nlohmann::json json = nlohmann::json::array();
    for (const T& one : list) json.push_back(field_json(one));
    return json;
  }
}

/// null for an empty std::optional, the name for an enumeration.
template <class T>
[[nodiscard]] nlohmann::json field_json(const T& value) {
  if constexpr (kIsOptional<T>) {
    return value ? field_json(*value) : nlohmann::json(nullptr);
  } else if constexpr (kHasFields<T>) {
    return object_json(value);
  } else if constexpr (std::is_enum_v<T>) {
    return name_of(kNamesOf<T>, value);
  } else if constexpr (kIsVector<T>) {
    if constexpr (std::is_arithmetic_v<typename T::value_type>) return value;
    return list_json(value);
  } else {
    return value;
  }
}

}  // namespace snapthrough::api
