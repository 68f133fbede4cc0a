#pragma once
/// @file
/// Sweeps: a request document, parameters whose values replace parts of it, and a row of outputs for each
/// point.
///
/// The caller solves: it visits points in any order on any number of threads, gets the request document of
/// each point, and turns the result into the row.

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/api.h"
#include "api/point_outcome.h"

namespace snapthrough::api {

/// Largest number of points; larger designs are rejected before any point is built.
inline constexpr std::uint64_t kMaxSweepPoints = 1'000'000;
inline constexpr std::size_t kMaxSweepParameters = 64;
/// Largest number of targets of a parameter.
inline constexpr std::size_t kMaxSweepTargets = 64;
inline constexpr std::size_t kMaxSweepOutputs = 256;
/// Bytes of the outputs of one point: rows are held whole where results are sent in pieces.
inline constexpr std::size_t kMaxOutputBytes = std::size_t{1} << 20;

struct SweepData;
struct SweepRow;

/// Numbers of rows.
struct RowCounts {
  std::uint64_t rows = 0;
  std::uint64_t failed = 0;
};

/// @brief A sweep document without findings. Immutable, cheap to copy, thread-safe. Each point is built on
/// request.
class Sweep {
 public:
  explicit Sweep(std::shared_ptr<const SweepData> data) : data_(std::move(data)) {}

  /// Returns the sweep document as read. Only files of api/ can use it: api/sweep_data.h defines SweepData.
  [[nodiscard]] const SweepData& data() const { return *data_; }
  /// Returns the number of outcomes, 1 to kMaxSweepPoints: one for each point, or for each curve or surface
  /// of a refined sweep.
  [[nodiscard]] std::uint64_t size() const;
  /// Returns the number of points that have a request: size(), or all places that rows of a refined sweep can
  /// have.
  [[nodiscard]] std::uint64_t places() const;
  /// Returns whether points are added over the last parameters (`refine`). An outcome is then that of a whole
  /// curve or surface, with the rows that rows_of() returns.
  [[nodiscard]] bool refines() const;
  /// Returns the first point of an outcome. @pre outcome < size()
  [[nodiscard]] std::uint64_t first_place(std::uint64_t outcome) const;

  /// Returns the columns of a row in their order: parameter names, output pointers, "piece" and "change" of a
  /// refined sweep, "error".
  [[nodiscard]] std::vector<std::string> columns() const;
  [[nodiscard]] std::size_t output_count() const;
  /// Returns the columns between the outputs and "error": "piece" and "change" of a refined sweep.
  [[nodiscard]] std::vector<std::string_view> own_columns() const;
  /// Returns a copy for columns(), output_count() and rows_of(), without model and analysis, so that a table
  /// that is written over a long time holds less memory.
  [[nodiscard]] Sweep for_table() const;
  /// Returns the approximate memory of the parameters' values in bytes.
  [[nodiscard]] std::size_t value_bytes() const;
  /// Returns the output pointers as a JSON array.
  [[nodiscard]] std::string outputs_text() const;
  /// Returns the title of the model; may be empty.
  [[nodiscard]] std::string title() const;
  /// Returns the type of the analysis before parameters are written; may be empty.
  [[nodiscard]] std::string analysis_type() const;

  /// @brief Returns the parameters' values at a point as a JSON array.
  /// @pre point < places(). In a grid, the last parameter varies fastest.
  [[nodiscard]] nlohmann::json values(std::uint64_t point) const;

  /// @brief Returns the request document of a point: model and analysis with the point's values.
  /// @pre point < places()
  [[nodiscard]] std::shared_ptr<const nlohmann::json> document_at(std::uint64_t point) const;

  /// Returns the request document of a point as text. @pre point < places()
  [[nodiscard]] std::string request_text(std::uint64_t point) const;

