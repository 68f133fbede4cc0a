#pragma once
/// @file
/// Tables of sweeps: parameters, outputs, and why points failed (docs/sweeps.md).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/plot/document.h"
#include "api/plot/plot.h"

namespace snapthrough::api::plot {

/// A column as numbers: kNone where there is none; texts count as 0, 1, 2, ... in the order of their first
/// rows.
struct Column {
  std::string name;
  std::string label;  ///< as people say it
  std::vector<double> values;
  std::optional<std::vector<std::string>> names;  ///< the texts; nothing for numbers

  [[nodiscard]] bool has_values() const;
  [[nodiscard]] std::size_t distinct() const;
};

/// Rows that were asked for.
struct Table {
  std::vector<Column> parameters;
  Column output;
  std::vector<std::string> errors;  ///< code of each row; empty where it did not fail
};

/// @brief The rows of a table with the columns of all parameters and of the output that is asked for.
/// @throws PlotError also when the request names a column or a value that is not there
[[nodiscard]] Table read_table(const Field& document, const PlotRequest& request);

/// The parameters with more than one value, those with most values first; one at least.
/// @throws PlotError when the table has no parameter
[[nodiscard]] std::vector<const Column*> varied_parameters(const Table& table);

/// The parameter of that name. @throws PlotError when there is none
[[nodiscard]] const Column& parameter(const Table& table, const std::string& name);

/// Whether values belong on a logarithmic axis: positive, and spaced more evenly there.
[[nodiscard]] bool is_logarithmic(const Column& column);

/// "3 failed: 2 no_start, 1 mechanism"; "" when none did.
[[nodiscard]] std::string failure_text(const std::vector<std::string>& errors);

/// Distinct finite values, increasing.
[[nodiscard]] std::vector<double> distinct_values(const std::vector<double>& values);

/// The value of a column as text: its name, or a number.
[[nodiscard]] std::string value_text(const Column& column, double value);

}  // namespace snapthrough::api::plot
