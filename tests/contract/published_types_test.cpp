/// What generators of clients make types of: the published document gives each answer one type or a
/// discriminator, each form of a value a name, and no field of a request a `default`, for which some
/// generators require the field.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "api/openapi/document.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;

constexpr std::string_view kSchemas = "#/components/schemas/";

const json& published() {
  static const json document = json::parse(openapi_document());
  return document;
}

const json& component(const std::string& name) { return published().at("components").at("schemas").at(name); }

std::string name_in(const std::string& reference) { return reference.substr(kSchemas.size()); }

const json& dereferenced(const json& schema) {
  return schema.contains("$ref") ? component(name_in(schema.at("$ref"))) : schema;
}

/// Calls `visit(object, pointer)` for each object of a part of the document, from the outside to the inside.
void walk(const json& part, const std::string& pointer,
          const std::function<void(const json&, const std::string&)>& visit) {
  if (part.is_object()) {
    visit(part, pointer);
  }
  if (part.is_structured()) {
    for (const auto& [key, inside] : part.items()) {
      if (key != "example") {
        walk(inside, pointer + "/" + key, visit);
      }
    }
  }
}

/// Calls `visit(members, pointer)` for the list of each oneOf and anyOf of the document.
void each_union(const std::function<void(const json&, const std::string&)>& visit) {
  walk(published(), "", [&](const json& object, const std::string& pointer) {
    for (const char* choice : {"oneOf", "anyOf"}) {
      if (object.contains(choice) && object.at(choice).is_array()) {
        visit(object.at(choice), pointer + "/" + choice);
      }
    }
  });
}

/// Schemas of the bodies of an operation.
struct Bodies {
  std::vector<json> taken;
  std::set<json> answered;  ///< as application/json with a status of 2xx; each schema once
};

Bodies bodies_of(const json& operation) {
  Bodies bodies;
  if (operation.contains("requestBody")) {
    for (const auto& [type, content] : operation.at("requestBody").at("content").items()) {
      bodies.taken.push_back(content.at("schema"));
    }
  }
  for (const auto& [status, response] : operation.at("responses").items()) {
    const json::json_pointer schema(std::string("/content/application~1json/schema"));
    if (status.starts_with("2") && response.contains(schema)) {
      bodies.answered.insert(response.at(schema));
    }
  }
  return bodies;
}

/// The operations of `paths` or `webhooks` by method and path.
std::map<std::string, Bodies> operations(const char* group) {
  std::map<std::string, Bodies> all;
  for (const auto& [path, methods] : published().at(group).items()) {
    for (const auto& [method, operation] : methods.items()) {
      if (method != "parameters") {
        all.emplace(method + " " + path, bodies_of(operation));
      }
    }
  }
  return all;
}

/// Expects that a value of several types tells its own: `oneOf` references, and a discriminator whose mapping
/// names each of them by the constant that its member has.
void expect_discriminator(const json& schema) {
  EXPECT_FALSE(schema.contains("anyOf")) << "anyOf takes no discriminator that is sure";
  if (!schema.contains("oneOf")) {
    return;
  }
  ASSERT_TRUE(schema.contains("discriminator"));
  const std::string member = schema.at("discriminator").at("propertyName");
  std::set<std::string> mapped;
  for (const auto& [value, reference] : schema.at("discriminator").at("mapping").items()) {
    mapped.insert(reference);
    const json& target = component(name_in(reference));
    EXPECT_EQ(target.at("properties").at(member).at("const"), value) << reference;
    const json& required = target.at("required");
    EXPECT_NE(std::find(required.begin(), required.end(), member), required.end()) << reference;
  }
  std::set<std::string> listed;
  for (const json& one : schema.at("oneOf")) {
    ASSERT_TRUE(one.contains("$ref")) << one;
    listed.insert(one.at("$ref"));
  }
  EXPECT_EQ(listed, mapped);
}

