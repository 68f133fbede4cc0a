#include "api/openapi/field_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "api/openapi/document.h"

namespace snapthrough::api {

namespace {

/// Keeps the order of the document.
using Schema = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

const Schema& published() {
  static const Schema document = Schema::parse(openapi_document());
  return document;
}

/// The schema that a reference names, else the schema itself.
const Schema& dereferenced(const Schema& schema) {
  const auto reference = schema.find("$ref");
  return reference == schema.end()
             ? schema
             : published().at(Schema::json_pointer(reference->get<std::string>().substr(1)));
}

/// A list or an object of the schema, empty where it has none.
const Schema& list_of(const Schema& schema, const char* key) {
  static const Schema none = Schema::array();
  const auto found = schema.find(key);
  return found == schema.end() ? none : *found;
}

void add_once(Texts& texts, const std::string& text) {
  if (std::find(texts.begin(), texts.end(), text) == texts.end()) {
    texts.push_back(text);
  }
}

std::string joined(const Texts& texts, std::string_view between) {
  std::string all;
  for (const std::string& text : texts) {
    all.append(&text == &texts.front() ? "" : between).append(text);
  }
  return all;
}

std::string code(const Schema& value) { return "`" + value.dump() + "`"; }

/// " (2 to 5)" for a list of 2 to 5 items; nothing where any number may be there.
std::string count(const Schema& schema) {
  const auto least = schema.find("minItems");
  const auto most = schema.find("maxItems");
  if (least == schema.end() && most == schema.end()) {
    return "";
  }
  return " (" + (least == schema.end() ? "0" : least->dump()) +
         (most == schema.end() ? " or more" : " to " + most->dump()) + ")";
}

/// One side of the range of a number; nothing for a bound that no number of practice reaches.
std::string bound(const Schema& schema, const char* key, const char* exclusive_key, std::string_view sign) {
  constexpr double kWide = 1e150;
  if (const auto exclusive = schema.find(exclusive_key); exclusive != schema.end()) {
    return std::string(sign) + " " + exclusive->dump();
  }
  const auto value = schema.find(key);
  const bool is_bound = value != schema.end() && std::abs(value->get<double>()) < kWide;
  return is_bound ? std::string(sign) + "= " + value->dump() : "";
}

std::string range(const Schema& schema) {
  const std::string lower = bound(schema, "minimum", "exclusiveMinimum", ">");
  const std::string upper = bound(schema, "maximum", "exclusiveMaximum", "<");
  const std::string both = lower + (lower.empty() || upper.empty() ? "" : ", ") + upper;
  return both.empty() ? "" : " " + both;
}

std::string values(const Schema& schema);

Texts values_of(const Schema& schemas) {
  Texts all;
  for (const Schema& one : schemas) {
    all.push_back(values(one));
  }
  return all;
}

std::string names_of(const Schema& names) {
  constexpr std::size_t kShown = 8;
  Texts all;
  for (const Schema& one : names) {
    all.push_back(code(one));
  }
  return names.size() > kShown ? "a code" : joined(all, ", ");
}

std::string types_of(const Schema& schema) {
  Texts all;
  for (const Schema& type :
       schema.at("type").is_array() ? schema.at("type") : Schema::array({schema.at("type")})) {
    all.push_back(type == "null" || type == "string" ? type.get<std::string>()
                                                     : type.get<std::string>() + range(schema));
  }
  return joined(all, " or ");
}

/// What values a schema allows, in a few words: its type and range, or its names.
std::string values(const Schema& schema) {
  const Schema& at = dereferenced(schema);
  if (at.contains("const")) return code(at.at("const"));
  if (at.contains("enum")) return names_of(at.at("enum"));
  for (const char* choice : {"oneOf", "anyOf"}) {
    if (!at.contains(choice)) continue;
    Texts forms;
    for (const std::string& one : values_of(at.at(choice))) add_once(forms, one);
    return joined(forms, " or ");
  }
  if (at.contains("prefixItems")) return "[" + joined(values_of(at.at("prefixItems")), ", ") + "]";
  if (at.at("type") == "array") return "list" + count(at) + " of " + values(at.at("items"));
  if (at.at("type") != "object") return types_of(at);
  return at.contains("properties") ? "object" : "object by id of " + values(at.at("additionalProperties"));
}

/// Units of a field, of its items and of its alternatives.
void add_units(const Schema& schema, Texts& units) {
  const Schema& at = dereferenced(schema);
  for (const Schema* one : {&schema, &at}) {
    if (one->contains("x-unit")) add_once(units, one->at("x-unit").get<std::string>());
    if (one->contains("x-unit")) break;
  }
  for (const char* key : {"oneOf", "anyOf", "prefixItems"}) {
    for (const Schema& one : list_of(at, key)) {
      if (!one.contains("properties")) add_units(one, units);
    }
  }
  if (at.contains("items") && at.at("items").is_object()) add_units(at.at("items"), units);
  if (at.contains("additionalProperties") && at.at("additionalProperties").is_object() &&
      !at.contains("properties")) {
    add_units(at.at("additionalProperties"), units);
  }
}

/// A field of a document; `forms` has the schema of each alternative that it is a field of.
struct DocumentField {
  std::string path;  ///< `a.b`; `a[].b` for items of lists; `a.ID.b` for objects by id
  std::vector<const Schema*> forms;
  bool required = false;
};

void add_fields(const Schema& schema, const std::string& path, std::vector<DocumentField>& fields) {
  if (schema.value("$ref", "").ends_with("/JsonValue")) return;
  const Schema& at = dereferenced(schema);
  for (const char* key : {"oneOf", "anyOf", "prefixItems"}) {
    for (const Schema& one : list_of(at, key)) add_fields(one, path, fields);
  }
  for (const auto& [key, property] : list_of(at, "properties").items()) {
    const std::string name = path.empty() ? key : path + "." + key;
    auto found = std::find_if(fields.begin(), fields.end(),
                              [&](const DocumentField& field) { return field.path == name; });
    if (found == fields.end()) {
      const Schema& required = list_of(at, "required");
      const bool is_required = std::find(required.begin(), required.end(), key) != required.end();
      found = fields.insert(fields.end(), {name, {}, is_required});
    }
    found->forms.push_back(&property);
    add_fields(property, name, fields);
  }
  if (at.contains("items") && at.at("items").is_object()) add_fields(at.at("items"), path + "[]", fields);
  if (at.contains("additionalProperties") && at.at("additionalProperties").is_object()) {
    const std::string ids = at.value("x-ids", "");
    add_fields(at.at("additionalProperties"), path + (ids == "supports" || ids == "nodes" ? ".NODE" : ".ID"),
               fields);
  }
}

std::string row(const DocumentField& field) {
  Texts kinds;
  Texts units;
  Texts descriptions;
  for (const Schema* form : field.forms) {
    add_once(kinds, values(*form));
    if (!dereferenced(*form).contains("properties")) add_units(*form, units);
    add_once(descriptions, form->value("description", ""));
  }
  return "| `" + field.path + "`" + (field.required ? "" : " ?") + " | " + joined(kinds, " or ") + " | " +
         joined(units, "; ") + " | " + joined(descriptions, " / ") + " |\n";
}

std::string table(const std::string& name) {
  std::vector<DocumentField> fields;
  add_fields(published().at("components").at("schemas").at(name), "", fields);
  std::string text = "| field | values | unit | what |\n| --- | --- | --- | --- |\n";
  for (const DocumentField& field : fields) {
    text += row(field);
  }
  return text;
}

}  // namespace

std::string with_field_tables(std::string_view markdown) {
  constexpr std::string_view kMark = "<!-- fields of ";
  constexpr std::string_view kEnd = " -->\n";
  std::string text;
  for (std::size_t at = 0;;) {
    const std::size_t mark = markdown.find(kMark, at);
    const std::size_t end = markdown.find(kEnd, mark);
    if (end == std::string_view::npos) {
      return text.append(markdown.substr(at));
    }
    const std::size_t name = mark + kMark.size();
    text.append(markdown.substr(at, end + kEnd.size() - at)).append("\n");
    text.append(table(std::string(markdown.substr(name, end - name))));
    at = end + kEnd.size();
  }
}

}  // namespace snapthrough::api
