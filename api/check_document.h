#pragma once
/// @file
/// Every mistake of a request or a sweep, or its size: what POST /v1/check answers.

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "api/api.h"
#include "api/sweep.h"

namespace snapthrough::api {

/// What is wrong with a document, and how large its analyses are.
struct CheckedDocument {
  std::vector<Finding> findings;  ///< empty: it can be solved
  std::uint64_t points = 1;       ///< of a sweep
  int unknowns =
      0;  ///< free displacements of the first mesh; of a sweep: at the first point that is a valid request
};

/// What else a caller refuses in a request without mistakes, such as one that needs too much memory.
using AlsoRefused = std::function<std::vector<Finding>(const Request&)>;

/// @brief Checks a request document.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
/// @param also asked about a request that has no mistakes; may be empty
[[nodiscard]] CheckedDocument check_request(const std::shared_ptr<const nlohmann::json>& document,
                                            const AlsoRefused& also = {});

/// @brief Checks a sweep document.
/// @pre as check_request()
/// @param most_points sweeps with more are refused; at most kMaxSweepPoints
/// @param also asked about the points from which the size is taken; may be empty
[[nodiscard]] CheckedDocument check_sweep(const std::shared_ptr<const nlohmann::json>& document,
                                          std::uint64_t most_points = kMaxSweepPoints,
                                          const AlsoRefused& also = {});

/// `{"valid", "errors", "size": {"points", "unknowns"} or null}` as a text; texts that are no UTF-8 are
/// replaced.
[[nodiscard]] std::string write_check(const CheckedDocument& checked);

}  // namespace snapthrough::api
