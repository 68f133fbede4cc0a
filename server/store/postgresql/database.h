#pragma once
/// @file
/// Pool of connections to one database, and transactions on them.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "server/bell.h"
#include "server/metrics/metrics.h"
#include "server/status.h"
#include "server/store/postgresql/connection.h"

namespace snapthrough::server::postgresql {

/// @brief Connections that threads of a process share. When all are in use and `most` are open, a thread
/// waits, at most 10 s. Thread-safe.
///
/// One thread at a time connects. While the database can't be reached, a thread tries every 0.5 s; others get
/// an error at once.
class Pool {
 public:
  Pool(std::string location, int most) : location_(std::move(location)), most_(most) {}

  /// Lends a connection for as long as it exists. A lost connection is closed then.
  class Lent {
   public:
    /// Takes a connection. Throws Error.
    explicit Lent(Pool& pool) : pool_(pool), connection_(pool.take()) {}
    ~Lent() { pool_.give_back(std::move(connection_)); }
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;
    Lent(Lent&&) = delete;
    Lent& operator=(Lent&&) = delete;
    [[nodiscard]] Connection& operator*() const { return *connection_; }

   private:
    Pool& pool_;
    std::unique_ptr<Connection> connection_;
  };

  /// Opens a connection beside the pool. Throws Error.
  [[nodiscard]] std::unique_ptr<Connection> open() const {
    return std::make_unique<Connection>(location_, &hurry_);
  }
  /// From now on no thread waits longer than 5 s for an answer of the database, not even one that waits
  /// already; once the database did not answer, or could not be reached, no thread connects again.
  void hurry();

 private:
  std::unique_ptr<Connection> take();
  void give_back(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connect();
  [[nodiscard]] std::chrono::steady_clock::time_point next_try() const;

  const std::string location_;
  const int most_;
  std::mutex mutex_;
  std::condition_variable returned_;
  std::vector<std::unique_ptr<Connection>> idle_;
  int open_ = 0;
  bool connecting_ = false;
  std::chrono::steady_clock::time_point next_try_{};
  const PollBell hurry_;
  bool hurried_ = false;
};

/// SQLSTATE that held_job() of the schema raises for a claim that does not hold.
inline constexpr std::string_view kLostClaim = "ST001";

/// The status for an error of PostgreSQL.
[[nodiscard]] Status to_status(const Error& error);

/// Writes and reads of one database. Thread-safe.
class Database {
 public:
  Database(std::string location, int connections) : pool_(std::move(location), connections) {}

  /// @brief Runs `work(connection)`, which returns a StatusOr<T>, in a transaction, which is undone when the
  /// status is not ok. Runs the work again after a deadlock or a serialisation failure.
  template <class T, class Work>
  StatusOr<T> write(const Work& work, Durability durability = Durability::synced) {
    const Timed timed(commit_seconds_);
    return again_if_in_the_way<T>([&](Connection& connection) -> StatusOr<T> {
      Transaction transaction(connection, durability == Durability::synced);
      StatusOr<T> outcome = work(connection);
      if (outcome.ok()) {
        transaction.commit();
      }
      return outcome;
    });
  }

  /// Runs work that returns a Status in a transaction.
  template <class Work>
  Status write_only(const Work& work, Durability durability = Durability::synced) {
    return write<bool>(
               [&](Connection& connection) -> StatusOr<bool> {
                 Status status = work(connection);
                 return status.ok() ? StatusOr<bool>(true) : std::move(status);
               },
               durability)
        .status();
  }

  /// @brief Runs statements as one transaction in one round trip, and returns `use(results)`, a StatusOr<T>.
  /// The transaction is committed before `use` is called.
  template <class T, class Use>
  StatusOr<T> write_at_once(std::vector<Statement> statements, Durability durability, const Use& use) {
    const Timed timed(commit_seconds_);
    const bool unsynced = durability == Durability::unsynced;
    if (unsynced) {
      statements.insert(statements.begin(), {"SELECT set_config('synchronous_commit', 'off', true)"});
    }
    return again_if_in_the_way<T>([&](Connection& connection) -> StatusOr<T> {
      const std::vector<Rows> all = connection.run_all(statements);
      return use(std::span(all).subspan(unsynced ? 1 : 0));
    });
  }

  /// Runs statements without wanted results as one transaction in one round trip.
  Status write_at_once(std::vector<Statement> statements, Durability durability = Durability::synced) {
    return write_at_once<bool>(std::move(statements), durability, [](const auto&) { return true; }).status();
  }

  /// Runs `work(connection)`, which returns a T; each statement is a transaction.
  template <class T, class Work>
  StatusOr<T> read(const Work& work) {
    const Timed timed(read_seconds_);
    return again_if_in_the_way<T>([&](Connection& connection) -> StatusOr<T> { return work(connection); });
  }

  /// Whether a write met a full disk, and found_room() was not called since.
  [[nodiscard]] bool is_full() const { return full_; }
  void found_room() { full_ = false; }

  void write_metrics(std::string& text) const {
    commit_seconds_.write(text);
    read_seconds_.write(text);
  }
  /// See Pool.
  [[nodiscard]] std::unique_ptr<Connection> open() const { return pool_.open(); }
  void hurry() { pool_.hurry(); }

 private:
  static constexpr int kTries = 5;
  static constexpr std::string_view kDiskFull = "53100";

  template <class T, class Run>
  StatusOr<T> again_if_in_the_way(const Run& run) {
    for (int attempt = 1;; ++attempt) {
      try {
        const Pool::Lent connection(pool_);
        return run(*connection);
      } catch (const Error& error) {
        if (error.state() == kDiskFull) {
          full_ = true;
        }
        // a deadlock (40P01) or a serialisation failure (40001): the transaction was undone
        if ((error.state() != "40P01" && error.state() != "40001") || attempt == kTries) {
          return to_status(error);
        }
      }
    }
  }

  Pool pool_;
  std::atomic<bool> full_ = false;
  Histogram commit_seconds_{"snapthrough_store_commit_seconds",
                            "Of one transaction that writes, with its sync."};
  Histogram read_seconds_{"snapthrough_store_read_seconds", "Of one read of the store."};
};

}  // namespace snapthrough::server::postgresql
