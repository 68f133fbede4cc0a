#include "server/store/sqlite/writer.h"

#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace snapthrough::server::sqlite {
namespace {

/// Largest number of pieces in one commit: more gain nothing and make the first caller wait.
constexpr std::size_t kLargestBatch = 128;
/// Time that a patient piece waits: a small job is solved within it, and its submission and outcome are one
/// commit.
constexpr std::chrono::milliseconds kPatience{1};

void roll_back(Connection& connection) {
  try {
    connection.execute("ROLLBACK");
  } catch (const Error&) {
    // After a full disk or an I/O error SQLite has rolled back already.
  }
}

/// Moves what the write-ahead log holds into the file, which gets its length of this moment, and the log is
/// written from its begin again: on a full disk it cannot grow, not even for a deletion.
void empty_log(Connection& connection) {
  try {
    connection.execute("PRAGMA wal_checkpoint(PASSIVE)");
  } catch (const Error&) {
    // The file cannot grow either; the next write that fails tries again.
  }
}

}  // namespace

Status to_status(const Error& error) {
  switch (error.code() & 0xFF) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_FULL:
    case SQLITE_NOMEM:
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
      return {StatusCode::unavailable, error.what()};
    case SQLITE_NOTADB:
      return {StatusCode::unsupported, error.what()};
    default:
      return {StatusCode::io_error, error.what()};
  }
}

Writer::Writer(std::unique_ptr<Connection> connection)
    : connection_(std::move(connection)), thread_([this] { loop(); }) {}

Writer::~Writer() {
  {
    const std::lock_guard guard(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

Status Writer::run(const Work& work, Durability durability, const std::function<void()>& queued,
                   bool patient) {
  Item item{work, durability, patient};
  {
    const std::lock_guard guard(mutex_);
    waiting_.push_back(&item);
  }
  if (queued) {
    queued();
  }
  changed_.notify_one();
  std::unique_lock lock(mutex_);
  item.ended.wait(lock, [&] { return item.done; });
  return std::move(item.status);
}

void Writer::loop() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) {
      return;
    }
    changed_.wait_for(lock, kPatience, [&] {
      return stopping_ ||
             std::any_of(waiting_.begin(), waiting_.end(), [](const Item* item) { return !item->patient; });
    });
    std::deque<Item*> batch;
    while (!waiting_.empty() && batch.size() < kLargestBatch) {
      batch.push_back(waiting_.front());
      waiting_.pop_front();
    }
    lock.unlock();
    commit_batch(batch);
    lock.lock();
    for (Item* item : batch) {
      item->done = true;  // once the lock is released, the caller may destroy the item
      item->ended.notify_one();
    }
  }
}

void Writer::commit_batch(std::deque<Item*>& batch) {
  const Timed timed(commit_seconds_);
  try {
    begin(batch);
    for (Item* item : batch) {
      if (!run_item(*item, batch.size() == 1)) {
        throw Error(SQLITE_IOERR, item->status.message());  // the whole batch is undone
      }
    }
    const bool undo = batch.size() == 1 && !batch.front()->status.ok();
    connection_->execute(undo ? "ROLLBACK" : "COMMIT");
    if (empties_log_.exchange(false)) {
      empty_log(*connection_);
    }
  } catch (const Error& error) {
    roll_back(*connection_);
    if ((error.code() & 0xff) == SQLITE_FULL) {
      empty_log(*connection_);
    }
    for (Item* item : batch) {
      item->status = to_status(error);
    }
  }
}

void Writer::begin(const std::deque<Item*>& batch) {
  const bool synced = std::any_of(batch.begin(), batch.end(),
                                  [](const Item* item) { return item->durability == Durability::synced; });
  const Durability wanted = synced ? Durability::synced : Durability::unsynced;
  if (wanted != level_) {
    // In WAL mode NORMAL commits without a sync; the next synced commit covers such a commit too.
    connection_->execute(synced ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = NORMAL");
    level_ = wanted;
  }
  connection_->execute("BEGIN IMMEDIATE");
}

/// Runs one piece; a piece alone needs no savepoint. Returns false when the transaction of the batch has to
/// be undone.
bool Writer::run_item(Item& item, bool alone) {
  if (!alone) {
    connection_->execute("SAVEPOINT item");
  }
  bool broken = false;
  try {
    item.status = item.work(*connection_);
  } catch (const Error& error) {
    item.status = to_status(error);
    broken = !connection_->in_transaction();
  } catch (const std::exception& error) {
    item.status = {StatusCode::io_error, error.what()};
  }
  if (!alone && !broken) {
    connection_->execute(item.status.ok() ? "RELEASE item" : "ROLLBACK TO item; RELEASE item");
  }
  return !broken;
}

}  // namespace snapthrough::server::sqlite
