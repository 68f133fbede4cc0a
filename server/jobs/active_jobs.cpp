#include "server/jobs/active_jobs.h"

#include <chrono>

namespace snapthrough::server {

namespace {

/// Whether the store has the job that `stored` is about, see ActiveJobs::Entry.
bool has_it(const std::shared_future<bool>& stored) {
  return !stored.valid() ||
         (stored.wait_for(std::chrono::seconds(0)) == std::future_status::ready && stored.get());
}

}  // namespace

ActiveJobs::Entry::Entry(ActiveJobs& active, const Claim& claim, Time since,
                         const std::shared_future<bool>* stored)
    : active_(active),
      claim_{claim.id, claim.attempt},
      since_(since),
      stored_(stored == nullptr ? std::shared_future<bool>() : *stored) {
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

std::vector<Claim> ActiveJobs::stored_before(Time since) const {
  const std::lock_guard guard(mutex_);
  std::vector<Claim> claims;
  for (const auto& [id, entry] : entries_) {
    if (entry->since_ < since && has_it(entry->stored_)) {
      claims.push_back(entry->claim_);
    }
  }
  return claims;
}

bool ActiveJobs::has(const std::string& id) const {
  const std::lock_guard guard(mutex_);
  return entries_.contains(id);
}

std::size_t ActiveJobs::count() const {
  const std::lock_guard guard(mutex_);
  return entries_.size();
}

}  // namespace snapthrough::server
