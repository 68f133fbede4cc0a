#pragma once
/// @file
/// Envelopes: what a client hands in is a document, or an object with a document, a label, metadata and a
/// callback.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "server/jobs/limits.h"
#include "solver/check/check.h"
#include "solver/check/check_place.h"

namespace snapthrough::server {

// Bounds in code points of Unicode.
inline constexpr std::size_t kLongestLabel = 200;
inline constexpr std::size_t kMostMetadata = 16;           ///< members of metadata
inline constexpr std::size_t kLongestMetadataName = 40;    ///< characters
inline constexpr std::size_t kLongestMetadataValue = 200;  ///< characters

/// What was handed in, in parts. `document` is set when `findings` is empty.
struct Envelope {
  std::shared_ptr<const nlohmann::json> document;  ///< the request or sweep
  std::string_view text;                           ///< text of the document, byte for byte
  std::string pointer;  ///< JSON Pointer of the document in what was handed in: "" or e.g. "/request"
  Annotations annotations;
  bool malformed = false;  ///< the text is not JSON that the service accepts
  std::vector<Finding> findings;
};

/// @brief Reads a document, or an envelope `{"<member>": document}` with optional `label`, `metadata` and
/// `callback`. An object with the member is an envelope: documents have no member of that name.
/// @param member "request" or "sweep"
/// REQUIRES: the text outlives the envelope.
[[nodiscard]] Envelope open_envelope(std::string_view text, std::string_view member,
                                     const JobLimits& limits = {});

/// Findings of the envelope and of the document, each with its pointer in what was handed in.
[[nodiscard]] std::vector<Finding> in_envelope(const Envelope& envelope, std::vector<Finding> findings);

using checks::characters;

}  // namespace snapthrough::server
