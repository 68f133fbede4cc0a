/// @file
/// The reader of request documents on arbitrary bytes.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "api/api.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const snapthrough::api::ReadOutcome outcome = snapthrough::api::read_request(text);
  if (outcome.findings.empty() != outcome.request.has_value()) {
    std::abort();  // exactly one of the two
  }
  return 0;
}
