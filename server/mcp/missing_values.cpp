#include "server/mcp/missing_values.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/openapi/schemas.h"
#include "solver/model/pointer.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;

constexpr std::size_t kMostQuestions = 20;  ///< a longer form is no help
constexpr std::array<std::string_view, 4> kTypes{"number", "integer", "string", "boolean"};

/// Schemas that a value at a place may have. @param schemas those of the value around it
std::vector<const json*> schemas_inside(const std::vector<const json*>& schemas, const std::string& token) {
  std::vector<const json*> inside;
  for (const json* schema : schemas) {
    const auto members = schema->find("properties");
    if (members != schema->end() && members->contains(token)) {
      api::expand(members->at(token), inside);
    } else if (schema->contains("items")) {
      api::expand(schema->at("items"), inside);
    }
  }
  return inside;
}

/// Returns the schema of a plain value at a pointer, with its description and unit; null when there is none.
json plain_schema_at(std::string_view name, const std::string& pointer) {
  std::vector<const json*> schemas;
  api::expand(api::published_schema(name), schemas);
  json::json_pointer rest(pointer);
  std::vector<std::string> tokens;
  for (; !rest.empty(); rest.pop_back()) {
    tokens.push_back(rest.back());
  }
  for (auto token = tokens.rbegin(); token != tokens.rend(); ++token) {
    schemas = schemas_inside(schemas, *token);
  }
  for (const json* schema : schemas) {
    const auto type = schema->find("type");
    if (type == schema->end() || !type->is_string() ||
        std::find(kTypes.begin(), kTypes.end(), type->get_ref<const std::string&>()) == kTypes.end()) {
      continue;
    }
    json plain = {{"type", *type}, {"title", pointer}};
    // that of the field, where it allows more than plain values
    std::string description = schemas.back()->value("description", schema->value("description", ""));
    if (const auto unit = schema->find("x-unit"); unit != schema->end()) {
      description += " [" + unit->get<std::string>() + "]";
    }
    plain["description"] = description;
    if (schema->contains("enum")) {
      plain["enum"] = schema->at("enum");
    }
    return plain;
  }
  return nullptr;
}

bool fits(const json& value, const std::string& type) {
  return type == "string"    ? value.is_string()
         : type == "boolean" ? value.is_boolean()
         : type == "integer" ? value.is_number_integer()
                             : value.is_number();
}

}  // namespace

std::optional<Question> question_about(const std::vector<Finding>& findings, std::string_view schema) {
  if (findings.empty() || findings.size() > kMostQuestions) {
    return std::nullopt;
  }
  json members = json::object();
  json required = json::array();
  for (const Finding& finding : findings) {
    json member = finding.code == "missing_field" ? plain_schema_at(schema, finding.pointer) : json();
    if (member.is_null()) {
      return std::nullopt;
    }
    members[finding.pointer] = std::move(member);
    required.push_back(finding.pointer);
  }
  const json form = {{"type", "object"}, {"properties", members}, {"required", required}};
  return Question{required.size() == 1 ? "The request lacks a value, which is not assumed."
                                       : "The request lacks values, which are not assumed.",
                  std::make_shared<const json>(form)};
}

std::string take_answer(const json& answer, const Question& question, json& document) {
  for (const auto& [pointer, schema] : question.schema->at("properties").items()) {
    const auto value = answer.find(pointer);
    if (value == answer.end() || !fits(*value, schema.at("type").get_ref<const std::string&>())) {
      return pointer + " got no " + schema.at("type").get<std::string>();
    }
    document[json::json_pointer(pointer)] = *value;
  }
  return "";
}

}  // namespace snapthrough::server::mcp
