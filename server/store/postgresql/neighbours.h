#pragma once
/// @file
/// What processes tell each other, in PostgreSQL.

#include <chrono>
#include <memory>

#include "server/store/neighbour_store.h"
#include "server/store/postgresql/database.h"

namespace snapthrough::server::postgresql {

/// @brief wait() listens on a connection of its own. Where notifications don't come through (a pool between
/// that gives connections for a transaction only), it only waits.
class PostgresqlNeighbourStore final : public NeighbourStore {
 public:
  /// The database must outlive this.
  explicit PostgresqlNeighbourStore(Database& database) : database_(database) {}

  StatusOr<WaitingWork> work(std::int64_t most) override;
  StatusOr<std::vector<std::string>> ended(const std::vector<std::string>& ids) override;
  Status tell(const std::vector<ToldProgress>& progress) override;
  StatusOr<std::vector<ToldProgress>> told(const std::vector<std::string>& ids) override;
  Status ring() override;
  /// One thread at a time.
  bool wait(std::chrono::milliseconds longest, const std::stop_token& stop) override;

 private:
  bool listen();

  Database& database_;
  std::unique_ptr<Connection> listener_;
  std::chrono::steady_clock::time_point next_try_{};
};

}  // namespace snapthrough::server::postgresql
