#pragma once
/// @file
/// What is wrong with a request.

#include <string>

namespace snapthrough {

/// One mistake: where (JSON Pointer into the request document), which rule, and a sentence.
struct Finding {
  std::string pointer;  ///< e.g. "/model/members/0/section"
  std::string code;  ///< e.g. "unknown_reference", "out_of_range", "zero_length", "mechanism", "unsupported"
  std::string detail;  ///< one sentence naming the field and the rule
};

}  // namespace snapthrough
