/// @file
/// Functions of the WebAssembly module: those of the C interface (clients/c/snapthrough.h), whose progress the
/// host is told by a function that the module imports.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>

#include "api/sweep.h"
#include "clients/c/snapthrough.h"

extern "C" {
/// Imported. Whether the call shall stop, 0: no.
__attribute__((import_module("snapthrough"), import_name("progress"))) int snapthrough_wasm_progress(
    double done, double total, double load_factor, int branch, int negative_eigenvalues, double arc_length,
    const double* monitors, std::size_t monitor_count);
}

namespace {

int tell(const snapthrough_progress* now, void* /*unused*/) {
  return snapthrough_wasm_progress(static_cast<double>(now->done), static_cast<double>(now->total),
                                   now->load_factor, now->branch, now->negative_eigenvalues, now->arc_length,
                                   now->monitors, now->monitor_count);
}

}  // namespace

#define EXPORTED(name) __attribute__((export_name(name)))

extern "C" {

/// @param watched not 0: the host is told the progress
EXPORTED("solve")
snapthrough_document* snapthrough_wasm_solve(const char* request, std::size_t length, int watched) {
  return snapthrough_solve(request, length, nullptr, watched != 0 ? tell : nullptr, nullptr);
}

EXPORTED("check")
snapthrough_document* snapthrough_wasm_check(const char* document, std::size_t length) {
  return snapthrough_check(document, length);
}

/// Counts of points are whole numbers below 2^53. @param watched as above
EXPORTED("sweep")
snapthrough_document* snapthrough_wasm_sweep(const char* document, std::size_t length, double first, double count,
                                             int watched) {
  return snapthrough_sweep(document, length, static_cast<std::uint64_t>(first),
                           static_cast<std::uint64_t>(count), nullptr, watched != 0 ? tell : nullptr, nullptr);
}

/// Request document of a point of a valid sweep; null: there is no such point.
EXPORTED("point")
snapthrough_document* snapthrough_wasm_point(const char* document, std::size_t length, double point) {
  const snapthrough::api::SweepOutcome read = snapthrough::api::read_sweep({document, length});
  if (!read.sweep || !(point >= 0.0) || point >= static_cast<double>(read.sweep->places())) {
    return nullptr;
  }
  const std::string text = read.sweep->request_text(static_cast<std::uint64_t>(point));
  // one allocation with its text, as snapthrough_free() takes it
  void* const memory = ::operator new(sizeof(snapthrough_document) + text.size() + 1);
  char* const copy = static_cast<char*>(memory) + sizeof(snapthrough_document);
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return new (memory) snapthrough_document{copy, text.size(), SNAPTHROUGH_DONE};
}

/// @param choices options, empty for none
EXPORTED("plot")
snapthrough_document* snapthrough_wasm_plot(const char* document, std::size_t length, const char* choices,
                                            std::size_t choices_length) {
  return snapthrough_plot(document, length, choices_length != 0 ? choices : nullptr, choices_length);
}

EXPORTED("release")
void snapthrough_wasm_release(snapthrough_document* document) { snapthrough_free(document); }

EXPORTED("version")
const char* snapthrough_wasm_version() { return snapthrough_version(); }
}
