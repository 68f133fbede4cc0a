#include "server/jobs/handoff.h"

#include <utility>

namespace snapthrough::server {

bool HandoffQueue::offer(Handoff& handoff) {
  return bell_.wake_if([&] {
    const bool wanted = idle_ > given_.size();
    if (wanted) {
      given_.push_back(std::move(handoff));
    }
    return wanted;
  });
}

std::optional<Handoff> HandoffQueue::wait(std::uint64_t& seen, std::stop_token stop,
                                          std::chrono::duration<double> time) {
  bell_.locked([&] { ++idle_; });
  bell_.wait(seen, std::move(stop), time, [&] { return !given_.empty(); });
  return bell_.locked([&] {
    --idle_;
    std::optional<Handoff> handoff;
    if (!given_.empty()) {
      handoff = std::move(given_.front());
      given_.pop_front();
    }
    return handoff;
  });
}

}  // namespace snapthrough::server
