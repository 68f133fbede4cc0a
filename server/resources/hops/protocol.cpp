#include "server/resources/hops/protocol.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "api/json_text.h"
#include "api/value.h"
#include "solver/model/pointer.h"

namespace snapthrough::server::hops {
namespace {

using api::ComponentInput;
using api::ComponentValue;
using api::PlugType;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view kAddress = "/v1/hops";
constexpr std::string_view kSolve = "/solve";

/// Largest number of errors shown one by one at a component, whose message area is small.
constexpr std::size_t kMostSentences = 20;
/// Largest number of values in an answer; each takes about 100 bytes.
constexpr std::size_t kMostItems = 50'000;
/// Largest size in bytes of the result document as a text output.
constexpr std::size_t kLongestText = 1024 * 1024;
constexpr int kAnyNumber = std::numeric_limits<std::int32_t>::max();

struct TypeNames {
  PlugType type;
  const char* param;   ///< type in Grasshopper
  const char* result;  ///< type in .NET
  const char* words;
};
constexpr TypeNames kTypes[] = {
    {PlugType::number, "Number", "System.Double", "a number"},
    {PlugType::integer, "Integer", "System.Int32", "a whole number of 32 bits"},
    {PlugType::text, "Text", "System.String", "a text"},
    {PlugType::boolean, "Boolean", "System.Boolean", "true or false"},
    {PlugType::point, "Point", "Rhino.Geometry.Point3d", "a point"},
};

const TypeNames& names_of(PlugType type) {
  return *std::find_if(std::begin(kTypes), std::end(kTypes),
                       [&](const TypeNames& one) { return one.type == type; });
}

std::string text_of(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

/// Returns a point in the JSON format of Rhino.
std::string point_text(double x, double y) { return text_of({{"X", x}, {"Y", y}, {"Z", 0.0}}); }

ordered_json item_of(PlugType type, std::string data) {
  return {{"type", names_of(type).result}, {"data", std::move(data)}};
}

/// Returns the initial value of an input, as a tree if the input takes a list.
ordered_json initial_of(const ComponentInput& input) {
  if (!input.list) {
    return input.initial;
  }
  ordered_json items = ordered_json::array();
  for (const json& one : input.initial) {
    items.push_back(item_of(input.type, input.type == PlugType::point
                                            ? point_text(one[0].get<double>(), one[1].get<double>())
                                            : text_of(one)));
  }
  return {{"ParamName", input.name}, {"InnerTree", {{"{0}", std::move(items)}}}};
}

ordered_json plug(const std::string& name, const std::string& description, PlugType type) {
  return {{"Name", name},
          {"Nickname", name},
          {"Description", description},
          {"ParamType", names_of(type).param},
          {"ResultType", names_of(type).result}};
}

ordered_json described(const ComponentInput& input) {
  ordered_json document = plug(input.name, input.description, input.type);
  document["AtLeast"] = 1;
  document["AtMost"] = input.list ? kAnyNumber : 1;
  document["TreeAccess"] = false;
  document["Default"] = initial_of(input);
  document["Minimum"] = input.least ? ordered_json(*input.least) : ordered_json();
  document["Maximum"] = input.most ? ordered_json(*input.most) : ordered_json();
  return document;
}

/// Returns a value converted to the type of an input; nullopt for a value of another type.
std::optional<json> taken(PlugType type, const json& value) {
  switch (type) {
    case PlugType::number:
      return value.is_number() ? std::optional(value) : std::nullopt;
    case PlugType::integer: {
      const double number = value.is_number() ? value.get<double>() : std::nan("");
      const bool whole = number == std::floor(number) && std::abs(number) <= kAnyNumber;
      return whole ? std::optional<json>(static_cast<std::int64_t>(number)) : std::nullopt;
    }
    case PlugType::text:
      return value.is_string() ? std::optional(value) : std::nullopt;
    case PlugType::boolean:
      return value.is_boolean() ? std::optional(value) : std::nullopt;
    case PlugType::point:
      break;
  }
  const auto coordinate = [&](const char* name) {
    return value.is_object() && value.contains(name) && value.at(name).is_number();
  };
  return coordinate("X") && coordinate("Y") ? std::optional(json::array({value.at("X"), value.at("Y")}))
                                            : std::nullopt;
}

/// Reads the values of one input and adds findings about them.
class InputReader {
 public:
  InputReader(const ComponentInput& input, std::vector<Finding>& findings)
      : input_(input), findings_(findings) {}

  /// Returns the value; nullopt without value or after a finding.
  std::optional<json> read(const json& tree) {
    if (!tree.is_object()) {
      return report("wrong_type", "InnerTree is no object with lists of values");
    }
    json all = json::array();
    for (const auto& [path, branch] : tree.items()) {
      if (!branch.is_array()) {
        return report("wrong_type", "InnerTree is no object with lists of values");
      }
      if (input_.list && !branch.empty() && !all.empty()) {
        return report("too_many", "has several lists: it takes one");
      }
      for (const json& item : branch) {
        std::optional<json> value = item_value(item);
        if (!value) {
          return std::nullopt;
        }
        all.push_back(*std::move(value));
      }
    }
    if (all.empty()) {
      return std::nullopt;  // no value counts as an absent input
    }
    if (!input_.list && all.size() > 1) {
      return report("too_many", "has " + std::to_string(all.size()) + " values: it takes one");
    }
    return input_.list ? all : all.front();
  }

 private:
  std::optional<json> report(const char* code, std::string detail) {
    findings_.push_back({"/" + escape_pointer_token(input_.name), code, std::move(detail)});
    return std::nullopt;
  }

  std::optional<json> item_value(const json& item) {
    const auto data = item.is_object() ? item.find("data") : item.end();
    if (!item.is_object() || data == item.end() || !data->is_string()) {
      return report("wrong_type", "each value is {type, data}, data a text");
    }
    const std::string& text = data->get_ref<const std::string&>();
    const api::ParsedText parsed = api::parse_json(text);
    std::optional<json> value =
        parsed.document == nullptr ? std::nullopt : taken(input_.type, *parsed.document);
    if (!value) {
      return report("wrong_type",
                    "expected " + std::string(names_of(input_.type).words) + ", got " + shortened(text));
    }
    const bool lifted = input_.type == PlugType::point && parsed.document->value("Z", json(0.0)) != 0.0;
    if (lifted) {
      return report("out_of_range", "structures are plane: points have Z = 0, got " + shortened(text));
    }
    return value;
  }

  /// Returns at most 80 bytes for a message; the writer of JSON replaces a character that is cut.
  static std::string shortened(const std::string& text) {
    constexpr std::size_t kLongest = 80;
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
  }

  const ComponentInput& input_;
  std::vector<Finding>& findings_;
};

/// Writes the values of one output as a Grasshopper tree.
class TreeWriter {
 public:
  explicit TreeWriter(PlugType type) : type_(type) {}

  /// @param path path of the branch for the value or the items of a list
  void append(const json& value, const std::string& path) {
    ordered_json& branch = tree_.emplace("{" + path + "}", ordered_json::array()).first.value();
    const bool list = value.is_array() && (type_ != PlugType::text || all_are_texts(value));
    if (!list) {
      append_item(value, branch);
      return;
    }
    if (std::none_of(value.begin(), value.end(), [](const json& one) { return one.is_array(); })) {
      for (const json& one : value) {
        append_item(one, branch);
      }
      return;
    }
    tree_.erase("{" + path + "}");
    for (std::size_t i = 0; i < value.size(); ++i) {
      append(value[i], path + ";" + std::to_string(i));
    }
  }

  void append(const api::Polyline& line) {
    std::string path;
    for (const int index : line.place) {
      path += (path.empty() ? "" : ";") + std::to_string(index);
    }
    ordered_json items = ordered_json::array();
    for (const auto& [x, y] : line.points) {
      items.push_back(item_of(PlugType::point, point_text(x, y)));
    }
    tree_["{" + path + "}"] = std::move(items);
  }

  [[nodiscard]] ordered_json take() {
    if (tree_.empty()) {
      tree_["{0}"] = ordered_json::array();
    }
    return std::move(tree_);
  }
  [[nodiscard]] std::size_t items() const { return items_; }
  /// Returns the number of null values, which are not items of the tree.
  [[nodiscard]] std::size_t missing() const { return missing_; }

 private:
  static bool all_are_texts(const json& list) {
    return std::all_of(list.begin(), list.end(), [](const json& one) { return one.is_string(); });
  }

  void append_item(const json& value, ordered_json& branch) {
    if (value.is_null()) {
      ++missing_;
      return;
    }
    ++items_;
    const bool number = type_ == PlugType::number || type_ == PlugType::integer;
    const bool as_text = type_ == PlugType::text && !value.is_string();
    const bool large = number && std::abs(value.get<double>()) > kAnyNumber;  // beyond System.Int32
    branch.push_back(
        item_of(large ? PlugType::number : type_, as_text ? text_of(text_of(value)) : text_of(value)));
  }

  const PlugType type_;
  ordered_json tree_ = ordered_json::object();
  std::size_t items_ = 0;
  std::size_t missing_ = 0;
};

void warn_of_missing(const api::ComponentOutput& output, std::size_t missing, ordered_json& warnings) {
  if (missing > 0) {
    warnings.push_back(output.name + ": " + (missing == 1 ? "1 value" : std::to_string(missing) + " values") +
                       " of " + output.description + " are null and left out");
  }
}

}  // namespace

bool is_description_path(std::string_view path) {
  return path == kAddress || (path.starts_with(kAddress) && path[kAddress.size()] == '/');
}

Form form_of(std::string_view method, std::string_view path) {
  const bool component = is_description_path(path) && path != kAddress;
  if (method == "POST" && (path == kSolve || component)) {
    return Form::answer;
  }
  const bool reads = method == "GET" || method == "HEAD";
  return reads && component ? Form::description : Form::none;
}

ordered_json description(std::string_view name, const Entry& entry) {
  ordered_json inputs = ordered_json::array();
  ordered_json outputs = ordered_json::array();
  if (entry.definition != nullptr) {
    for (const ComponentInput& input : entry.definition->inputs()) {
      inputs.push_back(described(input));
    }
    for (const api::ComponentOutput& output : entry.definition->outputs()) {
      outputs.push_back(plug(output.name, output.description, output.type));
    }
    outputs.push_back(plug(std::string(kJobOutput),
                           "Path of the job at the service; its result is at /result", PlugType::text));
  }
  return {{"Uri", "/" + std::string(name)},
          {"Name", name},
          {"Nickname", name},
          {"Description", entry.definition != nullptr ? entry.definition->description() : ""},
          {"Category", "snapthrough"},
          {"Subcategory", "Stability"},
          {"Inputs", std::move(inputs)},
          {"Outputs", std::move(outputs)},
          {"Warnings", ordered_json::array()},
          {"Errors", entry.errors}};
}

std::string refusal(Form form, const std::vector<std::string>& errors) {
  if (form == Form::description) {
    return text_of(description("", {nullptr, errors}));
  }
  return text_of({{"values", json::array()}, {"warnings", json::array()}, {"errors", errors}});
}

std::vector<std::string> sentences_of(const std::vector<Finding>& findings) {
  std::vector<std::string> sentences;
  for (const Finding& finding : findings) {
    if (sentences.size() == kMostSentences) {
      sentences.push_back("and " + std::to_string(findings.size() - kMostSentences) + " more mistakes");
      break;
    }
    sentences.push_back((finding.pointer.empty() ? "" : finding.pointer + ": ") + finding.detail);
  }
  return sentences;
}

std::string name_in(const json& call) {
  const auto pointer = call.find("pointer");
  if (pointer == call.end() || !pointer->is_string()) {
    return "";
  }
  const std::string& text = pointer->get_ref<const std::string&>();
  return text.substr(text.rfind('/') + 1);  // npos + 1 is 0
}

ReadValues read_values(const json& call, const Definition& definition) {
  ReadValues read;
  const auto trees = call.find("values");
  if (trees == call.end() || !trees->is_array()) {
    read.findings.push_back({"/values", "missing_field", "a call has a list of values"});
    return read;
  }
  std::set<std::string> seen;
  for (const json& tree : *trees) {
    const std::string name = tree.is_object() && tree.contains("ParamName") && tree["ParamName"].is_string()
                                 ? tree["ParamName"].get<std::string>()
                                 : "";
    const std::vector<ComponentInput>& inputs = definition.inputs();
    const auto input = std::find_if(inputs.begin(), inputs.end(),
                                    [&](const ComponentInput& one) { return one.name == name; });
    const std::string at = "/" + escape_pointer_token(name);
    if (input == inputs.end()) {
      std::vector<std::string_view> known;
      known.reserve(inputs.size());
      for (const ComponentInput& one : inputs) {
        known.push_back(one.name);
      }
      const std::string_view nearest = api::nearest_name(name, known);
      read.findings.push_back({at, "unknown_field",
                               "the component has no such input" +
                                   (nearest.empty() ? "" : "; did you mean " + std::string(nearest) + "?")});
    } else if (!seen.insert(name).second) {
      read.findings.push_back({at, "duplicate", "has two lists of values"});
    } else if (std::optional<json> value =
                   InputReader(*input, read.findings).read(tree.value("InnerTree", json::object()))) {
      read.values.emplace(name, *std::move(value));
    }
  }
  return read;
}

Answer answer(const Definition& definition, std::string_view pointer, const json& result,
              std::string_view job) {
  ordered_json trees = ordered_json::array();
  ordered_json warnings = ordered_json::array();
  for (const json& warning : result.value("warnings", json::array())) {
    warnings.push_back(warning.at("detail").get<std::string>());
  }
  std::vector<ComponentValue> values = definition.values(result);
  std::size_t items = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const api::ComponentOutput& output = definition.outputs()[i];
    if (values[i].value.is_string() && values[i].value.get_ref<const std::string&>().size() > kLongestText) {
      values[i].value = nullptr;
      warnings.push_back(output.name + ": longer than 1 MB, so it is left out; it is at " + std::string(job) +
                         "/result of the service");
    }
    TreeWriter tree(output.type);
    if (output.type != PlugType::point) {
      tree.append(values[i].value, "0");
    }
    for (const api::Polyline& line : values[i].lines) {
      items += line.points.size();
      if (items <= kMostItems) {
        tree.append(line);
      }
    }
    warn_of_missing(output, tree.missing(), warnings);
    items += tree.items();
    if (items > kMostItems) {
      return {"", "The answer has more than " + std::to_string(kMostItems) +
                      " values: ask for fewer points (analysis.output), or read the result at " +
                      std::string(job) + "/result of the service."};
    }
    trees.push_back({{"ParamName", output.name}, {"InnerTree", tree.take()}});
  }
  trees.push_back(
      {{"ParamName", kJobOutput}, {"InnerTree", {{"{0}", {item_of(PlugType::text, text_of(json(job)))}}}}});
  const ordered_json document{{"pointer", pointer},
                              {"values", std::move(trees)},
                              {"warnings", std::move(warnings)},
                              {"errors", ordered_json::array()}};
  return {document.dump(-1, ' ', false, ordered_json::error_handler_t::replace), ""};
}

}  // namespace snapthrough::server::hops
