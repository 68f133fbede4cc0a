#pragma once
/// @file
/// Checks a request or a sweep without solving it, and gives its size (POST /v1/check).

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/api.h"
#include "api/expected_time.h"
#include "api/sweep.h"

namespace snapthrough::api {

/// Findings about a document and the size of its analyses.
struct CheckedDocument {
  std::vector<Finding> findings;  ///< empty: the document is valid
  std::uint64_t points = 1;       ///< number of points of a sweep
  int unknowns =
      0;  ///< free displacements of the first mesh, for a sweep at its first valid point; 0: none valid
  /// Processor time of the analysis, or of all points of a sweep; nullopt: no point that was read is valid.
  std::optional<ExpectedTime> expected = std::nullopt;
};

/// Further findings of the caller about a valid request, such as too much memory.
using AlsoRefused = std::function<std::vector<Finding>(const Request&)>;

/// @brief Checks a request document.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
/// @param also called with a request without findings; may be empty
[[nodiscard]] CheckedDocument check_request(const std::shared_ptr<const nlohmann::json>& document,
                                            const AlsoRefused& also = {});

/// @brief Checks a sweep document.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
/// @param most_points largest accepted number of points, at most kMaxSweepPoints
/// @param also called with the points read for the size; may be empty
[[nodiscard]] CheckedDocument check_sweep(const std::shared_ptr<const nlohmann::json>& document,
                                          std::uint64_t most_points = kMaxSweepPoints,
                                          const AlsoRefused& also = {});

/// Returns `{"valid", "errors", "size": {"points", "unknowns", "expected"} or null}` as JSON text, where
/// `expected` is `{"cpu_seconds", "low", "high", "model"}` or null; invalid UTF-8 is replaced.
[[nodiscard]] std::string write_check(const CheckedDocument& checked);

}  // namespace snapthrough::api
