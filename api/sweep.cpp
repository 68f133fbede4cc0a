#include "api/sweep.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/sweep_data.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

/// Outcome of an output pointer: a value, null past the end of a list, or a field that results do not have.
struct Found {
  const Json* value = nullptr;
  bool no_such_field = false;
};

Found look_up(const Json& result, const std::vector<std::string>& tokens) {
  const Json* at = &result;
  for (const std::string& token : tokens) {
    if (at->is_null()) {
      return {};
    }
    if (at->is_object()) {
      const auto member = at->find(token);
      if (member == at->end()) {
        return {nullptr, true};
      }
      at = &*member;
    } else if (const auto index = array_index(token); at->is_array() && index) {
      if (*index >= at->size()) {
        return {};
      }
      at = &(*at)[*index];
    } else {
      return {nullptr, true};
    }
  }
  return {at, false};
}

std::size_t bytes_of(const Json& value) {
  constexpr std::size_t kNode = 64;  // estimated size of a tree node
  std::size_t bytes = sizeof(Json);
  if (value.is_string()) {
    bytes += value.get_ref<const std::string&>().size();
  } else if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      bytes += kNode + key.size() + bytes_of(member);
    }
  } else if (value.is_array()) {
    for (const Json& element : value) {
      bytes += bytes_of(element);
    }
  }
  return bytes;
}

}  // namespace

/// @param document base document, or the document of another point of this sweep
static void write_values(const SweepData& data, const std::vector<Json>& values, Json& document) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (const SweepTarget& target : data.parameters[i].targets) {
      document[target.place] =
          target.computes() ? Json(target.number_for(values[i].get<double>())) : values[i];
    }
  }
}

Json document_with(const SweepData& data, const std::vector<Json>& values) {
  Json document = data.base;
  write_values(data, values, document);
  return document;
}

std::uint64_t Sweep::size() const { return data_->points; }

std::uint64_t places_of_item(const SweepData& data) {
  std::uint64_t places = 1;
  for (int i = data.refine ? data.refine->parameters : 0; i > 0; --i) {
    places *= data.parameters[data.parameters.size() - static_cast<std::size_t>(i)].count();
  }
  return places;
}

std::uint64_t Sweep::places() const { return data_->points * places_of_item(*data_); }

bool Sweep::refines() const { return data_->refine.has_value(); }

std::uint64_t Sweep::first_place(std::uint64_t outcome) const { return outcome * places_of_item(*data_); }

std::size_t Sweep::output_count() const { return data_->outputs.size(); }

std::vector<std::string_view> Sweep::own_columns() const {
  return refines() ? std::vector<std::string_view>{kPieceColumn, kChangeColumn}
                   : std::vector<std::string_view>{};
}

std::vector<std::string> Sweep::columns() const {
  std::vector<std::string> names;
  for (const SweepParameter& parameter : data_->parameters) {
    names.push_back(parameter.name);
  }
  for (const SweepOutput& output : data_->outputs) {
    names.push_back(output.pointer);
  }
  for (const std::string_view name : own_columns()) {
    names.emplace_back(name);
  }
  names.emplace_back("error");
  return names;
}

Sweep Sweep::for_table() const {
  auto data = std::make_shared<SweepData>();
  data->parameters = data_->parameters;
  data->design = data_->design;
  data->samples = data_->samples;
  data->seed = data_->seed;
  data->outputs = data_->outputs;
  data->refine = data_->refine;
  data->points = data_->points;
  return Sweep(std::move(data));
}

std::size_t Sweep::value_bytes() const {
  std::size_t bytes = 0;
  for (const SweepParameter& parameter : data_->parameters) {
    for (const Json& value : parameter.values) {
      bytes += bytes_of(value);
    }
    for (const std::string& label : parameter.labels) {
      bytes += sizeof(std::string) + label.size();
    }
  }
  return bytes;
}

std::string Sweep::outputs_text() const {
  Json list = Json::array();
  for (const SweepOutput& output : data_->outputs) {
    list.push_back(output.pointer);
  }
  return list.dump();
}

