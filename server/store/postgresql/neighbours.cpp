#include <algorithm>
#include <string>

#include "server/bell.h"
#include "server/environment.h"
#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

/// Pause between two tries to listen.
constexpr std::chrono::seconds kBetweenTries{5};
/// Longest sleep without a look whether it is time for another try.
constexpr std::chrono::milliseconds kBetweenLooks{100};

/// @brief wait() listens on a connection of its own. Where notifications do not come through (a pool between
/// program and database that lends connections for a transaction only), it only waits.
class PostgresqlNeighbourStore final : public NeighbourStore {
 public:
  explicit PostgresqlNeighbourStore(Database& database) : database_(database) {}

  StatusOr<WaitingWork> work(std::int64_t most) override {
    return database_.read<WaitingWork>([&](Connection& connection) {
      const Rows rows = connection.run(
          "SELECT (SELECT count(*) FROM (SELECT FROM jobs WHERE " + may(JobEvent::claim) +
              " LIMIT $1) AS few), EXISTS (SELECT FROM sweeps WHERE " + may(SweepEvent::dismiss) +
              " AND NOT removed"
              "  AND EXISTS (SELECT FROM sweep_left WHERE sweep = seq))",
          Parameters().add(most));
      return WaitingWork{rows[0].integer(0), rows[0].boolean(1)};
    });
  }

  StatusOr<std::vector<std::string>> ended(const std::vector<std::string>& ids) override {
    return database_.read<std::vector<std::string>>([&](Connection& connection) {
      return connection
          .run(
              "SELECT asked FROM unnest($1) AS asked WHERE"
              " NOT EXISTS (SELECT FROM jobs WHERE id = asked AND finished_us IS NULL) AND"
              " NOT EXISTS (SELECT FROM sweeps WHERE id = asked AND finished_us IS NULL AND NOT removed)",
              Parameters().add(ids))
          .texts(0);
    });
  }

  Status tell(const std::vector<ToldProgress>& progress) override {
    std::vector<Statement> statements;
    statements.reserve(progress.size() + 1);
    static const std::string kSql =
        "INSERT INTO job_progress (job, attempt, number, branch, step, load_factor, negative_eigenvalues)"
        " SELECT seq, $2, $3, $4, $5, $6, $7 FROM jobs WHERE id = $1 AND attempt = $2 AND " +
        may(JobEvent::finish) +
        " ON CONFLICT (job) DO UPDATE SET attempt = excluded.attempt, number = excluded.number,"
        " branch = excluded.branch, step = excluded.step, load_factor = excluded.load_factor,"
        " negative_eigenvalues = excluded.negative_eigenvalues";
    for (const ToldProgress& one : progress) {
      Parameters row;
      row.add(one.id).add(one.attempt).add(static_cast<std::int64_t>(one.number)).add(one.progress.branch);
      row.add(one.progress.step).add(one.progress.load_factor).add(one.progress.negative_eigenvalues);
      statements.push_back({kSql, std::move(row)});
    }
    // Progress of jobs that do not run any more is removed, whoever stored it.
    statements.push_back(
        {"DELETE FROM job_progress WHERE NOT EXISTS"
         " (SELECT FROM job_leases WHERE job_leases.job = job_progress.job)"});
    return database_.write_at_once(std::move(statements), Durability::unsynced);
  }

  StatusOr<std::vector<ToldProgress>> told(const std::vector<std::string>& ids) override {
    return database_.read<std::vector<ToldProgress>>([&](Connection& connection) {
      const Rows rows = connection.run(
          "SELECT id, attempt, number, branch, step, load_factor, negative_eigenvalues"
          " FROM job_progress JOIN jobs USING (attempt) WHERE seq = job AND id = ANY ($1) AND " +
              may(JobEvent::finish),
          Parameters().add(ids));
      std::vector<ToldProgress> all;
      for (int row = 0; row < rows.count(); ++row) {
        const auto whole = [&](int column) { return static_cast<int>(rows[row].integer(column)); };
        all.push_back({rows[row].text(0),
                       whole(1),
                       static_cast<std::uint64_t>(rows[row].integer(2)),
                       {whole(3), whole(4), rows[row].real(5), whole(6)}});
      }
      return all;
    });
  }

  Status ring() override {
    return database_.write_at_once({{"SELECT pg_notify('snapthrough', $1)", Parameters().add(name_)}},
                                   Durability::unsynced);
  }

  bool wait(std::chrono::milliseconds longest, const std::stop_token& stop) override {
    const PollBell stopping;
    const std::stop_callback on_stop(stop, [&] { stopping.ring(); });
    const auto end = std::chrono::steady_clock::now() + longest;
    for (auto left = longest; left.count() > 0 && !stop.stop_requested();
         left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now())) {
      if (!listen()) {
        pause(stop, std::min(left, kBetweenLooks));
        continue;
      }
      try {
        if (listener_->wait_for_notification(left, stopping, name_)) {
          return true;
        }
      } catch (const Error&) {
        listener_.reset();
        return true;  // notifications may have been lost with the connection
      }
    }
    return false;
  }

 private:
  /// Opens the listening connection if need be; returns whether it is open.
  bool listen() {
    if (listener_) {
      return true;
    }
    if (std::chrono::steady_clock::now() < next_try_) {
      return false;
    }
    next_try_ = std::chrono::steady_clock::now() + kBetweenTries;
    try {
      std::unique_ptr<Connection> connection = database_.open();
      connection->execute("LISTEN snapthrough");
      listener_ = std::move(connection);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  Database& database_;
  /// Text of the notifications that this process sends. PostgreSQL delivers them to the process's own
  /// listening connection, too, where wait() ignores them.
  const std::string name_ = std::to_string(Environment::system().random_bits());
  std::unique_ptr<Connection> listener_;
  std::chrono::steady_clock::time_point next_try_{};
};

}  // namespace

std::unique_ptr<NeighbourStore> neighbours_in(Database& database) {
  return std::make_unique<PostgresqlNeighbourStore>(database);
}

}  // namespace snapthrough::server::postgresql
