#include "server/sweeps/scheduler.h"

#include <algorithm>
#include <utility>

namespace snapthrough::server {
namespace {

/// How long a worker computes before it stores rows and looks for jobs.
constexpr double kChunkSeconds = 0.1;
constexpr std::size_t kFirstChunk = 2;
constexpr std::size_t kLargestChunk = 2048;

}  // namespace

ActiveSweep::ActiveSweep(std::string name, api::Sweep read, OpenSweep open)
    : id(std::move(name)),
      document(std::move(open.document)),
      sweep(std::move(read)),
      owner(std::move(open.owner)),
      outputs(sweep.outputs_text()),
      reuse(open.reuse),
      done_(sweep.units(), true) {
  for (std::uint64_t point = 0; point < open.done.size(); ++point) {
    if (!open.done[point]) {
      done_[point / sweep.unit_size()] = false;  // it is computed wholly
    }
  }
  for (const auto& [point, crashes] : open.crashes) {
    if (const std::uint64_t unit = point / sweep.unit_size(); !done_.at(unit)) {
      done_[unit] = true;  // the process died with it once: not again with others beside it
      again_.push_back({unit});
    }
  }
}

std::vector<std::uint64_t> Chunk::points() const {
  const std::uint64_t size = sweep->sweep.unit_size();
  std::vector<std::uint64_t> points;
  for (const std::uint64_t unit : units) {
    for (std::uint64_t i = 0; i < size; ++i) {
      points.push_back(unit * size + i);
    }
  }
  return points;
}

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

bool SweepScheduler::has_room() const { return count() < kMost; }

std::size_t SweepScheduler::count() const {
  const std::lock_guard guard(mutex_);
  return sweeps_.size();
}

bool SweepScheduler::has_more(ActiveSweep& sweep) {
  while (sweep.cursor_ < sweep.done_.size() && sweep.done_[sweep.cursor_]) {
    ++sweep.cursor_;
  }
  return !sweep.again_.empty() || sweep.cursor_ < sweep.done_.size();
}

void SweepScheduler::look() {
  available_ =
      std::any_of(sweeps_.begin(), sweeps_.end(), [](const auto& sweep) { return has_more(*sweep); });
}

/// How many units a chunk has at most.
std::size_t SweepScheduler::most_units(const ActiveSweep& sweep) {
  if (sweep.sweep.unit_size() > 1) {
    return 1;  // it takes long: another worker may have the next
  }
  if (sweep.seconds_per_unit_ > 0.0) {
    return static_cast<std::size_t>(
        std::clamp(kChunkSeconds / sweep.seconds_per_unit_, 1.0, static_cast<double>(kLargestChunk)));
  }
  return kFirstChunk;
}

std::vector<std::uint64_t> SweepScheduler::next_units(ActiveSweep& sweep) {
  std::vector<std::uint64_t> units;
  if (sweep.cursor_ >= sweep.done_.size()) {
    units = std::move(sweep.again_.front());
    sweep.again_.pop_front();
    return units;
  }
  const std::size_t most = most_units(sweep);
  for (; units.size() < most && sweep.cursor_ < sweep.done_.size(); ++sweep.cursor_) {
    if (!sweep.done_[sweep.cursor_]) {
      units.push_back(sweep.cursor_);
    }
  }
  return units;
}

std::optional<Chunk> SweepScheduler::take() {
  const std::lock_guard guard(mutex_);
  for (std::size_t i = 0; i < sweeps_.size(); ++i) {
    std::shared_ptr<ActiveSweep> sweep = std::move(sweeps_.front());
    sweeps_.pop_front();
    sweeps_.push_back(sweep);
    if (has_more(*sweep)) {
      std::vector<std::uint64_t> units = next_units(*sweep);
      look();
      return Chunk{std::move(sweep), {}, std::move(units)};
    }
  }
  return std::nullopt;
}

void SweepScheduler::give_back(const Chunk& chunk, std::vector<std::uint64_t> rest, double seconds) {
  const std::lock_guard guard(mutex_);
  ActiveSweep& sweep = *chunk.sweep;
  const std::size_t done = chunk.units.size() - rest.size();
  if (!rest.empty()) {
    sweep.again_.push_back(std::move(rest));
  }
  if (done > 0) {
    const double latest = seconds / static_cast<double>(done);
    sweep.seconds_per_unit_ =
        sweep.seconds_per_unit_ > 0.0 ? 0.5 * (sweep.seconds_per_unit_ + latest) : latest;
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
    look();
  }
  removed->stop_.request_stop();  // calls those who work on it, who use this scheduler
}

void SweepScheduler::remove(const std::string& id) {
  remove_if([&](const auto& sweep) { return sweep->id == id; });
}

void SweepScheduler::remove(const std::shared_ptr<ActiveSweep>& sweep) {
  remove_if([&](const auto& other) { return other == sweep; });
}

SweepScheduler::Watch::Watch(SweepScheduler& scheduler, Time since) : scheduler_(scheduler), since_(since) {
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

void SweepScheduler::stop_older(Time since) {
  std::vector<std::stop_source> late;
  {
    const std::lock_guard guard(mutex_);
    for (Watch* watch : watches_) {
      if (watch->since_ < since && watch->reason_ == StopReason::none) {
        watch->reason_ = StopReason::time_limit;
        late.push_back(watch->stop_);
      }
    }
  }
  for (std::stop_source& source : late) {
    source.request_stop();
  }
}

}  // namespace snapthrough::server
