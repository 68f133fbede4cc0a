#pragma once
/// @file
/// Deliveries of callbacks in PostgreSQL.

#include "server/store/delivery_store.h"
#include "server/store/postgresql/database.h"
#include "server/store/postgresql/rows.h"

namespace snapthrough::server::postgresql {

class PostgresqlDeliveryStore final : public DeliveryStore {
 public:
  /// The database must outlive this.
  PostgresqlDeliveryStore(Database& database, Clock clock) : database_(database), clock_(clock) {}

  StatusOr<std::optional<Delivery>> next(std::string_view origin, std::chrono::milliseconds hold,
                                         Time now) override;
  Status postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) override;
  Status remove(std::int64_t number) override;
  StatusOr<std::int64_t> waiting() override;

 private:
  Database& database_;
  const Clock clock_;
};

}  // namespace snapthrough::server::postgresql