TEST(PublishedTypes, AnAnswerHasOneTypeOrTellsWhich) {
  int unions = 0;
  for (const auto& [operation, bodies] : operations("paths")) {
    SCOPED_TRACE(operation);
    EXPECT_LE(bodies.answered.size(), 1U) << "one type of JSON for all statuses of 2xx";
    for (const json& schema : bodies.answered) {
      unions += dereferenced(schema).contains("oneOf") ? 1 : 0;
      expect_discriminator(dereferenced(schema));
    }
  }
  EXPECT_GE(unions, 2) << "POST /v1/jobs answers with a result or a job";
  for (const auto& [operation, bodies] : operations("webhooks")) {
    SCOPED_TRACE(operation);
    for (const json& schema : bodies.taken) {
      expect_discriminator(dereferenced(schema));
    }
  }
}

TEST(PublishedTypes, EachFormOfAValueHasANameOfItsOwn) {
  static const std::regex kPascalCase("[A-Z][A-Za-z0-9]{1,39}");
  std::map<std::string, std::string> first_by_title;
  int inline_forms = 0;
  each_union([&](const json& members, const std::string& pointer) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      const json& member = members[i];
      const std::string where = pointer + "/" + std::to_string(i);
      const std::string title = dereferenced(member).value("title", "");
      EXPECT_TRUE(std::regex_match(title, kPascalCase)) << where << ": title '" << title << "'";
      if (member.contains("$ref")) {
        EXPECT_EQ(title, name_in(member.at("$ref"))) << where;
        continue;
      }
      ++inline_forms;
      EXPECT_FALSE(published().at("components").at("schemas").contains(title))
          << where << ": a schema has the title '" << title << "' as its name";
      const auto [first, is_new] = first_by_title.emplace(title, where);
      EXPECT_TRUE(is_new) << "'" << title << "' is the title of " << first->second << " and of " << where;
    }
  });
  EXPECT_GT(inline_forms, 90);
}

/// Visits the objects of a schema and of all that it refers to, each schema once.
void walk_reachable(const json& schema, const std::string& pointer, std::set<std::string>& seen,
                    const std::function<void(const json&, const std::string&)>& visit) {
  walk(schema, pointer, [&](const json& object, const std::string& where) {
    visit(object, where);
    const auto reference = object.find("$ref");
    if (reference != object.end() && reference->is_string() && seen.insert(*reference).second) {
      walk_reachable(component(name_in(*reference)), *reference, seen, visit);
    }
  });
}

TEST(PublishedTypes, NoFieldOfARequestHasADefaultThatMakesItRequired) {
  std::set<std::string> seen;
  for (const auto& [operation, bodies] : operations("paths")) {
    for (const json& schema : bodies.taken) {
      walk_reachable(schema, operation, seen, [](const json& object, const std::string& where) {
        // a field may have the name `default`; then its value is a schema
        EXPECT_TRUE(!object.contains("default") || where.ends_with("/properties")) << where;
      });
    }
  }
  EXPECT_TRUE(seen.contains("#/components/schemas/Analysis"));
}

/// The value as descriptions have it: a text without quotes, lists with a space behind each comma.
std::string in_words(const json& value) {
  if (value.is_string() && value != "") {
    return value;
  }
  return std::regex_replace(value.dump(), std::regex(","), ", ");
}

TEST(PublishedTypes, DescriptionsNameTheDefault) {
  int defaults = 0;
  const auto expect_named = [&](const json& schema, const json& value, const std::string& where) {
    ++defaults;
    EXPECT_TRUE(schema.value("description", "").ends_with(". Default: " + in_words(value) + ".")) << where;
  };
  walk(published().at("components").at("schemas"), "", [&](const json& object, const std::string& where) {
    if (object.contains("x-default")) {
      expect_named(object, object.at("x-default"), where);
    }
    if (!object.contains("properties") || where.ends_with("/properties")) {
      return;
    }
    const json required = object.value("required", json::array());
    for (const auto& [name, field] : object.at("properties").items()) {
      const bool is_required = std::find(required.begin(), required.end(), name) != required.end();
      if (!is_required && field.contains("$ref") && dereferenced(field).contains("x-default")) {
        expect_named(field, dereferenced(field).at("x-default"), where + "/properties/" + name);
      }
      EXPECT_FALSE(is_required && field.contains("x-default")) << where << " requires " << name;
    }
  });
  EXPECT_GT(defaults, 100);
}

}  // namespace
}  // namespace snapthrough::api
