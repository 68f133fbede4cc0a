/// Usage and events in SQLite.

#include <utility>

#include "server/store/ledger_rows.h"
#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

class SqliteLedgerStore final : public LedgerStore {
 public:
  explicit SqliteLedgerStore(Database& database) : database_(database) {}

  StatusOr<std::vector<UsageRow>> usage(const UsageQuery& query) override {
    return database_.read<std::vector<UsageRow>>([&](const Connection& connection) {
      Statement row = connection.query(
          "SELECT hour, label, jobs, points, cpu_us, peak_bytes, factorizations FROM usage WHERE owner = ?1"
          " AND hour >= ?2 AND hour < ?3 AND (?4 IS NULL OR label = ?4) ORDER BY hour, label LIMIT ?5",
          query.owner, first_hour(query.from), first_hour(query.to), query.label, query.limit + 1);
      std::vector<UsageRow> rows;
      while (row.step()) {
        rows.push_back(read_usage_row(row));
      }
      return rows;
    });
  }

  StatusOr<std::vector<AuditEntry>> events(const AuditQuery& query) override {
    return database_.read<std::vector<AuditEntry>>([&](const Connection& connection) {
      Statement row = connection.query(
          "SELECT number, at_us, event, sweep, entry FROM audit WHERE owner = ?1 AND number < ?2"
          " AND at_us >= ?3 AND at_us < ?4 ORDER BY number DESC LIMIT ?5",
          query.owner, query.before.value_or(INT64_MAX), query.from ? to_row(*query.from) : INT64_MIN,
          query.to ? to_row(*query.to) : INT64_MAX, query.limit + 1);
      std::vector<AuditEntry> entries;
      while (row.step()) {
        entries.push_back(read_audit_entry(row));
      }
      return entries;
    });
  }

  StatusOr<std::optional<AuditEntry>> deletion(std::string_view id, std::string_view owner) override {
    return database_.read<std::optional<AuditEntry>>(
        [&](const Connection& connection) -> std::optional<AuditEntry> {
          Statement row = connection.query(
              "SELECT number, at_us, event, sweep, entry FROM audit WHERE entry = ? AND owner = ?"
              " AND event IN ('deleted', 'retired') ORDER BY number DESC LIMIT 1",
              id, owner);
          return row.step() ? std::optional(read_audit_entry(row)) : std::nullopt;
        });
  }

  StatusOr<Balance> balance(std::string_view owner, Time now) override {
    return database_.read<Balance>([&](const Connection& connection) {
      Balance balance{usage_of(connection, owner)};
      const HourOfPoints hour = points_of_hour(connection, owner, now);
      balance.has.points_this_hour = hour.points;
      balance.until_more = until_more(hour.oldest, to_row(now));
      return balance;
    });
  }

  StatusOr<bool> forget(std::chrono::seconds age, int most, Time now) override {
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      connection.run("DELETE FROM usage WHERE hour < ?", hour_of(now - age));
      // numbers have the order of events, of which the clocks may differ a little
      connection.run(
          "DELETE FROM audit WHERE number IN (SELECT number FROM audit ORDER BY number LIMIT ?) AND at_us < "
          "?",
          most, to_row(now - age));
      return connection.changes() == most;
    });
  }

 private:
  Database& database_;
};

}  // namespace

std::unique_ptr<LedgerStore> ledger_in(Database& database) {
  return std::make_unique<SqliteLedgerStore>(database);
}

}  // namespace snapthrough::server::sqlite
