#include "server/jobs/work.h"

#include <utility>

namespace snapthrough::server {

void WorkExchange::ring() {
  const std::lock_guard guard(mutex_);
  ++rings_;
  changed_.notify_one();
}

bool WorkExchange::offer(Handoff& handoff) {
  const std::lock_guard guard(mutex_);
  if (idle_ <= given_.size()) {
    return false;
  }
  given_.push_back(std::move(handoff));
  changed_.notify_one();
  return true;
}

std::optional<Handoff> WorkExchange::wait(std::uint64_t& seen, std::stop_token stop,
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

ActiveJobs::Entry::Entry(ActiveJobs& active, const Claim& claim, Time since)
    : active_(active), claim_{claim.id, claim.attempt}, since_(since) {
  const std::lock_guard guard(active_.mutex_);
  active_.entries_.emplace(claim_.id, this);
}

ActiveJobs::Entry::~Entry() {
  const std::lock_guard guard(active_.mutex_);
  const auto [first, last] = active_.entries_.equal_range(claim_.id);
  for (auto it = first; it != last; ++it) {
    if (it->second == this) {
      active_.entries_.erase(it);
      return;
    }
  }
}

void ActiveJobs::Entry::stop(StopReason reason) {
  const std::lock_guard guard(active_.mutex_);
  stop_entry(*this, reason);
}

StopReason ActiveJobs::Entry::reason() const {
  const std::lock_guard guard(active_.mutex_);
  return reason_;
}

void ActiveJobs::stop_entry(Entry& entry, StopReason reason) {
  if (entry.reason_ == StopReason::none) {
    entry.reason_ = reason;
    entry.stop_.request_stop();
  }
}

void ActiveJobs::stop(const std::string& id, StopReason reason) {
  const std::lock_guard guard(mutex_);
  const auto [first, last] = entries_.equal_range(id);
  for (auto it = first; it != last; ++it) {
    stop_entry(*it->second, reason);
  }
}

void ActiveJobs::stop_older(Time since, StopReason reason) {
  const std::lock_guard guard(mutex_);
  for (const auto& [id, entry] : entries_) {
    if (entry->since_ < since) {
      stop_entry(*entry, reason);
    }
  }
}

std::vector<Claim> ActiveJobs::older(Time since) const {
  const std::lock_guard guard(mutex_);
  std::vector<Claim> claims;
  for (const auto& [id, entry] : entries_) {
    if (entry->since_ < since) {
      claims.push_back(entry->claim_);
    }
  }
  return claims;
}

std::size_t ActiveJobs::count() const {
  const std::lock_guard guard(mutex_);
  return entries_.size();
}

}  // namespace snapthrough::server
