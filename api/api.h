#pragma once
/// @file
/// JSON in, JSON out: reads request documents strictly and writes result documents.
///
/// Only `nlohmann/json_fwd.hpp` is included, so this header is cheap; a file that looks inside a document
/// includes
/// `<nlohmann/json.hpp>` itself. Every function is reentrant and shares nothing.

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

/// A request that was read and found to be without mistakes.
struct Request {
  Model model;
  Analysis analysis;
  std::shared_ptr<const nlohmann::json>
      document;  ///< as received; never null in a request that read_request gave
};

/// What reading a text gave. Exactly one of `findings` (not empty) and `request` (a value) holds.
struct ReadOutcome {
  bool malformed = false;  ///< not acceptable as JSON: syntax, too deep, duplicate keys, too many values
  std::vector<Finding> findings;  ///< every mistake, at most kMaxFindings and one that says there are more
  std::optional<Request> request;
};

/// More mistakes than this are not listed one by one.
inline constexpr int kMaxFindings = 1000;

/// @brief Reads a request document and checks it: JSON syntax, fields, types, ranges, references, mechanics.
/// @param text UTF-8 JSON; its size is the caller's to limit
/// @return The request, or all that is wrong with it. Never throws for a wrong text (std::bad_alloc apart).
[[nodiscard]] ReadOutcome read_request(std::string_view text);

/// @brief The same for a document that is in memory already, such as one point of a sweep.
/// @pre document is not null and nested no deeper than ParseLimits::depth (api/json_text.h)
[[nodiscard]] ReadOutcome read_request_document(std::shared_ptr<const nlohmann::json> document);

/// @brief The result document.
/// @param wall_time_s seconds that the analysis took, as its caller measured them
/// @param parts names of the document's members that are wanted; none: all of them
/// @throws std::runtime_error with the JSON Pointer of the first number that is not finite
[[nodiscard]] nlohmann::json write_result(const Request& request, const Result& result, double wall_time_s,
                                          std::span<const std::string_view> parts = {});

/// @brief `[{"pointer", "code", "detail"}, ...]`, in the order given.
[[nodiscard]] nlohmann::json write_findings(const std::vector<Finding>& findings);

}  // namespace snapthrough::api
