#include "server/sweeps/scheduler.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace snapthrough::server {
namespace {

constexpr double kShortestChunk = 0.1;
constexpr double kLongestChunk = 1.0;
constexpr double kStoreShare = 0.05;
constexpr std::uint64_t kFirstChunk = 2;
constexpr std::uint64_t kLargestChunk = 8192;  // items; all are prepared before the first is computed

}  // namespace

ActiveSweep::ActiveSweep(std::string name, api::Sweep read, OpenSweep open)
    : id(std::move(name)),
      document(std::move(open.document)),
      sweep(std::move(read)),
      owner(std::move(open.owner)),
      outputs(sweep.outputs_text()),
      reuse(open.reuse) {}

bool SweepScheduler::add(std::shared_ptr<ActiveSweep> sweep) {
  const std::lock_guard guard(mutex_);
  const auto same = [&](const auto& other) { return other->id == sweep->id; };
  if (std::any_of(sweeps_.begin(), sweeps_.end(), same)) {
    return false;
  }
  sweeps_.push_back(std::move(sweep));
  look();
  return true;
}

bool SweepScheduler::has(const std::string& id) const {
  const std::lock_guard guard(mutex_);
  return std::any_of(sweeps_.begin(), sweeps_.end(), [&](const auto& sweep) { return sweep->id == id; });
}

void SweepScheduler::give_turns_to(const std::vector<std::string>& ids) {
  const std::lock_guard guard(mutex_);
  for (const std::shared_ptr<ActiveSweep>& sweep : sweeps_) {
    sweep->aside_ = std::find(ids.begin(), ids.end(), sweep->id) == ids.end();
  }
  look();
}

std::size_t SweepScheduler::count() const {
  const std::lock_guard guard(mutex_);
  return sweeps_.size();
}

void SweepScheduler::look() {
  available_ = std::any_of(sweeps_.begin(), sweeps_.end(),
                           [](const auto& sweep) { return !sweep->aside_ && !sweep->exhausted_; });
}

double SweepScheduler::chunk_seconds() const {
  return std::clamp(store_seconds_ / kStoreShare, kShortestChunk, kLongestChunk);
}

void SweepScheduler::store_took(double seconds) {
  const double before = store_seconds_;
  store_seconds_ =
      before > 0.0 ? 0.5 * (before + seconds) : seconds;  // a lost update between threads does not matter
}

/// Largest number of items in a chunk that should take `seconds`.
std::uint64_t SweepScheduler::most_items(const ActiveSweep& sweep, double seconds) {
  if (sweep.sweep.item_size() > 1) {
    return 1;  // a curve takes long: another worker may have the next one
  }
  if (sweep.seconds_per_item_ > 0.0) {
    return static_cast<std::uint64_t>(
        std::clamp(seconds / sweep.seconds_per_item_, 1.0, static_cast<double>(kLargestChunk)));
  }
  return kFirstChunk;
}

std::uint64_t SweepScheduler::served(const std::string& owner) const {
  const auto found = served_.find(owner);
  return found == served_.end() ? 0 : found->second;
}

/// Returns how many chunks of the owner's sweeps are in work.
std::ptrdiff_t SweepScheduler::chunks_of(const std::string& owner) const {
  return std::count_if(watches_.begin(), watches_.end(), [&](const Watch* watch) {
    const auto of_watch = std::find_if(sweeps_.begin(), sweeps_.end(),
                                       [&](const auto& sweep) { return sweep->id == watch->claim_.sweep; });
    return of_watch != sweeps_.end() && (*of_watch)->owner == owner;
  });
}

std::optional<SweepTurn> SweepScheduler::next(double seconds, const OwnersInTurn& owners) {
  const std::lock_guard guard(mutex_);
  const auto waits = [&](const ActiveSweep& sweep) {
    return !sweep.aside_ && !sweep.exhausted_ && (owners.most == 0 || chunks_of(sweep.owner) < owners.most) &&
           std::find(owners.except.begin(), owners.except.end(), sweep.owner) == owners.except.end();
  };
  const auto order = [&](const auto& sweep) {
    return std::tuple(!waits(*sweep), served(sweep->owner), sweep->served_);
  };
  const auto first = std::min_element(sweeps_.begin(), sweeps_.end(),
                                      [&](const auto& a, const auto& b) { return order(a) < order(b); });
  if (first == sweeps_.end() || !waits(**first)) {
    return std::nullopt;
  }
  ActiveSweep& sweep = **first;
  served_[sweep.owner] = sweep.served_ = ++turns_;
  return SweepTurn{*first, most_items(sweep, seconds), sweep.changes_};
}

