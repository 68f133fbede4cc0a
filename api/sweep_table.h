#pragma once
/// @file
/// The table of a sweep as JSON, CSV or NDJSON text, in pieces, so that a table need not fit into memory.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/names.h"
#include "api/point_outcome.h"
#include "api/sweep.h"

namespace snapthrough::api {

enum class TableForm {
  json,   ///< `{"columns": [...], "rows": [[...], ...], "points": [...]}`
  csv,    ///< header and rows (RFC 4180 quoting, lines end with LF); null is empty
  ndjson  ///< one object a line, with the columns as members
};

inline constexpr Named<TableForm> kTableForms[] = {
    {"json", TableForm::json}, {"csv", TableForm::csv}, {"ndjson", TableForm::ndjson}};

/// Links to the points of a table; `{point}` stands for the point's number.
struct PointLinks {
  std::string request;  ///< GET returns the request document of a point
  std::string job;      ///< POST submits the request of a point as a job
};

/// Returns the form with a name; nullopt for an unknown name.
[[nodiscard]] std::optional<TableForm> table_form_from(std::string_view name);

/// @brief Writes the rows of one sweep. Not thread-safe.
///
/// The columns of JSON and NDJSON are Sweep::columns() and `point`, the point's number (Sweep::places()).
/// With links, JSON has a member `links`, and CSV has the columns `point` and `request`.
class TableWriter {
 public:
  /// @param about members of the JSON document that tell what made it (provenance_members()); "": none
  TableWriter(const Sweep& sweep, TableForm form, std::optional<PointLinks> links = {},
              std::string about = {});

  /// Returns the text before the rows.
  [[nodiscard]] std::string head() const;
  /// Appends the row of a point, or all rows of a curve or surface of a refined sweep.
  /// @param number of the outcome, less than sweep.size()
  /// @pre outcome is one of item_outcomes()
  void append_row(std::uint64_t number, const PointOutcome& outcome, std::string& text);
  /// @brief Appends at most about `bytes` of the text after the rows. Returns false at its end.
  /// @pre no row follows
  bool append_tail(std::string& text, std::size_t bytes = SIZE_MAX);
  /// Returns the approximate memory in use, in bytes.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  void append_one(const SweepRow& row, std::string& text);
  void append_json(const SweepRow& row, std::string& text) const;
  void append_csv(const SweepRow& row, std::string& text) const;
  void append_ndjson(const SweepRow& row, std::string& text) const;

  Sweep sweep_;
  TableForm form_;
  std::optional<PointLinks> links_;
  std::string about_;
  std::vector<std::string> columns_;
  std::vector<std::string> keys_;  ///< quoted member names of NDJSON
  /// Ranges [first, end) of the numbers of written points in their order, for the end of a JSON document.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> runs_;
  bool tail_begun_ = false;
  std::size_t run_ = 0;               ///< range that the tail writes next
  std::uint64_t written_of_run_ = 0;  ///< number of its points that are written
};

}  // namespace snapthrough::api
