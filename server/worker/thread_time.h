#pragma once
/// @file
/// Processor time of the calling thread.

#include <cstdint>
#include <ctime>

namespace snapthrough::server {

/// Measures the processor time of its thread since it was made. To be used by the thread that made it.
class ThreadTime {
 public:
  [[nodiscard]] std::int64_t microseconds() const { return now() - begun_; }

 private:
  [[nodiscard]] static std::int64_t now() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
  }

  std::int64_t begun_ = now();
};

}  // namespace snapthrough::server