void SweepScheduler::exhausted(const SweepTurn& turn) {
  const std::lock_guard guard(mutex_);
  turn.sweep->exhausted_ = turn.sweep->changes_ == turn.changes;
  look();
}

void SweepScheduler::refresh() {
  const std::lock_guard guard(mutex_);
  std::erase_if(sweeps_, [](const auto& sweep) {
    return (sweep->aside_ || sweep->exhausted_) && sweep.use_count() == 1;
  });
  for (const std::shared_ptr<ActiveSweep>& sweep : sweeps_) {
    ++sweep->changes_;
    sweep->exhausted_ = false;
  }
  look();
}

void SweepScheduler::give_back(const Chunk& chunk, std::uint64_t done, double seconds) {
  const std::lock_guard guard(mutex_);
  ActiveSweep& sweep = *chunk.sweep;
  if (done < chunk.claim.items.count) {
    ++sweep.changes_;
    sweep.exhausted_ = false;
  }
  if (done > 0) {
    const double latest = seconds / static_cast<double>(done);
    sweep.seconds_per_item_ =
        sweep.seconds_per_item_ > 0.0 ? 0.5 * (sweep.seconds_per_item_ + latest) : latest;
  }
  look();
}

template <class Is>
void SweepScheduler::remove_if(Is is) {
  std::shared_ptr<ActiveSweep> removed;
  {
    const std::lock_guard guard(mutex_);
    const auto found = std::find_if(sweeps_.begin(), sweeps_.end(), is);
    if (found == sweeps_.end()) {
      return;
    }
    removed = std::move(*found);
    sweeps_.erase(found);
    if (sweeps_.empty()) {
      served_.clear();
    }
    look();
  }
  removed->stop_.request_stop();  // without the lock: the callbacks of workers use this scheduler
}

void SweepScheduler::remove(const std::string& id) {
  remove_if([&](const auto& sweep) { return sweep->id == id; });
}

void SweepScheduler::remove(const std::shared_ptr<ActiveSweep>& sweep) {
  remove_if([&](const auto& other) { return other == sweep; });
}

SweepScheduler::Watch::Watch(SweepScheduler& scheduler, const ItemClaim& claim, Time since)
    : scheduler_(scheduler), claim_(claim), held_since_(since), since_(since) {
  const std::lock_guard guard(scheduler_.mutex_);
  scheduler_.watches_.push_back(this);
}

SweepScheduler::Watch::~Watch() {
  const std::lock_guard guard(scheduler_.mutex_);
  std::erase(scheduler_.watches_, this);
}

void SweepScheduler::Watch::begin(Time since) {
  const std::lock_guard guard(scheduler_.mutex_);
  since_ = since;
}

void SweepScheduler::Watch::stop(StopReason reason) {
  {
    const std::lock_guard guard(scheduler_.mutex_);
    reason_ = reason_ == StopReason::none ? reason : reason_;
  }
  stop_.request_stop();
}

StopReason SweepScheduler::Watch::reason() const {
  const std::lock_guard guard(scheduler_.mutex_);
  return reason_;
}

template <class Is>
void SweepScheduler::stop_if(Is is, StopReason reason) {
  std::vector<std::stop_source> found;
  {
    const std::lock_guard guard(mutex_);
    for (Watch* watch : watches_) {
      if (is(*watch) && watch->reason_ == StopReason::none) {
        watch->reason_ = reason;
        found.push_back(watch->stop_);
      }
    }
  }
  for (const std::stop_source& source : found) {
    source.request_stop();
  }
}

void SweepScheduler::stop_older(Time since) {
  stop_if([&](const Watch& watch) { return watch.since_ < since; }, StopReason::time_limit);
}

void SweepScheduler::stop_claim(std::int64_t number, StopReason reason) {
  stop_if([&](const Watch& watch) { return watch.claim_.number == number; }, reason);
}

std::vector<ItemClaim> SweepScheduler::older(Time since) const {
  const std::lock_guard guard(mutex_);
  std::vector<ItemClaim> held;
  for (const Watch* watch : watches_) {
    if (watch->held_since_ <= since) {
      held.push_back(watch->claim_);
    }
  }
  return held;
}

}  // namespace snapthrough::server
