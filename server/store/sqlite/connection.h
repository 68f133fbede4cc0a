#pragma once
/// @file
/// Thin owners of SQLite's handles. Inside the driver an error is an exception; the store's verbs turn it
/// into a Status. sqlite3.h is not included here.

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

/// SQLite refused something; `code()` is its (extended) result code.
class Error : public std::runtime_error {
 public:
  Error(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] int code() const { return code_; }

 private:
  int code_;
};

/// Statements of one connection that are compiled and not in use.
class StatementCache {
 public:
  StatementCache() = default;
  ~StatementCache();
  StatementCache(const StatementCache&) = delete;
  StatementCache& operator=(const StatementCache&) = delete;
  StatementCache(StatementCache&&) = delete;
  StatementCache& operator=(StatementCache&&) = delete;

  /// One for this text, compiled now if none is idle. Throws Error.
  sqlite3_stmt* take(sqlite3* database, std::string_view sql);
  void give_back(sqlite3_stmt* statement);

 private:
  std::unordered_map<std::string, std::vector<sqlite3_stmt*>> idle_;
};

/// @brief A prepared statement: add parameters in order, step, read the current row. Not thread-safe. Every
/// member throws Error.
class Statement final : public Row {
 public:
  /// Both must outlive the statement.
  Statement(sqlite3* database, StatementCache& cache, std::string_view sql);

  /// Gives the next parameter its value. Text and blobs are copied.
  Statement& add(std::int64_t value);
  Statement& add(int value) { return add(static_cast<std::int64_t>(value)); }
  Statement& add(double value);
  Statement& add(std::string_view text);
  Statement& add_null();
  Statement& add_blob(std::string_view bytes);
  /// Little-endian float64, one after the other.
  Statement& add_series(std::span<const double> values);
  template <class T>
  Statement& add(const std::optional<T>& value) {
    return value ? add(*value) : add_null();
  }

  /// To the next row; false when there is none.
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
  /// Opens, and with read_write creates, the database.
  Connection(const std::string& path, Access access);

  /// Runs statements that return nothing.
  void execute(const std::string& sql);
  [[nodiscard]] Statement prepare(std::string_view sql) const { return {handle_.get(), *cache_, sql}; }
  /// The statement with its parameters, in order.
  template <class... Values>
  [[nodiscard]] Statement query(std::string_view sql, const Values&... values) const {
    Statement statement = prepare(sql);
    (statement.add(values), ...);
    return statement;
  }
  /// Runs a statement that returns no rows with its parameters, in order.
  template <class... Values>
  void run(std::string_view sql, const Values&... values) {
    query(sql, values...).run();
  }
  /// Rows changed by the latest insert, update or delete.
  [[nodiscard]] std::int64_t changes() const;
  [[nodiscard]] std::int64_t last_row() const;
  /// @brief Bytes of a text in the row with this rowid, from `offset` on, at most `most`, without reading the
  /// others. @param[out] size of the whole text
  [[nodiscard]] std::string part(const char* table, const char* column, std::int64_t row, std::size_t offset,
                                 std::size_t most, std::size_t& size) const;
  /// Whether a transaction is open; an error may have ended it.
  [[nodiscard]] bool in_transaction() const;
  /// Writes a consistent copy of the whole database to a new file; others may write meanwhile.
  void copy_to(const std::string& path) const;

 private:
  /// A new file without pragmas, to copy into.
  explicit Connection(const std::string& path);

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> handle_;
  std::unique_ptr<StatementCache> cache_ = std::make_unique<StatementCache>();  ///< gone before the handle
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
