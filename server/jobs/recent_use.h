#pragma once
/// @file
/// Processor time that owners and other parties have used recently.

#include <chrono>
#include <cmath>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace snapthrough::server {

/// @brief Tells parties that use much processor time from others. Half of what a party has used is forgotten
/// every kHalf. Thread-safe.
class RecentUse {
 public:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  static constexpr Seconds kHalf{2.0};
  /// More is much: a tenth of a processor, used without a pause.
  static constexpr Seconds kMuch{0.3};

  void add(const std::string& party, Seconds used, Clock::time_point now = Clock::now()) {
    const std::lock_guard guard(mutex_);
    forget(now);
    Use& use = of_[party];
    use = {left(use, now) + used, now};
  }

  [[nodiscard]] bool is_much(const std::string& party, Clock::time_point now = Clock::now()) const {
    const std::lock_guard guard(mutex_);
    const auto use = of_.find(party);
    return use != of_.end() && left(use->second, now) > kMuch;
  }

  /// Returns all parties that use much.
  [[nodiscard]] std::vector<std::string> of_much(Clock::time_point now = Clock::now()) const {
    const std::lock_guard guard(mutex_);
    std::vector<std::string> parties;
    for (const auto& [party, use] : of_) {
      if (left(use, now) > kMuch) {
        parties.push_back(party);
      }
    }
    return parties;
  }

 private:
  struct Use {
    Seconds used{0.0};
    Clock::time_point at;
  };

  static Seconds left(const Use& use, Clock::time_point now) {
    return use.used * std::exp2(-(now - use.at) / kHalf);
  }

  /// Removes parties that have used nearly nothing, once every kHalf.
  void forget(Clock::time_point now) {
    if (now < forgot_ + kHalf) {
      return;
    }
    forgot_ = now;
    std::erase_if(of_, [&](const auto& use) { return left(use.second, now) < kMuch / 100; });
  }

  mutable std::mutex mutex_;
  std::unordered_map<std::string, Use> of_;
  Clock::time_point forgot_;
};

}  // namespace snapthrough::server
