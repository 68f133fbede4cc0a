#pragma once
/// @file
/// Sweeps: one request document, parameters that are written into it, and one row of outputs for each point.
///
/// Nothing here solves anything: a caller goes through the points in whatever order and on as many threads
/// as it likes, and gets for each one the request document to solve and, from its result, the row.

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/api.h"

namespace snapthrough::api {

/// Designs with more points than this are refused before any of them is built.
inline constexpr std::uint64_t kMaxSweepPoints = 1'000'000;
inline constexpr std::size_t kMaxSweepParameters = 64;
/// Of one parameter.
inline constexpr std::size_t kMaxSweepTargets = 64;
inline constexpr std::size_t kMaxSweepOutputs = 256;

struct SweepData;

/// What became of a point: its outputs, or why there are none.
struct PointOutcome {
  std::string outputs = {};  ///< JSON array, one value for each output; empty: the point failed
  std::string code = {};     ///< of the failure, e.g. "no_convergence"; empty: the point was solved
  std::string detail = {};   ///< of the failure: a sentence

  [[nodiscard]] bool failed() const { return !code.empty(); }
};

/// @brief A sweep document that was read and found to be without mistakes. Immutable, cheap to copy, and safe
/// to use from several threads; points are built one by one when they are asked for.
class Sweep {
 public:
  explicit Sweep(std::shared_ptr<const SweepData> data) : data_(std::move(data)) {}

  /// The sweep document as it was read. Only files of api/ can use it: SweepData is defined in
  /// api/sweep_data.h.
  [[nodiscard]] const SweepData& data() const { return *data_; }
  /// Number of points, 1 to kMaxSweepPoints.
  [[nodiscard]] std::uint64_t size() const;

  /// Names of the parameters, pointers of the outputs, and "error": what a row begins with, in this order.
  [[nodiscard]] std::vector<std::string> columns() const;
  [[nodiscard]] std::size_t output_count() const;
  /// What columns(), output_count() and labels() need, without the model and the analysis: a table that is
  /// written for a while keeps no more in memory.
  [[nodiscard]] Sweep for_table() const;
  /// Memory of the values of the parameters, about.
  [[nodiscard]] std::size_t value_bytes() const;
  /// The pointers of the outputs as a JSON array.
  [[nodiscard]] std::string outputs_text() const;
  /// Title of the model; may be empty.
  [[nodiscard]] std::string title() const;
  /// Type of the analysis as it stands around the targets; may be empty.
  [[nodiscard]] std::string analysis_type() const;

  /// @brief The values of the parameters at a point, as a JSON array.
  /// @pre point < size(). Points of a grid are numbered with the last parameter varying fastest.
  [[nodiscard]] nlohmann::json values(std::uint64_t point) const;

  /// @brief The same as a row shows them: labels in place of values that have one.
  /// @pre point < size()
  [[nodiscard]] nlohmann::json labels(std::uint64_t point) const;

  /// @brief The request document of a point: the sweep's model and analysis with the values written in.
  /// @pre point < size()
  [[nodiscard]] std::shared_ptr<const nlohmann::json> document_at(std::uint64_t point) const;

  /// The same as a text. @pre point < size()
  [[nodiscard]] std::string request_text(std::uint64_t point) const;

  /// @brief How many points, from a multiple of it on, are one unit of work: computed together, and wholly.
  /// 1, or the length of a curve.
  [[nodiscard]] std::uint64_t unit_size() const;
  [[nodiscard]] std::uint64_t units() const { return size() / unit_size(); }
  /// Whether units are curves, along which the critical point is followed as the last parameter varies.
  [[nodiscard]] bool follows() const;
  /// Whether a curve is followed in the logarithm of its parameter. @pre follows()
  [[nodiscard]] bool follows_logarithm() const;
  /// @brief The request document of a point with another value of the last parameter. @pre follows()
  [[nodiscard]] std::shared_ptr<const nlohmann::json> document_between(std::uint64_t point,
                                                                       double value) const;
  /// All values of the curve that a point is on, as a text. @pre follows()
  [[nodiscard]] std::string curve_text(std::uint64_t point) const;

  /// @brief The document of a point, written over that of another point of this sweep: every point writes all
  /// of its targets, so nothing of the other one stays. Null makes a new one.
  void write_document(std::uint64_t point, std::shared_ptr<nlohmann::json>& document) const;

  /// @brief Spares an analysis what no output looks into: places along the members where states and modes
  /// are given.
  void spare_unused(Analysis& analysis) const;
  /// @brief Empties the lists of a result that no output looks into, so that they are not written for
  /// nothing: critical points, contact events, branches, states, buckling modes.
  void drop_unused(Result& result) const;

  /// @brief The outputs of a point that was solved.
  /// @param result what write_result() gave, with at least parts(). An output whose place the result cannot
  /// have is a failure; one past the end of a list (a second critical point where there is one) is null.
  [[nodiscard]] PointOutcome outcome(const nlohmann::json& result) const;
  /// @brief What an output finds in a result; null where there is nothing. @pre output < output_count()
  [[nodiscard]] nlohmann::json value_at(const nlohmann::json& result, std::size_t output) const;
  /// Members of the result document that outputs look into. Refers to the sweep.
  [[nodiscard]] std::vector<std::string_view> parts() const;

 private:
  [[nodiscard]] bool looks_into(std::string_view part, std::string_view list = {}) const;

  std::shared_ptr<const SweepData> data_;
};

/// What reading a sweep gave. Exactly one of `findings` (not empty) and `sweep` (a value) holds.
struct SweepOutcome {
  bool malformed = false;  ///< not acceptable as JSON
  std::vector<Finding> findings;
  std::optional<Sweep> sweep;
};

/// @brief Reads a sweep document and checks all of it that does not depend on a point: fields, targets,
/// values, the number of points, output pointers, and the request as it stands around the targets. What is
/// wrong with single points is left to reading their documents.
/// @param text UTF-8 JSON; its size is the caller's to limit
/// @param most_points designs with more are refused; at most kMaxSweepPoints
[[nodiscard]] SweepOutcome read_sweep(std::string_view text, std::uint64_t most_points = kMaxSweepPoints);

/// @brief The same for a document in memory.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
[[nodiscard]] SweepOutcome read_sweep_document(const std::shared_ptr<const nlohmann::json>& document,
                                               std::uint64_t most_points = kMaxSweepPoints);

/// Whether a document is meant to be a sweep rather than a request: it has parameters.
[[nodiscard]] bool is_sweep(const nlohmann::json& document);

}  // namespace snapthrough::api
