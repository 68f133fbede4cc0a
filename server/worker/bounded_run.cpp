#include "server/worker/bounded_run.h"

#include <exception>
#include <new>
#include <string>
#include <utility>

#include "server/worker/memory_meter.h"

namespace snapthrough::server {
namespace {

/// Names the exception that is being handled. @param limit it ran into; 0: none
JobFailure mishap_of(std::int64_t limit) {
  const MemoryMeter::Pause pause;  // the words are the service's
  if (limit > 0) {
    return {"memory_limit", "the analysis needs more than " + std::to_string(limit) + " bytes of memory", ""};
  }
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {"out_of_memory", "the analysis needs more memory than the service has", ""};
  } catch (const std::exception& error) {
    return {"internal_error", error.what(), ""};
  } catch (...) {
    return {"internal_error", "unknown exception", ""};
  }
}

}  // namespace

BoundedRun run_bounded(std::int64_t memory, const std::function<void()>& analyse) {
  BoundedRun run;
  MemoryMeter meter(memory);
  try {
    analyse();
  } catch (...) {
    run.mishap = mishap_of(meter.exceeded() ? memory : 0);
  }
  run.peak_bytes = meter.peak();
  return run;
}

}  // namespace snapthrough::server
