#include "server/store/postgresql/connection.h"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

namespace snapthrough::server::postgresql {
namespace {

// Object identifiers of built-in types, which never change (PostgreSQL, pg_type.dat).
constexpr unsigned kBool = 16;
constexpr unsigned kBytes = 17;
constexpr unsigned kInt8 = 20;
constexpr unsigned kText = 25;
constexpr unsigned kFloat8 = 701;
constexpr unsigned kTextArray = 1009;
constexpr unsigned kInt8Array = 1016;

template <class Unsigned>
void append_big_endian(std::string& bytes, Unsigned value) {
  for (int shift = 8 * static_cast<int>(sizeof value) - 8; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(value >> shift)));
  }
}

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) {
    value = value << 8 | static_cast<unsigned char>(byte);
  }
  return value;
}

/// Array of one dimension without NULLs in the binary form of the protocol.
std::string array_bytes(unsigned type, const std::vector<std::string>& elements) {
  std::string bytes;
  append_big_endian(bytes, std::uint32_t{elements.empty() ? 0U : 1U});
  append_big_endian(bytes, std::uint32_t{0});
  append_big_endian(bytes, std::uint32_t{type});
  if (!elements.empty()) {
    append_big_endian(bytes, static_cast<std::uint32_t>(elements.size()));
    append_big_endian(bytes, std::uint32_t{1});
  }
  for (const std::string& element : elements) {
    append_big_endian(bytes, static_cast<std::uint32_t>(element.size()));
    bytes += element;
  }
  return bytes;
}

std::string series_bytes(std::span<const double> values) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes(values.size() * sizeof(double), '\0');
  if (!values.empty()) {
    std::memcpy(bytes.data(), values.data(), bytes.size());
  }
  return bytes;
}

/// Defaults of a connection: a server that is gone is noticed within about 15 s. The location, which comes
/// last, overrides them.
constexpr std::array kKeywords{"application_name",    "connect_timeout",  "keepalives_idle",
                               "keepalives_interval", "keepalives_count", "tcp_user_timeout",
                               "client_encoding",     "dbname",           static_cast<const char*>(nullptr)};
constexpr std::array kDefaults{
    "snapthrough", "5", "5", "3", "3", "15000", "UTF8", "", static_cast<const char*>(nullptr)};

/// Longest wait for an answer after the service has begun to stop.
constexpr std::chrono::seconds kLongestInHurry{5};

}  // namespace

Parameters& Parameters::add_value(unsigned type, std::string value) {
  types_.push_back(type);
  values_.emplace_back(std::move(value));
  return *this;
}

Parameters& Parameters::add(std::int64_t value) {
  std::string bytes;
  append_big_endian(bytes, static_cast<std::uint64_t>(value));
  return add_value(kInt8, std::move(bytes));
}

Parameters& Parameters::add(double value) {
  std::string bytes;
  append_big_endian(bytes, std::bit_cast<std::uint64_t>(value));
  return add_value(kFloat8, std::move(bytes));
}

Parameters& Parameters::add(bool value) { return add_value(kBool, std::string(1, value ? '\1' : '\0')); }

Parameters& Parameters::add(std::string_view text) { return add_value(kText, std::string(text)); }

Parameters& Parameters::add_bytes(std::string_view bytes) { return add_value(kBytes, std::string(bytes)); }

Parameters& Parameters::add_bytes_or_null(std::string_view bytes) {
  add_bytes(bytes);
  if (bytes.empty()) {
    values_.back().reset();
  }
  return *this;
}

Parameters& Parameters::add(std::span<const std::int64_t> values) {
  std::vector<std::string> elements(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    append_big_endian(elements[i], static_cast<std::uint64_t>(values[i]));
  }
  return add_value(kInt8Array, array_bytes(kInt8, elements));
}

Parameters& Parameters::add(std::span<const std::string> texts) {
  return add_value(kTextArray, array_bytes(kText, {texts.begin(), texts.end()}));
}

Parameters& Parameters::add_series(std::span<const double> values) {
  return add_value(kBytes, series_bytes(values));
}

Rows::Rows(pg_result* result) : result_(result) {}

void Rows::Clear::operator()(pg_result* result) const { PQclear(result); }

int Rows::count() const { return PQntuples(result_.get()); }

std::int64_t Rows::changed() const {
  const std::string_view text = PQcmdTuples(result_.get());
  return text.empty() ? 0 : std::stoll(std::string(text));
}

bool ResultRow::is_null(int column) const { return PQgetisnull(result_, row_, column) == 1; }

std::string_view ResultRow::bytes(int column) const {
  return {PQgetvalue(result_, row_, column), static_cast<std::size_t>(PQgetlength(result_, row_, column))};
}

