#include "server/worker/memory_meter.h"

#include <algorithm>
#include <limits>

namespace snapthrough::server {

MemoryMeter*& MemoryMeter::current() {
  static thread_local constinit MemoryMeter* meter = nullptr;
  return meter;
}

MemoryMeter::MemoryMeter(std::int64_t limit) : limit_(limit), outer_(current()) { current() = this; }

MemoryMeter::~MemoryMeter() { current() = outer_; }

MemoryMeter::Pause::Pause() : paused_(current()) { current() = nullptr; }

MemoryMeter::Pause::~Pause() { current() = paused_; }

bool MemoryMeter::admits(std::size_t bytes) {
  // used_ may be negative: memory from before was freed.
  const std::int64_t room = limit_ - std::max<std::int64_t>(used_, 0);
  if (bytes <= static_cast<std::uint64_t>(std::max<std::int64_t>(room, 0))) {
    return true;
  }
  exceeded_ = true;
  return false;
}

void MemoryMeter::add(std::int64_t bytes) {
  used_ += bytes;
  peak_ = std::max(peak_, used_);
}

}  // namespace snapthrough::server
