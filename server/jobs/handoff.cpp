#include "server/jobs/handoff.h"

#include <utility>

namespace snapthrough::server {

void HandoffQueue::ring() {
  const std::lock_guard guard(mutex_);
  ++rings_;
  changed_.notify_one();
}

std::size_t HandoffQueue::idle() {
  const std::lock_guard guard(mutex_);
  return idle_;
}

bool HandoffQueue::offer(Handoff& handoff) {
  const std::lock_guard guard(mutex_);
  if (idle_ <= given_.size()) {
    return false;
  }
  given_.push_back(std::move(handoff));
  changed_.notify_one();
  return true;
}

std::optional<Handoff> HandoffQueue::wait(std::uint64_t& seen, std::stop_token stop,
                                          std::chrono::duration<double> time) {
  std::unique_lock lock(mutex_);
  ++idle_;
  changed_.wait_for(lock, std::move(stop), time, [&] { return rings_ != seen || !given_.empty(); });
  --idle_;
  std::optional<Handoff> handoff;
  if (!given_.empty()) {
    handoff = std::move(given_.front());
    given_.pop_front();
  } else {
    seen = rings_;
  }
  return handoff;
}

}  // namespace snapthrough::server
