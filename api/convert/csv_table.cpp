#include "api/convert/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "api/convert/text.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::convert {

namespace {

/// Largest number of fields of a row that are kept. No table has so many columns, so that a first row that
/// names more has a column that is unknown, or there twice.
constexpr std::size_t kKeptFields = 100;

struct CsvRow {
  std::vector<std::string> fields;  ///< the first kKeptFields
  std::size_t count = 0;            ///< number of all fields
};

/// Splits a text into rows of fields, one row at a time.
class CsvSplitter {
 public:
  explicit CsvSplitter(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  /// Returns the line that the next row begins with.
  [[nodiscard]] std::size_t line() const { return line_; }
  /// Returns whether a row broke the rules of quotes; splitting cannot go on.
  [[nodiscard]] bool has_wrong_quotes() const { return wrong_quotes_; }

  /// Returns the fields of the next row. @pre !at_end()
  CsvRow next() {
    CsvRow row;
    bool more = true;
    while (more && !wrong_quotes_) {
      WorkLimit::poll();
      std::string field = text_.substr(at_).starts_with('"') ? quoted() : plain();
      if (++row.count <= kKeptFields) {
        row.fields.push_back(std::move(field));
      }
      more = !at_end() && text_[at_] == ',';
      at_ += more ? 1 : 0;
    }
    end_line();
    return row;
  }

 private:
  std::string plain() {
    const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    std::string field(trimmed(text_.substr(at_, end - at_)));
    wrong_quotes_ = field.find('"') != std::string::npos;
    at_ = end;
    return field;
  }

  /// Reads a field in quotes; a pair of quotes in it stands for one.
  std::string quoted() {
    std::string field;
    for (++at_; !at_end(); ++at_) {
      if (text_[at_] == '"' && !text_.substr(at_ + 1).starts_with('"')) {
        ++at_;
        wrong_quotes_ = !at_end() && std::string_view(",\r\n").find(text_[at_]) == std::string_view::npos;
        return field;
      }
      at_ += text_[at_] == '"' ? 1 : 0;
      line_ += text_[at_] == '\n' ? 1 : 0;
      field += text_[at_];
    }
    wrong_quotes_ = true;  // the closing quote is missing
    return field;
  }

  void end_line() {
    at_ += text_.substr(std::min(at_, text_.size())).starts_with("\r\n") ? 2 : 1;
    ++line_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool wrong_quotes_ = false;
};

std::string list_of(std::span<const Column> columns) {
  std::string all;
  for (const Column& column : columns) {
    all.append(all.empty() ? "" : ", ").append(column.name);
  }
  return all;
}

}  // namespace

CsvTable::CsvTable(const CsvFile& file, std::span<const Column> columns, std::size_t most_rows,
                   std::vector<Finding>& findings)
    : name_(file.name), findings_(&findings) {
  const std::size_t before = findings.size();
  std::string_view text = file.text;
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  if (!is_utf8(text)) {
    report(1, "malformed", "the table must be text in UTF-8");
  } else {
    read_rows(text, most_rows);
    read_header(columns);
  }
  if (findings.size() > before) {
    rows_.clear();
  }
}

void CsvTable::read_rows(std::string_view text, std::size_t most_rows) {
  CsvSplitter splitter(text);
  std::size_t column_count = 0;
  while (!splitter.at_end()) {
    const std::size_t line = splitter.line();
    auto [fields, count] = splitter.next();
    if (splitter.has_wrong_quotes()) {
      report(line, "malformed",
             "a quote must enclose a whole field, and a quote in the field must be doubled");
      return;
    }
    if (count == 1 && fields.front().empty()) {
      continue;
    }
    if (columns_.empty()) {
      columns_ = std::move(fields);
      column_count = count;
      continue;
    }
    if (count != column_count) {
      report(
          line, "malformed",
          "the row has " + std::to_string(count) + " fields, the first row " + std::to_string(column_count));
      return;
    }
    if (rows_.size() == most_rows) {
      report(line, "too_many", "the table may have at most " + std::to_string(most_rows) + " rows");
      return;
    }
    rows_.push_back({line, std::move(fields)});
  }
}

void CsvTable::read_header(std::span<const Column> columns) {
  const auto count = [this](std::string_view name) {
    return std::count(columns_.begin(), columns_.end(), name);
  };
  for (const Column& column : columns) {
    if (column.is_required && count(column.name) == 0) {
      report(1, "missing_field",
             "the first row must name the column " + std::string(column.name) +
                 "; columns are separated by commas");
    }
    if (count(column.name) > 1) {
      report(1, "duplicate", "the column " + std::string(column.name) + " is there twice");
    }
  }
  for (const std::string& name : columns_) {
    if (std::none_of(columns.begin(), columns.end(),
                     [&](const Column& known) { return known.name == name; })) {
      report(1, "unknown_field",
             "unknown column " + checks::in_quotes(name) + "; known here: " + list_of(columns));
    }
  }
}

void CsvTable::report(std::size_t line, std::string_view code, std::string detail) const {
  findings_->push_back({name_ + ":" + std::to_string(line), std::string(code), std::move(detail)});
}

std::string CsvTable::place(std::size_t row, std::string_view column) const {
  return name_ + ":" + std::to_string(rows_[row].line) + ":" + std::string(column);
}

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  static const std::string kNone;
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  return found == columns_.end() ? kNone
                                 : rows_[row].fields[static_cast<std::size_t>(found - columns_.begin())];
}

std::optional<double> CsvTable::number(std::size_t row, std::string_view column, bool is_required) const {
  const std::string& field = text(row, column);
  if (field.empty() && !is_required) {
    return std::nullopt;
  }
  const std::optional<double> value = parse_number(field);
  if (!value) {
    findings_->push_back({place(row, column), "wrong_type",
                          "expected a number with a decimal point, got " + checks::in_quotes(field)});
  } else if (!(std::abs(*value) <= kMaxMagnitude)) {
    findings_->push_back({place(row, column), "out_of_range",
                          "the number must be finite and at most " + checks::text(kMaxMagnitude)});
    return std::nullopt;
  }
  return value;
}

}  // namespace snapthrough::api::convert