std::int64_t ResultRow::integer(int column) const {
  const std::string_view value = bytes(column);
  switch (value.size()) {
    case 2:
      return static_cast<std::int16_t>(big_endian(value));
    case 4:
      return static_cast<std::int32_t>(big_endian(value));
    case 8:
      return static_cast<std::int64_t>(big_endian(value));
    default:
      refuse("column " + std::to_string(column) + " of the store is no integer");
  }
}

double ResultRow::real(int column) const {
  return std::bit_cast<double>(static_cast<std::uint64_t>(integer(column)));
}

bool ResultRow::boolean(int column) const { return bytes(column) == std::string_view("\1", 1); }

std::string ResultRow::text(int column) const { return std::string(bytes(column)); }

std::vector<double> ResultRow::series(int column) const {
  const std::string_view value = bytes(column);
  std::vector<double> values(value.size() / sizeof(double));
  if (!values.empty()) {
    std::memcpy(values.data(), value.data(), values.size() * sizeof(double));
  }
  return values;
}

std::vector<std::int64_t> ResultRow::integers(int column) const {
  constexpr std::size_t kHead = 20;  // dimensions, whether there are NULLs, type; length, lower bound
  std::string_view value = bytes(column);
  std::vector<std::int64_t> all;
  for (value.remove_prefix(std::min(kHead, value.size())); value.size() >= 12; value.remove_prefix(12)) {
    if (big_endian(value.substr(0, 4)) != 8) {
      refuse("an array of the store has another type, or NULLs");
    }
    all.push_back(static_cast<std::int64_t>(big_endian(value.substr(4, 8))));
  }
  return all;
}

std::vector<std::string> Rows::texts(int column) const {
  std::vector<std::string> all;
  all.reserve(static_cast<std::size_t>(count()));
  for (int row = 0; row < count(); ++row) {
    all.push_back((*this)[row].text(column));
  }
  return all;
}

void ResultRow::refuse(const std::string& why) const { throw Error("XX001", why); }

void Connection::Close::operator()(pg_conn* connection) const { PQfinish(connection); }

Connection::Connection(const std::string& location, const PollBell* hurry) : hurry_(hurry) {
  // The error does not quote the location, which may have a password.
  PQconninfoOption* const parsed = PQconninfoParse(location.c_str(), nullptr);
  if (parsed == nullptr) {
    throw Error("", "this is no connection URI of PostgreSQL");
  }
  PQconninfoFree(parsed);
  std::array<const char*, kDefaults.size()> values = kDefaults;
  values[values.size() - 2] = location.c_str();
  handle_.reset(PQconnectdbParams(kKeywords.data(), values.data(), 1));
  if (PQstatus(handle_.get()) != CONNECTION_OK) {
    throw Error("", handle_ ? PQerrorMessage(handle_.get()) : "no memory");
  }
  execute("SET idle_in_transaction_session_timeout = '15s'; SET lock_timeout = '10s'");
}

bool Connection::good() const { return !cut_ && PQstatus(handle_.get()) == CONNECTION_OK; }

bool Connection::in_transaction() const { return PQtransactionStatus(handle_.get()) != PQTRANS_IDLE; }

void Connection::fail(const Rows& failed) const {
  const PGresult* result = failed.get();
  const char* state = result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const char* message = result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY);
  throw Error(state == nullptr || !good() ? "" : state,
              message == nullptr ? PQerrorMessage(handle_.get()) : message);
}

/// Waits for the next result of what was sent, which the caller owns; null after the last one. The connection
/// stays open, and no answer comes, where the server's host stands still, or where the server process waits
/// for a lock that a killed process had.
PGresult* Connection::next_result() {
  using SteadyClock = std::chrono::steady_clock;
  std::optional<SteadyClock::time_point> end;
  while (PQisBusy(handle_.get()) == 1) {
    std::array<pollfd, 2> waited{pollfd{PQsocket(handle_.get()), POLLIN, 0},
                                 pollfd{hurry_ == nullptr || end ? -1 : hurry_->descriptor(), POLLIN, 0}};
    int longest = -1;  // without bound
    if (end) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(*end - SteadyClock::now());
      longest = std::max(0, static_cast<int>(left.count()));
    }
    const int ready = ::poll(waited.data(), waited.size(), longest);
    if (ready > 0 && waited[0].revents != 0 && PQconsumeInput(handle_.get()) != 1) {
      break;  // the connection is lost, which PQgetResult() tells
    }
    if (waited[1].revents != 0) {
      end = SteadyClock::now() + kLongestInHurry;
    }
    if (end && SteadyClock::now() >= *end) {
      cut_ = true;
      throw Error("", "the database did not answer while the service stopped");
    }
  }
  return PQgetResult(handle_.get());
}

