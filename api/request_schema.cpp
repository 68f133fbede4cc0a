#include "api/request_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <unordered_map>
#include <utility>

#include "api/openapi/schemas.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

constexpr std::string_view kModel = "model.";
constexpr std::string_view kCaseLoads = "model.load_cases.loads";

/// Returns the dotted name of a member of an object.
std::string within(const std::string& object, std::string_view name) {
  return object.empty() ? std::string(name) : object + "." + std::string(name);
}

/// Returns the dotted name of the object at a pointer, without indices: "model.members.curve".
std::string kind_of(std::string_view pointer) {
  std::string kind;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);  // without the leading slash
    const std::string_view token = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(token.size());
    const bool is_index = !token.empty() && token.find_first_not_of("0123456789") == std::string_view::npos;
    if (!is_index) {
      kind = within(kind, token);
    }
  }
  return kind;
}

/// Returns the name of a kind of object in messages.
std::string spoken(const std::string& kind, const std::string& type) {
  std::string name = kind.starts_with(kModel) ? kind.substr(kModel.size()) : kind;
  if (name.empty()) {
    name = "the request";
  }
  return type.empty() ? name : name + " of type \"" + type + "\"";
}

/// A kind of object that has a given field.
struct Owner {
  std::string kind;
  std::string type;  ///< value of the object's field `type`; empty: the kind has no types
};

/// Owners by field name, built once: a document may have as many unknown fields as values.
class FieldIndex {
 public:
  FieldIndex() { look_into(published_schema("Request"), ""); }

  [[nodiscard]] std::span<const Owner> owners_of(std::string_view field) const {
    const auto found = owners_.find(std::string(field));
    return found == owners_.end() ? std::span<const Owner>() : std::span<const Owner>(found->second);
  }

 private:
  void look_into(const Json& schema, const std::string& kind);
  void add_object(const Json& properties, const std::string& kind);

  std::unordered_map<std::string, std::vector<Owner>> owners_;
};

void FieldIndex::add_object(const Json& properties, const std::string& kind) {
  const auto tag = properties.find("type");
  const std::string type = tag == properties.end() ? "" : tag->value("const", "");
  for (const auto& [name, part] : properties.items()) {
    owners_[name].push_back({kind, type});
    look_into(part, within(kind, name));
  }
}

void FieldIndex::look_into(const Json& schema, const std::string& kind) {
  std::vector<const Json*> alternatives;
  expand(schema, alternatives);
  for (const Json* one : alternatives) {
    if (const auto properties = one->find("properties"); properties != one->end()) {
      add_object(*properties, kind);
    }
    if (const auto items = one->find("items"); items != one->end() && items->is_object()) {
      look_into(*items, kind);
    }
  }
}

}  // namespace

std::vector<std::string> objects_with_field(std::string_view field, std::string_view at) {
  static const FieldIndex index;
  std::vector<std::string> of_own_kind;  // other types of the objects at the pointer: more likely meant
  std::vector<std::string> of_others;
  const std::string own = kind_of(at);
  for (const Owner& owner : index.owners_of(field)) {
    if (owner.kind.starts_with(kCaseLoads)) {  // loads of cases are those of /model/loads
      continue;
    }
    if (owner.kind == own && owner.type.empty()) {
      continue;
    }
    std::vector<std::string>& found = owner.kind == own ? of_own_kind : of_others;
    std::string name = spoken(owner.kind, owner.type);
    if (std::find(found.begin(), found.end(), name) == found.end()) {
      found.push_back(std::move(name));
    }
  }
  return of_own_kind.empty() ? of_others : of_own_kind;
}

}  // namespace snapthrough::api
