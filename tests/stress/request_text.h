#pragma once
/// @file
/// A drawn request as the document that a user would send.

#include <string>

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @return JSON that reads back as the same request, all digits of every number included
[[nodiscard]] std::string request_text(const RandomRequest& request);

}  // namespace snapthrough::testing
