/// What happens to jobs: verbs that write.

#include "server/store/postgresql/jobs.h"

#include <utility>

#include "server/store/crashes.h"
#include "server/store/postgresql/quotas.h"

namespace snapthrough::server::postgresql {
namespace {

/// Puts jobs back at their place in the queue.
const std::string& put_back_sql() {
  static const std::string kSql =
      "UPDATE jobs SET status = " + literal(JobState::accepted) + ", started_us = NULL WHERE id = $1";
  return kSql;
}

/// Parameters of the statement that inserts a job: $1 to $12.
Parameters job_parameters(const NewJob& job, const Clock& clock, JobState state, std::int64_t bytes) {
  Parameters row;
  row.add(job.id).add_bytes(job.title).add(job.analysis_type).add(clock.at(job.created)).add(job.owner);
  row.add(job.content_key).add(to_string(state)).add_bytes_or_null(job.annotations.label);
  row.add_bytes_or_null(job.annotations.metadata);
  const std::string& callback = job.annotations.callback;
  row.add(callback.empty() ? std::nullopt : std::optional<std::string_view>(callback));
  row.add(bytes).add_bytes(job.document);
  return row;
}

/// Inserts the job with its request, and its lease when it comes with one ($13 worker, $14 microseconds).
constexpr std::string_view kInsertJob =
    "WITH job AS (INSERT INTO jobs (id, title, analysis_type, created_us, owner, content_key, status, label,"
    "  metadata, callback, bytes, attempt, started_us)"
    " SELECT $1, $2, $3, moment, $5, $6, $7, $8, $9, $10, $11, CASE WHEN $7 = 'running' THEN 1 ELSE 0 END,"
    "  CASE WHEN $7 = 'running' THEN moment END"
    " FROM (SELECT coalesce($4, snapthrough_now()) AS moment) AS clock RETURNING seq, started_us),"
    " lease AS (INSERT INTO job_leases (job, worker, until_us)"
    "  SELECT seq, $13, started_us + $14 FROM job WHERE $13 IS NOT NULL)"
    " INSERT INTO requests (job, document) SELECT seq, $12 FROM job";

Statement insert_job(const NewJob& job, const Clock& clock) {
  Parameters row = job_parameters(job, clock, job.lease ? JobState::running : JobState::accepted,
                                  static_cast<std::int64_t>(job.document.size()));
  row.add(job.lease ? std::optional<std::string_view>(job.lease->worker) : std::nullopt);
  row.add(job.lease ? microseconds(job.lease->until - job.created) : std::int64_t{0});
  return {kInsertJob, std::move(row)};
}

/// A job whose result will do for another one.
struct KnownJob {
  std::string id;
  Annotations annotations;  ///< its callback, which was told, left out
};

/// The newest successful job of that content and owner, of those with these annotations if there are any.
std::optional<KnownJob> same_content(Connection& connection, std::string_view content_key,
                                     std::string_view owner, const Annotations& annotations) {
  if (content_key.empty()) {
    return std::nullopt;
  }
  static const std::string kSql =
      "SELECT id, label, metadata FROM jobs WHERE content_key = $1 AND content_key <> '' AND owner = $2"
      " AND status = " +
      literal(JobState::successful) +
      " ORDER BY (label IS NOT DISTINCT FROM $3 AND metadata IS NOT DISTINCT FROM $4) DESC, seq DESC LIMIT 1";
  Parameters wanted;
  wanted.add(content_key).add(owner);
  wanted.add_bytes_or_null(annotations.label).add_bytes_or_null(annotations.metadata);
  const Rows rows = connection.run(kSql, wanted);
  if (rows.empty()) {
    return std::nullopt;
  }
  return KnownJob{rows.text(0, 0), {rows.text(0, 1), rows.text(0, 2), ""}};
}

/// Inserts a job and makes it successful with a copy of everything that another one's success left.
void insert_copy(Connection& connection, const NewJob& job, const std::string& original, const Clock& clock) {
  NewJob running = job;
  running.lease = Lease{"", job.created};  // a result needs a running job
  std::vector<Statement> statements{insert_job(running, clock)};
  const Parameters both = Parameters().add(job.id).add(original);
  for (const char* sql :
       {"INSERT INTO results SELECT (SELECT seq FROM jobs WHERE id = $1), size, packed, critical_load_factor,"
        " critical_type, termination, wall_time_s FROM results JOIN jobs ON seq = job WHERE id = $2",
        "INSERT INTO result_pieces SELECT (SELECT seq FROM jobs WHERE id = $1), number, result_pieces.bytes"
        " FROM result_pieces JOIN jobs ON seq = job WHERE id = $2",
        "INSERT INTO branches SELECT (SELECT seq FROM jobs WHERE id = $1), branch, parent, load_factor,"
        " arc_length, negative_eigenvalues, stiffness_ratio, fields FROM branches JOIN jobs ON seq = job"
        " WHERE id = $2",
        "INSERT INTO branch_series SELECT (SELECT seq FROM jobs WHERE id = $1), branch, kind, number,"
        " branch_series.id, samples FROM branch_series JOIN jobs ON seq = job WHERE jobs.id = $2",
        "INSERT INTO critical_points SELECT (SELECT seq FROM jobs WHERE id = $1), number, branch, type,"
        " load_factor, error_estimate, arc_length, negative_before, negative_after, multiplicity,"
        " imperfection, fields FROM critical_points JOIN jobs ON seq = job WHERE id = $2",
        "UPDATE jobs SET status = 'successful', finished_us = started_us,"
        " bytes = bytes + (SELECT size FROM results JOIN jobs ON seq = job WHERE id = $2) WHERE id = $1",
        "DELETE FROM job_leases USING jobs WHERE job = seq AND id = $1 AND $2 <> ''"}) {
    statements.push_back({sql, both});
  }
  connection.run_all(statements);
}

constexpr std::string_view kKnownKey =
    "SELECT fingerprint, id FROM idempotency_keys JOIN jobs ON seq = job"
    " WHERE idempotency_keys.owner = $1 AND key = $2";

void insert_key(Connection& connection, const NewJob& job, const std::string& id, const Clock& clock) {
  Parameters row;
  row.add(job.owner).add(job.idempotency->key).add(job.idempotency->fingerprint).add(id);
  row.add(clock.at(job.created));
  connection.run(
      "INSERT INTO idempotency_keys (owner, key, fingerprint, job, created_us)"
      " SELECT $1, $2, $3, seq, coalesce($5, snapthrough_now()) FROM jobs WHERE id = $4",
      row);
}

}  // namespace

/// One that can't be known already, nor refused.
StatusOr<Submitted> PostgresqlStore::submit_only(const NewJob& job) {
  if (Status status = database_.write_at_once({insert_job(job, clock_)}); !status.ok()) {
    return status;
  }
  return Submitted{Submitted::Kind::created, job.id};
}

StatusOr<Submitted> PostgresqlStore::submit_or_known(Connection& connection, const NewJob& job) const {
  if (job.idempotency) {
    // Who comes second with a key waits here, and then finds what the first did.
    connection.run("SELECT pg_advisory_xact_lock(hashtextextended($1 || ' ' || $2, 1))",
                   Parameters().add(job.owner).add(job.idempotency->key));
    const Rows rows = connection.run(kKnownKey, Parameters().add(job.owner).add(job.idempotency->key));
    if (const std::optional<Submitted> known = known_key(rows, *job.idempotency)) {
      return *known;
    }
  }
  const auto known =
      job.reuse ? same_content(connection, job.content_key, job.owner, job.annotations) : std::nullopt;
  // A callback, which the known job does not have, is told of a new job.
  const bool will_do = known && (job.annotations == Annotations{} || job.annotations == known->annotations);
  Submitted submitted{Submitted::Kind::reused, known ? known->id : ""};
  if (!will_do) {
    const Usage addition{job.lease || known ? 0 : 1, 0, static_cast<std::int64_t>(job.document.size())};
    if (Status status = admit(connection, job.owner, job.quotas, addition, clock_.at(job.created));
        !status.ok()) {
      return status;
    }
    submitted = {known ? Submitted::Kind::copied : Submitted::Kind::created, job.id};
    if (known) {
      insert_copy(connection, job, known->id, clock_);
    } else {
      const Statement insertion = insert_job(job, clock_);
      connection.run(insertion.sql, insertion.parameters);
    }
  }
  if (job.idempotency) {
    insert_key(connection, job, submitted.id, clock_);
  }
  return submitted;
}

StatusOr<Submitted> PostgresqlStore::submit(const NewJob& job, const std::function<void()>& queued) {
  const bool plain = !job.idempotency && !job.reuse && !job.quotas.any();
  StatusOr<Submitted> submitted =
      plain ? submit_only(job) : database_.write<Submitted>([&](Connection& connection) {
        return submit_or_known(connection, job);
      });
  if (submitted.ok()) {
    queued();  // connections know no order: what comes after the commit comes after it
  }
  return submitted;
}

StatusOr<std::optional<Submitted>> PostgresqlStore::find_key(const IdempotencyKey& key,
                                                             std::string_view owner) {
  return database_.read<std::optional<Submitted>>([&](Connection& connection) {
    return known_key(connection.run(kKnownKey, Parameters().add(owner).add(key.key)), key);
  });
}

StatusOr<std::optional<Claim>> PostgresqlStore::claim(const Lease& lease, Time now) {
  // Of the next owner by name that has a job waiting, after the one that had a turn here, the oldest that
  // nobody is about to take; if others are about to take all of those, that of any owner (in the order of the
  // index: the oldest of all would be looked for among all jobs that are kept).
  static const std::string kSql =
      "WITH turn AS (SELECT coalesce((SELECT min(owner) FROM jobs WHERE status = 'accepted' AND owner > $1),"
      "  (SELECT min(owner) FROM jobs WHERE status = 'accepted')) AS owner),"
      " mine AS MATERIALIZED (SELECT seq FROM jobs WHERE status = 'accepted' AND owner = (SELECT owner FROM "
      "turn)"
      "  ORDER BY seq LIMIT 1 FOR UPDATE SKIP LOCKED),"
      " other AS MATERIALIZED (SELECT seq FROM jobs WHERE status = 'accepted' AND NOT EXISTS (SELECT FROM "
      "mine)"
      "  ORDER BY owner, seq LIMIT 1 FOR UPDATE SKIP LOCKED),"
      " taken AS (UPDATE jobs SET status = 'running', attempt = attempt + 1,"
      "  started_us = coalesce($2, snapthrough_now())"
      "  WHERE seq = (SELECT seq FROM mine UNION ALL SELECT seq FROM other)"
      "  RETURNING seq, id, attempt, created_us, owner, started_us),"
      " leased AS (INSERT INTO job_leases (job, worker, until_us) SELECT seq, $3, started_us + $4 FROM taken)"
      " SELECT id, attempt, document, created_us, owner FROM taken JOIN requests ON job = seq";
  std::string last;
  {
    const std::lock_guard guard(turn_mutex_);
    last = last_owner_;
  }
  Parameters wanted;
  wanted.add(last).add(clock_.at(now)).add(lease.worker).add(microseconds(lease.until - now));
  const auto use = [&](std::span<const Rows> all) -> StatusOr<std::optional<Claim>> {
    const Rows& rows = all.front();
    if (rows.empty()) {
      return std::optional<Claim>();
    }
    const std::lock_guard guard(turn_mutex_);
    last_owner_ = rows.text(0, 4);
    return std::optional(
        Claim{rows.text(0, 0), static_cast<int>(rows.integer(0, 1)), rows.text(0, 2), time_in(rows, 0, 3)});
  };
  return database_.write_at_once<std::optional<Claim>>({{kSql, wanted}}, Durability::unsynced, use);
}

StatusOr<std::vector<std::string>> PostgresqlStore::renew(const std::vector<Claim>& claims, Time until,
                                                          Time now) {
  std::vector<std::string> ids;
  std::vector<std::int64_t> attempts;
  for (const Claim& claim : claims) {
    ids.push_back(claim.id);
    attempts.push_back(claim.attempt);
  }
  Parameters held;
  held.add(ids).add(attempts).add(clock_.at(now)).add(microseconds(until - now));
  const auto use = [&](std::span<const Rows> all) -> StatusOr<std::vector<std::string>> {
    return all.front().texts(0);
  };
  // In the order of rows, so that two that renew the same do not wait for each other.
  static constexpr std::string_view kSql =
      "WITH clock AS (SELECT coalesce($3, snapthrough_now()) AS moment),"
      " held AS (SELECT job, jobs.id FROM unnest($1, $2) AS claim (id, attempt)"
      "  JOIN jobs ON jobs.id = claim.id AND jobs.attempt = claim.attempt AND status = 'running'"
      "  JOIN job_leases ON job = seq AND until_us >= (SELECT moment FROM clock)"
      "  ORDER BY job FOR UPDATE OF job_leases),"
      " renewed AS (UPDATE job_leases SET until_us = (SELECT moment FROM clock) + $4"
      "  WHERE job IN (SELECT job FROM held))"
      " SELECT id FROM unnest($1) AS claimed (id) WHERE id NOT IN (SELECT id FROM held)";
  return database_.write_at_once<std::vector<std::string>>({{kSql, held}}, Durability::unsynced, use);
}

/// Ends a job under its claim, with what it left. @param bytes of the documents that it left
Status PostgresqlStore::end(const Claim& claim, JobEvent event, std::vector<Statement> more,
                            std::int64_t bytes, Time now) {
  static constexpr std::string_view kFence = "SELECT held_job($1, $2, coalesce($3, snapthrough_now()))";
  static constexpr std::string_view kEnd =
      "UPDATE jobs SET status = $2, finished_us = coalesce($3, snapthrough_now()), bytes = bytes + $4"
      " WHERE id = $1";
  static constexpr std::string_view kRelease =
      "DELETE FROM job_leases WHERE job = (SELECT seq FROM jobs WHERE id = $1)";
  std::vector<Statement> statements{
      {kFence, Parameters().add(claim.id).add(claim.attempt).add(clock_.at(now))}};
  statements.insert(statements.end(), std::make_move_iterator(more.begin()),
                    std::make_move_iterator(more.end()));
  const JobState after = next_state(JobState::running, event).value();
  statements.push_back(
      {kEnd, Parameters().add(claim.id).add(to_string(after)).add(clock_.at(now)).add(bytes)});
  statements.push_back({kRelease, Parameters().add(claim.id)});
  return database_.write_at_once(std::move(statements));
}

Status PostgresqlStore::finish(const Claim& claim, const JobResult& result, Time now) {
  std::vector<Statement> statements;
  add_document(statements, claim.id, result);
  add_path(statements, claim.id, result.branches, result.critical_points);
  return end(claim, JobEvent::finish, std::move(statements),
             static_cast<std::int64_t>(result.document.size()), now);
}

Status PostgresqlStore::fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached,
                             Time now) {
  std::vector<Statement> statements{
      {"INSERT INTO failures (job, code, detail, reached)"
       " VALUES ((SELECT seq FROM jobs WHERE id = $1), $2, $3, $4)",
       Parameters()
           .add(claim.id)
           .add(failure.code)
           .add_bytes(failure.detail)
           .add_bytes_or_null(failure.reached)}};
  add_path(statements, claim.id, reached.branches, reached.critical_points);
  return end(claim, JobEvent::fail, std::move(statements), static_cast<std::int64_t>(failure.reached.size()),
             now);
}

