#pragma once
/// @file
/// Sweeps in PostgreSQL.

#include <string>
#include <vector>

#include "server/store/postgresql/database.h"
#include "server/store/postgresql/rows.h"
#include "server/store/sweep_store.h"

namespace snapthrough::server::postgresql {

class PostgresqlSweepStore final : public SweepStore {
 public:
  /// The database must outlive this.
  PostgresqlSweepStore(Database& database, Clock clock) : database_(database), clock_(clock) {}

  StatusOr<Submitted> submit(const NewSweep& sweep) override;
  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) override;
  StatusOr<std::int64_t> unfinished() override;
  StatusOr<std::vector<std::string>> with_units() override;
  StatusOr<std::optional<OpenSweep>> open(std::string_view id) override;
  StatusOr<std::optional<UnitClaim>> claim(std::string_view id, std::uint64_t most, const Lease& lease,
                                           Time now) override;
  StatusOr<std::vector<std::int64_t>> renew(const std::vector<UnitClaim>& claims, Time until,
                                            Time now) override;
  StatusOr<SweepRecord> put(const UnitClaim& claim, const std::vector<PointRow>& rows, Time now) override;
  StatusOr<std::int64_t> recover(int max_crashes, Time now) override;
  StatusOr<std::int64_t> rescue(std::string_view worker, int max_crashes, Time now) override;
  StatusOr<SweepChange> dismiss(std::string_view id, Time now) override;
  StatusOr<SweepChange> retry(std::string_view id, const Quotas& quotas, Time now) override;
  StatusOr<bool> remove(std::string_view id) override;
  StatusOr<int> retire(std::chrono::seconds age, Time now) override;
  StatusOr<bool> purge(int most) override;
  Status forget_keys(std::chrono::seconds age, Time now) override;
  StatusOr<std::optional<SweepRecord>> get(std::string_view id) override;
  StatusOr<SweepPage> list(const ListQuery& query) override;
  StatusOr<std::optional<std::string>> document(std::string_view id) override;
  Status each_row(std::string_view id, const PointQuery& query,
                  const std::function<bool(std::uint64_t, const api::PointOutcome&)>& use) override;
  StatusOr<std::vector<std::optional<std::string>>> find_outputs(
      const std::vector<std::string>& keys) override;

 private:
  Database& database_;
  const Clock clock_;
};

}  // namespace snapthrough::server::postgresql
