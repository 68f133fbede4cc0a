#pragma once
/// @file
/// What a client hands in: a document by itself, or in an envelope with what it wants with it.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "solver/check/check.h"

namespace snapthrough::server {

// Characters are code points of Unicode.
inline constexpr std::size_t kLongestLabel = 200;
inline constexpr std::size_t kMostMetadata = 16;           ///< members of metadata
inline constexpr std::size_t kLongestMetadataName = 40;    ///< characters
inline constexpr std::size_t kLongestMetadataValue = 200;  ///< characters

/// What was handed in, taken apart. Without findings there is a document.
struct Envelope {
  std::shared_ptr<const nlohmann::json> document;  ///< the request or sweep
  std::string_view text;                           ///< of the document, byte for byte as it came
  std::string pointer;  ///< of the document in what was handed in: "" or e.g. "/request"
  Annotations annotations;
  bool malformed = false;  ///< not acceptable as JSON
  std::vector<Finding> findings;
};

/// @brief Reads a text that is a document, or an envelope `{"<member>": document}` with `label`, `metadata`
/// and `callback` where they are wanted. A document has no member of that name itself.
/// @param member "request" or "sweep"
/// @param callback_hosts see check_callback()
/// @pre the text outlives the envelope
[[nodiscard]] Envelope open_envelope(std::string_view text, std::string_view member,
                                     const std::vector<std::string>& callback_hosts = {});

/// Findings about the document, with the pointers that they have in what was handed in.
[[nodiscard]] std::vector<Finding> in_envelope(const Envelope& envelope, std::vector<Finding> findings);

/// How many characters a UTF-8 text has.
[[nodiscard]] std::size_t characters(std::string_view text);

}  // namespace snapthrough::server
