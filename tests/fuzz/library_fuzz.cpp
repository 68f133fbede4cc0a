/// @file
/// The C interface on arbitrary bytes: checks, solves and sweeps whatever is accepted, for a while, and stops
/// it from another thread.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <thread>

#include "clients/c/snapthrough.h"

namespace {

/// Stops a call after so long unless it ends before.
class Deadline {
 public:
  explicit Deadline(std::chrono::milliseconds longest)
      : stop_(snapthrough_stop_new()), thread_([this, longest](std::stop_token ended) {
          std::unique_lock lock(mutex_);
          waiting_.wait_for(lock, ended, longest, [] { return false; });
          snapthrough_stop_request(stop_);
        }) {}
  ~Deadline() {
    thread_.request_stop();
    thread_.join();
    snapthrough_stop_free(stop_);
  }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
  Deadline(Deadline&&) = delete;
  Deadline& operator=(Deadline&&) = delete;

  [[nodiscard]] snapthrough_options options() const { return {sizeof(snapthrough_options), stop_}; }

 private:
  snapthrough_stop* stop_;
  std::mutex mutex_;
  std::condition_variable_any waiting_;
  std::jthread thread_;
};

/// A document is a text that ends where it says, begins as an object does, and is no defect of the library.
void take(snapthrough_document* document) {
  if (document == nullptr || document->length == 0 || document->text[0] != '{' ||
      document->text[document->length] != '\0' || document->status == SNAPTHROUGH_INTERNAL_ERROR ||
      document->status == SNAPTHROUGH_WRONG_USE) {
    std::abort();
  }
  snapthrough_free(document);
}

int count_steps(const snapthrough_progress* progress, void* user) {
  if (progress->size != sizeof(snapthrough_progress)) {
    std::abort();
  }
  constexpr int kMostSteps = 200;
  return ++*static_cast<int*>(user) > kMostSteps ? 1 : 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const char* text = reinterpret_cast<const char*>(data);
  snapthrough_document* checked = snapthrough_check(text, size);
  const bool valid = checked != nullptr && checked->status == SNAPTHROUGH_DONE;
  take(checked);
  const Deadline deadline(std::chrono::milliseconds(100));
  const snapthrough_options options = deadline.options();
  int steps = 0;
  snapthrough_document* solved = snapthrough_solve(text, size, &options, count_steps, &steps);
  snapthrough_document* swept = snapthrough_sweep(text, size, 0, 0, &options, count_steps, &steps);
  const auto accepted = [](const snapthrough_document* document) {
    return document != nullptr && document->status != SNAPTHROUGH_WRONG_REQUEST;
  };
  if (valid != (accepted(solved) || accepted(swept))) {
    std::abort();  // what is found valid is solved, and nothing else
  }
  take(solved);
  take(swept);
  return 0;
}