namespace {

/// Returns a text member of a part of the request; "" when absent.
std::string text_of(const Json& part, const char* member) {
  const auto found = part.find(member);
  return found != part.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::string Sweep::title() const { return text_of(data_->base.at("model"), "title"); }

std::string Sweep::analysis_type() const { return text_of(data_->base.at("analysis"), "type"); }

Json Sweep::values(std::uint64_t point) const { return design_values(*data_, point); }

std::shared_ptr<const Json> Sweep::document_at(std::uint64_t point) const {
  return std::make_shared<Json>(document_with(*data_, design_values(*data_, point)));
}

std::string Sweep::request_text(std::uint64_t point) const { return document_at(point)->dump(); }

void Sweep::write_document(std::uint64_t point, std::shared_ptr<Json>& document) const {
  if (document == nullptr) {
    document = std::make_shared<Json>(data_->base);
  }
  write_values(*data_, design_values(*data_, point), *document);
}

std::shared_ptr<const Json> Sweep::document_between(std::uint64_t point, double value) const {
  std::vector<Json> values = design_values(*data_, point);
  values.back() = value;
  return std::make_shared<Json>(document_with(*data_, values));
}

bool Sweep::follows() const { return data_->follow; }

std::uint64_t Sweep::item_size() const { return data_->item_size; }

bool Sweep::follows_logarithm() const {
  const std::optional<SweepRange>& range = data_->parameters.back().range;
  return range && range->log;
}

std::string Sweep::curve_text(std::uint64_t point) const {
  Json values = Json::array();
  for (std::uint64_t i = 0; i < item_size(); ++i) {
    values.push_back(design_values(*data_, point - point % item_size() + i).back());
  }
  const SweepFollow& followed = data_->followed;
  const std::string which = followed.locus   ? " locus"
                            : followed.point ? " point " + std::to_string(*followed.point)
                                             : "";
  return "follow" + which + values.dump();
}

bool Sweep::looks_into(std::string_view part, std::string_view list) const {
  return std::any_of(data_->outputs.begin(), data_->outputs.end(), [&](const SweepOutput& output) {
    return output.tokens[0] == part &&
           (list.empty() || output.tokens.size() == 1 || output.tokens[1] == list);
  });
}

std::vector<std::string_view> Sweep::parts() const {
  std::vector<std::string_view> parts;
  for (const SweepOutput& output : data_->outputs) {
    parts.emplace_back(output.tokens[0]);
  }
  return parts;
}

void Sweep::spare_unused(Analysis& analysis) const {
  OutputOptions& output = analysis.output;
  output.modes = std::any_of(data_->outputs.begin(), data_->outputs.end(), [](const SweepOutput& one) {
    return one.tokens[0] == "critical_points" && (one.tokens.size() < 3 || one.tokens[2] == "mode");
  });
  output.extremes = output.extremes && looks_into("extremes");
  const bool tells_modes = refines() && analysis.traits().linearised;
  if (!looks_into("states") && !looks_into("buckling", "modes") && !tells_modes && !output.extremes &&
      !output.modes) {
    output.points_per_member = std::min(output.points_per_member, 2);
  }
}

void Sweep::drop_unused(Result& result) const {
  const auto drop = [&](auto& list, std::string_view part) {
    if (!looks_into(part)) {
      list.clear();
    }
  };
  drop(result.critical_points, "critical_points");
  drop(result.contact_events, "contact_events");
  drop(result.branches, "branches");
  drop(result.states, "states");
  if (result.buckling && !looks_into("buckling", "modes")) {
    result.buckling->modes.clear();
  }
}

Json Sweep::value_at(const Json& result, std::size_t output) const {
  const Found found = look_up(result, data_->outputs[output].tokens);
  return found.value == nullptr ? Json() : *found.value;
}

PointOutcome Sweep::outcome(const Json& result) const {
  Json outputs = Json::array();
  for (const SweepOutput& output : data_->outputs) {
    const Found found = look_up(result, output.tokens);
    if (found.no_such_field) {
      return {"", "no_such_output", "the result of this analysis has no " + output.pointer};
    }
    outputs.push_back(found.value == nullptr ? Json() : *found.value);
  }
  std::string text = outputs.dump();
  if (text.size() > kMaxOutputBytes) {
    return {"", "outputs_too_large",
            "the outputs of a point have at most " + std::to_string(kMaxOutputBytes) + " bytes, these have " +
                std::to_string(text.size()) + ": point at parts of them, or solve the point as a job"};
  }
  return {std::move(text), "", ""};
}

}  // namespace snapthrough::api
