#include "server/jobs/notices.h"

#include <utility>

namespace snapthrough::server {

JobEnds::Ticket::Ticket(JobEnds& ends, std::string id) : ends_(ends), id_(std::move(id)) {
  const std::lock_guard guard(ends_.mutex_);
  ends_.tickets_.emplace(id_, this);
}

JobEnds::Ticket::~Ticket() {
  const std::lock_guard guard(ends_.mutex_);
  const auto [first, last] = ends_.tickets_.equal_range(id_);
  for (auto it = first; it != last; ++it) {
    if (it->second == this) {
      ends_.tickets_.erase(it);
      return;
    }
  }
}

bool JobEnds::Ticket::wait_for(std::chrono::duration<double> time) {
  std::unique_lock lock(ends_.mutex_);
  changed_.wait_for(lock, time, [&] { return ended_ || ends_.closed_; });
  return ended_;
}

void JobEnds::announce(const std::string& id) {
  const std::lock_guard guard(mutex_);
  const auto [first, last] = tickets_.equal_range(id);
  for (auto it = first; it != last; ++it) {
    it->second->ended_ = true;
    it->second->changed_.notify_all();
  }
}

void JobEnds::close() {
  const std::lock_guard guard(mutex_);
  closed_ = true;
  for (const auto& [id, ticket] : tickets_) {
    ticket->changed_.notify_all();
  }
}

void WorkBell::ring() {
  const std::lock_guard guard(mutex_);
  ++count_;
  rung_.notify_one();
}

void WorkBell::wait(std::uint64_t& seen, std::stop_token stop, std::chrono::duration<double> time) {
  std::unique_lock lock(mutex_);
  rung_.wait_for(lock, std::move(stop), time, [&] { return count_ != seen; });
  seen = count_;
}

}  // namespace snapthrough::server
