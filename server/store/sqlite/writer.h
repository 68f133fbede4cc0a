#pragma once
/// @file
/// Thread that writes to the database, with many callers to a commit.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "server/metrics/metrics.h"
#include "server/status.h"
#include "server/store/sqlite/connection.h"

namespace snapthrough::server::sqlite {

/// The status for an error of SQLite.
[[nodiscard]] Status to_status(const Error& error);

/// @brief Runs pieces of work in transactions on a connection of its own. Thread-safe.
///
/// All pieces that wait are done in one transaction, each in a savepoint, so that a refused piece does not
/// undo the others. Their callers return after the commit.
class Writer {
 public:
  using Work = std::function<Status(Connection&)>;

  explicit Writer(std::unique_ptr<Connection> connection);
  /// Runs the pieces that wait, then ends the thread.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  Writer(Writer&&) = delete;
  Writer& operator=(Writer&&) = delete;

  /// @brief Runs the work on the writing thread and returns when it is committed or undone. Work is undone
  /// when it returns a status other than ok. It may run more than once.
  /// @param queued called as soon as later work is done after this work
  /// @param patient the commit may wait a millisecond for work that is not patient
  Status run(const Work& work, Durability durability, const std::function<void()>& queued = {},
             bool patient = false);
  /// Lets the next commit be followed by one attempt to move the write-ahead log into the file: until then
  /// the file keeps its length, and the disk lacks the room that was given back.
  void empty_log_next() { empties_log_ = true; }
  [[nodiscard]] const Histogram& commit_seconds() const { return commit_seconds_; }

 private:
  struct Item {
    const Work& work;
    Durability durability;
    bool patient = false;
    Status status = {};
    bool done = false;                ///< guarded by mutex_
    std::condition_variable ended{};  ///< not a semaphore: that yields the processor before it sleeps
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
  std::atomic<bool> empties_log_ = false;
  std::thread thread_;
};

}  // namespace snapthrough::server::sqlite
