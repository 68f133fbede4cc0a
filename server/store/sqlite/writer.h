#pragma once
/// @file
/// The one thread that writes to the database, many callers to a commit.

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <semaphore>
#include <thread>

#include "server/metrics/metrics.h"
#include "server/status.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// The status that an error of SQLite amounts to.
[[nodiscard]] Status to_status(const Error& error);

/// @brief Runs pieces of work in transactions on a connection of its own. Thread-safe.
///
/// What waits is done together in one transaction, each piece in a savepoint, so that one that is refused
/// leaves the others alone; all are answered after the commit.
class Writer {
 public:
  using Work = std::function<Status(Connection&)>;

  explicit Writer(std::unique_ptr<Connection> connection);
  /// Finishes what waits.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  Writer(Writer&&) = delete;
  Writer& operator=(Writer&&) = delete;

  /// @brief Runs the work on the writing thread and returns when it is committed, or why it is not.
  /// Work that returns a status that is not ok is undone. It may run more than once.
  /// @param queued called when work that is handed in from then on comes after this
  /// @param patient the commit may wait a millisecond for work that is not patient
  Status run(const Work& work, Durability durability, const std::function<void()>& queued = {},
             bool patient = false);
  [[nodiscard]] const Histogram& commit_seconds() const { return commit_seconds_; }

 private:
  struct Item {
    const Work& work;
    Durability durability;
    bool patient = false;
    Status status = {};
    std::binary_semaphore done{0};
  };
  void loop();
  void commit_batch(std::deque<Item*>& batch);
  void begin(const std::deque<Item*>& batch);
  bool run_item(Item& item, bool alone);

  std::unique_ptr<Connection> connection_;
  Durability level_ = Durability::synced;
  Histogram commit_seconds_{"snapthrough_store_commit_seconds",
                            "Of one transaction that writes, with all that waited for it and its sync."};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item*> waiting_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace snapthrough::server::sqlite
