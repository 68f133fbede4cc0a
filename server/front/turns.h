#pragma once
/// @file
/// Limits how many clients are worked on at a time, fairly by party.

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace snapthrough::server::http {

/// @brief A fixed number of turns, of which one party has a part at most. Thread-safe; no function blocks.
///
/// A party is whoever shares a key or an address. Parties that wait are served in rotation, the clients of
/// one party in the order of their arrival.
class Turns {
 public:
  Turns(int count, int of_one_party) : free_(count), of_one_party_(of_one_party) {}

  /// Returns whether `who` gets a turn at once; else `who` joins the end of its party's row for pass().
  bool take(std::uint64_t who, const std::string& party) {
    const std::lock_guard guard(mutex_);
    Party& its = parties_[party];
    if (free_ > 0 && its.held < of_one_party_) {
      --free_;
      ++its.held;
      return true;
    }
    if (its.row.empty()) {
      rotation_.push_back(party);
    }
    its.row.push_back(who);
    return false;
  }

  /// A client with a turn.
  struct Next {
    std::uint64_t who = 0;
    std::string party;
  };

  /// Takes a turn back from a party and gives it to the next that waits; nullopt when none may have it.
  std::optional<Next> pass(const std::string& party) {
    const std::lock_guard guard(mutex_);
    ++free_;
    --parties_[party].held;
    forget_if_idle(party);
    for (std::size_t i = 0; i < rotation_.size(); ++i) {
      const std::string next = std::move(rotation_.front());
      rotation_.pop_front();
      Party& its = parties_[next];
      if (its.held == of_one_party_) {
        rotation_.push_back(next);
        continue;
      }
      const std::uint64_t who = its.row.front();
      its.row.pop_front();
      if (!its.row.empty()) {
        rotation_.push_back(next);
      }
      --free_;
      ++its.held;
      return Next{who, next};
    }
    return std::nullopt;
  }

 private:
  struct Party {
    int held = 0;
    std::deque<std::uint64_t> row;
  };

  void forget_if_idle(const std::string& party) {
    const auto its = parties_.find(party);
    if (its->second.held == 0 && its->second.row.empty()) {
      parties_.erase(its);
    }
  }

  std::mutex mutex_;
  int free_;
  const int of_one_party_;
  std::unordered_map<std::string, Party> parties_;
  std::deque<std::string> rotation_;  ///< parties with a row
};

}  // namespace snapthrough::server::http
