#include "server/store/postgresql/database.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace snapthrough::server::postgresql {
namespace {

/// Pause between two tries to connect to a database that is gone.
constexpr std::chrono::milliseconds kBetweenTries{500};
/// Longest wait for a connection that other threads use.
constexpr std::chrono::seconds kLongestWait{10};

}  // namespace

std::unique_ptr<Connection> Pool::take() {
  std::unique_lock lock(mutex_);
  const auto may_go_on = [&] {
    return !idle_.empty() || (open_ < most_ && !connecting_) || std::chrono::steady_clock::now() < next_try_;
  };
  if (!returned_.wait_for(lock, kLongestWait, may_go_on)) {
    throw Error("", "every connection to the database is in use");
  }
  if (!idle_.empty()) {
    std::unique_ptr<Connection> connection = std::move(idle_.back());
    idle_.pop_back();
    return connection;
  }
  if (std::chrono::steady_clock::now() < next_try_) {
    throw Error("", "the database could not be reached a moment ago");
  }
  ++open_;
  connecting_ = true;
  lock.unlock();
  return connect();
}

void Pool::hurry() {
  {
    const std::lock_guard guard(mutex_);
    hurried_ = true;
  }
  hurry_.ring();
}

/// Returns when to try to connect again after the database could not be reached.
std::chrono::steady_clock::time_point Pool::next_try() const {
  return hurried_ ? std::chrono::steady_clock::time_point::max()
                  : std::chrono::steady_clock::now() + kBetweenTries;
}

std::unique_ptr<Connection> Pool::connect() {
  std::unique_ptr<Connection> connection;
  std::optional<Error> trouble;
  try {
    connection = open();
  } catch (const Error& error) {
    trouble = error;
  }
  {
    const std::lock_guard guard(mutex_);
    connecting_ = false;
    if (trouble) {
      --open_;
      next_try_ = next_try();
    }
  }
  returned_.notify_all();
  if (trouble) {
    throw *trouble;
  }
  return connection;
}

void Pool::give_back(std::unique_ptr<Connection> connection) {
  std::vector<std::unique_ptr<Connection>> lost;
  {
    const std::lock_guard guard(mutex_);
    if (connection->good() && !connection->in_transaction()) {
      idle_.push_back(std::move(connection));
    } else {
      // a lost connection means that the server is gone or was started anew: idle connections are lost too
      lost = std::exchange(idle_, {});
      lost.push_back(std::move(connection));
      open_ -= static_cast<int>(lost.size());
      if (hurried_) {
        next_try_ = next_try();
      }
    }
  }
  returned_.notify_all();
}

Status to_status(const Error& error) {
  if (error.state() == kLostClaim) {
    return {StatusCode::conflict, error.what()};
  }
  // Classes and codes in appendix A of PostgreSQL's manual: connection (08), insufficient resources (53),
  // intervention of an operator (57), system error (58), lock not available (55P03), read-only database
  // (25006), idle transaction ended (25P03), rollback of a transaction (40).
  constexpr std::array<std::string_view, 8> kMayWorkLater{"08",    "53",    "57",    "58",
                                                          "55P03", "25006", "25P03", "40"};
  const bool later =
      error.lost() || std::any_of(kMayWorkLater.begin(), kMayWorkLater.end(),
                                  [&](std::string_view start) { return error.state().starts_with(start); });
  return {later ? StatusCode::unavailable : StatusCode::io_error, error.what()};
}

}  // namespace snapthrough::server::postgresql
