#pragma once
/// @file
/// Mistakes in a request.

#include <string>

namespace snapthrough {

/// Mistake: place (JSON Pointer into the request document), rule, and message.
struct Finding {
  std::string pointer;  ///< e.g. "/model/members/0/section"
  std::string code;  ///< e.g. "unknown_reference", "out_of_range", "zero_length", "mechanism", "unsupported"
  std::string detail;  ///< one sentence naming the field and the rule
};

}  // namespace snapthrough
