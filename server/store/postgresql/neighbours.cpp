#include "server/store/postgresql/neighbours.h"

#include <algorithm>

#include "server/bell.h"

namespace snapthrough::server::postgresql {
namespace {

/// Pause between two tries to listen.
constexpr std::chrono::seconds kBetweenTries{5};
/// Longest sleep without a look whether it is time for another try.
constexpr std::chrono::milliseconds kBetweenLooks{100};

}  // namespace

StatusOr<WaitingWork> PostgresqlNeighbourStore::work(std::int64_t most) {
  return database_.read<WaitingWork>([&](Connection& connection) {
    const Rows rows = connection.run(
        "SELECT (SELECT count(*) FROM (SELECT FROM jobs WHERE status = 'accepted' LIMIT $1) AS few),"
        " EXISTS (SELECT FROM sweeps WHERE status IN ('accepted', 'running') AND NOT removed"
        "  AND EXISTS (SELECT FROM sweep_left WHERE sweep = seq))",
        Parameters().add(most));
    return WaitingWork{rows.integer(0, 0), rows.boolean(0, 1)};
  });
}

StatusOr<std::vector<std::string>> PostgresqlNeighbourStore::ended(const std::vector<std::string>& ids) {
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

Status PostgresqlNeighbourStore::tell(const std::vector<ToldProgress>& progress) {
  std::vector<Statement> statements;
  statements.reserve(progress.size() + 1);
  for (const ToldProgress& one : progress) {
    statements.push_back(
        {"INSERT INTO job_progress (job, attempt, number, branch, step, load_factor, negative_eigenvalues)"
         " SELECT seq, $2, $3, $4, $5, $6, $7 FROM jobs WHERE id = $1 AND attempt = $2 AND status = 'running'"
         " ON CONFLICT (job) DO UPDATE SET attempt = excluded.attempt, number = excluded.number,"
         " branch = excluded.branch, step = excluded.step, load_factor = excluded.load_factor,"
         " negative_eigenvalues = excluded.negative_eigenvalues",
         Parameters()
             .add(one.id)
             .add(one.attempt)
             .add(static_cast<std::int64_t>(one.number))
             .add(one.progress.branch)
             .add(one.progress.step)
             .add(one.progress.load_factor)
             .add(one.progress.negative_eigenvalues)});
  }
  // of jobs that run no more, whoever worked on them
  statements.push_back(
      {"DELETE FROM job_progress WHERE NOT EXISTS"
       " (SELECT FROM job_leases WHERE job_leases.job = job_progress.job)"});
  return database_.write_at_once(std::move(statements), Durability::unsynced);
}

StatusOr<std::vector<ToldProgress>> PostgresqlNeighbourStore::told(const std::vector<std::string>& ids) {
  return database_.read<std::vector<ToldProgress>>([&](Connection& connection) {
    const Rows rows = connection.run(
        "SELECT id, attempt, number, branch, step, load_factor, negative_eigenvalues"
        " FROM job_progress JOIN jobs USING (attempt) WHERE seq = job AND id = ANY ($1) AND status = "
        "'running'",
        Parameters().add(ids));
    std::vector<ToldProgress> all;
    for (int row = 0; row < rows.count(); ++row) {
      const auto whole = [&](int column) { return static_cast<int>(rows.integer(row, column)); };
      all.push_back({rows.text(row, 0),
                     whole(1),
                     static_cast<std::uint64_t>(rows.integer(row, 2)),
                     {whole(3), whole(4), rows.real(row, 5), whole(6)}});
    }
    return all;
  });
}

Status PostgresqlNeighbourStore::ring() {
  return database_.write_at_once({{"SELECT pg_notify('snapthrough', '')"}}, Durability::unsynced);
}

/// Whether it listens.
bool PostgresqlNeighbourStore::listen() {
  if (listener_) {
    return true;
  }
  if (std::chrono::steady_clock::now() < next_try_) {
    return false;
  }
  next_try_ = std::chrono::steady_clock::now() + kBetweenTries;
  try {
    auto connection = std::make_unique<Connection>(database_.location());
    connection->execute("LISTEN snapthrough");
    listener_ = std::move(connection);
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool PostgresqlNeighbourStore::wait(std::chrono::milliseconds longest, const std::stop_token& stop) {
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
      if (listener_->wait_for_notification(left, stopping)) {
        return true;
      }
    } catch (const Error&) {
      listener_.reset();
      return true;  // notifications may have been lost with the connection
    }
  }
  return false;
}

}  // namespace snapthrough::server::postgresql
