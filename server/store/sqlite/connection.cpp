#include "server/store/sqlite/connection.h"

#include <sqlite3.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace snapthrough::server::sqlite {
namespace {

// Series are stored as little-endian float64 without conversion.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(double) == 8);

[[noreturn]] void raise(sqlite3* database, int code) {
  const char* message = database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code);
  throw Error(code, message);
}

}  // namespace

StatementCache::~StatementCache() {
  for (const auto& [sql, statements] : idle_) {
    for (sqlite3_stmt* statement : statements) {
      sqlite3_finalize(statement);
    }
  }
}

sqlite3_stmt* StatementCache::take(sqlite3* database, std::string_view sql) {
  auto& idle = idle_[std::string(sql)];
  if (!idle.empty()) {
    sqlite3_stmt* statement = idle.back();
    idle.pop_back();
    return statement;
  }
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(database, sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  if (code != SQLITE_OK) {
    raise(database, code);
  }
  return statement;
}

void StatementCache::give_back(sqlite3_stmt* statement) {
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  idle_[sqlite3_sql(statement)].push_back(statement);
}

Statement::Statement(sqlite3* database, StatementCache& cache, std::string_view sql)
    : database_(database), statement_(cache.take(database, sql), GiveBack{&cache}) {}

void Statement::check(int code) const {
  if (code != SQLITE_OK) {
    raise(database_, code);
  }
}

Statement& Statement::add(std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::add(double value) {
  check(sqlite3_bind_double(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::add(std::string_view text) {
  // An empty view may hold a null pointer, which SQLite would take for NULL.
  const char* data = text.empty() ? "" : text.data();
  check(sqlite3_bind_text64(statement_.get(), ++bound_, data, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::add_null() {
  check(sqlite3_bind_null(statement_.get(), ++bound_));
  return *this;
}

Statement& Statement::add_blob(std::string_view bytes) {
  const void* data = bytes.empty() ? "" : bytes.data();
  check(sqlite3_bind_blob64(statement_.get(), ++bound_, data, bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::add_series(std::span<const double> values) {
  return add_blob({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    raise(database_, code);
  }
  return code == SQLITE_ROW;
}

void Statement::run() {
  if (step()) {
    throw Error(SQLITE_MISUSE, "a statement without result returned a row");
  }
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string Statement::text(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return data == nullptr ? std::string() : std::string(data, static_cast<std::size_t>(size));
}

std::vector<double> Statement::series(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  std::vector<double> values(size / sizeof(double));
  if (!values.empty()) {
    std::memcpy(values.data(), data, values.size() * sizeof(double));
  }
  return values;
}

void Statement::refuse(const std::string& why) const { throw Error(0, why); }

void Connection::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Connection::Connection(const std::string& path) {
  sqlite3* handle = nullptr;
  const int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) {
    raise(handle, code);
  }
}

Connection::Connection(const std::string& path, Access access) {
  const int flags =
      SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE |
      (access == Access::read_write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY);
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) {
    raise(handle, code);
  }
  sqlite3_busy_timeout(handle, 5000);
  if (access == Access::read_write) {
    execute(
        // auto_vacuum has no effect on a file that has tables: stores of older versions do not shrink.
        "PRAGMA auto_vacuum = INCREMENTAL;"
        "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA secure_delete = OFF;"
        "PRAGMA journal_size_limit = 8388608;");
  } else {
    execute("PRAGMA query_only = ON;");
  }
  execute(
      "PRAGMA foreign_keys = ON; PRAGMA trusted_schema = OFF; PRAGMA mmap_size = 0;"
      "PRAGMA temp_store = MEMORY;");
}

void Connection::execute(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) {
    raise(handle_.get(), code);
  }
}

std::int64_t Connection::changes() const { return sqlite3_changes64(handle_.get()); }

std::int64_t Connection::last_row() const { return sqlite3_last_insert_rowid(handle_.get()); }

std::string Connection::part(const char* table, const char* column, std::int64_t row, std::size_t offset,
                             std::size_t most, std::size_t& size) const {
  sqlite3_blob* opened = nullptr;
  int code = sqlite3_blob_open(handle_.get(), "main", table, column, row, 0, &opened);
  const std::unique_ptr<sqlite3_blob, decltype(&sqlite3_blob_close)> blob(opened, &sqlite3_blob_close);
  if (code != SQLITE_OK) {
    raise(handle_.get(), code);
  }
  size = static_cast<std::size_t>(sqlite3_blob_bytes(opened));
  offset = std::min(offset, size);
  std::string bytes(std::min(most, size - offset), '\0');
  code = sqlite3_blob_read(opened, bytes.data(), static_cast<int>(bytes.size()), static_cast<int>(offset));
  if (code != SQLITE_OK) {
    raise(handle_.get(), code);
  }
  return bytes;
}

bool Connection::in_transaction() const { return sqlite3_get_autocommit(handle_.get()) == 0; }

void Connection::copy_to(const std::string& path) const {
  const Connection target(path);
  sqlite3_backup* backup = sqlite3_backup_init(target.handle_.get(), "main", handle_.get(), "main");
  if (backup == nullptr) {
    raise(target.handle_.get(), sqlite3_errcode(target.handle_.get()));
  }
  sqlite3_backup_step(backup, -1);  // all pages at once: one state of the database although others write
  const int code = sqlite3_backup_finish(backup);
  if (code != SQLITE_OK) {
    raise(target.handle_.get(), code);
  }
}

Transaction::Transaction(Connection& connection) : connection_(connection) {
  connection_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) {
    return;
  }
  try {
    connection_.execute("ROLLBACK");
  } catch (const Error&) {
    // After a full disk or an I/O error SQLite has rolled back already.
  }
}

void Transaction::commit() {
  connection_.execute("COMMIT");
  open_ = false;
}

}  // namespace snapthrough::server::sqlite
