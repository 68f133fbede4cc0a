#pragma once
/// @file
/// Tables of sweeps: parameters, outputs, and error codes of failed points (docs/sweeps.md).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/plot/document.h"
#include "api/plot/plot_request.h"

namespace snapthrough::api::plot {

/// A column as numbers: kNone for null; texts are numbered 0, 1, 2, ... in the order of their first rows.
struct Column {
  std::string name;
  std::string label;  ///< name in words, for axis labels
  std::vector<double> values;
  std::optional<std::vector<std::string>> names;  ///< texts by number; nullopt: a column of numbers
  bool refined = false;                           ///< rows of a refined sweep lie where its curves need them

  [[nodiscard]] bool has_values() const;
  [[nodiscard]] std::size_t distinct() const;
};

/// The rows of a sweep table that a figure draws.
struct Table {
  std::vector<Column> parameters;
  Column output;
  std::vector<std::string> errors;  ///< error code of each row; empty: the point did not fail
  /// Columns of a refined sweep, one entry for each row; empty for other sweeps. Rows of different pieces are
  /// not joined; `changes` is "" where no piece begins.
  std::vector<double> pieces;
  std::vector<std::string> changes;
};

/// @brief Reads the rows that match `where`, with all parameters and the requested output.
/// @throws PlotError when the table is invalid or lacks a column or value of the request
[[nodiscard]] Table read_table(const Field& document, const PlotRequest& request);

/// Returns the parameters with more than one value, most values first; the first parameter if none varies.
[[nodiscard]] std::vector<const Column*> varied_parameters(const Table& table);

/// Returns the parameter with a name. @throws PlotError when the table has none
[[nodiscard]] const Column& parameter(const Table& table, const std::string& name);

/// Returns whether a logarithmic axis spaces the values more evenly: all > 0, over a factor of 8 or more. The
/// values of a refined column are places of a range: multiples of a step, or of a ratio.
[[nodiscard]] bool is_logarithmic(const Column& column);

/// Returns the counts of error codes, such as "3 failed: 2 no_start, 1 mechanism"; "" without errors.
[[nodiscard]] std::string failure_text(const std::vector<std::string>& errors);

/// Returns the distinct finite values in increasing order.
[[nodiscard]] std::vector<double> distinct_values(const std::vector<double>& values);

/// Returns a value of a column as text: the text with that number, or the number.
[[nodiscard]] std::string value_text(const Column& column, double value);

}  // namespace snapthrough::api::plot
