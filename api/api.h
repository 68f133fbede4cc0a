#pragma once
/// @file
/// Reads request documents (JSON) strictly and writes result documents (JSON).
///
/// The header includes only `nlohmann/json_fwd.hpp`; a file that accesses a document includes
/// `<nlohmann/json.hpp>` itself. Every function is reentrant and has no shared state.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "solver/check/check.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough::api {

/// A request document that was read without findings.
struct Request {
  Model model;
  Analysis analysis;
  std::shared_ptr<const nlohmann::json>
      document;  ///< the document as received; never null after read_request()
};

/// Outcome of reading a request. Either `findings` is not empty or `request` has a value.
struct ReadOutcome {
  bool malformed = false;         ///< not acceptable JSON: syntax, nesting, duplicate keys, number of values
  std::vector<Finding> findings;  ///< all mistakes; beyond kMaxFindings one finding gives their number
  std::optional<Request> request;
};

/// Largest number of findings that are listed one by one.
inline constexpr int kMaxFindings = 1000;

/// @brief Reads and checks a request document: JSON syntax, fields, types, ranges, references, mechanics.
/// @param text UTF-8 JSON; the caller limits its size
/// @return the request, or all findings. Throws only std::bad_alloc, whatever the text.
[[nodiscard]] ReadOutcome read_request(std::string_view text);

/// @brief Reads and checks a request document in memory, such as a point of a sweep.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
[[nodiscard]] ReadOutcome read_request_document(std::shared_ptr<const nlohmann::json> document);

/// @brief Returns the result document.
/// @param wall_time_s duration of the analysis in seconds, measured by the caller
/// @param parts names of the members to write; empty: all members
/// @throws std::runtime_error with the JSON Pointer of the first number that is not finite
[[nodiscard]] nlohmann::json write_result(const Request& request, const Result& result, double wall_time_s,
                                          std::span<const std::string_view> parts = {});

/// @brief Returns findings as `[{"pointer", "code", "detail"}, ...]`, in their order.
[[nodiscard]] nlohmann::json write_findings(const std::vector<Finding>& findings);

}  // namespace snapthrough::api
