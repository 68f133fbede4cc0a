#pragma once
/// @file
/// JSON Schema 2020-12, as far as the published document uses it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

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

  /// The part of the document that a reference means, or what is no reference itself.
  [[nodiscard]] const json& dereferenced(const json& part) const {
    return part.contains("$ref") ? resolve(part["$ref"]) : part;
  }

  [[nodiscard]] bool valid(const json& schema, const json& value) const {
    if (schema.is_boolean()) {
      return schema.get<bool>();
    }
    return std::all_of(schema.items().begin(), schema.items().end(),
                       [&](const auto& rule) { return holds(schema, rule.key(), rule.value(), value); });
  }

  /// A random instance: small, but with the ends of ranges now and then.
  [[nodiscard]] json make(const json& schema, std::mt19937& random) const {
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
      json value = candidate(schema, random);
      if (valid(schema, value)) {
        return value;
      }
    }
    throw std::logic_error("no instance was found of " + schema.dump());
  }

 private:
  /// An instance, but for the keywords that only valid() knows (not, contains, pattern, ...).
  [[nodiscard]] json candidate(const json& schema, std::mt19937& random) const {
    if (schema.contains("$ref")) {
      return make(resolve(schema["$ref"]), random);
    }
    if (schema.contains("const")) {
      return schema["const"];
    }
    if (schema.contains("enum")) {
      return schema["enum"][random() % schema["enum"].size()];
    }
    for (const char* choice : {"oneOf", "anyOf"}) {
      if (schema.contains(choice)) {
        return make(schema[choice][random() % schema[choice].size()], random);
      }
    }
    if (schema.contains("examples")) {
      return schema["examples"][random() % schema["examples"].size()];
    }
    const json& types = schema.at("type");
    const std::string type = types.is_array() ? types[random() % types.size()] : types;
    if (type == "object") {
      return make_object(schema, random);
    }
    if (type == "array") {
      return make_array(schema, random);
    }
    if (type == "string") {
      return make_string(schema, random);
    }
    if (type == "boolean") {
      return random() % 2 == 0;
    }
    return type == "null" ? json() : make_number(schema, type == "integer", random);
  }

  [[nodiscard]] const json& resolve(const std::string& reference) const {
    return document_.at(json::json_pointer(reference.substr(1)));
  }

  [[nodiscard]] json make_array(const json& schema, std::mt19937& random) const {
    json list = json::array();
    if (schema.contains("prefixItems")) {
      for (const json& item : schema["prefixItems"]) {
        list.push_back(make(item, random));
      }
      return list;
    }
    const std::size_t least = schema.value("minItems", 0U);
    const std::size_t most = std::min<std::size_t>(schema.value("maxItems", least + 2), least + 2);
    const std::size_t count = least + random() % (most - least + 1);
    for (std::size_t i = 0; i < count; ++i) {
      json item = make(schema["items"], random);
      if (!schema.contains("uniqueItems") || std::find(list.begin(), list.end(), item) == list.end()) {
        list.push_back(std::move(item));
      }
    }
    return list;
  }

  static json make_string(const json& schema, std::mt19937& random) {
    static const std::vector<std::string> kLetters{"a", "b",      "c",      "/",         "~",
                                                   " ", "\u00e4", "\u6881", "\U0001F309"};
    const bool longest = schema.contains("maxLength") && random() % 50 == 0;
    const std::size_t length = longest ? schema["maxLength"].get<std::size_t>() : 1;
    std::string text;
    for (std::size_t i = 0; i < length; ++i) {
      text += kLetters[random() % (random() % 20 == 0 ? kLetters.size() : 3)];
    }
    return text;
  }

  /// One of the ends of the range, or a number near its middle or near 0.
  static json make_number(const json& schema, bool whole, std::mt19937& random) {
    const auto bound = [&](const char* key, const char* exclusive, double none, double outwards) {
      if (schema.contains(exclusive)) {
        const double end = schema[exclusive];
        return whole ? end - std::copysign(1.0, outwards) : std::nextafter(end, -outwards);
      }
      return schema.contains(key) ? schema[key].get<double>() : none;
    };
    const double infinity = std::numeric_limits<double>::infinity();
    const double lo = bound("minimum", "exclusiveMinimum", whole ? -20.0 : -50.0, -infinity);
    const double hi = bound("maximum", "exclusiveMaximum", whole ? 20.0 : 50.0, infinity);
    double value = 0.0;
    switch (random() % 20) {
      case 0:
        value = lo;
        break;
      case 1:
        value = hi;
        break;
      default: {
        const double from = std::max(lo, -50.0);
        const double to = std::min(hi, from + 100.0);
        value = from + (to - from) * static_cast<double>(random() % 2001) / 2000.0;
      }
    }
    return whole ? json(static_cast<std::int64_t>(std::floor(value))) : json(value);
  }

  [[nodiscard]] json make_object(const json& schema, std::mt19937& random) const {
    json object = json::object();
    static const json kNone = json::object();
    const json& properties = schema.contains("properties") ? schema["properties"] : kNone;
    const json& required = schema.contains("required") ? schema["required"] : kNone;
    for (const auto& [name, part] : properties.items()) {
      if (random() % 2 == 0 || std::find(required.begin(), required.end(), name) != required.end()) {
        object[name] = make(part, random);
      }
    }
    if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
      object["m"] = make(schema["additionalProperties"], random);
    }
    const json& dependent = schema.contains("dependentRequired") ? schema["dependentRequired"] : kNone;
    for (const auto& [name, needed] : dependent.items()) {
      if (object.contains(name)) {
        for (const auto& other : needed) {
          object[other.get<std::string>()] = make(schema["properties"][other.get<std::string>()], random);
        }
      }
    }
    return object;
  }

  static bool has_type(const json& type, const json& value) {
    if (type.is_array()) {
      return std::any_of(type.begin(), type.end(), [&](const json& one) { return has_type(one, value); });
    }
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
    static const std::set<std::string> kNotes{
        "title", "description", "format",           "default",       "x-default", "x-unit",        "examples",
        "x-ids", "x-analysis",  "contentMediaType", "contentSchema", "x-column",  "discriminator", "x-names"};
    static const std::set<std::string> kOfNumbers{"minimum", "maximum", "exclusiveMinimum",
                                                  "exclusiveMaximum"};
    static const std::set<std::string> kOfStrings{"minLength", "maxLength", "pattern"};
    static const std::set<std::string> kOfArrays{"items",    "prefixItems", "minItems",
                                                 "maxItems", "uniqueItems", "contains"};
    if (kNotes.contains(keyword)) {
      return true;
    }
    if (kOfNumbers.contains(keyword)) {
      return !value.is_number() || number_holds(keyword, rule, value);
    }
    if (kOfStrings.contains(keyword)) {
      return !value.is_string() || string_holds(keyword, rule, value.get<std::string>());
    }
    if (kOfArrays.contains(keyword)) {
      return !value.is_array() || array_holds(schema, keyword, rule, value);
    }
    return any_holds(schema, keyword, rule, value);
  }

  [[nodiscard]] bool any_holds(const json& schema, const std::string& keyword, const json& rule,
                               const json& value) const {
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
    return keyword == "not" ? !valid(rule, value) : object_holds(schema, keyword, rule, value);
  }

  static bool number_holds(const std::string& keyword, const json& rule, const json& value) {
    if (keyword == "minimum") {
      return value >= rule;
    }
    if (keyword == "maximum") {
      return value <= rule;
    }
    return keyword == "exclusiveMinimum" ? value > rule : value < rule;
  }

  static bool string_holds(const std::string& keyword, const json& rule, const std::string& value) {
    if (keyword == "pattern") {
      static std::map<std::string, std::regex> compiled;
      const auto& pattern = rule.get_ref<const std::string&>();
      return std::regex_search(value, compiled.try_emplace(pattern, pattern).first->second);
    }
    const auto characters = static_cast<std::size_t>(std::count_if(
        value.begin(), value.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
    return keyword == "minLength" ? characters >= rule : characters <= rule;
  }

  [[nodiscard]] bool array_holds(const json& schema, const std::string& keyword, const json& rule,
                                 const json& value) const {
    const std::size_t leading = schema.contains("prefixItems") ? schema["prefixItems"].size() : 0;
    if (keyword == "items") {
      return value.size() <= leading ||
             std::all_of(value.begin() + static_cast<std::ptrdiff_t>(leading), value.end(),
                         [&](const json& item) { return valid(rule, item); });
    }
    if (keyword == "prefixItems") {
      std::size_t i = 0;
      return std::all_of(rule.begin(), rule.end(), [&](const json& one) {
        const bool good = i >= value.size() || valid(one, value[i]);
        ++i;
        return good;
      });
    }
    if (keyword == "minItems") {
      return value.size() >= rule;
    }
    if (keyword == "maxItems") {
      return value.size() <= rule;
    }
    if (keyword == "contains") {
      return std::any_of(value.begin(), value.end(), [&](const json& item) { return valid(rule, item); });
    }
    return !rule.get<bool>() || std::set<json>(value.begin(), value.end()).size() == value.size();
  }

  [[nodiscard]] bool object_holds(const json& schema, const std::string& keyword, const json& rule,
                                  const json& value) const {
    static const std::set<std::string> kKnown{"required",     "minProperties",        "maxProperties",
                                              "properties",   "additionalProperties", "dependentRequired",
                                              "propertyNames"};
    if (!kKnown.contains(keyword)) {
      throw std::logic_error("this checker does not know the keyword " + keyword);
    }
    if (!value.is_object()) {
      return true;
    }
    if (keyword == "required") {
      return has_all(value, rule);
    }
    if (keyword == "minProperties") {
      return value.size() >= rule;
    }
    if (keyword == "maxProperties") {
      return value.size() <= rule;
    }
    return std::all_of(value.items().begin(), value.items().end(), [&](const auto& member) {
      if (keyword == "additionalProperties") {
        const auto known = schema.find("properties");
        return (known != schema.end() && known->contains(member.key())) || valid(rule, member.value());
      }
      if (keyword == "propertyNames") {
        return valid(rule, member.key());
      }
      return !rule.contains(member.key()) ||
             (keyword == "properties" ? valid(rule[member.key()], member.value())
                                      : has_all(value, rule[member.key()]));
    });
  }

  static bool has_all(const json& object, const json& names) {
    return std::all_of(names.begin(), names.end(),
                       [&](const json& name) { return object.contains(name.get<std::string>()); });
  }

  const json document_;
};

}  // namespace snapthrough::server::test
