#pragma once
/// @file
/// Limits how many clients are worked on at a time, fairly by party.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace snapthrough::server::http {

/// @brief A fixed number of turns, of which one party has a part at most. Thread-safe; no function blocks.
///
/// A party is whoever shares a key or an address. Parties that wait are served in rotation, the clients of
/// one party in the order of their arrival. A function that throws std::bad_alloc has changed nothing.
class Turns {
 public:
  using Clock = std::chrono::steady_clock;

  Turns(int count, int of_one_party) : free_(count), of_one_party_(of_one_party) {}

  /// Returns whether `who` gets a turn at once; else `who` joins the end of its party's row for next().
  bool take(std::uint64_t who, const std::string& party, Clock::time_point now = Clock::now()) {
    const std::lock_guard guard(mutex_);
    Party& its = parties_[party];
    if (free_ > 0 && its.held < of_one_party_) {
      --free_;
      ++its.held;
      return true;
    }
    std::list<std::string> place;
    if (its.row.empty()) {
      place.push_back(party);
    }
    its.row.push_back(who);
    if (!place.empty()) {
      its.since = now;
      rotation_.splice(rotation_.end(), place);
    }
    return false;
  }

  /// A client with a turn.
  struct Next {
    std::uint64_t who = 0;
    std::string party;
  };

  /// Takes a turn back from a party and gives it to the next that waits; nullopt when none may have it.
  std::optional<Next> pass(const std::string& party, Clock::time_point now = Clock::now()) {
    const std::lock_guard guard(mutex_);
    const auto may_have_one = [&](const std::string& name) {
      return parties_.find(name)->second.held - (name == party ? 1 : 0) < of_one_party_;
    };
    const auto place = std::find_if(rotation_.begin(), rotation_.end(), may_have_one);
    std::optional<Next> next;
    if (place != rotation_.end()) {
      next = Next{parties_.find(*place)->second.row.front(), *place};
    }
    take_back(party, now);  // from here on nothing throws
    if (next) {
      // Parties before the place have their part, and wait on.
      rotation_.splice(rotation_.end(), rotation_, rotation_.begin(), place);
      give_next(place, now);
    }
    return next;
  }

  /// Returns the longest time for which a party has had none of the turns that it could have while a client
  /// of it waits; zero when no party waits for others. Time in which a party has all the turns that one party
  /// may have does not count.
  [[nodiscard]] Clock::duration longest_wait(Clock::time_point now = Clock::now()) const {
    const std::lock_guard guard(mutex_);
    Clock::duration longest{0};
    for (const std::string& party : rotation_) {
      const Party& its = parties_.find(party)->second;
      if (its.held < of_one_party_) {
        longest = std::max(longest, now - its.since);
      }
    }
    return longest;
  }

 private:
  struct Party {
    int held = 0;
    std::deque<std::uint64_t> row;
    /// Begin of the wait of the row's first client: when the row began, the party got its last turn, or it
    /// gave one of its full share back.
    Clock::time_point since;
  };

  void take_back(const std::string& party, Clock::time_point now) {
    const auto at = parties_.find(party);
    Party& its = at->second;
    if (its.held == of_one_party_) {
      its.since = now;
    }
    --its.held;
    ++free_;
    if (its.held == 0 && its.row.empty()) {
      parties_.erase(at);
    }
  }

  /// Gives a turn to the first client of the party at a place of the rotation.
  void give_next(std::list<std::string>::iterator place, Clock::time_point now) {
    Party& its = parties_.find(*place)->second;
    its.row.pop_front();
    its.since = now;
    ++its.held;
    --free_;
    if (its.row.empty()) {
      rotation_.erase(place);
    } else {
      rotation_.splice(rotation_.end(), rotation_, place);
    }
  }

  mutable std::mutex mutex_;
  int free_;
  const int of_one_party_;
  std::unordered_map<std::string, Party> parties_;
  std::list<std::string> rotation_;  ///< parties with a row
};

}  // namespace snapthrough::server::http