Status PostgresqlStore::requeue(const Claim& claim) {
  return database_.write_at_once(
      {{"SELECT held_job($1, $2, NULL)", Parameters().add(claim.id).add(claim.attempt)},
       {put_back_sql(), Parameters().add(claim.id)},
       {"DELETE FROM job_leases WHERE job = (SELECT seq FROM jobs WHERE id = $1)",
        Parameters().add(claim.id)}});
}

StatusOr<Recovery> PostgresqlStore::recover(int /*max_crashes*/, Time /*now*/) {
  return Recovery{};  // who is gone is seen by leases
}

StatusOr<Recovery> PostgresqlStore::rescue(std::string_view worker, int max_crashes, Time now) {
  static constexpr std::string_view kLate =
      "SELECT id, crashes, job_leases.worker FROM job_leases JOIN jobs ON seq = job"
      " WHERE until_us < coalesce($1, snapthrough_now()) ORDER BY seq FOR UPDATE SKIP LOCKED";
  return database_.write<Recovery>([&](Connection& connection) -> StatusOr<Recovery> {
    const Rows late = connection.run(kLate, Parameters().add(clock_.at(now)));
    Recovery recovery;
    std::vector<Statement> statements;
    for (int row = 0; row < late.count(); ++row) {
      const std::string id = late.text(row, 0);
      const bool crashed = late.text(row, 2) != worker;
      const bool give_up = crashed && late.integer(row, 1) + 1 >= max_crashes;
      const Parameters job = Parameters().add(id);
      statements.push_back({"DELETE FROM job_leases WHERE job = (SELECT seq FROM jobs WHERE id = $1)", job});
      if (crashed) {
        statements.push_back({"UPDATE jobs SET crashes = crashes + 1 WHERE id = $1", job});
      }
      if (give_up) {
        statements.push_back(
            {"INSERT INTO failures (job, code, detail)"
             " VALUES ((SELECT seq FROM jobs WHERE id = $1), 'crashed', $2)",
             Parameters().add(id).add_bytes(crashed_detail(max_crashes, "job"))});
        statements.push_back(
            {"UPDATE jobs SET status = 'failed', finished_us = coalesce($2, snapthrough_now())"
             " WHERE id = $1",
             Parameters().add(id).add(clock_.at(now))});
      } else {
        statements.push_back({put_back_sql(), job});
      }
      (give_up ? recovery.failed : recovery.requeued).push_back(id);
    }
    connection.run_all(statements);
    return recovery;
  });
}

