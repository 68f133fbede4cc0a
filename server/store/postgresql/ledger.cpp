/// Usage and events in PostgreSQL.

#include <utility>

#include "server/store/ledger_rows.h"
#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

class PostgresqlLedgerStore final : public LedgerStore {
 public:
  PostgresqlLedgerStore(Database& database, Clock clock) : database_(database), clock_(clock) {}

  StatusOr<std::vector<UsageRow>> usage(const UsageQuery& query) override {
    static constexpr std::string_view kSql =
        "SELECT hour, label, sum(jobs)::bigint, sum(points)::bigint, sum(cpu_us)::bigint, max(peak_bytes),"
        " sum(factorizations)::bigint FROM usage WHERE owner = $1 AND hour >= $2 AND hour < $3"
        " AND ($4 OR label = $5) GROUP BY hour, label ORDER BY hour, label LIMIT $6";
    Parameters wanted;
    wanted.add(query.owner).add(first_hour(query.from)).add(first_hour(query.to));
    wanted.add(!query.label.has_value()).add_bytes(query.label.value_or("")).add(query.limit + 1);
    return database_.read<std::vector<UsageRow>>([&](Connection& connection) {
      const Rows rows = connection.run(kSql, wanted);
      std::vector<UsageRow> all;
      for (int row = 0; row < rows.count(); ++row) {
        all.push_back(read_usage_row(rows[row]));
      }
      return all;
    });
  }

  StatusOr<std::vector<AuditEntry>> events(const AuditQuery& query) override {
    static constexpr std::string_view kSql =
        "SELECT number, at_us, event, sweep::int::bigint, entry FROM audit WHERE owner = $1 AND number < $2"
        " AND at_us >= $3 AND at_us < $4 ORDER BY number DESC LIMIT $5";
    Parameters wanted;
    wanted.add(query.owner).add(query.before.value_or(INT64_MAX));
    wanted.add(query.from ? to_row(*query.from) : INT64_MIN).add(query.to ? to_row(*query.to) : INT64_MAX);
    wanted.add(query.limit + 1);
    return database_.read<std::vector<AuditEntry>>([&](Connection& connection) {
      const Rows rows = connection.run(kSql, wanted);
      std::vector<AuditEntry> entries;
      for (int row = 0; row < rows.count(); ++row) {
        entries.push_back(read_audit_entry(rows[row]));
      }
      return entries;
    });
  }

  StatusOr<std::optional<AuditEntry>> deletion(std::string_view id, std::string_view owner) override {
    static constexpr std::string_view kSql =
        "SELECT number, at_us, event, sweep::int::bigint, entry FROM audit WHERE entry = $1 AND owner = $2"
        " AND event IN ('deleted', 'retired') ORDER BY number DESC LIMIT 1";
    return database_.read<std::optional<AuditEntry>>(
        [&](Connection& connection) -> std::optional<AuditEntry> {
          const Rows rows = connection.run(kSql, Parameters().add(id).add(owner));
          return rows.empty() ? std::nullopt : std::optional(read_audit_entry(rows[0]));
        });
  }

  StatusOr<Balance> balance(std::string_view owner, Time now) override {
    return database_.read<Balance>(
        [&](Connection& connection) { return balance_of(connection, owner, INT64_MAX, clock_.at(now)); });
  }

  StatusOr<bool> forget(std::chrono::seconds age, int most, Time now) override {
    Parameters old = Parameters().add(clock_.at(now)).add(microseconds(age));
    const std::vector<Statement> statements{
        {"DELETE FROM usage WHERE hour < (coalesce($1, snapthrough_now()) - $2) / 3600000000", old},
        {"DELETE FROM audit WHERE number IN (SELECT number FROM audit ORDER BY number LIMIT $3)"
         " AND at_us < coalesce($1, snapthrough_now()) - $2",
         Parameters(old).add(most)}};
    return database_.write_at_once<bool>(
        statements, Durability::synced,
        [&](std::span<const Rows> all) -> StatusOr<bool> { return all.back().changed() == most; });
  }

 private:
  Database& database_;
  const Clock clock_;
};

}  // namespace

std::unique_ptr<LedgerStore> ledger_in(Database& database, Clock clock) {
  return std::make_unique<PostgresqlLedgerStore>(database, clock);
}

}  // namespace snapthrough::server::postgresql
