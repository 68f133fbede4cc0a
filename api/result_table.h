#pragma once
/// @file
/// Tables of one result as CSV (RFC 4180): the same whoever asks, the command line or the service.
///
/// Numbers have the digits that read back to the same value; what a result does not have is empty. Lines end
/// with CR LF.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/json_pieces.h"
#include "solver/result.h"

namespace snapthrough::api {

enum class ResultTable {
  points,           ///< points of all paths
  critical_points,  ///< critical points of all paths
  static_rows,      ///< the load factors of a static analysis
  buckling,         ///< buckling load factors
  vibrations,       ///< one row for each motion at each load factor
  states            ///< one row for each output point of each member in each reported state
};

/// The table of that name ("points", "critical_points", "static", "buckling", "vibrations", "states"), or
/// nothing.
[[nodiscard]] std::optional<ResultTable> result_table_from(std::string_view name);

/// @brief The tables that results of an analysis of this type have, the one to give by default first.
/// @param analysis_type as in a request, such as "path"; another text has none
[[nodiscard]] std::span<const ResultTable> tables_of(std::string_view analysis_type);

/// The names of these tables, separated by commas.
[[nodiscard]] std::string table_names(std::span<const ResultTable> tables);

/// @brief The points of all paths, one a row, under a header line.
///
/// Columns: branch, point, the lists of a branch (api/result_fields.h), one for each monitor (its id), one
/// for each id of its other series ("contact_fraction:<id>"), and where there are frequencies
/// "omega_squared:<number>" and, for loads without a potential, "imaginary:<number>".
class PointsTable {
 public:
  explicit PointsTable(std::vector<Branch> branches);
  /// Appends the next rows until about so many bytes are added. @return whether there are more
  bool append_rows(std::string& csv, std::size_t bytes);
  /// Memory that is kept, about.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  void append_head(std::string& csv) const;
  void append_row(const Branch& branch, std::size_t point, std::string& csv) const;

  const std::vector<Branch> branches_;
  std::vector<std::pair<std::string, std::string>> by_id_;  ///< field and id of the columns by id
  std::size_t squares_ = 0;                                 ///< largest number of frequencies of a point
  std::size_t imaginary_ = 0;                               ///< likewise of imaginary parts
  bool begun_ = false;
  std::size_t branch_ = 0;  ///< index of the next row's branch
  std::size_t point_ = 0;
};

/// @brief A table of a result document.
///
/// Columns are the numbers and texts of the table of fields (api/result_fields.h) in its order, then one for
/// each monitor (its id) and for each id of other fields ("field:<id>"). critical_points: CriticalPoint.
/// static: StaticTable, then frequencies as in PointsTable. buckling: mode (from 1), load_factor,
/// error_estimate. vibrations: load_factor, mode (from 1), omega_squared, imaginary, error_estimate. states:
/// state, branch, load_factor, member, then MemberState.
/// @pre table is not points (see PointsTable)
[[nodiscard]] std::string result_csv(const nlohmann::json& result, ResultTable table);

/// @brief result_csv() of a document that comes in pieces: states one by one, of the others only what the
/// table needs is in memory.
/// @pre table is not points
class ResultTableReader {
 public:
  explicit ResultTableReader(ResultTable table);
  /// Appends what is known after the next piece of the document to `csv`.
  void append(std::string_view piece, std::string& csv);
  /// Appends what is left when the document has ended.
  void end(std::string& csv);
  /// Memory that is kept, about.
  [[nodiscard]] std::size_t held_bytes() const { return source_.held_bytes(); }

 private:
  const ResultTable table_;
  JsonPieces source_;
  bool begun_ = false;
  std::size_t states_ = 0;
};

}  // namespace snapthrough::api
