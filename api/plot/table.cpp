#include "api/plot/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "api/plot/numbers.h"
#include "api/plot/plot_error.h"

namespace snapthrough::api::plot {
namespace {

struct KnownLabel {
  const char* pointer;
  const char* label;
};

constexpr KnownLabel kLabels[] = {
    {"/summary/critical_load_factor", "critical load factor"},
    {"/summary/critical_type", "kind of critical point"},
    {"/summary/error_estimate", "estimated relative error"},
    {"/summary/softest/load_factor", "load factor of the softest point"},
    {"/summary/softest/stiffness_ratio", "stiffness ratio of the softest point"}};

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns the unescaped tokens of a JSON Pointer.
std::vector<std::string> tokens_of(const std::string& pointer) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    const char c = pointer[i];
    if (c == '/') {
      tokens.emplace_back();
    } else if (c == '~' && i + 1 < pointer.size() && (pointer[i + 1] == '0' || pointer[i + 1] == '1')) {
      tokens.back() += pointer[++i] == '0' ? '~' : '/';
    } else {
      tokens.back() += c;
    }
  }
  return tokens;
}

std::string in_words(std::string token) {
  std::replace(token.begin(), token.end(), '_', ' ');
  return token;
}

/// Returns the index in a token plus one, as text.
std::string ordinal(const std::string& token) {
  std::size_t index = 0;
  std::from_chars(token.data(), token.data() + token.size(), index);
  return std::to_string(index + 1);
}

/// Returns the label of a column: "/critical_points/0/monitors/crown" is "crown at critical point 1".
std::string label_of(const std::string& column) {
  for (const auto& [pointer, label] : kLabels) {
    if (column == pointer) {
      return label;
    }
  }
  if (!column.starts_with('/')) {
    return column;
  }
  const std::vector<std::string> tokens = tokens_of(column);
  if (tokens[0] == "critical_points" && tokens.size() > 2) {
    return in_words(tokens.back()) + " at critical point " + ordinal(tokens[1]);
  }
  if (tokens[0] == "buckling" && tokens.size() == 3 && tokens[1] == "load_factors") {
    return "buckling load " + ordinal(tokens[2]);
  }
  std::vector<std::string> words;
  std::copy_if(tokens.begin(), tokens.end(), std::back_inserter(words),
               [](const std::string& token) { return !is_number(token); });
  const std::string label = words.empty() ? column : in_words(words.back());
  return words.size() > 1 ? in_words(words[words.size() - 2]) + ", " + label : label;
}

/// Returns the text of a cell that is not a number.
std::string text_of(const nlohmann::json& cell) {
  if (cell.is_string()) {
    return cell.get<std::string>();
  }
  return cell.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Rows of a document that match the request, and column names. Refers to the document.
struct Raw {
  std::vector<std::string> columns;
  Field all;                      ///< all rows of the document
  std::vector<std::size_t> rows;  ///< indices of the matching rows

  [[nodiscard]] Field cell(std::size_t row, std::size_t column) const {
    return all.item(rows[row]).item(column);
  }
  [[nodiscard]] const nlohmann::json& value(std::size_t row, std::size_t column) const {
    return all.json()[rows[row]][column];
  }
};

/// Returns a column: as numbers when all cells are numbers or null, else as texts.
Column column_of(const Raw& raw, std::size_t index) {
  const std::string& name = raw.columns[index];
  Column column{name, label_of(name), {}, std::nullopt};
  bool plain = true;
  for (std::size_t row = 0; row < raw.rows.size() && plain; ++row) {
    plain = raw.value(row, index).is_number() || raw.value(row, index).is_null();
  }
  std::map<std::string, std::size_t> places;
  if (!plain) {
    column.names.emplace();
  }
  for (std::size_t row = 0; row < raw.rows.size(); ++row) {
    const nlohmann::json& cell = raw.value(row, index);
    if (plain || cell.is_null()) {
      column.values.push_back(raw.cell(row, index).number_or_none());
      continue;
    }
    const std::string text = text_of(cell);
    const auto [place, is_new] = places.emplace(text, column.names->size());
    if (is_new) {
      column.names->push_back(text);
    }
    column.values.push_back(static_cast<double>(place->second));
  }
  return column;
}

/// Name that replaces those of the two columns of a refined sweep.
constexpr const char* kOwnColumn = "";

/// Renames the columns of a refined sweep, `piece` and `change`, which stand after an output and before
/// `error`, so that parameters of these names are not taken for them.
void rename_own(std::vector<std::string>& columns) {
  const auto error = std::find(columns.begin(), columns.end(), "error");
  if (error - columns.begin() > 2 && error != columns.end() && error[-1] == "change" &&
      error[-2] == "piece" && error[-3].starts_with('/')) {
    error[-1] = kOwnColumn;
    error[-2] = kOwnColumn;
  }
}

Raw read_raw(const Field& document) {
  const Field rows = document.at("rows");
  Raw raw{{}, rows, {}};
  const Field columns = document.at("columns");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    raw.columns.push_back(columns.item(i).text());
  }
  rename_own(raw.columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows.item(i).size() != raw.columns.size()) {
      rows.item(i).fail("must have a value for each of the " + std::to_string(raw.columns.size()) +
                        " columns");
    }
    raw.rows.push_back(i);
  }
  if (raw.rows.empty()) {
    rows.fail("has no row to draw");
  }
  return raw;
}

