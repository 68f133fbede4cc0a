#pragma once
/// @file
/// The table of a sweep as text: JSON, CSV, or NDJSON, piece by piece, so that no table has to be in memory.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/names.h"
#include "api/sweep.h"

namespace snapthrough::api {

enum class TableForm {
  json,   ///< `{"columns": [...], "rows": [[...], ...], "points": [...]}`
  csv,    ///< header and rows (RFC 4180 quoting, lines end with a line feed); null is empty
  ndjson  ///< one object a line, members named like the columns
};

inline constexpr Named<TableForm> kTableForms[] = {
    {"json", TableForm::json}, {"csv", TableForm::csv}, {"ndjson", TableForm::ndjson}};

/// Where the points of a table are found, as texts in which `{point}` stands for the number of a point.
struct PointLinks {
  std::string request;  ///< GET: its request document
  std::string job;      ///< POST: its request is handed in as a job
};

/// The form of that name, or nothing.
[[nodiscard]] std::optional<TableForm> table_form_from(std::string_view name);

/// @brief Writes the rows of one sweep. Not thread-safe.
///
/// The columns of JSON and NDJSON are Sweep::columns() and `point`, the number of the point. With links a
/// JSON document has them as a member, and CSV has columns `point` and `request`.
class TableWriter {
 public:
  TableWriter(const Sweep& sweep, TableForm form, std::optional<PointLinks> links = {});

  /// What comes before the rows.
  [[nodiscard]] std::string head() const;
  /// Appends the row of a point. @pre outcome.outputs is a JSON array of sweep.output_count() values, or
  /// outcome.failed()
  void append_row(std::uint64_t point, const PointOutcome& outcome, std::string& text);
  /// @brief Appends what comes after the rows, at most about so many bytes of it at once.
  /// False when that was the rest of it. No row may follow.
  bool append_tail(std::string& text, std::size_t bytes = SIZE_MAX);
  /// Memory that it keeps, about.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  void append_json(std::uint64_t point, const PointOutcome& outcome, std::string& text) const;
  void append_csv(std::uint64_t point, const PointOutcome& outcome, std::string& text) const;
  void append_ndjson(std::uint64_t point, const PointOutcome& outcome, std::string& text) const;

  Sweep sweep_;
  TableForm form_;
  std::optional<PointLinks> links_;
  std::vector<std::string> columns_;
  std::vector<std::string> keys_;  ///< of NDJSON, quoted
  /// Numbers of points of the rows, for the end of a JSON document: first and one past the last, in order.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> runs_;
  bool tail_begun_ = false;
  std::size_t run_ = 0;               ///< of the tail: that is written next,
  std::uint64_t written_of_run_ = 0;  ///< and how many of its points were
};

}  // namespace snapthrough::api
