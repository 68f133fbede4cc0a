#pragma once
/// @file
/// The table of deliveries; triggers (migrations/sqlite/0007_deliveries.sql) fill it.

#include "server/store/delivery_store.h"
#include "server/store/sqlite/database.h"

namespace snapthrough::server::sqlite {

class SqliteDeliveryStore final : public DeliveryStore {
 public:
  /// The database must outlive this.
  explicit SqliteDeliveryStore(Database& database) : database_(database) {}

  StatusOr<std::optional<Delivery>> next(std::string_view origin, std::chrono::milliseconds hold,
                                         Time now) override;
  Status postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) override;
  Status remove(std::int64_t number) override;
  StatusOr<std::int64_t> waiting() override;

 private:
  Database& database_;
};

}  // namespace snapthrough::server::sqlite
