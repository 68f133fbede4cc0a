#include "api/sweep_table.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "api/csv_field.h"
#include "api/sweep_data.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

void append_csv_value(const Json& value, std::string& text) {
  if (value.is_null()) {
    return;
  }
  if (value.is_string()) {
    append_csv_text(text, value.get<std::string>());
  } else {
    append_csv_field(text, value.dump());
  }
}

Json error_of(const PointOutcome& outcome) { return {{"code", outcome.code}, {"detail", outcome.detail}}; }

/// Returns a link with {point} replaced by the point's number.
std::string for_point(std::string link, std::uint64_t point) {
  constexpr std::string_view kPlace = "{point}";
  const std::size_t at = link.find(kPlace);
  return at == link.npos ? link : link.replace(at, kPlace.size(), std::to_string(point));
}

/// Returns JSON text with invalid UTF-8 replaced, which messages of exceptions may contain.
std::string dumped(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::optional<TableForm> table_form_from(std::string_view name) { return value_of(kTableForms, name); }

TableWriter::TableWriter(const Sweep& sweep, TableForm form, std::optional<PointLinks> links,
                         std::string about)
    : sweep_(sweep.for_table()),
      form_(form),
      links_(std::move(links)),
      about_(std::move(about)),
      columns_(sweep.columns()) {
  if (form_ == TableForm::ndjson || (form_ == TableForm::csv && links_)) {
    columns_.emplace_back("point");
  }
  if (form_ == TableForm::csv && links_) {
    columns_.emplace_back("request");
  }
  for (const std::string& column : columns_) {
    keys_.push_back(Json(column).dump());
  }
}

std::string TableWriter::head() const {
  std::string text;
  switch (form_) {
    case TableForm::json:
      text = "{" + about_ + (about_.empty() ? "" : ",\n ") + "\"columns\": " + Json(columns_).dump() + ",\n";
      if (links_) {
        text += " \"links\": " + Json{{"request", links_->request}, {"job", links_->job}}.dump() + ",\n";
      }
      return text + " \"rows\": [";
    case TableForm::csv:
      for (const std::string& column : columns_) {
        text += text.empty() ? "" : ",";
        append_csv_text(text, column);
      }
      return text + "\n";
    case TableForm::ndjson:
      return "";
  }
  return text;
}

bool TableWriter::append_tail(std::string& text, std::size_t bytes) {
  if (form_ != TableForm::json) {
    return false;
  }
  const std::size_t before = text.size();
  if (!std::exchange(tail_begun_, true)) {
    text += "\n ],\n \"points\": [";
  }
  for (; run_ < runs_.size(); ++run_, written_of_run_ = 0) {
    const auto& [first, end] = runs_[run_];
    for (; first + written_of_run_ < end; ++written_of_run_) {
      if (text.size() - before >= bytes) {
        return true;
      }
      text += run_ + written_of_run_ == 0 ? "" : ",";
      text += std::to_string(first + written_of_run_);
    }
  }
  text += "]}\n";
  return false;
}

std::size_t TableWriter::held_bytes() const {
  return sweep_.value_bytes() + runs_.capacity() * sizeof(runs_[0]);
}

void TableWriter::append_row(std::uint64_t number, const PointOutcome& outcome, std::string& text) {
  for (const SweepRow& row : sweep_.rows_of(number, outcome)) {
    append_one(row, text);
  }
}

void TableWriter::append_one(const SweepRow& row, std::string& text) {
  switch (form_) {
    case TableForm::json:
      text += runs_.empty() ? "\n  " : ",\n  ";
      append_json(row, text);
      if (runs_.empty() || runs_.back().second != row.point) {
        runs_.emplace_back(row.point, row.point);
      }
      ++runs_.back().second;
      break;
    case TableForm::csv:
      append_csv(row, text);
      break;
    case TableForm::ndjson:
      append_ndjson(row, text);
      break;
  }
}

void TableWriter::append_json(const SweepRow& row, std::string& text) const {
  text += '[';
  for (const Json& value : row.labels) {
    text += value.dump() + ",";
  }
  if (row.outcome.failed()) {
    for (std::size_t i = 0; i < sweep_.output_count(); ++i) {
      text += "null,";
    }
  } else {
    text.append(row.outcome.outputs, 1, row.outcome.outputs.size() - 2);  // without the brackets
    text += ',';
  }
  for (const Json& value : row.own) {
    text += value.dump() + ",";
  }
  text += row.outcome.failed() ? dumped(error_of(row.outcome)) : "null";
  text += ']';
}

void TableWriter::append_csv(const SweepRow& row, std::string& text) const {
  for (const Json& value : row.labels) {
    append_csv_value(value, text);
    text += ',';
  }
  if (row.outcome.failed()) {
    text.append(sweep_.output_count(), ',');
  } else {
    for (const Json& value : Json::parse(row.outcome.outputs)) {
      append_csv_value(value, text);
      text += ',';
    }
  }
  for (const Json& value : row.own) {
    append_csv_value(value, text);
    text += ',';
  }
  if (row.outcome.failed()) {
    append_csv_field(text, dumped(error_of(row.outcome)));
  }
  if (links_) {
    text += ',' + std::to_string(row.point) + ',';
    append_csv_field(text, for_point(links_->request, row.point));
  }
  text += '\n';
}

void TableWriter::append_ndjson(const SweepRow& row, std::string& text) const {
  std::size_t column = 0;
  const auto member = [&](const std::string& value) {
    text += (column == 0 ? "{" : ",") + keys_[column] + ":" + value;
    ++column;
  };
  for (const Json& value : row.labels) {
    member(value.dump());
  }
  if (row.outcome.failed()) {
    for (std::size_t i = 0; i < sweep_.output_count(); ++i) {
      member("null");
    }
  } else {
    for (const Json& value : Json::parse(row.outcome.outputs)) {
      member(value.dump());
    }
  }
  for (const Json& value : row.own) {
    member(value.dump());
  }
  member(row.outcome.failed() ? dumped(error_of(row.outcome)) : "null");
  member(std::to_string(row.point));
  text += "}\n";
}

}  // namespace snapthrough::api