std::string names_of(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) {
    all += (all.empty() ? "" : ", ") + name;
  }
  return all.empty() ? "there are none" : "there are: " + all;
}

bool is_parameter(const std::string& column) {
  return column != kOwnColumn && !column.starts_with('/') && column != "error" && column != "point" &&
         column != "request";
}

/// Returns whether a cell equals a text; a number may be written in any form.
bool is_value(const nlohmann::json& cell, const std::string& text) {
  if (!cell.is_number()) {
    return text_of(cell) == text;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // relative tolerance 1e-12: a range's values are often written with fewer digits
  return error == std::errc() && end == text.data() + text.size() &&
         std::abs(cell.get<double>() - value) <= 1e-12 * std::abs(value);
}

/// Keeps only the rows with the values in `where`.
void keep_rows(Raw& raw, const PlotRequest& request) {
  for (const auto& [name, value] : request.where) {
    const auto found = std::find(raw.columns.begin(), raw.columns.end(), name);
    if (found == raw.columns.end() || !is_parameter(name)) {
      std::vector<std::string> names;
      std::copy_if(raw.columns.begin(), raw.columns.end(), std::back_inserter(names), is_parameter);
      throw PlotError("/columns", "has no parameter \"" + name + "\"; " + names_of(names));
    }
    const auto column = static_cast<std::size_t>(found - raw.columns.begin());
    std::erase_if(raw.rows, [&, text = value](std::size_t row) {
      return !is_value(raw.all.json()[row][column], text);
    });
    if (raw.rows.empty()) {
      throw PlotError("/rows", "has no row where " + name + " is " + value);
    }
  }
}

/// Returns the requested output, or the first one with numbers.
Column read_output(const Raw& raw, const PlotRequest& request) {
  std::vector<std::string> outputs;
  for (std::size_t i = 0; i < raw.columns.size(); ++i) {
    const std::string& name = raw.columns[i];
    if (name == "error" || name == kOwnColumn || is_parameter(name)) {
      continue;
    }
    outputs.push_back(name);
    if (request.output ? name != *request.output : name == "point") {
      continue;
    }
    Column column = column_of(raw, i);
    if (request.output || (!column.names && column.has_values())) {
      return column;
    }
  }
  throw PlotError("/columns", request.output
                                  ? "has no output \"" + *request.output + "\"; " + names_of(outputs)
                                  : "has no output with numbers");
}

std::vector<std::string> read_errors(const Raw& raw) {
  std::vector<std::string> errors(raw.rows.size());
  const auto found = std::find(raw.columns.begin(), raw.columns.end(), "error");
  for (std::size_t i = 0; found != raw.columns.end() && i < raw.rows.size(); ++i) {
    const Field cell = raw.cell(i, static_cast<std::size_t>(found - raw.columns.begin()));
    if (cell.json().is_object()) {
      errors[i] = text_or(cell, "code", "failed");
    } else if (!cell.json().is_null()) {
      cell.fail("must be null, or an object with a code");
    }
  }
  return errors;
}

/// Reads the columns of a refined sweep, which read_raw() took out of the others.
void read_pieces(const Raw& raw, Table& table) {
  const auto first = std::find(raw.columns.begin(), raw.columns.end(), kOwnColumn);
  if (first == raw.columns.end()) {
    return;
  }
  const auto piece = static_cast<std::size_t>(first - raw.columns.begin());
  for (std::size_t row = 0; row < raw.rows.size(); ++row) {
    table.pieces.push_back(raw.cell(row, piece).number_or_none());
    const nlohmann::json& change = raw.value(row, piece + 1);
    table.changes.push_back(change.is_null() ? "" : text_of(change));
  }
}

/// Returns the coefficient of variation of the steps between values, or between their logarithms.
double unevenness(const std::vector<double>& values, bool logarithms) {
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = logarithms ? std::log(values[i] / values[i - 1]) : values[i] - values[i - 1];
    sum += step;
    squares += step * step;
  }
  const auto count = static_cast<double>(values.size() - 1);
  const double mean = sum / count;
  return std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean;
}

