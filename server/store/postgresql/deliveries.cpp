#include <utility>

#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

class PostgresqlDeliveryStore final : public DeliveryStore {
 public:
  PostgresqlDeliveryStore(Database& database, Clock clock) : database_(database), clock_(clock) {}

  using DeliveryStore::next;
  StatusOr<std::optional<Delivery>> next(std::string_view origin, const UnderWay& under_way,
                                         std::chrono::milliseconds hold, Time now) override {
    // Nothing is written while nothing is due. A delivery that is taken is due later for other processes.
    static constexpr std::string_view kSql =
        "WITH clock AS (SELECT coalesce($2, snapthrough_now()) AS moment),"
        " mine AS MATERIALIZED (SELECT number FROM deliveries WHERE origin = $1"
        "  AND due_us <= (SELECT moment FROM clock)"
        "  AND number <> ALL ($4) AND coalesce((SELECT owner FROM jobs WHERE seq = job),"
        "   (SELECT owner FROM sweeps WHERE seq = sweep)) <> ALL ($5)"
        "  ORDER BY due_us, number LIMIT 1 FOR UPDATE SKIP LOCKED),"
        " taken AS (UPDATE deliveries SET due_us = CASE WHEN $3 > 0 THEN (SELECT moment FROM clock) + $3"
        "   ELSE due_us END WHERE number = (SELECT number FROM mine)"
        "  RETURNING number, job, sweep, address, attempts)"
        " SELECT number, coalesce(jobs.id, sweeps.id), sweep IS NOT NULL, address, attempts,"
        " coalesce(jobs.owner, sweeps.owner) FROM taken"
        " LEFT JOIN jobs ON jobs.seq = job LEFT JOIN sweeps ON sweeps.seq = sweep";
    const auto use = [](std::span<const Rows> all) -> StatusOr<std::optional<Delivery>> {
      const Rows& rows = all.front();
      if (rows.empty()) {
        return std::optional<Delivery>();
      }
      return std::optional(Delivery{rows[0].integer(0), rows[0].text(1), rows[0].boolean(2), rows[0].text(3),
                                    static_cast<int>(rows[0].integer(4)), rows[0].text(5)});
    };
    Parameters parameters;
    parameters.add(origin).add(clock_.at(now)).add(microseconds(hold));
    parameters.add(std::span<const std::int64_t>(under_way.numbers));
    parameters.add(std::span<const std::string>(under_way.owners));
    return database_.write_at_once<std::optional<Delivery>>({{kSql, std::move(parameters)}},
                                                            Durability::unsynced, use);
  }

  Status postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) override {
    return database_.write_at_once(
        {{"UPDATE deliveries SET attempts = attempts + 1, due_us = coalesce($2, snapthrough_now()) + $3"
          " WHERE number = $1",
          Parameters().add(number).add(clock_.at(now)).add(microseconds(pause))}},
        Durability::unsynced);
  }

  Status remove(std::int64_t number) override {
    return database_.write_at_once({{"DELETE FROM deliveries WHERE number = $1", Parameters().add(number)}},
                                   Durability::unsynced);
  }

  StatusOr<std::int64_t> waiting() override {
    return database_.read<std::int64_t>([](Connection& connection) {
      return connection.run("SELECT count(*) FROM deliveries")[0].integer(0);
    });
  }

 private:
  Database& database_;
  const Clock clock_;
};

}  // namespace

std::unique_ptr<DeliveryStore> deliveries_in(Database& database, Clock clock) {
  return std::make_unique<PostgresqlDeliveryStore>(database, clock);
}

}  // namespace snapthrough::server::postgresql
