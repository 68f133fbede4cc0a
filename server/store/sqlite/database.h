#pragma once
/// @file
/// One writer and many readers of a database file.

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/status.h"
#include "server/store/sqlite/connection.h"
#include "server/store/sqlite/writer.h"

namespace snapthrough::server::sqlite {

/// Pool of read-only connections, which opens one when none is free. Thread-safe.
class ReaderPool {
 public:
  explicit ReaderPool(std::string path) : path_(std::move(path)) {}

  template <class Use>
  auto with(const Use& use) {
    std::unique_ptr<Connection> reader = take();
    auto result = use(*reader);
    const std::lock_guard guard(mutex_);
    idle_.push_back(std::move(reader));  // a connection with an exception is dropped
    return result;
  }

 private:
  std::unique_ptr<Connection> take() {
    {
      const std::lock_guard guard(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Connection> reader = std::move(idle_.back());
        idle_.pop_back();
        return reader;
      }
    }
    return std::make_unique<Connection>(path_, Access::read_only);
  }

  std::string path_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Connection>> idle_;
};

/// Writes and reads of one database. Thread-safe.
class Database {
 public:
  Database(std::unique_ptr<Connection> writer, const std::string& path)
      : writer_(std::move(writer)), readers_(path) {}

  /// Runs `work(connection)`, which returns a StatusOr<T>, in a write transaction; parameters as of
  /// Writer::run().
  template <class T, class Work>
  StatusOr<T> write(const Work& work, Durability durability = Durability::synced,
                    const std::function<void()>& queued = {}, bool patient = false) {
    StatusOr<T> outcome = Status(StatusCode::io_error, "nothing was done");
    Status status = writer_.run(
        [&](Connection& connection) {
          outcome = work(connection);
          return outcome.status();
        },
        durability, queued, patient);
    if (!status.ok()) {
      return status;
    }
    return outcome;
  }

  /// Runs work that returns a Status in a write transaction.
  Status write_only(const Writer::Work& work, Durability durability = Durability::synced) {
    return writer_.run(work, durability);
  }

  /// Runs `work(connection)`, which returns a T, on a read-only connection.
  template <class T, class Work>
  StatusOr<T> read(const Work& work) {
    const Timed timed(read_seconds_);
    try {
      return readers_.with([&](const Connection& connection) -> T { return work(connection); });
    } catch (const Error& error) {
      return to_status(error);
    }
  }

  /// See Writer::empty_log_next().
  void empty_log_next() { writer_.empty_log_next(); }

  void write_metrics(std::string& text) const {
    writer_.commit_seconds().write(text);
    read_seconds_.write(text);
  }

 private:
  Writer writer_;
  ReaderPool readers_;
  Histogram read_seconds_{"snapthrough_store_read_seconds", "Of one read of the store."};
};

}  // namespace snapthrough::server::sqlite