StatusOr<Dismissal> PostgresqlStore::dismiss(std::string_view id, Time now) {
  return database_.write<Dismissal>([&](Connection& connection) -> StatusOr<Dismissal> {
    const Rows found =
        connection.run("SELECT status FROM jobs WHERE id = $1 FOR UPDATE", Parameters().add(id));
    if (found.empty()) {
      return Dismissal{};
    }
    const Dismissal dismissal{true, state_in(found, 0, 0)};
    if (const auto after = next_state(dismissal.before, JobEvent::dismiss)) {
      connection.run_all(std::vector<Statement>{
          {"UPDATE jobs SET status = $2, finished_us = coalesce($3, snapthrough_now()) WHERE id = $1",
           Parameters().add(id).add(to_string(*after)).add(clock_.at(now))},
          {"DELETE FROM job_leases WHERE job = (SELECT seq FROM jobs WHERE id = $1)", Parameters().add(id)}});
    }
    return dismissal;
  });
}

StatusOr<bool> PostgresqlStore::remove(std::string_view id) {
  return database_.write_at_once<bool>(
      {{"DELETE FROM jobs WHERE id = $1", Parameters().add(id)}}, Durability::synced,
      [](std::span<const Rows> all) -> StatusOr<bool> { return all.front().changed() > 0; });
}

