/// Jobs in PostgreSQL.

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "api/provenance.h"
#include "server/store/crashes.h"
#include "server/store/postgresql/list.h"
#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

constexpr std::string_view kDropLease =
    "DELETE FROM job_leases WHERE job = (SELECT seq FROM jobs WHERE id = $1)";

/// Puts a job back at its place in the queue.
Statement put_back(std::string_view id) {
  static const std::string kSql =
      "UPDATE jobs SET " + becomes(JobEvent::requeue) + ", started_us = NULL WHERE id = $1";
  return {kSql, Parameters().add(id)};
}

/// Statement that claims a job that fulfils a condition: the oldest of the next owner by name after the first
/// parameter. Jobs that other transactions are about to take are skipped; when no job of that owner is left,
/// a job of any owner, in the order of the index: the oldest of all would be searched among all jobs that are
/// kept.
std::string take_next_of(const std::string& waits) {
  return "WITH turn AS (SELECT coalesce((SELECT min(owner) FROM jobs WHERE " + waits +
         " AND owner > $1), (SELECT min(owner) FROM jobs WHERE " + waits + ")) AS owner)," +
         " mine AS MATERIALIZED (SELECT seq FROM jobs WHERE " + waits +
         " AND owner = (SELECT owner FROM turn) ORDER BY seq LIMIT 1 FOR UPDATE SKIP LOCKED)," +
         " other AS MATERIALIZED (SELECT seq FROM jobs WHERE " + waits +
         " AND NOT EXISTS (SELECT FROM mine) ORDER BY owner, seq LIMIT 1 FOR UPDATE SKIP LOCKED)," +
         " taken AS (UPDATE jobs SET " + becomes(JobEvent::claim) +
         ", attempt = attempt + 1, started_us = coalesce($2, snapthrough_now())"
         "  WHERE seq = (SELECT seq FROM mine UNION ALL SELECT seq FROM other)"
         "  RETURNING seq, id, attempt, created_us, owner, started_us),"
         " leased AS (INSERT INTO job_leases (job, worker, until_us) SELECT seq, $3, started_us + $4 FROM "
         "taken)"
         " SELECT id, attempt, document, started_us - created_us, owner FROM taken JOIN requests ON job = "
         "seq";
}

/// Inserts the job with its request, and with its lease if it has one.
Statement insert_job(const NewJob& job, const Clock& clock) {
  static constexpr std::string_view kSql =
      "WITH job AS (INSERT INTO jobs (id, title, analysis_type, created_us, owner, content_key, status, "
      "label,"
      "  metadata, callback, bytes, attempt, started_us, crashes, request_sha256)"
      " SELECT $1, $2, $3, moment, $5, $6, $7, $8, $9, $10, $11,"
      "  $15 + CASE WHEN $13 IS NOT NULL THEN 1 ELSE 0 END, CASE WHEN $13 IS NOT NULL THEN moment END, $16, "
      "$17"
      " FROM (SELECT coalesce($4, snapthrough_now()) AS moment) AS clock RETURNING seq, started_us),"
      " lease AS (INSERT INTO job_leases (job, worker, until_us)"
      "  SELECT seq, $13, started_us + $14 FROM job WHERE $13 IS NOT NULL)"
      " INSERT INTO requests (job, document) SELECT seq, $12 FROM job";
  const std::optional<Lease>& lease = job.lease;
  const Annotations& notes = job.annotations;
  Parameters row;
  row.add(job.id).add_bytes(job.title).add(job.analysis_type).add(clock.at(job.created)).add(job.owner);
  row.add(job.content_key).add(to_string(lease ? JobState::running : JobState::accepted));
  row.add_bytes_or_null(notes.label).add_bytes_or_null(notes.metadata).add(text_or_null(notes.callback));
  row.add(static_cast<std::int64_t>(job.document.size())).add_bytes(job.document);
  row.add(lease ? std::optional<std::string_view>(lease->worker) : std::nullopt);
  row.add(lease ? microseconds(lease->until - job.created) : std::int64_t{0})
      .add(job.attempt)
      .add(job.crashes)
      .add(text_or_null(job.request_sha256));
  return {kSql, std::move(row)};
}

