#pragma once
/// @file
/// Reader of tables of comma-separated values (RFC 4180).

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/convert/convert.h"

namespace snapthrough::api::convert {

/// Column of a table.
struct Column {
  std::string_view name;
  bool is_required = true;
};

/// @brief A table whose first row names its columns, in any order.
///
/// Rows have line numbers of the file, which begin with 1. Empty lines are no rows. Texts are without the
/// blanks around them. Findings name their place as FILE:LINE:COLUMN.
class CsvTable {
 public:
  /// Reads a table; reports what breaks RFC 4180, unknown and missing columns, rows with too few or too many
  /// fields, and more than `most_rows` rows. A table with findings has no rows. Polls WorkLimit.
  CsvTable(const CsvFile& file, std::span<const Column> columns, std::size_t most_rows,
           std::vector<Finding>& findings);

  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  /// Returns the text of a field; "" when the table lacks the column.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
  /// Returns a number of at most kMaxMagnitude; nullopt for an empty field, and after a finding.
  /// @param is_required an empty field is a finding
  [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view column,
                                             bool is_required) const;
  /// Returns the place of a field for findings.
  [[nodiscard]] std::string place(std::size_t row, std::string_view column) const;

 private:
  struct Row {
    std::size_t line = 0;
    std::vector<std::string> fields;
  };

  void read_rows(std::string_view text, std::size_t most_rows);
  void read_header(std::span<const Column> columns);
  void report(std::size_t line, std::string_view code, std::string detail) const;

  std::string name_;
  std::vector<Finding>* findings_;
  std::vector<std::string> columns_;  ///< names in the order of the file
  std::vector<Row> rows_;
};

}  // namespace snapthrough::api::convert