void Connection::send(const Statement& statement) {
  const Parameters& all = statement.parameters;
  std::vector<const char*> values;
  std::vector<int> lengths;
  for (const std::optional<std::string>& value : all.values_) {
    values.push_back(value ? value->data() : nullptr);
    lengths.push_back(value ? static_cast<int>(value->size()) : 0);
  }
  const std::vector<int> binary(values.size(), 1);
  if (PQsendQueryParams(handle_.get(), std::string(statement.sql).c_str(), static_cast<int>(values.size()),
                        all.types_.data(), values.data(), lengths.data(), binary.data(), 1) != 1) {
    throw Error("", PQerrorMessage(handle_.get()));
  }
}

Rows Connection::run(std::string_view sql, const Parameters& parameters) {
  send({sql, parameters});
  Rows result(next_result());
  while (PGresult* more = next_result()) {
    PQclear(more);
  }
  const ExecStatusType status = PQresultStatus(result.get());
  if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK) {
    fail(result);
  }
  return result;
}

std::vector<Rows> Connection::run_all(std::span<const Statement> statements) {
  if (statements.empty()) {
    return {};
  }
  if (PQenterPipelineMode(handle_.get()) != 1) {
    throw Error("", PQerrorMessage(handle_.get()));
  }
  for (const Statement& statement : statements) {
    send(statement);
  }
  PQpipelineSync(handle_.get());
  std::vector<Rows> all;
  Rows failed(nullptr);
  cut_ = !read_pipeline(all, failed);
  PQexitPipelineMode(handle_.get());
  if (cut_ || failed.get() != nullptr || all.size() != statements.size()) {
    fail(failed);
  }
  return all;
}

/// @brief Reads the results of a pipeline up to its synchronisation, which follows the commit: only then it
/// is known that the commit did not fail.
/// @param failed the first error, if any
/// @return false when the connection was lost before the synchronisation
bool Connection::read_pipeline(std::vector<Rows>& all, Rows& failed) {
  bool ended = false;  // a null result ended a statement; a second one: the server is gone
  while (good()) {
    PGresult* result = next_result();
    if (result == nullptr && ended) {
      return false;
    }
    ended = result == nullptr;
    switch (PQresultStatus(result)) {  // PGRES_FATAL_ERROR for a null result
      case PGRES_PIPELINE_SYNC:
        PQclear(result);
        return true;
      case PGRES_TUPLES_OK:
      case PGRES_COMMAND_OK:
        all.emplace_back(result);
        break;
      case PGRES_PIPELINE_ABORTED:
        PQclear(result);
        break;
      default:
        if (failed.get() == nullptr) {
          failed = Rows(result);
        } else {
          PQclear(result);
        }
    }
  }
  return false;
}

void Connection::execute(const std::string& sql) {
  if (PQsendQuery(handle_.get(), sql.c_str()) != 1) {
    throw Error("", PQerrorMessage(handle_.get()));
  }
  Rows failed(nullptr);
  while (PGresult* result = next_result()) {
    const ExecStatusType status = PQresultStatus(result);
    Rows owned(result);
    if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK && status != PGRES_EMPTY_QUERY) {
      failed = std::move(owned);
    }
  }
  if (failed.get() != nullptr) {
    fail(failed);
  }
}

bool Connection::take_notifications(std::string_view own) {
  bool any = false;
  while (PGnotify* notification = PQnotifies(handle_.get())) {
    any = any || notification->extra != own;
    PQfreemem(notification);
  }
  return any;
}

bool Connection::wait_for_notification(std::chrono::milliseconds longest, const PollBell& bell,
                                       std::string_view own) {
  if (take_notifications(own)) {
    return true;  // read with the answer to an earlier statement
  }
  std::array<pollfd, 2> waited{pollfd{PQsocket(handle_.get()), POLLIN, 0},
                               pollfd{bell.descriptor(), POLLIN, 0}};
  const int ready = ::poll(waited.data(), waited.size(), static_cast<int>(longest.count()));
  if (ready > 0 && waited[0].revents != 0 && PQconsumeInput(handle_.get()) != 1) {
    throw Error("", PQerrorMessage(handle_.get()));
  }
  return take_notifications(own);
}

Transaction::Transaction(Connection& connection, bool synced) : connection_(connection) {
  connection_.execute(synced ? "BEGIN" : "BEGIN; SET LOCAL synchronous_commit = off");
}

Transaction::~Transaction() {
  if (open_ && connection_.good()) {
    try {
      connection_.execute("ROLLBACK");
    } catch (const Error&) {  // the connection is lost: the server rolls back
    }
  }
}

void Transaction::commit() {
  connection_.execute("COMMIT");
  open_ = false;
}

}  // namespace snapthrough::server::postgresql
