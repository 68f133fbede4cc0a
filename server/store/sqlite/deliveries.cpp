#include "server/store/sqlite/deliveries.h"

#include "server/store/sqlite/rows.h"

namespace snapthrough::server::sqlite {

StatusOr<std::optional<Delivery>> SqliteDeliveryStore::next(std::string_view origin,
                                                            std::chrono::milliseconds /*hold*/, Time now) {
  return database_.read<std::optional<Delivery>>(
      [&](const Connection& connection) -> std::optional<Delivery> {
        Statement row = connection.prepare(
            "SELECT number, ifnull(jobs.id, sweeps.id), sweep IS NOT NULL, address, attempts FROM deliveries"
            " LEFT JOIN jobs ON jobs.seq = job LEFT JOIN sweeps ON sweeps.seq = sweep"
            " WHERE origin = ? AND due_us <= ? ORDER BY due_us, number LIMIT 1");
        row.bind(origin).bind(to_row(now));
        if (!row.step()) {
          return std::nullopt;
        }
        return Delivery{row.integer(0), row.text(1), row.integer(2) == 1, row.text(3),
                        static_cast<int>(row.integer(4))};
      });
}

Status SqliteDeliveryStore::postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) {
  return database_.write_only(
      [&](Connection& connection) {
        connection.prepare("UPDATE deliveries SET attempts = attempts + 1, due_us = ? WHERE number = ?")
            .bind(to_row(now + pause))
            .bind(number)
            .run();
        return Status();
      },
      Durability::unsynced);
}

Status SqliteDeliveryStore::remove(std::int64_t number) {
  return database_.write_only(
      [&](Connection& connection) {
        connection.prepare("DELETE FROM deliveries WHERE number = ?").bind(number).run();
        return Status();
      },
      Durability::unsynced);
}

StatusOr<std::int64_t> SqliteDeliveryStore::waiting() {
  return database_.read<std::int64_t>([](const Connection& connection) {
    Statement row = connection.prepare("SELECT count(*) FROM deliveries");
    row.step();
    return row.integer(0);
  });
}

}  // namespace snapthrough::server::sqlite