  /// @brief Returns the rows of an outcome: the outcome itself, or all rows of a curve or surface
  /// (api/sweep_data.h). @pre number < size()
  [[nodiscard]] std::vector<SweepRow> rows_of(std::uint64_t number, const PointOutcome& outcome) const;
  /// Returns the number of rows of an outcome, and of failed ones. @pre number < size()
  [[nodiscard]] RowCounts row_counts(std::uint64_t number, const PointOutcome& outcome) const;
  /// Returns what distinguishes a refined curve from other sweeps of its points, as text. @pre refines()
  [[nodiscard]] std::string refinement_text() const;

  /// @brief Returns the number of consecutive points that are computed together as an item: 1, or the length
  /// of a followed curve. Items begin at multiples of it.
  [[nodiscard]] std::uint64_t item_size() const;
  [[nodiscard]] std::uint64_t items() const { return size() / item_size(); }
  /// Returns whether items are curves, along which the critical point is followed over the last parameter.
  [[nodiscard]] bool follows() const;
  /// Returns whether a curve is followed in the logarithm of its parameter. @pre follows()
  [[nodiscard]] bool follows_logarithm() const;
  /// @brief Returns the document of a point with another value of the last parameter. @pre follows()
  [[nodiscard]] std::shared_ptr<const nlohmann::json> document_between(std::uint64_t point,
                                                                       double value) const;
  /// Returns all values of the curve through a point as text. @pre follows()
  [[nodiscard]] std::string curve_text(std::uint64_t point) const;

  /// @brief Turns the document of any point of this sweep into that of `point`: a point writes all targets,
  /// so no other value remains. Null creates a document.
  void write_document(std::uint64_t point, std::shared_ptr<nlohmann::json>& document) const;

  /// @brief Switches off modes and extremes that no output needs, and reduces the places along members to two
  /// when no output needs states or modes.
  void spare_unused(Analysis& analysis) const;
  /// @brief Empties the lists of a result that no output needs, to save their writing: critical points,
  /// contact events, branches, states, buckling modes.
  void drop_unused(Result& result) const;

  /// @brief Returns the outputs of a solved point.
  /// @param result document of write_result() with at least parts(). An output that results cannot have is a
  /// failure; one past the end of a list (a second critical point where there is one) is null.
  [[nodiscard]] PointOutcome outcome(const nlohmann::json& result) const;
  /// @brief Returns the value of an output in a result; null when absent. @pre output < output_count()
  [[nodiscard]] nlohmann::json value_at(const nlohmann::json& result, std::size_t output) const;
  /// Returns the members of the result document that outputs need. The views refer to the sweep.
  [[nodiscard]] std::vector<std::string_view> parts() const;

 private:
  [[nodiscard]] bool looks_into(std::string_view part, std::string_view list = {}) const;

  std::shared_ptr<const SweepData> data_;
};

/// Outcome of reading a sweep. Either `findings` is not empty or `sweep` has a value.
struct SweepOutcome {
  bool malformed = false;  ///< not acceptable JSON
  std::vector<Finding> findings;
  std::optional<Sweep> sweep;
};

/// @brief Reads a sweep document and checks what does not depend on a point: fields, targets, values, number
/// of points, output pointers, and the request apart from the targets. Mistakes of single points are found
/// when their documents are read.
/// @param text UTF-8 JSON; the caller limits its size
/// @param most_points largest accepted number of points, at most kMaxSweepPoints
[[nodiscard]] SweepOutcome read_sweep(std::string_view text, std::uint64_t most_points = kMaxSweepPoints);

/// @brief Reads a sweep document in memory.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
[[nodiscard]] SweepOutcome read_sweep_document(const std::shared_ptr<const nlohmann::json>& document,
                                               std::uint64_t most_points = kMaxSweepPoints);

/// Returns whether a document is a sweep rather than a request: it has `parameters`.
[[nodiscard]] bool is_sweep(const nlohmann::json& document);

}  // namespace snapthrough::api
