#pragma once
/// @file
/// What each party takes of the memory and the streams that all clients share.

#include <cstddef>
#include <mutex>
#include <string>
#include <unordered_map>

namespace snapthrough::server::http {

/// @brief Bytes and streams by party: an owner, or an address without a key. Thread-safe.
class Shares {
 public:
  /// Adds bytes, or takes them away; returns how many the party has then.
  std::size_t add_bytes(const std::string& party, std::size_t more, std::size_t less) {
    const std::lock_guard guard(mutex_);
    Share& share = of_[party];
    share.bytes = share.bytes + more - less;
    return settled(party).bytes;
  }
  /// Adds a stream unless the party has `most`.
  bool add_stream(const std::string& party, int most) {
    const std::lock_guard guard(mutex_);
    Share& share = of_[party];
    const bool may = share.streams < most;
    share.streams += may ? 1 : 0;
    settled(party);
    return may;
  }
  void remove_stream(const std::string& party) {
    const std::lock_guard guard(mutex_);
    --of_[party].streams;
    settled(party);
  }

 private:
  struct Share {
    std::size_t bytes = 0;
    int streams = 0;
  };

  /// The share of a party, which is forgotten when it is nothing.
  Share settled(const std::string& party) {
    const auto at = of_.find(party);
    const Share share = at->second;
    if (share.bytes == 0 && share.streams == 0) {
      of_.erase(at);
    }
    return share;
  }

  std::mutex mutex_;
  std::unordered_map<std::string, Share> of_;
};

}  // namespace snapthrough::server::http
