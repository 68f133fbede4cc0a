#pragma once
/// @file
/// Owners of libpq's handles. Errors are exceptions inside the driver; verbs of the store turn them into a
/// Status. This header does not include libpq-fe.h.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "server/bell.h"
#include "server/store/driver.h"

struct pg_conn;
struct pg_result;

namespace snapthrough::server::postgresql {

/// Error of PostgreSQL, or of a connection to it.
class Error : public std::runtime_error {
 public:
  /// @param state SQLSTATE, five characters; empty: the connection is lost
  Error(std::string state, const std::string& message)
      : std::runtime_error(message), state_(std::move(state)) {}
  [[nodiscard]] const std::string& state() const { return state_; }
  /// Whether the connection is lost: the last statement may have been done or not.
  [[nodiscard]] bool lost() const { return state_.empty(); }

 private:
  std::string state_;
};

/// Parameters of a statement, $1 first, with their types, in the binary form of the protocol.
class Parameters {
 public:
  Parameters& add(std::int64_t value);
  Parameters& add(int value) { return add(static_cast<std::int64_t>(value)); }
  Parameters& add(double value);
  Parameters& add(bool value);
  Parameters& add(std::string_view text);
  Parameters& add(const char* text) { return add(std::string_view(text)); }
  Parameters& add_bytes(std::string_view bytes);
  /// Adds the bytes; NULL for an empty text.
  Parameters& add_bytes_or_null(std::string_view bytes);
  Parameters& add(std::span<const std::int64_t> values);
  Parameters& add(std::span<const std::string> texts);
  /// Adds the numbers as little-endian float64.
  Parameters& add_series(std::span<const double> values);
  template <class T>
  Parameters& add(const std::optional<T>& value) {
    if (value) {
      return add(*value);
    }
    add(T{});  // gives the type
    values_.back().reset();
    return *this;
  }

 private:
  friend class Connection;
  Parameters& add_value(unsigned type, std::string value);

  std::vector<unsigned> types_;
  std::vector<std::optional<std::string>> values_;
};

/// A statement with its parameters.
struct Statement {
  std::string_view sql;
  Parameters parameters = {};
};

/// @brief One row of a result, which must outlive it. Throws Error where a value is NULL or of another type.
class ResultRow final : public Row {
 public:
  ResultRow(const pg_result* result, int row) : result_(result), row_(row) {}

  [[nodiscard]] bool is_null(int column) const override;
  [[nodiscard]] std::int64_t integer(int column) const override;  ///< any integer type
  [[nodiscard]] double real(int column) const override;
  [[nodiscard]] std::string text(int column) const override;  ///< text or bytes
  [[nodiscard]] std::vector<double> series(int column) const override;
  [[noreturn]] void refuse(const std::string& why) const override;
  [[nodiscard]] bool boolean(int column) const;
  /// An array of bigint without NULLs.
  [[nodiscard]] std::vector<std::int64_t> integers(int column) const;

 private:
  [[nodiscard]] std::string_view bytes(int column) const;
  const pg_result* result_;
  int row_;
};

/// The result of a statement. Rows count from 0.
class Rows {
 public:
  /// @param result taken over; null: none
  explicit Rows(pg_result* result);

  [[nodiscard]] const pg_result* get() const { return result_.get(); }
  [[nodiscard]] int count() const;
  [[nodiscard]] bool empty() const { return count() == 0; }
  /// Number of rows that an insert, update or delete changed.
  [[nodiscard]] std::int64_t changed() const;
  [[nodiscard]] ResultRow operator[](int row) const { return {result_.get(), row}; }
  /// A column of all rows.
  [[nodiscard]] std::vector<std::string> texts(int column) const;

 private:
  struct Clear {
    void operator()(pg_result* result) const;
  };
  std::unique_ptr<pg_result, Clear> result_;
};

/// @brief One connection. Not thread-safe. Members throw Error; after an error that is lost() the connection
/// is of no use.
class Connection {
 public:
  /// Connects. @param location a connection URI (postgresql://...)
  /// @param hurry bell that is rung when the service stops, and outlives the connection: 5 s later a member
  /// that still waits for an answer throws, and the connection is lost. Null: members wait without bound
  explicit Connection(const std::string& location, const PollBell* hurry = nullptr);

  /// Runs one statement.
  Rows run(std::string_view sql, const Parameters& parameters = {});
  /// @brief Runs statements in order in one round trip, as one transaction if none is open. The first error
  /// ends the run and is thrown.
  std::vector<Rows> run_all(std::span<const Statement> statements);
  /// Runs statements without parameters and results, with semicolons between them.
  void execute(const std::string& sql);
  [[nodiscard]] bool in_transaction() const;
  [[nodiscard]] bool good() const;
  /// Waits for notifications for at most `longest`, or until the bell is rung; returns whether one came whose
  /// text is not `own`, which is the text of the notifications that the caller sends.
  /// @pre the connection has run LISTEN
  bool wait_for_notification(std::chrono::milliseconds longest, const PollBell& bell, std::string_view own);

 private:
  bool take_notifications(std::string_view own);
  void send(const Statement& statement);
  [[nodiscard]] pg_result* next_result();
  bool read_pipeline(std::vector<Rows>& all, Rows& failed);
  [[noreturn]] void fail(const Rows& failed) const;

  struct Close {
    void operator()(pg_conn* connection) const;
  };
  std::unique_ptr<pg_conn, Close> handle_;
  const PollBell* hurry_;
  bool cut_ = false;  ///< the server went away while a pipeline was read, or did not answer in time
};

/// @brief A transaction: rolled back when it is destroyed without commit().
class Transaction {
 public:
  /// @param synced false: the commit does not wait for the disk
  Transaction(Connection& connection, bool synced);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  Transaction(Transaction&&) = delete;
  Transaction& operator=(Transaction&&) = delete;
  void commit();

 private:
  Connection& connection_;
  bool open_ = true;
};

}  // namespace snapthrough::server::postgresql
