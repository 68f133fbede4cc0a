/// The tables of fields against the published schema, and what stores keep of them.

#include "api/result_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>

#include "api/field_json.h"
#include "api/openapi/document.h"
#include "api/stored_fields.h"

namespace snapthrough::api {
namespace {

using Schema = nlohmann::ordered_json;

const Schema& published() {
  static const Schema document = Schema::parse(openapi_document());
  return document;
}

/// The schema that a reference leads to.
const Schema& resolved(const Schema& schema) {
  const auto reference = schema.find("$ref");
  if (reference == schema.end()) return schema;
  return resolved(published().at(Schema::json_pointer(reference->get<std::string>().substr(1))));
}

/// Types of JSON values that a schema allows, and the schema of its objects and lists.
struct Allowed {
  explicit Allowed(const Schema& schema) { add(resolved(schema)); }
  std::set<std::string> types;
  const Schema* inside = nullptr;

 private:
  void add(const Schema& schema) {
    for (const char* choice : {"anyOf", "oneOf"}) {
      if (!schema.contains(choice)) continue;
      for (const Schema& one : schema.at(choice)) add(resolved(one));
    }
    if (!schema.contains("type")) return;
    const Schema& type = schema.at("type");
    for (const std::string one : type.is_array() ? type : Schema::array({type})) {
      types.insert(one);
      if (one == "object" || one == "array") inside = &schema;
    }
  }
};

/// The type inside a std::optional.
template <class T>
struct Inside {
  using Type = T;
};
template <class T>
struct Inside<std::optional<T>> {
  using Type = T;
};

template <class T>
void check_object(const Schema& schema, const std::string& where);

/// The value of a field, without its null.
template <class T>
void check_value(const Schema& schema, std::set<std::string> null, const std::string& where) {
  const Allowed allowed(schema);
  const auto expect = [&](const char* type) {
    null.insert(type);
    EXPECT_EQ(allowed.types, null) << where;
  };
  if constexpr (kIsOptional<T>) {
    null.insert("null");
    check_value<typename T::value_type>(schema, null, where);
  } else if constexpr (std::is_same_v<T, bool>) {
    expect("boolean");
  } else if constexpr (std::is_integral_v<T>) {
    expect("integer");
  } else if constexpr (std::is_arithmetic_v<T>) {
    expect("number");
  } else if constexpr (std::is_enum_v<T> || std::is_convertible_v<T, std::string_view>) {
    expect("string");
  } else if constexpr (kHasFields<T>) {
    expect("object");
    check_object<T>(*allowed.inside, where);
  } else if constexpr (requires(const typename T::value_type& one) { value_of_id(one); }) {
    expect("object");
    using Value = std::remove_cvref_t<decltype(value_of_id(std::declval<typename T::value_type>()))>;
    check_value<Value>(allowed.inside->at("additionalProperties"), {}, where + ".ID");
  } else if constexpr (has_key<typename T::value_type>()) {
    expect("object");
    check_value<typename T::value_type>(allowed.inside->at("additionalProperties"), {}, where + ".ID");
  } else {
    expect("array");
    if (allowed.inside->contains("items") && allowed.inside->at("items").is_object())
      check_value<typename T::value_type>(allowed.inside->at("items"), {}, where + "[]");
  }
}

/// Fields that documents have and tables do not.
bool is_written_apart(const std::string& where, const std::string& name) {
  static const std::set<std::string> kOfResult{"kind", "program", "request_sha256", "model"};
  return (where.empty() && kOfResult.contains(name)) || (where == ".diagnostics" && name == "wall_time_s");
}

template <class T>
void check_object(const Schema& schema, const std::string& where) {
  std::vector<std::string> published_names;
  for (const auto& [name, one] : schema.at("properties").items())
    if (!is_written_apart(where, name)) published_names.push_back(name);
  std::vector<std::string> names;
  const Schema required = schema.value("required", Schema::array());
  for_each_field<T>([&](const auto& one) {
    if constexpr (!FieldOf<decltype(one)>::is(kInternal) && !FieldOf<decltype(one)>::is(kKey)) {
      using Value = ValueOf<T, std::remove_cvref_t<decltype(one)>>;
      const std::string name(one.name);
      const std::string here = where + "." + name;
      names.push_back(name);
      ASSERT_TRUE(schema.at("properties").contains(name)) << here << " is not in api/openapi/openapi.json";
      const bool is_required = std::find(required.begin(), required.end(), name) != required.end();
      EXPECT_EQ(is_required, !one.is(kIfAny)) << here << " in the schema's list `required`";
      std::set<std::string> null;
      if (one.is(kCount)) null.insert("null");
      const Schema& property = schema.at("properties").at(name);
      EXPECT_EQ(property.value("x-column", true), !one.is(kNoColumn)) << here;
      // what is absent where it is empty has no null, but for koiter, which tells two kinds of emptiness
      // apart
      constexpr bool is_never_null =
          FieldOf<decltype(one)>::is(kIfAny) && !std::is_same_v<Value, std::optional<KoiterCoefficients>>;
      using Present = std::conditional_t<is_never_null, typename Inside<Value>::Type, Value>;
      check_value<Present>(property, null, here);
    }
  });
  EXPECT_EQ(names, published_names) << where << ": names, or their order, differ from the schema's";
}

TEST(ResultFields, AreThoseOfThePublishedSchema) {
  check_object<Result>(published().at("components").at("schemas").at("Result"), "");
}

TEST(StoredFields, ThoseOfALaterVersionArePassedOver) {
  CriticalPoint point;
  read_stored_fields(R"({"field of a later version": [1]})", point);
  EXPECT_EQ(stored_fields(point), stored_fields(CriticalPoint{}));
}

TEST(StoredFields, DamagedTextsAreRefused) {
  CriticalPoint point;
  Branch branch;
  for (const char* text : {"", "{", "[1]", "{\"a\": }"}) {
    EXPECT_THROW(read_stored_fields(text, point), std::runtime_error) << text;
    EXPECT_THROW(read_stored_fields(text, branch), std::runtime_error) << text;
  }
}

}  // namespace
}  // namespace snapthrough::api
