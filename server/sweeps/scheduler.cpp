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
      done_(std::move(open.done)) {
  const auto block = static_cast<std::ptrdiff_t>(sweep.block());
  for (auto begin = done_.begin(); sweep.follows() && begin != done_.end(); begin += block) {
    const bool all = std::all_of(begin, begin + block, [](bool done) { return done; });
    std::fill(begin, begin + block, all);  // a curve is computed wholly
  }
  for (const auto& [point, crashes] : open.crashes) {
    if (!sweep.follows() && !done_.at(point)) {
      done_[point] = true;  // the process died with it once: not again with others beside it
      again_.push_back({point});
    }
  }
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

std::vector<std::uint64_t> SweepScheduler::next_points(ActiveSweep& sweep) {
  std::vector<std::uint64_t> points;
  if (sweep.cursor_ >= sweep.done_.size()) {
    points = std::move(sweep.again_.front());
    sweep.again_.pop_front();
    return points;
  }
  std::size_t wanted = kFirstChunk;
  if (sweep.seconds_per_point_ > 0.0) {
    wanted = static_cast<std::size_t>(
        std::clamp(kChunkSeconds / sweep.seconds_per_point_, 1.0, static_cast<double>(kLargestChunk)));
  }
  if (sweep.sweep.follows()) {
    wanted = static_cast<std::size_t>(sweep.sweep.block());  // the cursor is where a curve begins
  }
  while (points.size() < wanted && sweep.cursor_ < sweep.done_.size()) {
    if (!sweep.done_[sweep.cursor_]) {
      points.push_back(sweep.cursor_);
    }
    ++sweep.cursor_;
  }
  return points;
}

std::optional<Chunk> SweepScheduler::take() {
  const std::lock_guard guard(mutex_);
  for (std::size_t i = 0; i < sweeps_.size(); ++i) {
    std::shared_ptr<ActiveSweep> sweep = std::move(sweeps_.front());
    sweeps_.pop_front();
    sweeps_.push_back(sweep);
    if (has_more(*sweep)) {
      std::vector<std::uint64_t> points = next_points(*sweep);
      look();
      return Chunk{std::move(sweep), {}, std::move(points)};
    }
  }
  return std::nullopt;
}

void SweepScheduler::give_back(const Chunk& chunk, std::vector<std::uint64_t> rest, double seconds,
                               std::size_t done) {
  const std::lock_guard guard(mutex_);
  ActiveSweep& sweep = *chunk.sweep;
  if (!rest.empty()) {
    sweep.again_.push_back(std::move(rest));
  }
  if (done > 0) {
    const double latest = seconds / static_cast<double>(done);
    sweep.seconds_per_point_ =
        sweep.seconds_per_point_ > 0.0 ? 0.5 * (sweep.seconds_per_point_ + latest) : latest;
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
