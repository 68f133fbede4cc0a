#pragma once
/// @file
/// JSON Schema 2020-12, as far as the published document uses it.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

namespace snapthrough::server::test {

/// @brief Checks instances against the schemas of an OpenAPI document, and makes instances of them.
/// A keyword that is not known throws: nothing is passed over in silence.
class Schemas {
 public:
  using json = nlohmann::json;
  explicit Schemas(const json& document) : document_(document) {}

  [[nodiscard]] json named(const std::string& name) const {
    return {{"$ref", "#/components/schemas/" + name}};
  }

  [[nodiscard]] bool valid(const json& schema, const json& value) const {
    bool good = true;
    for (const auto& [keyword, rule] : schema.items()) {
      good = good && holds(schema, keyword, rule, value);
    }
    return good;
  }

  /// A random instance; small, so that most stay readable.
  [[nodiscard]] json make(const json& schema, std::mt19937& random) const {
    const auto pick = [&](std::size_t count) { return random() % count; };
    if (schema.contains("$ref")) {
      return make(resolve(schema["$ref"]), random);
    }
    if (schema.contains("const")) {
      return schema["const"];
    }
    for (const char* choice : {"enum", "oneOf", "anyOf"}) {
      if (schema.contains(choice)) {
        const json& one = schema[choice][pick(schema[choice].size())];
        return std::string(choice) == "enum" ? one : make(one, random);
      }
    }
    const std::string type = schema["type"];
    if (type == "object") {
      return make_object(schema, random);
    }
    if (type == "array") {
      json list = json::array();
      const std::size_t least = schema.value("minItems", 0U);
      const std::size_t count = schema.contains("maxItems") ? least : least + pick(3);
      for (std::size_t i = 0; i < count; ++i) {
        json item = make(schema["items"], random);
        if (!schema.contains("uniqueItems") || std::find(list.begin(), list.end(), item) == list.end()) {
          list.push_back(std::move(item));
        }
      }
      return list;
    }
    if (type == "string") {
      return std::string(1, static_cast<char>('a' + pick(6)));
    }
    return type == "integer" ? json(static_cast<int>(pick(20)))
                             : json(static_cast<double>(pick(2000)) / 7.0 - 50.0);
  }

 private:
  [[nodiscard]] const json& resolve(const std::string& reference) const {
    return document_.at(json::json_pointer(reference.substr(1)));
  }

  [[nodiscard]] json make_object(const json& schema, std::mt19937& random) const {
    json object = json::object();
    const json required = schema.value("required", json::array());
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, part] : properties.items()) {
      if (random() % 2 == 0 || std::find(required.begin(), required.end(), name) != required.end()) {
        object[name] = make(part, random);
      }
    }
    if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
      object["m"] = make(schema["additionalProperties"], random);
    }
    const json dependent = schema.value("dependentRequired", json::object());
    for (const auto& [name, needed] : dependent.items()) {
      if (object.contains(name)) {
        for (const auto& other : needed) {
          object[other.get<std::string>()] = make(schema["properties"][other.get<std::string>()], random);
        }
      }
    }
    return object;
  }

  static bool has_type(const std::string& type, const json& value) {
    if (type == "integer") {
      return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
    }
    return type == "number" ? value.is_number() : type == value.type_name();
  }

  [[nodiscard]] std::size_t count_valid(const json& schemas, const json& value) const {
    return static_cast<std::size_t>(
        std::count_if(schemas.begin(), schemas.end(), [&](const json& one) { return valid(one, value); }));
  }

  [[nodiscard]] bool holds(const json& schema, const std::string& keyword, const json& rule,
                           const json& value) const {
    static const std::set<std::string> kNotes{"description", "format", "default"};
    if (keyword == "$ref") {
      return valid(resolve(rule), value);
    }
    if (keyword == "type") {
      return has_type(rule, value);
    }
    if (keyword == "const") {
      return value == rule;
    }
    if (keyword == "enum") {
      return std::find(rule.begin(), rule.end(), value) != rule.end();
    }
    if (keyword == "oneOf") {
      return count_valid(rule, value) == 1;
    }
    if (keyword == "anyOf") {
      return count_valid(rule, value) > 0;
    }
    if (keyword == "minimum") {
      return !value.is_number() || value >= rule;
    }
    if (keyword == "maximum") {
      return !value.is_number() || value <= rule;
    }
    if (kNotes.contains(keyword)) {
      return true;
    }
    return value.is_array() ? array_holds(keyword, rule, value) : object_holds(schema, keyword, rule, value);
  }

  [[nodiscard]] bool array_holds(const std::string& keyword, const json& rule, const json& value) const {
    if (keyword == "items") {
      return std::all_of(value.begin(), value.end(), [&](const json& item) { return valid(rule, item); });
    }
    if (keyword == "minItems") {
      return value.size() >= rule;
    }
    if (keyword == "maxItems") {
      return value.size() <= rule;
    }
    if (keyword == "uniqueItems") {
      return std::set<json>(value.begin(), value.end()).size() == value.size();
    }
    return is_object_keyword(keyword);
  }

  static bool is_object_keyword(const std::string& keyword) {
    static const std::set<std::string> kKnown{"properties",        "required",      "additionalProperties",
                                              "dependentRequired", "items",         "minItems",
                                              "maxItems",          "minProperties", "uniqueItems"};
    if (!kKnown.contains(keyword)) {
      throw std::logic_error("this checker does not know the keyword " + keyword);
    }
    return true;
  }

  [[nodiscard]] bool object_holds(const json& schema, const std::string& keyword, const json& rule,
                                  const json& value) const {
    is_object_keyword(keyword);
    if (!value.is_object()) {
      return true;
    }
    if (keyword == "required") {
      return std::all_of(rule.begin(), rule.end(),
                         [&](const json& name) { return value.contains(name.get<std::string>()); });
    }
    if (keyword == "minProperties") {
      return value.size() >= rule;
    }
    if (keyword == "properties") {
      return std::all_of(rule.items().begin(), rule.items().end(), [&](const auto& part) {
        return !value.contains(part.key()) || valid(part.value(), value[part.key()]);
      });
    }
    if (keyword == "additionalProperties") {
      const json known = schema.value("properties", json::object());
      return std::all_of(value.items().begin(), value.items().end(), [&](const auto& member) {
        return known.contains(member.key()) ||
               (rule.is_boolean() ? rule.template get<bool>() : valid(rule, member.value()));
      });
    }
    if (keyword == "dependentRequired") {
      return std::all_of(rule.items().begin(), rule.items().end(), [&](const auto& part) {
        return !value.contains(part.key()) ||
               std::all_of(part.value().begin(), part.value().end(), [&](const json& name) {
                 return value.contains(name.template get<std::string>());
               });
      });
    }
    return true;
  }

  const json document_;
};

}  // namespace snapthrough::server::test
