#include <nlohmann/json.hpp>

#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

class SqliteDeliveryStore final : public DeliveryStore {
 public:
  explicit SqliteDeliveryStore(Database& database) : database_(database) {}

  using DeliveryStore::next;
  StatusOr<std::optional<Delivery>> next(std::string_view origin, const UnderWay& under_way,
                                         std::chrono::milliseconds /*hold*/, Time now) override {
    static constexpr std::string_view kSql =
        "SELECT number, ifnull(jobs.id, sweeps.id), sweep IS NOT NULL, address, attempts,"
        " ifnull(jobs.owner, sweeps.owner) FROM deliveries"
        " LEFT JOIN jobs ON jobs.seq = job LEFT JOIN sweeps ON sweeps.seq = sweep"
        " WHERE origin = ? AND due_us <= ? AND number NOT IN (SELECT value FROM json_each(?))"
        " AND ifnull(jobs.owner, sweeps.owner) NOT IN (SELECT value FROM json_each(?))"
        " ORDER BY due_us, number LIMIT 1";
    const std::string numbers = nlohmann::json(under_way.numbers).dump();
    const std::string owners = nlohmann::json(under_way.owners).dump();
    return database_.read<std::optional<Delivery>>(
        [&](const Connection& connection) -> std::optional<Delivery> {
          Statement row = connection.query(kSql, origin, to_row(now), numbers, owners);
          if (!row.step()) {
            return std::nullopt;
          }
          return Delivery{
              row.integer(0), row.text(1), row.integer(2) == 1, row.text(3), static_cast<int>(row.integer(4)),
              row.text(5)};
        });
  }

  Status postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) override {
    return database_.write_only(
        [&](Connection& connection) {
          connection.run("UPDATE deliveries SET attempts = attempts + 1, due_us = ? WHERE number = ?",
                         to_row(now + pause), number);
          return Status();
        },
        Durability::unsynced);
  }

  Status remove(std::int64_t number) override {
    return database_.write_only(
        [&](Connection& connection) {
          connection.run("DELETE FROM deliveries WHERE number = ?", number);
          return Status();
        },
        Durability::unsynced);
  }

  StatusOr<std::int64_t> waiting() override {
    return database_.read<std::int64_t>([](const Connection& connection) {
      Statement row = connection.prepare("SELECT count(*) FROM deliveries");
      row.step();
      return row.integer(0);
    });
  }

 private:
  Database& database_;
};

}  // namespace

std::unique_ptr<DeliveryStore> deliveries_in(Database& database) {
  return std::make_unique<SqliteDeliveryStore>(database);
}

}  // namespace snapthrough::server::sqlite
