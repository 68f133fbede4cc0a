#include "api/sweep.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/sweep_data.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

Json value_at(const SweepParameter& parameter, std::uint64_t i) {
  if (!parameter.range) {
    return parameter.values[i];
  }
  const SweepRange& range = *parameter.range;
  const auto last = static_cast<std::uint64_t>(range.count - 1);
  if (i == 0 || i == last) {
    return i == 0 ? range.from : range.to;  // the ends are exact
  }
  const double t = static_cast<double>(i) / static_cast<double>(last);
  return range.log ? range.from * std::pow(range.to / range.from, t)
                   : range.from + t * (range.to - range.from);
}

/// Position in each parameter's values of a point of the design.
std::vector<std::uint64_t> positions(const SweepData& data, std::uint64_t point) {
  std::vector<std::uint64_t> result(data.parameters.size(), point);
  if (data.design == SweepDesign::grid) {
    for (std::size_t i = result.size(); i-- > 0;) {
      const std::uint64_t count = data.parameters[i].count();
      result[i] = point % count;
      point /= count;
    }
  }
  return result;
}

std::vector<Json> values_at(const SweepData& data, std::uint64_t point) {
  const std::vector<std::uint64_t> at = positions(data, point);
  std::vector<Json> values;
  for (std::size_t i = 0; i < at.size(); ++i) {
    values.push_back(value_at(data.parameters[i], at[i]));
  }
  return values;
}

/// What an output pointer found: a value, nothing where a list ended, or a place that results do not have.
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

std::string csv_field(const Json& value) {
  if (value.is_null()) {
    return "";
  }
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

}  // namespace

std::uint64_t Sweep::size() const { return data_->points; }

std::vector<std::string> Sweep::columns() const {
  std::vector<std::string> names;
  for (const SweepParameter& parameter : data_->parameters) {
    names.push_back(parameter.name);
  }
  for (const SweepOutput& output : data_->outputs) {
    names.push_back(output.pointer);
  }
  names.emplace_back("error");
  return names;
}

std::shared_ptr<const Json> Sweep::document_at(std::uint64_t point) const {
  auto document = std::make_shared<Json>(data_->base);
  const std::vector<Json> values = values_at(*data_, point);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (const SweepTarget& target : data_->parameters[i].targets) {
      (*document)[Json::json_pointer(target.pointer)] =
          target.scale ? Json(values[i].get<double>() * *target.scale) : values[i];
    }
  }
  return document;
}

Json Sweep::row(std::uint64_t point, const Json& result) const {
  Json row = values_at(*data_, point);
  for (const SweepOutput& output : data_->outputs) {
    const Found found = look_up(result, output.tokens);
    if (found.no_such_field) {
      return error_row(point, "no_such_output", "the result of this analysis has no " + output.pointer);
    }
    row.push_back(found.value == nullptr ? Json() : *found.value);
  }
  row.push_back(nullptr);
  return row;
}

Json Sweep::error_row(std::uint64_t point, std::string_view code, std::string_view detail) const {
  Json row = values_at(*data_, point);
  for (std::size_t i = 0; i < data_->outputs.size(); ++i) {
    row.push_back(nullptr);
  }
  row.push_back({{"code", code}, {"detail", detail}});
  return row;
}

std::string csv_line(const Json& row) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    line += (i == 0 ? "" : ",") + csv_field(row[i]);
  }
  return line + "\n";
}

}  // namespace snapthrough::api
