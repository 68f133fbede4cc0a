#include "api/openapi/schemas.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "api/openapi/document.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

const Json& published() {
  static const Json document = Json::parse(openapi_document());
  return document;
}

constexpr std::string_view kSchemas = "#/components/schemas/";
constexpr std::string_view kDefinitions = "#/$defs/";

/// Lets all references in a value refer to `$defs`; adds the names of what they refer to.
void refer_to_definitions(Json& value, std::set<std::string>& names) {
  if (value.is_object() && value.contains("$ref")) {
    const std::string name = value["$ref"].get<std::string>().substr(kSchemas.size());
    value["$ref"] = std::string(kDefinitions) + name;
    names.insert(name);
  }
  for (Json& one : value) {
    if (one.is_structured()) {
      refer_to_definitions(one, names);
    }
  }
}

constexpr std::array kChoices{"anyOf", "oneOf", "allOf"};

}  // namespace

const Json& published_schema(std::string_view name) {
  return published().at("components").at("schemas").at(std::string(name));
}

Json standalone_schema(std::string_view name, const std::set<std::string>& without) {
  Json schema = published_schema(name);
  std::set<std::string> names;
  refer_to_definitions(schema, names);
  Json definitions = Json::object();
  for (bool more = true; more;) {
    more = false;
    for (const std::string& one : std::set<std::string>(names)) {
      if (!definitions.contains(one) && !without.contains(one)) {
        definitions[one] = published_schema(one);
        refer_to_definitions(definitions[one], names);
        more = true;
      }
    }
  }
  schema["$defs"] = std::move(definitions);
  return schema;
}

bool is_choice(const Json& schema) {
  return std::any_of(kChoices.begin(), kChoices.end(), [&](const char* one) { return schema.contains(one); });
}

void expand(const Json& schema, std::vector<const Json*>& out) {
  if (const auto reference = schema.find("$ref"); reference != schema.end()) {
    const std::string pointer = reference->get<std::string>().substr(1);  // without the leading #
    expand(published().at(Json::json_pointer(pointer)), out);
  }
  for (const char* choice : kChoices) {
    if (const auto list = schema.find(choice); list != schema.end()) {
      for (const Json& one : *list) {
        expand(one, out);
      }
    }
  }
  out.push_back(&schema);
}

}  // namespace snapthrough::api
