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

constexpr std::array kChoices{"anyOf", "oneOf", "allOf"};

}  // namespace

const Json& published_schema(std::string_view name) {
  return published().at("components").at("schemas").at(std::string(name));
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
