/// @file
/// The readers of request and sweep documents on arbitrary bytes, and what is made of a sweep that was read.

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "api/api.h"
#include "api/sweep.h"
#include "api/sweep_table.h"

namespace {

/// Rows and documents of the first and last points, in every form.
void use_sweep(const snapthrough::api::Sweep& sweep) {
  using namespace snapthrough::api;
  for (const TableForm form : {TableForm::json, TableForm::csv, TableForm::ndjson}) {
    TableWriter writer(sweep, form);
    std::string text = writer.head();
    for (const std::uint64_t point : {std::uint64_t{0}, sweep.size() - 1}) {
      writer.append_row(point, {"", "code", "a \"detail\""}, text);
    }
    writer.append_tail(text);
  }
  for (const std::uint64_t point : {std::uint64_t{0}, sweep.size() - 1}) {
    const ReadOutcome read = read_request_document(sweep.document_at(point));
    if (read.findings.empty() != read.request.has_value()) {
      std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const snapthrough::api::ReadOutcome outcome = snapthrough::api::read_request(text);
  if (outcome.findings.empty() != outcome.request.has_value()) {
    std::abort();  // exactly one of the two
  }
  const snapthrough::api::SweepOutcome sweep = snapthrough::api::read_sweep(text, 10'000);
  if (sweep.findings.empty() != sweep.sweep.has_value()) {
    std::abort();
  }
  if (sweep.sweep) {
    use_sweep(*sweep.sweep);
  }
  return 0;
}
