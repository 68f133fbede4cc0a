#pragma once
/// @file
/// Jobs in PostgreSQL.

#include <memory>
#include <mutex>
#include <string>

#include "server/store/postgresql/database.h"
#include "server/store/postgresql/deliveries.h"
#include "server/store/postgresql/neighbours.h"
#include "server/store/postgresql/rows.h"
#include "server/store/postgresql/sweeps.h"
#include "server/store/store.h"

namespace snapthrough::server::postgresql {

class PostgresqlStore final : public Store {
 public:
  PostgresqlStore(const std::string& location, int connections, Clock clock)
      : database_(location, connections),
        clock_(clock),
        sweeps_(database_, clock),
        deliveries_(database_, clock),
        neighbours_(database_) {}

  using Store::submit;
  StatusOr<Submitted> submit(const NewJob& job, const std::function<void()>& queued) override;
  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) override;
  StatusOr<std::optional<Claim>> claim(const Lease& lease, Time now) override;
  StatusOr<std::vector<std::string>> renew(const std::vector<Claim>& claims, Time until, Time now) override;
  Status finish(const Claim& claim, const JobResult& result, Time now) override;
  Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) override;
  Status requeue(const Claim& claim) override;
  StatusOr<Recovery> recover(int max_crashes, Time now) override;
  StatusOr<Recovery> rescue(std::string_view worker, int max_crashes, Time now) override;
  StatusOr<Dismissal> dismiss(std::string_view id, Time now) override;
  StatusOr<bool> remove(std::string_view id) override;
  StatusOr<int> retire(std::chrono::seconds age, int most, Time now) override;
  Status forget_keys(std::chrono::seconds age, Time now) override;
  Status probe(Time now) override;
  StatusOr<std::optional<std::string>> find_result(std::string_view content_key,
                                                   std::string_view owner) override;
  StatusOr<std::int64_t> waiting() override;
  StatusOr<std::optional<Time>> oldest_waiting() override;
  void write_metrics(std::string& text) const override { database_.write_metrics(text); }
  StatusOr<std::vector<std::string>> owners() override;
  StatusOr<std::optional<Job>> get(std::string_view id) override;
  StatusOr<JobPage> list(const ListQuery& query) override;
  StatusOr<std::optional<std::string>> request(std::string_view id) override;
  StatusOr<DocumentPiece> result_piece(std::string_view id, std::size_t offset, std::size_t most) override;
  StatusOr<StoredPath> path(std::string_view id) override;
  SweepStore& sweeps() override { return sweeps_; }
  DeliveryStore& deliveries() override { return deliveries_; }
  NeighbourStore* neighbours() override { return &neighbours_; }

 private:
  StatusOr<Submitted> submit_only(const NewJob& job);
  StatusOr<Submitted> submit_or_known(Connection& connection, const NewJob& job) const;
  Status end(const Claim& claim, JobEvent event, std::vector<Statement> more, std::int64_t bytes, Time now);

  Database database_;
  const Clock clock_;
  std::mutex turn_mutex_;
  std::string last_owner_;  ///< whose job was claimed last
  PostgresqlSweepStore sweeps_;
  PostgresqlDeliveryStore deliveries_;
  PostgresqlNeighbourStore neighbours_;
};

}  // namespace snapthrough::server::postgresql