StatusOr<int> PostgresqlStore::retire(std::chrono::seconds age, int most, Time now) {
  static constexpr std::string_view kSql =
      "DELETE FROM jobs WHERE seq IN (SELECT seq FROM jobs WHERE"
      " finished_us < coalesce($1, snapthrough_now()) - $2 ORDER BY finished_us LIMIT $3 FOR UPDATE SKIP "
      "LOCKED)";
  return database_.write_at_once<int>(
      {{kSql, Parameters().add(clock_.at(now)).add(microseconds(age)).add(most)}}, Durability::synced,
      [](std::span<const Rows> all) -> StatusOr<int> { return static_cast<int>(all.front().changed()); });
}

Status PostgresqlStore::forget_keys(std::chrono::seconds age, Time now) {
  return database_.write_at_once(
      {{"DELETE FROM idempotency_keys WHERE created_us < coalesce($1, snapthrough_now()) - $2",
        Parameters().add(clock_.at(now)).add(microseconds(age))}});
}

/// @brief A database that only reads (a standby) says so without a row that is written. After its disk was
/// full there has to be room for a megabyte again: what is small finds some now and then before.
Status PostgresqlStore::probe(Time /*now*/) {
  const StatusOr<bool> writes = database_.read<bool>([](Connection& connection) {
    return connection
        .run("SELECT NOT pg_is_in_recovery() AND current_setting('transaction_read_only') = 'off'")
        .boolean(0, 0);
  });
  if (!writes.ok()) {
    return writes.status();
  }
  if (!*writes) {
    return {StatusCode::unavailable, "the database only reads"};
  }
  if (!database_.is_full()) {
    return {};
  }
  Status room = database_.write_at_once({{"CREATE TEMP TABLE probe ON COMMIT DROP AS"
                                          " SELECT gen_random_uuid()::text FROM generate_series(1, 16384)"}},
                                        Durability::unsynced);
  if (room.ok()) {
    database_.found_room();
  }
  return room;
}

}  // namespace snapthrough::server::postgresql