/// See JobSubmission::find_result().
std::optional<KnownJob> find_result_in(Connection& connection, std::string_view content_key,
                                       std::string_view owner, const Annotations& annotations) {
  static const std::string kSql =
      "SELECT seq, id, label, metadata FROM jobs WHERE content_key = $1 AND content_key <> '' AND owner = $2"
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
  return KnownJob{rows[0].integer(0), rows[0].text(1), {rows[0].text(2), rows[0].text(3), ""}};
}

/// Inserts a job and makes it successful with a copy of everything that belongs to the result of another job.
void copy_job(Connection& connection, const NewJob& job, std::int64_t original, const Clock& clock) {
  static const std::string kNew = "SELECT (SELECT seq FROM jobs WHERE id = $1), ";
  static const std::vector<std::string> kCopies{
      "INSERT INTO results " + kNew +
          "size, packed, critical_load_factor, critical_type, termination, wall_time_s FROM results WHERE "
          "job = $2",
      "INSERT INTO result_pieces " + kNew + "number, bytes FROM result_pieces WHERE job = $2",
      "INSERT INTO branches (job, " + std::string(kBranchColumns) + ") " + kNew + kBranchColumns +
          " FROM branches WHERE job = $2",
      "INSERT INTO branch_series " + kNew +
          "branch, kind, number, id, samples FROM branch_series WHERE job = $2",
      "INSERT INTO critical_points (job, number, " + std::string(kCriticalPointColumns) + ") " + kNew +
          "number, " + kCriticalPointColumns + " FROM critical_points WHERE job = $2",
      "UPDATE jobs SET " + becomes(JobEvent::finish) +
          ", program = (SELECT program FROM jobs WHERE seq = $2), finished_us = started_us, bytes = bytes + "
          "(SELECT size FROM results WHERE job = $2) WHERE id = "
          "$1",
      "DELETE FROM job_leases USING jobs WHERE job = seq AND id = $1 AND $2 <> 0"};
  NewJob running = job;
  running.lease = Lease{"", job.created};  // only a running job gets a result
  std::vector<Statement> statements{insert_job(running, clock)};
  for (const std::string& sql : kCopies) {
    statements.push_back({sql, Parameters().add(job.id).add(original)});
  }
  connection.run_all(statements);
}

constexpr std::string_view kKnownKey =
    "SELECT fingerprint, id FROM idempotency_keys JOIN jobs ON seq = job"
    " WHERE idempotency_keys.owner = $1 AND key = $2";

class PostgresqlSubmission final : public JobSubmission {
 public:
  PostgresqlSubmission(Connection& connection, const NewJob& job, const Clock& clock)
      : JobSubmission(job), connection_(connection), clock_(clock) {}

 private:
  std::optional<Submitted> find_key() override {
    // A second submission with the key waits here, and then finds what the first one did.
    const Parameters key = Parameters().add(job_.owner).add(job_.idempotency->key);
    connection_.run("SELECT pg_advisory_xact_lock(hashtextextended($1 || ' ' || $2, 1))", key);
    return known_key(connection_.run(kKnownKey, key), *job_.idempotency);
  }
  std::optional<KnownJob> find_result() override {
    return find_result_in(connection_, job_.content_key, job_.owner, job_.annotations);
  }
  Status admit(const Usage& addition) override {
    return postgresql::admit(connection_, job_.owner, job_.quotas, addition, clock_.at(job_.created));
  }
  void insert() override {
    const Statement insertion = insert_job(job_, clock_);
    connection_.run(insertion.sql, insertion.parameters);
  }
  void insert_copy(const KnownJob& original) override { copy_job(connection_, job_, original.row, clock_); }
  void insert_key(const std::string& id) override {
    Parameters row;
    row.add(job_.owner).add(job_.idempotency->key).add(job_.idempotency->fingerprint).add(id);
    row.add(clock_.at(job_.created));
    connection_.run(
        "INSERT INTO idempotency_keys (owner, key, fingerprint, job, created_us)"
        " SELECT $1, $2, $3, seq, coalesce($5, snapthrough_now()) FROM jobs WHERE id = $4",
        row);
  }

