#include "server/store/sqlite/sqlite_store.h"

#include <filesystem>
#include <utility>

#include "api/names.h"
#include "server/store/crashes.h"
#include "server/store/sqlite/database.h"
#include "server/store/sqlite/deliveries.h"
#include "server/store/sqlite/file_lock.h"
#include "server/store/sqlite/list.h"
#include "server/store/sqlite/long_document.h"
#include "server/store/sqlite/quotas.h"
#include "server/store/sqlite/rows.h"
#include "server/store/sqlite/sweeps.h"

namespace snapthrough::server::sqlite {
namespace {

class SqliteStore final : public Store {
 public:
  SqliteStore(FileLock lock, std::unique_ptr<Connection> writer, const std::string& path)
      : lock_(std::move(lock)),
        database_(std::move(writer), path),
        sweeps_(database_),
        deliveries_(database_) {}

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

 private:
  FileLock lock_;
  std::string last_owner_;  ///< who had a turn; of the writing thread
  Database database_;
  SqliteSweepStore sweeps_;
  SqliteDeliveryStore deliveries_;
};

const ListedTable kListedJobs{"jobs", kJobColumns, ""};

/// The row number of the claimed job if the claim still holds, i.e. (id, running, attempt) matches.
std::optional<std::int64_t> held_job(Connection& connection, const Claim& claim) {
  static const std::string kSql =
      "SELECT seq FROM jobs WHERE id = ? AND attempt = ? AND status = " + literal(JobState::running);
  Statement row = connection.prepare(kSql);
  row.bind(claim.id).bind(claim.attempt);
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

/// The same, and its lease has not run out: who works past it may have been given up.
std::optional<std::int64_t> leased_job(Connection& connection, const Claim& claim, Time now) {
  static const std::string kSql =
      "SELECT seq FROM jobs WHERE id = ? AND attempt = ? AND lease_until_us >= ? AND status = " +
      literal(JobState::running);
  Statement row = connection.prepare(kSql);
  row.bind(claim.id).bind(claim.attempt).bind(to_row(now));
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

Status lost_claim(const Claim& claim) {
  return {StatusCode::conflict, "job " + claim.id + " is no longer " +
                                    std::string(to_string(JobState::running)) + " in attempt " +
                                    std::to_string(claim.attempt)};
}

void end_job(Connection& connection, std::int64_t job, JobEvent event, Time now) {
  connection.prepare("UPDATE jobs SET status = ?, finished_us = ? WHERE seq = ?")
      .bind(to_string(next_state(JobState::running, event).value()))
      .bind(to_row(now))
      .bind(job)
      .run();
}

/// To its place in the queue.
void put_back(Connection& connection, std::int64_t job) {
  connection.prepare("UPDATE jobs SET status = ?, started_us = NULL WHERE seq = ?")
      .bind(to_string(next_state(JobState::running, JobEvent::requeue).value()))
      .bind(job)
      .run();
}

void insert_failure(Connection& connection, std::int64_t job, const JobFailure& failure) {
  const std::optional<std::string_view> reached =
      failure.reached.empty() ? std::nullopt : std::optional<std::string_view>(failure.reached);
  connection.prepare("INSERT INTO failures (job, code, detail, reached) VALUES (?, ?, ?, ?)")
      .bind(job)
      .bind(failure.code)
      .bind(failure.detail)
      .bind(reached)
      .run();
}

/// What an idempotency key that is known amounts to; empty when it is new.
std::optional<Submitted> known_key(const Connection& connection, const IdempotencyKey& key,
                                   std::string_view owner) {
  Statement row = connection.prepare(
      "SELECT idempotency_keys.fingerprint, jobs.id FROM idempotency_keys JOIN jobs ON jobs.seq = job"
      " WHERE idempotency_keys.owner = ? AND idempotency_keys.key = ?");
  row.bind(owner).bind(key.key);
  return known_key(row, key);
}

void insert_job(Connection& connection, const NewJob& job) {
  const std::optional<Lease>& lease = job.lease;
  connection
      .prepare(
          "INSERT INTO jobs (id, title, analysis_type, created_us, owner, content_key, status, attempt,"
          " started_us, worker, lease_until_us, label, metadata, callback)"
          " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(job.id)
      .bind(job.title)
      .bind(job.analysis_type)
      .bind(to_row(job.created))
      .bind(job.owner)
      .bind(job.content_key)
      .bind(to_string(lease ? JobState::running : JobState::accepted))
      .bind(lease ? 1 : 0)
      .bind(lease ? std::optional(to_row(job.created)) : std::nullopt)
      .bind(lease ? std::optional<std::string_view>(lease->worker) : std::nullopt)
      .bind(lease ? std::optional(to_row(lease->until)) : std::nullopt)
      .bind(text_or_null(job.annotations.label))
      .bind(text_or_null(job.annotations.metadata))
      .bind(text_or_null(job.annotations.callback))
      .run();
}

void insert_key(Connection& connection, const NewJob& job, std::int64_t row) {
  connection
      .prepare(
          "INSERT INTO idempotency_keys (owner, key, fingerprint, job, created_us) VALUES (?, ?, ?, ?, ?)")
      .bind(job.owner)
      .bind(job.idempotency->key)
      .bind(job.idempotency->fingerprint)
      .bind(row)
      .bind(to_row(job.created))
      .run();
}

/// A job whose result will do for another one.
struct KnownJob {
  std::int64_t row = 0;
  std::string id;
  Annotations annotations;  ///< its callback, which was told, left out
};

/// The newest successful job of that content and owner, of those with these annotations if there are any.
std::optional<KnownJob> same_content(const Connection& connection, std::string_view content_key,
                                     std::string_view owner, const Annotations& annotations) {
  static const std::string kSql =
      "SELECT seq, id, label, metadata, NULL FROM jobs INDEXED BY jobs_by_content WHERE content_key = ?1"
      " AND owner = ?2 AND content_key <> '' AND status = " +
      literal(JobState::successful) + " ORDER BY label IS ?3 AND metadata IS ?4 DESC, seq DESC LIMIT 1";
  Statement row = connection.prepare(kSql);
  row.bind(content_key)
      .bind(owner)
      .bind(text_or_null(annotations.label))
      .bind(text_or_null(annotations.metadata));
  return row.step() ? std::optional(KnownJob{row.integer(0), row.text(1), annotations_in(row, 2)})
                    : std::nullopt;
}

/// Inserts a job with its request; its row number.
std::int64_t insert_job_and_request(Connection& connection, const NewJob& job) {
  insert_job(connection, job);
  const std::int64_t row = connection.last_row();
  connection.prepare("INSERT INTO requests (job, document) VALUES (?, ?)").bind(row).bind(job.document).run();
  return row;
}

/// Inserts a job and makes it successful with a copy of everything that another one's success left.
std::int64_t insert_copy(Connection& connection, NewJob job, std::int64_t original) {
  job.lease = Lease{"", job.created};  // a result needs a running job
  const std::int64_t row = insert_job_and_request(connection, job);
  for (const char* sql :
       {"INSERT INTO results SELECT ?, document, critical_load_factor, critical_type, termination,"
        " wall_time_s FROM results WHERE job = ?",
        "INSERT INTO result_pieces (job, number, bytes) SELECT ?, number, bytes FROM result_pieces"
        " WHERE job = ?",
        "INSERT INTO branches SELECT ?, branch, parent, points, load_factor, arc_length,"
        " negative_eigenvalues, stiffness_ratio, fields FROM branches WHERE job = ?",
        "INSERT INTO branch_series SELECT ?, branch, kind, number, id, samples FROM branch_series"
        " WHERE job = ?",
        "INSERT INTO critical_points SELECT ?, number, branch, type, load_factor, error_estimate, arc_length,"
        " negative_before, negative_after, multiplicity, imperfection, fields FROM critical_points WHERE job "
        "= ?"}) {
    connection.prepare(sql).bind(row).bind(original).run();
  }
  end_job(connection, row, JobEvent::finish, job.created);
  return row;
}

StatusOr<Submitted> SqliteStore::submit(const NewJob& job, const std::function<void()>& queued) {
  const auto work = [&](Connection& connection) -> StatusOr<Submitted> {
    if (job.idempotency) {
      if (const std::optional<Submitted> known = known_key(connection, *job.idempotency, job.owner)) {
        return *known;
      }
    }
    const auto known =
        job.reuse ? same_content(connection, job.content_key, job.owner, job.annotations) : std::nullopt;
    // A callback, which the known job does not have, is told of a new job.
    const bool will_do = known && (job.annotations == Annotations{} || job.annotations == known->annotations);
    Submitted submitted{Submitted::Kind::reused, known ? known->id : ""};
    std::int64_t row = known ? known->row : 0;
    if (!will_do) {
      const Usage addition{job.lease || known ? 0 : 1, 0, static_cast<std::int64_t>(job.document.size())};
      if (Status status = admit(connection, job.owner, job.quotas, addition, job.created); !status.ok()) {
        return status;
      }
      submitted = {known ? Submitted::Kind::copied : Submitted::Kind::created, job.id};
      row = known ? insert_copy(connection, job, known->row) : insert_job_and_request(connection, job);
    }
    if (job.idempotency) {
      insert_key(connection, job, row);
    }
    return submitted;
  };
  return database_.write<Submitted>(work, Durability::synced, queued, job.patient);
}

StatusOr<std::optional<Submitted>> SqliteStore::find_key(const IdempotencyKey& key, std::string_view owner) {
  return database_.read<std::optional<Submitted>>(
      [&](const Connection& connection) { return known_key(connection, key, owner); });
}

/// The oldest accepted job of the owner whose turn it is: the next that has one waiting, by name, after
/// `last`.
std::optional<Claim> next_in_turn(const Connection& connection, const std::string& last, std::int64_t& row,
                                  std::string& owner) {
  static const std::string kWaits = " status = " + literal(JobState::accepted);
  static const std::string kSql =
      "SELECT jobs.id, jobs.attempt, requests.document, jobs.created_us, jobs.seq, jobs.owner FROM jobs"
      " JOIN requests ON requests.job = jobs.seq WHERE jobs.seq = (SELECT seq FROM jobs WHERE" +
      kWaits + " AND owner = coalesce((SELECT min(owner) FROM jobs WHERE" + kWaits +
      " AND owner > ?1),"
      " (SELECT min(owner) FROM jobs WHERE" +
      kWaits + ")) ORDER BY seq LIMIT 1)";
  Statement found = connection.prepare(kSql);
  found.bind(last);
  if (!found.step()) {
    return std::nullopt;
  }
  row = found.integer(4);
  owner = found.text(5);
  return Claim{found.text(0), static_cast<int>(found.integer(1)) + 1, found.text(2), time_in(found, 3)};
}

StatusOr<std::optional<Claim>> SqliteStore::claim(const Lease& lease, Time now) {
  using Outcome = StatusOr<std::optional<Claim>>;
  return database_.write<std::optional<Claim>>(
      [&](Connection& connection) -> Outcome {
        std::int64_t row = 0;
        std::optional<Claim> claim = next_in_turn(connection, last_owner_, row, last_owner_);
        if (!claim) {
          return claim;
        }
        connection
            .prepare(
                "UPDATE jobs SET status = ?, attempt = ?, started_us = ?, worker = ?, lease_until_us = ?"
                " WHERE seq = ?")
            .bind(to_string(JobState::running))
            .bind(claim->attempt)
            .bind(to_row(now))
            .bind(lease.worker)
            .bind(to_row(lease.until))
            .bind(row)
            .run();
        return claim;
      },
      Durability::unsynced);
}

StatusOr<std::vector<std::string>> SqliteStore::renew(const std::vector<Claim>& claims, Time until,
                                                      Time now) {
  return database_.write<std::vector<std::string>>(
      [&](Connection& connection) -> StatusOr<std::vector<std::string>> {
        std::vector<std::string> lost;
        for (const Claim& claim : claims) {
          const std::optional<std::int64_t> job = leased_job(connection, claim, now);
          if (!job) {
            lost.push_back(claim.id);
            continue;
          }
          connection.prepare("UPDATE jobs SET lease_until_us = ? WHERE seq = ?")
              .bind(to_row(until))
              .bind(*job)
              .run();
        }
        return lost;
      },
      Durability::unsynced);
}

Status SqliteStore::finish(const Claim& claim, const JobResult& result, Time now) {
  return database_.write_only([&](Connection& connection) {
    const std::optional<std::int64_t> job = leased_job(connection, claim, now);
    if (!job) {
      return lost_claim(claim);
    }
    const Summary& summary = result.summary;
    const bool critical = summary.critical_load_factor && summary.critical_type;
    connection
        .prepare(
            "INSERT INTO results (job, document, critical_load_factor, critical_type, termination,"
            " wall_time_s) VALUES (?, ?, ?, ?, ?, ?)")
        .bind(*job)
        .bind(first_piece(result.document))
        .bind(critical ? summary.critical_load_factor : std::nullopt)
        .bind(critical ? std::optional(api::name_of(api::kCriticalTypes, *summary.critical_type))
                       : std::nullopt)
        .bind(summary.termination)
        .bind(result.wall_time_s)
        .run();
    insert_document_rest(connection, *job, result.document);
    insert_path(connection, *job, result.branches, result.critical_points);
    end_job(connection, *job, JobEvent::finish, now);
    return Status();
  });
}

Status SqliteStore::fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) {
  return database_.write_only([&](Connection& connection) {
    const std::optional<std::int64_t> job = leased_job(connection, claim, now);
    if (!job) {
      return lost_claim(claim);
    }
    insert_failure(connection, *job, failure);
    insert_path(connection, *job, reached.branches, reached.critical_points);
    end_job(connection, *job, JobEvent::fail, now);
    return Status();
  });
}

Status SqliteStore::requeue(const Claim& claim) {
  return database_.write_only([&](Connection& connection) {
    const std::optional<std::int64_t> job = held_job(connection, claim);
    if (!job) {
      return lost_claim(claim);
    }
    put_back(connection, *job);
    return Status();
  });
}

/// A job that is taken back from whoever has it.
struct TakenBack {
  std::int64_t row = 0;
  std::string id;
  bool give_up = false;
};

void take_back(Connection& connection, const TakenBack& job, bool crashed, int max_crashes, Time now) {
  if (crashed) {
    connection.prepare("UPDATE jobs SET crashes = crashes + 1 WHERE seq = ?").bind(job.row).run();
  }
  if (job.give_up) {
    insert_failure(connection, job.row, {"crashed", crashed_detail(max_crashes, "job"), ""});
    return end_job(connection, job.row, JobEvent::fail, now);
  }
  put_back(connection, job.row);
}

/// Takes back every running job whose lease ends before `ended_before`, except that those of `worker` don't
/// count as crashed.
Recovery take_all_back(Connection& connection, Time ended_before, std::string_view worker, int max_crashes,
                       Time now) {
  std::vector<std::pair<TakenBack, bool>> jobs;
  {
    static const std::string kSql =
        "SELECT seq, id, crashes, worker FROM jobs INDEXED BY jobs_by_lease WHERE status = " +
        literal(JobState::running) + " AND lease_until_us < ? ORDER BY seq";
    Statement row = connection.prepare(kSql);
    row.bind(to_row(ended_before));
    while (row.step()) {
      const bool crashed = worker.empty() || row.text(3) != worker;
      const bool give_up = crashed && row.integer(2) + 1 >= max_crashes;
      jobs.push_back({{row.integer(0), row.text(1), give_up}, crashed});
    }
  }
  Recovery recovery;
  for (const auto& [job, crashed] : jobs) {
    take_back(connection, job, crashed, max_crashes, now);
    (job.give_up ? recovery.failed : recovery.requeued).push_back(job.id);
  }
  return recovery;
}

StatusOr<Recovery> SqliteStore::recover(int max_crashes, Time now) {
  return database_.write<Recovery>([&](Connection& connection) -> StatusOr<Recovery> {
    return take_all_back(connection, Time::max(), "", max_crashes, now);
  });
}

StatusOr<Recovery> SqliteStore::rescue(std::string_view worker, int max_crashes, Time now) {
  return database_.write<Recovery>([&](Connection& connection) -> StatusOr<Recovery> {
    return take_all_back(connection, now, worker, max_crashes, now);
  });
}

StatusOr<Dismissal> SqliteStore::dismiss(std::string_view id, Time now) {
  return database_.write<Dismissal>([&](Connection& connection) -> StatusOr<Dismissal> {
    Statement row = connection.prepare("SELECT seq, status FROM jobs WHERE id = ?");
    row.bind(id);
    if (!row.step()) {
      return Dismissal{};
    }
    const Dismissal dismissal{true, state_in(row, 1)};
    if (const auto after = next_state(dismissal.before, JobEvent::dismiss)) {
      connection.prepare("UPDATE jobs SET status = ?, finished_us = ? WHERE seq = ?")
          .bind(to_string(*after))
          .bind(to_row(now))
          .bind(row.integer(0))
          .run();
    }
    return dismissal;
  });
}

StatusOr<bool> SqliteStore::remove(std::string_view id) {
  return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
    connection.prepare("DELETE FROM jobs WHERE id = ?").bind(id).run();
    return connection.changes() > 0;
  });
}

StatusOr<int> SqliteStore::retire(std::chrono::seconds age, int most, Time now) {
  return database_.write<int>([&](Connection& connection) -> StatusOr<int> {
    connection
        .prepare(
            "DELETE FROM jobs WHERE seq IN (SELECT seq FROM jobs WHERE finished_us < ? ORDER BY finished_us"
            " LIMIT ?)")
        .bind(to_row(now - age))
        .bind(most)
        .run();
    return static_cast<int>(connection.changes());
  });
}

Status SqliteStore::forget_keys(std::chrono::seconds age, Time now) {
  return database_.write_only([&](Connection& connection) {
    connection.prepare("DELETE FROM idempotency_keys WHERE created_us < ?").bind(to_row(now - age)).run();
    return Status();
  });
}

Status SqliteStore::probe(Time now) {
  return database_.write_only([&](Connection& connection) {
    connection.prepare("INSERT OR REPLACE INTO probes (number, at_us) VALUES (1, ?)").bind(to_row(now)).run();
    return Status();
  });
}

StatusOr<std::optional<std::string>> SqliteStore::find_result(std::string_view content_key,
                                                              std::string_view owner) {
  return database_.read<std::optional<std::string>>(
      [&](const Connection& connection) -> std::optional<std::string> {
        auto same = same_content(connection, content_key, owner, {});
        return same ? std::optional(std::move(same->id)) : std::nullopt;
      });
}

StatusOr<std::int64_t> SqliteStore::waiting() {
  return database_.read<std::int64_t>([](const Connection& connection) {
    static const std::string kSql = "SELECT count(*) FROM jobs WHERE status = " + literal(JobState::accepted);
    Statement row = connection.prepare(kSql);
    row.step();
    return row.integer(0);
  });
}

StatusOr<std::optional<Time>> SqliteStore::oldest_waiting() {
  return database_.read<std::optional<Time>>([](const Connection& connection) {
    static const std::string kSql =
        "SELECT min(created_us) FROM jobs WHERE status = " + literal(JobState::accepted);
    Statement row = connection.prepare(kSql);
    row.step();
    return optional_time_in(row, 0);
  });
}

StatusOr<std::vector<std::string>> SqliteStore::owners() {
  return database_.read<std::vector<std::string>>([](const Connection& connection) {
    Statement row = connection.prepare("SELECT owner FROM owners ORDER BY owner");
    std::vector<std::string> all;
    while (row.step()) {
      all.push_back(row.text(0));
    }
    return all;
  });
}

StatusOr<std::optional<Job>> SqliteStore::get(std::string_view id) {
  return database_.read<std::optional<Job>>([&](const Connection& connection) -> std::optional<Job> {
    Statement row = connection.prepare("SELECT " + std::string(kJobColumns) +
                                       ", (SELECT reached FROM failures WHERE failures.job = jobs.seq)"
                                       " FROM jobs WHERE jobs.id = ?");
    row.bind(id);
    if (!row.step()) {
      return std::nullopt;
    }
    Job job = read_job(row);
    if (job.failure) {
      job.failure->reached = row.text(kJobColumnCount);
    }
    return job;
  });
}

StatusOr<JobPage> SqliteStore::list(const ListQuery& query) {
  return database_.read<JobPage>([&](const Connection& connection) {
    auto [jobs, next] = read_page<Job>(connection, kListedJobs, kJobColumnCount, query, read_job);
    return JobPage{std::move(jobs), next};
  });
}

StatusOr<std::optional<std::string>> SqliteStore::request(std::string_view id) {
  return database_.read<std::optional<std::string>>(
      [&](const Connection& connection) -> std::optional<std::string> {
        Statement row =
            connection.prepare("SELECT document FROM requests JOIN jobs ON seq = job WHERE id = ?");
        row.bind(id);
        return row.step() ? std::optional(row.text(0)) : std::nullopt;
      });
}

StatusOr<DocumentPiece> SqliteStore::result_piece(std::string_view id, std::size_t offset, std::size_t most) {
  return database_.read<DocumentPiece>([&](const Connection& connection) -> DocumentPiece {
    Statement row = connection.prepare("SELECT job FROM results JOIN jobs ON seq = job WHERE id = ?");
    row.bind(id);
    return row.step() ? read_document_piece(connection, row.integer(0), offset, most) : DocumentPiece{};
  });
}

StatusOr<StoredPath> SqliteStore::path(std::string_view id) {
  return database_.read<StoredPath>([&](const Connection& connection) -> StoredPath {
    Statement row = connection.prepare("SELECT seq FROM jobs WHERE id = ?");
    row.bind(id);
    if (!row.step()) {
      return {};
    }
    const std::int64_t job = row.integer(0);
    return {read_branches(connection, job), read_critical_points(connection, job)};
  });
}

}  // namespace

StatusOr<std::unique_ptr<Store>> open_store(const std::string& path, Time now,
                                            std::span<const Migration> migrations) {
  StatusOr<FileLock> lock = FileLock::acquire(path);
  if (!lock.ok()) {
    return lock.status();
  }
  try {
    auto writer = std::make_unique<Connection>(path, Access::read_write);
    if (const Status status = migrate(*writer, migrations, now); !status.ok()) {
      return Status(status.code(), path + ": " + status.message());
    }
    return std::unique_ptr<Store>(
        std::make_unique<SqliteStore>(std::move(lock).value(), std::move(writer), path));
  } catch (const Error& error) {
    const Status status = to_status(error);
    return Status(status.code(), path + ": " + status.message());
  }
}

namespace {

/// A copy that is not finished, and what SQLite keeps beside it.
void remove_unfinished(const std::string& path) {
  for (const char* ending : {"", "-journal", "-wal", "-shm"}) {
    std::error_code ignored;
    std::filesystem::remove(path + ending, ignored);
  }
}

Status copy_and_check(const std::string& path, const std::string& copy_path, const std::string& target) {
  try {
    Connection(path, Access::read_only).copy_to(copy_path);
    // One that may write removes its -wal and -shm when it is closed.
    const Connection copy(copy_path, Access::read_write);
    Statement check = copy.prepare("PRAGMA integrity_check");
    if (!check.step() || check.text(0) != "ok") {
      return {StatusCode::io_error, target + ": the copy is damaged"};
    }
  } catch (const Error& error) {
    const Status status = to_status(error);
    return {status.code(), path + ": " + status.message()};
  }
  return {};
}

}  // namespace

Status back_up(const std::string& path, const std::string& target) {
  const std::string unfinished = target + ".part";
  remove_unfinished(unfinished);
  Status status = copy_and_check(path, unfinished, target);
  if (status.ok()) {
    status = publish_file(unfinished, target);
  }
  if (!status.ok()) {
    remove_unfinished(unfinished);
  }
  return status;
}

}  // namespace snapthrough::server::sqlite
