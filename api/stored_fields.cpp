#include "api/stored_fields.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "api/field_json.h"
#include "api/names.h"
#include "api/result_fields.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

template <class T>
std::optional<std::string> write(const T& object) {
  Json json = Json::object();
  for_each_field<T>([&](const auto& one) {
    if constexpr (FieldOf<decltype(one)>::is(kStored)) {
      if (!is_left_out(one, object.*one.get)) json.emplace(one.name, field_json(object.*one.get));
    }
  });
  return json.empty() ? std::nullopt : std::optional(json.dump());
}

template <class T>
void read(const Json& json, T& value);

/// The inverse of value_of_id().
template <class T>
void read_by_id(const std::string& id, const Json& json, T& one) {
  one.id = id;
  if constexpr (std::is_same_v<T, NamedValue>) {
    read(json, one.value);
  } else {
    read(json, one.values);
  }
}

/// The inverse of field_json() for the types that stored fields have.
template <class T>
void read(const Json& json, T& value) {
  if constexpr (kIsOptional<T>) {
    value.reset();
    if (!json.is_null()) read(json, value.emplace());
  } else if constexpr (std::is_enum_v<T>) {
    value = value_of(kNamesOf<T>, json.get_ref<const std::string&>()).value();
  } else if constexpr (kIsVector<T>) {
    value.clear();
    for (const auto& item : json.items()) {
      if constexpr (requires { value_of_id(value.front()); }) {
        read_by_id(item.key(), item.value(), value.emplace_back());
      } else {
        read(item.value(), value.emplace_back());
      }
    }
  } else if constexpr (kHasFields<T>) {
    for_each_field<T>([&](const auto& one) {
      if (json.contains(one.name)) read(json.at(std::string(one.name)), value.*one.get);
    });
  } else {
    json.get_to(value);
  }
}

template <class T>
void read_stored(std::string_view text, T& object) try {
  const Json json = Json::parse(text);
  if (!json.is_object()) throw std::invalid_argument("they are no object");
  for_each_field<T>([&](const auto& one) {
    if constexpr (FieldOf<decltype(one)>::is(kStored)) {
      if (json.contains(one.name)) read(json.at(std::string(one.name)), object.*one.get);
    }
  });
} catch (const std::exception& error) {
  throw std::runtime_error(std::string("the stored fields are damaged: ") + error.what());
}

}  // namespace

std::optional<std::string> stored_fields(const CriticalPoint& point) { return write(point); }
std::optional<std::string> stored_fields(const Branch& branch) { return write(branch); }
void read_stored_fields(std::string_view json, CriticalPoint& point) { read_stored(json, point); }
void read_stored_fields(std::string_view json, Branch& branch) { read_stored(json, branch); }

}  // namespace snapthrough::api