  Connection& connection_;
  const Clock& clock_;
};

class PostgresqlStore final : public Store {
 public:
  PostgresqlStore(const std::string& location, int connections, Clock clock)
      : database_(location, connections),
        clock_(clock),
        sweeps_(sweeps_in(database_, clock)),
        deliveries_(deliveries_in(database_, clock)),
        ledger_(ledger_in(database_, clock)),
        neighbours_(neighbours_in(database_)) {}

  using Store::submit;
  StatusOr<Submitted> submit(const NewJob& job, const std::function<void()>& queued) override {
    const bool plain = !job.idempotency && !job.reuse && !job.quotas.any();
    StatusOr<Submitted> submitted =
        plain ? submit_only(job) : database_.write<Submitted>([&](Connection& connection) {
          return PostgresqlSubmission(connection, job, clock_).run();
        });
    if (submitted.ok()) {
      queued();  // connections have no order between them: verbs that follow the commit follow this one
    }
    return submitted;
  }

  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) override {
    return database_.read<std::optional<Submitted>>([&](Connection& connection) {
      return known_key(connection.run(kKnownKey, Parameters().add(owner).add(key.key)), key);
    });
  }

  StatusOr<std::vector<UsedKey>> keys(std::string_view id) override {
    return database_.read<std::vector<UsedKey>>([&](Connection& connection) {
      return used_keys(connection.run(
          "SELECT key, fingerprint, idempotency_keys.created_us FROM idempotency_keys JOIN jobs ON seq = job"
          " WHERE id = $1 ORDER BY key COLLATE \"C\"",
          Parameters().add(id)));
    });
  }

  Status add_key(std::string_view id, const UsedKey& used) override {
    return database_.write_at_once(
        {{"INSERT INTO idempotency_keys (owner, key, fingerprint, job, created_us)"
          " SELECT owner, $1, $2, seq, $3 FROM jobs WHERE id = $4 ON CONFLICT DO NOTHING",
          key_parameters(id, used)}});
  }

  using Store::claim;
  StatusOr<std::optional<Claim>> claim(const Lease& lease, Time now, const OwnersInTurn& owners) override {
    static const std::string kWaits = may(JobEvent::claim);
    static const std::string kOfAll = take_next_of(kWaits);
    static const std::string kOfFew = take_next_of(
        kWaits + " AND owner NOT IN (SELECT jsonb_array_elements_text($6::jsonb))" +
        " AND owner NOT IN (SELECT running.owner FROM jobs AS running JOIN job_leases ON job = running.seq"
        " GROUP BY running.owner HAVING count(*) >= $5)");
    std::string last;
    {
      const std::lock_guard guard(turn_mutex_);
      last = last_owner_;
    }
    Parameters wanted;
    wanted.add(last).add(clock_.at(now)).add(lease.worker).add(microseconds(lease.until - now));
    if (owners.most != 0) {
      wanted.add(static_cast<std::int64_t>(owners.most)).add(nlohmann::json(owners.except).dump());
    }
    const auto use = [&](std::span<const Rows> all) -> StatusOr<std::optional<Claim>> {
      const Rows& rows = all.front();
      if (rows.empty()) {
        return std::optional<Claim>();
      }
      const std::lock_guard guard(turn_mutex_);
      last_owner_ = rows[0].text(4);
      const Time created = now - std::chrono::microseconds(rows[0].integer(3));
      return std::optional(
          Claim{rows[0].text(0), rows[0].whole(1), rows[0].text(2), created, rows[0].text(4)});
    };
    return database_.write_at_once<std::optional<Claim>>({{owners.most == 0 ? kOfAll : kOfFew, wanted}},
                                                         Durability::unsynced, use);
  }

  StatusOr<std::vector<std::string>> renew(const std::vector<Claim>& claims, Time until, Time now) override {
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
    // In the order of rows, so that two transactions that renew the same leases do not wait for each other.
    static const std::string kSql =
        "WITH clock AS (SELECT coalesce($3, snapthrough_now()) AS moment),"
        " held AS (SELECT job, jobs.id FROM unnest($1, $2) AS claim (id, attempt)"
        "  JOIN jobs ON jobs.id = claim.id AND jobs.attempt = claim.attempt AND " +
        may(JobEvent::finish) +
        ""
        "  JOIN job_leases ON job = seq AND until_us >= (SELECT moment FROM clock)"
        "  ORDER BY job FOR UPDATE OF job_leases),"
        " renewed AS (UPDATE job_leases SET until_us = (SELECT moment FROM clock) + $4"
        "  WHERE job IN (SELECT job FROM held))"
        " SELECT id FROM unnest($1) AS claimed (id) WHERE id NOT IN (SELECT id FROM held)";
    return database_.write_at_once<std::vector<std::string>>({{kSql, held}}, Durability::unsynced, use);
  }

  using Store::finish;
  Status finish(const Claim& claim, const JobResult& result, const WorkUsage& usage, Time now) override {
    std::vector<Statement> statements;
    add_document(statements, claim.id, result);
    add_path(statements, claim.id, result.branches, result.critical_points);
    return end(claim, JobEvent::finish, std::move(statements),
               static_cast<std::int64_t>(result.document.size()), usage, now);
  }

  using Store::fail;
  Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached,
              const WorkUsage& usage, Time now) override {
    std::vector<Statement> statements{
        {"INSERT INTO failures (job, code, detail, reached)"
         " VALUES ((SELECT seq FROM jobs WHERE id = $1), $2, $3, $4)",
         Parameters()
             .add(claim.id)
             .add(failure.code)
             .add_bytes(failure.detail)
             .add_bytes_or_null(failure.reached)}};
    add_path(statements, claim.id, reached.branches, reached.critical_points);
    return end(claim, JobEvent::fail, std::move(statements),
               static_cast<std::int64_t>(failure.reached.size()), usage, now);
  }

  Status requeue(const Claim& claim) override {
    return database_.write_at_once(
        {{"SELECT held_job($1, $2, NULL)", Parameters().add(claim.id).add(claim.attempt)},
         put_back(claim.id),
         {kDropLease, Parameters().add(claim.id)}});
  }

  StatusOr<Recovery> recover(int /*max_crashes*/, Time /*now*/) override {
    return Recovery{};  // a process that is gone is seen by its leases
  }

  StatusOr<Recovery> rescue(std::string_view worker, int max_crashes, Time now) override {
    static const std::string kGiveUp = "UPDATE jobs SET " + becomes(JobEvent::fail) +
                                       ", finished_us = coalesce($2, snapthrough_now()) WHERE id = $1";
    static constexpr std::string_view kLate =
        "SELECT id, crashes, job_leases.worker FROM job_leases JOIN jobs ON seq = job"
        " WHERE until_us < coalesce($1, snapthrough_now()) ORDER BY seq FOR UPDATE SKIP LOCKED";
    return database_.write<Recovery>([&](Connection& connection) -> StatusOr<Recovery> {
      const Rows late = connection.run(kLate, Parameters().add(clock_.at(now)));
      Recovery recovery;
      std::vector<Statement> statements;
      for (int row = 0; row < late.count(); ++row) {
        const std::string id = late[row].text(0);
        const LostLease lost = lost_job(late[row].text(2), worker, late[row].integer(1), max_crashes);
        const Parameters job = Parameters().add(id);
        statements.push_back({kDropLease, job});
        if (lost.crashed) {
          statements.push_back({"UPDATE jobs SET crashes = crashes + 1 WHERE id = $1", job});
        }
        if (lost.given_up) {
          statements.push_back(
              {"INSERT INTO failures (job, code, detail)"
               " VALUES ((SELECT seq FROM jobs WHERE id = $1), 'crashed', $2)",
               Parameters().add(id).add_bytes(crashed_detail(max_crashes, "job"))});
          statements.push_back({kGiveUp, Parameters().add(id).add(clock_.at(now))});
        } else {
          statements.push_back(put_back(id));
        }
        (lost.given_up ? recovery.failed : recovery.requeued).push_back(id);
      }
      connection.run_all(statements);
      return recovery;
    });
  }

  StatusOr<Dismissal> dismiss(std::string_view id, Time now) override {
    return database_.write<Dismissal>([&](Connection& connection) -> StatusOr<Dismissal> {
      const Rows found =
          connection.run("SELECT status FROM jobs WHERE id = $1 FOR UPDATE", Parameters().add(id));
      if (found.empty()) {
        return Dismissal{};
      }
      const Dismissal dismissal{true, found[0].state(0)};
      if (const auto after = next_state(dismissal.before, JobEvent::dismiss)) {
        connection.run_all(std::vector<Statement>{
            {"UPDATE jobs SET status = $2, finished_us = coalesce($3, snapthrough_now()) WHERE id = $1",
             Parameters().add(id).add(to_string(*after)).add(clock_.at(now))},
            {kDropLease, Parameters().add(id)}});
      }
      return dismissal;
    });
  }

  using Store::remove;
  StatusOr<bool> remove(std::string_view id, std::optional<Time> noted) override {
    static constexpr std::string_view kSql =
        "WITH gone AS (DELETE FROM jobs WHERE id = $1 RETURNING owner, id)"
        " INSERT INTO audit (owner, at_us, event, sweep, entry)"
        " SELECT owner, coalesce($2, snapthrough_now()), 'deleted', false, id FROM gone";
    Statement statement{"DELETE FROM jobs WHERE id = $1", Parameters().add(id)};
    if (noted) {
      statement = {kSql, Parameters().add(id).add(clock_.at(*noted))};
    }
    return database_.write_at_once<bool>(
        {statement}, Durability::synced,
        [](std::span<const Rows> all) -> StatusOr<bool> { return all.front().changed() > 0; });
  }

  StatusOr<bool> set_key(std::string_view id, std::string_view sha256) override {
    return database_.write_at_once<bool>(
        {{"UPDATE jobs SET key_sha256 = $2 WHERE id = $1", Parameters().add(id).add(sha256)}},
        Durability::synced,
        [](std::span<const Rows> all) -> StatusOr<bool> { return all.front().changed() > 0; });
  }

  StatusOr<std::optional<std::string>> owner_by_key(std::string_view id, std::string_view sha256) override {
    return database_.read<std::optional<std::string>>(
        [&](Connection& connection) -> std::optional<std::string> {
          const Rows rows = connection.run("SELECT owner FROM jobs WHERE id = $1 AND key_sha256 = $2",
                                           Parameters().add(id).add(sha256));
          return rows.empty() ? std::nullopt : std::optional(rows[0].text(0));
        });
  }

  StatusOr<int> retire(std::chrono::seconds age, int most, Time now) override {
    static constexpr std::string_view kSql =
        "WITH gone AS (DELETE FROM jobs WHERE seq IN (SELECT seq FROM jobs WHERE"
        " finished_us < coalesce($1, snapthrough_now()) - $2 ORDER BY finished_us LIMIT $3 FOR UPDATE SKIP "
        "LOCKED) RETURNING owner, id)"
        " INSERT INTO audit (owner, at_us, event, sweep, entry)"
        " SELECT owner, coalesce($1, snapthrough_now()), 'retired', false, id FROM gone";
    return database_.write_at_once<int>(
        {{kSql, Parameters().add(clock_.at(now)).add(microseconds(age)).add(most)}}, Durability::synced,
        [](std::span<const Rows> all) -> StatusOr<int> { return static_cast<int>(all.front().changed()); });
  }

  Status forget_keys(std::chrono::seconds age, Time now) override {
    return database_.write_at_once(
        {{"DELETE FROM idempotency_keys WHERE created_us < coalesce($1, snapthrough_now()) - $2",
          Parameters().add(clock_.at(now)).add(microseconds(age))}});
  }

  /// @brief Asks a database whether it is read-only (a standby) without a write. After a full disk it writes
  /// a megabyte: small writes may find room before the disk has any to speak of.
  Status probe(Time /*now*/) override {
    const StatusOr<bool> writes = database_.read<bool>([](Connection& connection) {
      return connection
          .run("SELECT NOT pg_is_in_recovery() AND current_setting('transaction_read_only') = 'off'")[0]
          .boolean(0);
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
    Status room =
        database_.write_at_once({{"CREATE TEMP TABLE probe ON COMMIT DROP AS"
                                  " SELECT gen_random_uuid()::text FROM generate_series(1, 16384)"}},
                                Durability::unsynced);
    if (room.ok()) {
      database_.found_room();
    }
    return room;
  }

  StatusOr<std::optional<std::string>> find_result(std::string_view content_key,
                                                   std::string_view owner) override {
    return database_.read<std::optional<std::string>>(
        [&](Connection& connection) -> std::optional<std::string> {
          auto known = find_result_in(connection, content_key, owner, {});
          return known ? std::optional(std::move(known->id)) : std::nullopt;
        });
  }

  StatusOr<std::int64_t> waiting() override {
    return database_.read<std::int64_t>([](Connection& connection) {
      return connection.run("SELECT count(*) FROM jobs WHERE " + may(JobEvent::claim))[0].integer(0);
    });
  }

  StatusOr<std::optional<Time>> oldest_waiting(Time now) override {
    return database_.read<std::optional<Time>>([&](Connection& connection) -> std::optional<Time> {
      const Rows rows = connection.run(
          "SELECT coalesce($1, snapthrough_now()) - min(created_us) FROM jobs WHERE " + may(JobEvent::claim),
          Parameters().add(clock_.at(now)));
      const std::optional<std::int64_t> age = rows[0].optional_integer(0);
      return age ? std::optional(now - std::chrono::microseconds(*age)) : std::nullopt;
    });
  }

  StatusOr<std::vector<std::string>> owners() override {
    return database_.read<std::vector<std::string>>([](Connection& connection) {
      return connection.run("SELECT DISTINCT owner FROM owner_bytes ORDER BY owner").texts(0);
    });
  }

  StatusOr<std::optional<Job>> get(std::string_view id) override {
    static const std::string kSql = "SELECT " + std::string(kJobColumns) +
                                    ", (SELECT reached FROM failures WHERE failures.job = jobs.seq)"
                                    " FROM jobs WHERE jobs.id = $1";
    return database_.read<std::optional<Job>>([&](Connection& connection) -> std::optional<Job> {
      const Rows rows = connection.run(kSql, Parameters().add(id));
      if (rows.empty()) {
        return std::nullopt;
      }
      Job job = read_job(rows[0]);
      if (job.failure) {
        job.failure->reached = rows[0].text(kJobColumnCount);
      }
      return job;
    });
  }

  StatusOr<JobPage> list(const ListQuery& query) override {
    return database_.read<JobPage>([&](Connection& connection) {
      static const ListedTable kJobs{"jobs", kJobColumns, kJobColumnCount, ""};
      auto [jobs, next] = read_page<Job>(connection, kJobs, query, read_job);
      return JobPage{std::move(jobs), next};
    });
  }

  StatusOr<std::optional<std::string>> request(std::string_view id) override {
    return database_.read<std::optional<std::string>>(
        [&](Connection& connection) -> std::optional<std::string> {
          const Rows rows = connection.run(
              "SELECT document FROM requests JOIN jobs ON seq = job WHERE id = $1", Parameters().add(id));
          return rows.empty() ? std::nullopt : std::optional(rows[0].text(0));
        });
  }

  StatusOr<DocumentPiece> result_piece(std::string_view id, std::size_t offset, std::size_t most) override {
    static constexpr std::string_view kSql =
        "SELECT size, packed, result_pieces.bytes FROM jobs JOIN results ON results.job = seq"
        " LEFT JOIN result_pieces ON result_pieces.job = seq AND number = $2 WHERE id = $1";
    return database_.read<DocumentPiece>([&](Connection& connection) -> DocumentPiece {
      const auto number = static_cast<std::int64_t>(std::min<std::size_t>(offset / kPiece, INT32_MAX));
      const Rows rows = connection.run(kSql, Parameters().add(id).add(number));
      if (rows.empty()) {
        return {};
      }
      DocumentPiece piece{"", static_cast<std::size_t>(rows[0].integer(0))};
      if (!rows[0].is_null(2)) {
        const std::string bytes = rows[0].boolean(1) ? unpacked(rows[0].text(2)) : rows[0].text(2);
        piece.bytes = bytes.substr(std::min(offset % kPiece, bytes.size()), most);
      }
      return piece;
    });
  }

  StatusOr<StoredPath> path(std::string_view id) override {
    return database_.read<StoredPath>([&](Connection& connection) { return read_path(connection, id); });
  }

  void write_metrics(std::string& text) const override { database_.write_metrics(text); }
  SweepStore& sweeps() override { return *sweeps_; }
  DeliveryStore& deliveries() override { return *deliveries_; }
  LedgerStore& ledger() override { return *ledger_; }
  NeighbourStore* neighbours() override { return neighbours_.get(); }
  void hurry() override { database_.hurry(); }

 private:
  /// Stores a job without idempotency key, reuse and quotas in one round trip.
  StatusOr<Submitted> submit_only(const NewJob& job) {
    if (Status status = database_.write_at_once({insert_job(job, clock_)}); !status.ok()) {
      return status;
    }
    return Submitted{Submitted::Kind::created, job.id};
  }

  /// Ends a job under its claim. @param more statements that store its outcome @param bytes size of the
  /// stored documents
  Status end(const Claim& claim, JobEvent event, std::vector<Statement> more, std::int64_t bytes,
             const WorkUsage& usage, Time now) {
    static constexpr std::string_view kFence = "SELECT held_job($1, $2, coalesce($3, snapthrough_now()))";
    static constexpr std::string_view kEnd =
        "UPDATE jobs SET status = $2, finished_us = coalesce($3, snapthrough_now()), bytes = bytes + $4,"
        " program = $5, cpu_us = $6, peak_bytes = $7, factorizations = $8 WHERE id = $1";
    static const std::string kCount =
        "INSERT INTO usage AS sums (owner, hour, label, slot, jobs, cpu_us, peak_bytes, factorizations)"
        " SELECT owner, coalesce($2, snapthrough_now()) / 3600000000, coalesce(label, ''), pg_backend_pid() "
        "% 16,"
        " 1, $3, $4, $5 FROM jobs WHERE id = $1 " +
        std::string(kAddUsage);
    std::vector<Statement> statements{
        {kFence, Parameters().add(claim.id).add(claim.attempt).add(clock_.at(now))}};
    statements.insert(statements.end(), std::make_move_iterator(more.begin()),
                      std::make_move_iterator(more.end()));
    Parameters ended = Parameters().add(claim.id).add(to_string(state_after(event))).add(clock_.at(now));
    ended.add(bytes).add(api::program_text()).add(usage.cpu_us).add(usage.peak_bytes);
    statements.push_back({kEnd, ended.add(usage.factorizations)});
    Parameters used = Parameters().add(claim.id).add(clock_.at(now)).add(usage.cpu_us);
    statements.push_back({kCount, used.add(usage.peak_bytes).add(usage.factorizations)});
    statements.push_back({kDropLease, Parameters().add(claim.id)});
    return database_.write_at_once(std::move(statements));
  }

  Database database_;
  const Clock clock_;
  std::mutex turn_mutex_;
  std::string last_owner_;  ///< whose job was claimed last
  std::unique_ptr<SweepStore> sweeps_;
  std::unique_ptr<DeliveryStore> deliveries_;
  std::unique_ptr<LedgerStore> ledger_;
  std::unique_ptr<NeighbourStore> neighbours_;
};

}  // namespace

std::unique_ptr<Store> jobs_in(const std::string& location, int connections, Clock clock) {
  return std::make_unique<PostgresqlStore>(location, connections, clock);
}

}  // namespace snapthrough::server::postgresql
