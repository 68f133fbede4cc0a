#pragma once
/// @file
/// Owners of SQLite's handles. Errors are exceptions inside the driver; verbs of the store turn them into a
/// Status. This header does not include sqlite3.h.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "server/store/driver.h"

struct sqlite3;
struct sqlite3_stmt;

namespace snapthrough::server::sqlite {

/// Error of SQLite with its extended result code.
class Error : public std::runtime_error {
 public:
  Error(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] int code() const { return code_; }

 private:
  int code_;
};

/// Compiled statements of one connection that are not in use.
class StatementCache {
 public:
  StatementCache() = default;
  ~StatementCache();
  StatementCache(const StatementCache&) = delete;
  StatementCache& operator=(const StatementCache&) = delete;
  StatementCache(StatementCache&&) = delete;
  StatementCache& operator=(StatementCache&&) = delete;

  /// A statement with this text; compiles it when none is idle. Throws Error.
  sqlite3_stmt* take(sqlite3* database, std::string_view sql);
  void give_back(sqlite3_stmt* statement);

 private:
  std::unordered_map<std::string, std::vector<sqlite3_stmt*>> idle_;
};

/// @brief A prepared statement: add parameters in order, step, read the current row. Not thread-safe. Every
/// member throws Error.
class Statement final : public Row {
 public:
  /// REQUIRES: database and cache outlive the statement.
  Statement(sqlite3* database, StatementCache& cache, std::string_view sql);

  /// Gives the next parameter its value. Text and blobs are copied.
  Statement& add(std::int64_t value);
  Statement& add(int value) { return add(static_cast<std::int64_t>(value)); }
  Statement& add(double value);
  Statement& add(std::string_view text);
  Statement& add_null();
  Statement& add_blob(std::string_view bytes);
  /// Adds the numbers as little-endian float64.
  Statement& add_series(std::span<const double> values);
  template <class T>
  Statement& add(const std::optional<T>& value) {
    return value ? add(*value) : add_null();
  }

  /// Goes to the next row; returns false when there is none.
  bool step();
  /// Steps a statement that returns no rows.
  void run();

  [[nodiscard]] bool is_null(int column) const override;
  [[nodiscard]] std::int64_t integer(int column) const override;
  [[nodiscard]] double real(int column) const override;
  [[nodiscard]] std::string text(int column) const override;
  [[nodiscard]] std::vector<double> series(int column) const override;
  [[noreturn]] void refuse(const std::string& why) const override;

 private:
  struct GiveBack {
    StatementCache* cache;
    void operator()(sqlite3_stmt* statement) const { cache->give_back(statement); }
  };
  void check(int code) const;

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, GiveBack> statement_;
  int bound_ = 0;
};

enum class Access { read_write, read_only };

/// @brief One connection with the pragmas of this project. Not thread-safe. Members throw Error.
class Connection {
 public:
  /// Opens the database; read_write creates it if it is new.
  Connection(const std::string& path, Access access);

  /// Runs statements without parameters that return no rows.
  void execute(const std::string& sql);
  [[nodiscard]] Statement prepare(std::string_view sql) const { return {handle_.get(), *cache_, sql}; }
  /// A statement with its parameters in order.
  template <class... Values>
  [[nodiscard]] Statement query(std::string_view sql, const Values&... values) const {
    Statement statement = prepare(sql);
    (statement.add(values), ...);
    return statement;
  }
  /// Runs a statement that returns no rows, with its parameters in order.
  template <class... Values>
  void run(std::string_view sql, const Values&... values) {
    query(sql, values...).run();
  }
  /// Number of rows that the latest insert, update or delete changed.
  [[nodiscard]] std::int64_t changes() const;
  [[nodiscard]] std::int64_t last_row() const;
  /// @brief At most `most` bytes of a text in the row with this rowid, from `offset` on; other bytes are not
  /// read.
  /// @param[out] size bytes of the whole text
  [[nodiscard]] std::string part(const char* table, const char* column, std::int64_t row, std::size_t offset,
                                 std::size_t most, std::size_t& size) const;
  /// Whether a transaction is open. Some errors end it.
  [[nodiscard]] bool in_transaction() const;
  /// Writes a consistent copy of the whole database to a new file; others may write meanwhile.
  void copy_to(const std::string& path) const;

 private:
  /// Opens a new file without pragmas, as a target of copy_to().
  explicit Connection(const std::string& path);

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> handle_;
  std::unique_ptr<StatementCache> cache_ =
      std::make_unique<StatementCache>();  ///< destroyed before the handle
};

/// @brief A write transaction (BEGIN IMMEDIATE): rolled back when it is destroyed without commit().
class Transaction {
 public:
  explicit Transaction(Connection& connection);
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

}  // namespace snapthrough::server::sqlite
