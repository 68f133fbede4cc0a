#include "api/result_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/openapi/schemas.h"
#include "api/sweep_data.h"
#include "api/value.h"
#include "solver/model/pointer.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;
using Alternatives = std::vector<const Json*>;

/// Outcome of following one token.
struct Step {
  Alternatives next;
  bool open = false;                    ///< the schema allows anything here
  std::string list;                     ///< list of the model whose ids are valid tokens; empty: none
  bool is_array = false;                ///< the token must be an index
  std::vector<std::string_view> known;  ///< names of known fields
};

void step_into_object(const Json& schema, const std::string& token, Step& step) {
  const auto properties = schema.find("properties");
  const bool described = properties != schema.end();
  if (described) {
    for (const auto& [name, part] : properties->items()) {
      step.known.push_back(properties->find(name).key());
      if (name == token) {
        expand(part, step.next);
      }
    }
  }
  const auto others = schema.find("additionalProperties");
  if (others != schema.end() && others->is_object()) {
    if (step.next.empty()) {
      step.list = schema.value("x-ids", "");
      expand(*others, step.next);
    }
  } else if (!described && !is_choice(schema) && (others == schema.end() || *others == true)) {
    step.open = true;
  }
}

void step_into_array(const Json& schema, const std::string& token, Step& step) {
  step.is_array = true;
  const std::optional<std::size_t> index = array_index(token);
  if (!index || *index >= schema.value("maxItems", SIZE_MAX)) {
    return;
  }
  const auto first = schema.find("prefixItems");
  if (first != schema.end() && *index < first->size()) {
    expand((*first)[*index], step.next);
  } else if (const auto items = schema.find("items"); items == schema.end()) {
    step.open = true;
  } else if (items->is_object()) {
    expand(*items, step.next);
  }
}

bool has_type(const Json& schema, const char* type) {
  const auto types = schema.find("type");
  return types != schema.end() &&
         (*types == type ||
          (types->is_array() && std::find(types->begin(), types->end(), type) != types->end()));
}

Step step_from(const Alternatives& schemas, const std::string& token) {
  Step step;
  for (const Json* schema : schemas) {
    if (has_type(*schema, "object") || schema->contains("properties")) {
      step_into_object(*schema, token, step);
    } else if (has_type(*schema, "array")) {
      step_into_array(*schema, token, step);
    }
  }
  return step;
}

std::string pointer_to(std::span<const std::string> tokens) {
  std::string pointer;
  for (const std::string& token : tokens) {
    pointer += "/" + escape_pointer_token(token);
  }
  return pointer;
}

/// Returns "; did you mean ...?" with the nearest name in place of the token, or the list of names.
std::string suggestion(std::span<const std::string> tokens, std::size_t at,
                       const std::vector<std::string_view>& names, const IdsIn& ids_in) {
  const std::string_view nearest = nearest_name(tokens[at], names);
  if (!nearest.empty()) {
    std::vector<std::string> meant(tokens.begin(), tokens.end());
    meant[at] = nearest;
    // Following tokens are kept as far as they fit the other name.
    if (const auto next = find_no_such_place(meant, ids_in)) {
      meant.resize(next->token);
    }
    return "; did you mean " + pointer_to(meant) + "?";
  }
  std::string all;
  for (const std::string_view name : names) {
    all += (all.empty() ? "; known here: " : ", ") + std::string(name);
  }
  return all;
}

NoSuchPlace nowhere(std::span<const std::string> tokens, std::size_t at, const Step& step,
                    const IdsIn& ids_in) {
  const std::string above = pointer_to(tokens.first(at));
  if (!step.known.empty()) {
    return {
        at, false,
        "a result has no " + pointer_to(tokens.first(at + 1)) + suggestion(tokens, at, step.known, ids_in)};
  }
  if (step.is_array) {
    return {at, false, above + " is a list: " + tokens[at] + " is no index that it can have"};
  }
  return {at, false, "there is nothing inside " + above};
}

}  // namespace

PlaceTypes types_at(std::string_view schema, std::span<const std::string> tokens) {
  Alternatives here;
  expand(published_schema(schema), here);
  for (const std::string& token : tokens) {
    here = step_from(here, token).next;
  }
  const auto any_has = [&](const char* type) {
    return std::any_of(here.begin(), here.end(), [&](const Json* one) { return has_type(*one, type); });
  };
  return {any_has("number"),  any_has("integer"), any_has("string"),
          any_has("boolean"), any_has("array"),   any_has("object")};
}

std::optional<NoSuchPlace> find_no_such_place(std::span<const std::string> tokens, const IdsIn& ids_in) {
  Alternatives here;
  expand(published_schema("Result"), here);
  for (std::size_t at = 0; at < tokens.size(); ++at) {
    Step step = step_from(here, tokens[at]);
    if (step.open) {
      return std::nullopt;
    }
    if (step.next.empty()) {
      return nowhere(tokens, at, step, ids_in);
    }
    const auto names = step.list.empty() ? std::nullopt : ids_in(step.list);
    if (names && std::find(names->begin(), names->end(), tokens[at]) == names->end()) {
      return NoSuchPlace{at, true,
                         "the model has nothing named " + tokens[at] + " for " +
                             pointer_to(tokens.first(at)) +
                             suggestion(tokens, at, {names->begin(), names->end()}, ids_in)};
    }
    here = std::move(step.next);
  }
  return std::nullopt;
}

}  // namespace snapthrough::api
