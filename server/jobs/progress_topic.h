#pragma once
/// @file
/// News of running work for those who follow it.

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "solver/solve.h"

namespace snapthrough::server {

/// Latest news of the work in this process and its followers, by id. Thread-safe.
template <class News>
class ProgressTopic {
 public:
  /// Follows one id for as long as the follower exists.
  class Follower {
   public:
    /// Calls `callback` with the latest news if there are any, and then with each further news. One thread at
    /// a time calls it; it must be quick, must not throw, and must not use the topic.
    Follower(ProgressTopic& topic, std::string id, std::function<void(const News&)> callback)
        : topic_(topic), id_(std::move(id)), callback_(std::move(callback)) {
      const std::lock_guard guard(topic_.mutex_);
      topic_.followers_.emplace(id_, this);
      if (const auto latest = topic_.latest_.find(id_); latest != topic_.latest_.end()) {
        callback_(latest->second);
      }
    }
    ~Follower() {
      const std::lock_guard guard(topic_.mutex_);
      const auto [first, last] = topic_.followers_.equal_range(id_);
      for (auto it = first; it != last; ++it) {
        if (it->second == this) {
          topic_.followers_.erase(it);
          return;
        }
      }
    }
    Follower(const Follower&) = delete;
    Follower& operator=(const Follower&) = delete;
    Follower(Follower&&) = delete;
    Follower& operator=(Follower&&) = delete;

   private:
    friend class ProgressTopic;
    ProgressTopic& topic_;
    std::string id_;
    std::function<void(const News&)> callback_;
  };

  /// Changes the remembered news of an id, empty at first, by `change(News&)`; calls the followers.
  template <class Change>
  void update(const std::string& id, Change change) {
    const std::lock_guard guard(mutex_);
    News& news = latest_[id];
    change(news);
    tell(id, news);
  }
  /// Calls the followers with news that are not remembered.
  void pass_on(const std::string& id, const News& news) const {
    const std::lock_guard guard(mutex_);
    tell(id, news);
  }
  void erase(const std::string& id) {
    const std::lock_guard guard(mutex_);
    latest_.erase(id);
  }
  /// Ids with a follower, one entry for each follower.
  [[nodiscard]] std::vector<std::string> followed() const {
    const std::lock_guard guard(mutex_);
    std::vector<std::string> ids;
    for (const auto& [id, follower] : followers_) {
      ids.push_back(id);
    }
    return ids;
  }
  /// One field of the remembered news.
  template <class Field>
  [[nodiscard]] std::optional<Field> get(const std::string& id, Field News::*field) const {
    const std::lock_guard guard(mutex_);
    const auto found = latest_.find(id);
    return found == latest_.end() ? std::nullopt : std::optional<Field>(found->second.*field);
  }

 private:
  void tell(const std::string& id, const News& news) const {
    const auto [first, last] = followers_.equal_range(id);
    for (auto it = first; it != last; ++it) {
      it->second->callback_(news);
    }
  }
  mutable std::mutex mutex_;
  std::unordered_map<std::string, News> latest_;
  std::unordered_multimap<std::string, Follower*> followers_;
};

/// A critical point on the path's own mesh.
struct FoundPoint {
  std::uint64_t number = 0;  ///< JobNews::number of the news that brought it
  CriticalPoint point;
};

/// Points of the path in one `points` event.
struct TracedPoints {
  std::uint64_t number = 0;  ///< JobNews::number of the news that brought them
  std::string document;      ///< see path_points_document()
};

/// News of a running analysis.
struct JobNews {
  int attempt = 0;
  std::uint64_t number = 0;          ///< number of news in this attempt
  std::optional<Progress> progress;  ///< the latest
  std::vector<FoundPoint> found;     ///< all so far, in the order of discovery
  std::deque<TracedPoints> traced;   ///< the latest, in their order; about kTracedBytes of documents
};

/// Bytes of `points` documents that are kept for followers who come later.
inline constexpr std::size_t kTracedBytes = 128 * 1024;

/// News of the jobs that run in this process.
using JobProgress = ProgressTopic<JobNews>;

}  // namespace snapthrough::server