/// Returns whether all values are the first one and a whole multiple of their smallest step.
bool are_multiples(const std::vector<double>& values) {
  double step = values.back() - values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    step = std::min(step, values[i] - values[i - 1]);
  }
  return std::all_of(values.begin(), values.end(), [&](double value) {
    constexpr double kRounding = 1e-3;  // share of a step
    const double multiple = (value - values.front()) / step;
    return std::abs(multiple - std::round(multiple)) < kRounding;
  });
}

}  // namespace

bool Column::has_values() const {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

std::size_t Column::distinct() const { return distinct_values(values).size(); }

Table read_table(const Field& document, const PlotRequest& request) {
  Raw raw = read_raw(document);
  keep_rows(raw, request);
  Table table;
  for (std::size_t i = 0; i < raw.columns.size(); ++i) {
    if (is_parameter(raw.columns[i])) {
      table.parameters.push_back(column_of(raw, i));
    }
  }
  table.output = read_output(raw, request);
  table.errors = read_errors(raw);
  read_pieces(raw, table);
  for (Column& column : table.parameters) {
    column.refined = !table.pieces.empty();
  }
  return table;
}

std::vector<const Column*> varied_parameters(const Table& table) {
  if (table.parameters.empty()) {
    throw PlotError("/columns", "has no parameter, whose column begins with no slash");
  }
  std::vector<std::pair<std::size_t, const Column*>> counted;
  counted.reserve(table.parameters.size());
  for (const Column& column : table.parameters) {
    counted.emplace_back(column.distinct(), &column);
  }
  std::stable_sort(counted.begin(), counted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Column*> varied;
  for (const auto& [count, column] : counted) {
    if (count > 1 || varied.empty()) {
      varied.push_back(column);
    }
  }
  return varied;
}

const Column& parameter(const Table& table, const std::string& name) {
  std::vector<std::string> names;
  for (const Column& column : table.parameters) {
    if (column.name == name) {
      return column;
    }
    names.push_back(column.name);
  }
  throw PlotError("/columns", "has no parameter \"" + name + "\"; " + names_of(names));
}

bool is_logarithmic(const Column& column) {
  const std::vector<double> values = distinct_values(column.values);
  constexpr double kLeastRatio = 8;  // smallest ratio of values for a logarithmic axis
  if (column.names || values.size() < 3 || !(values.front() > 0) ||
      values.back() < kLeastRatio * values.front()) {
    return false;
  }
  return column.refined ? !are_multiples(values) : unevenness(values, true) < unevenness(values, false);
}

std::string failure_text(const std::vector<std::string>& errors) {
  std::map<std::string, std::size_t> counts;
  std::size_t all = 0;
  for (const std::string& code : errors) {
    if (!code.empty()) {
      ++counts[code];
      ++all;
    }
  }
  if (all == 0) {
    return "";
  }
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [code, count] : sorted) {
    text += (text.empty() ? "" : ", ") + format_number(static_cast<double>(count), 6) + " " + code;
  }
  return format_number(static_cast<double>(all), 6) + " failed: " + text;
}

std::vector<double> distinct_values(const std::vector<double>& values) {
  std::vector<double> all;
  std::copy_if(values.begin(), values.end(), std::back_inserter(all),
               [](double value) { return std::isfinite(value); });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string value_text(const Column& column, double value) {
  if (column.names && value >= 0 && value < static_cast<double>(column.names->size())) {
    return (*column.names)[static_cast<std::size_t>(value)];
  }
  return format_number(value);
}

}  // namespace snapthrough::api::plot
