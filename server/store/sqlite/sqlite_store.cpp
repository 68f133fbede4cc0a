#include "server/store/sqlite/sqlite_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <system_error>
#include <utility>

#include "api/provenance.h"
#include "server/descriptor.h"
#include "server/store/crashes.h"
#include "server/store/sqlite/list.h"
#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

/// Most pages of the file that one transaction gives back to the file system.
constexpr int kPagesAtOnce = 256;
/// Most such transactions in one call of give_back_space().
constexpr int kShrinksAtOnce = 64;

/// Pages of a database file.
struct Pages {
  std::int64_t all = 0;
  std::int64_t free = 0;  ///< unused ones among them
  std::int64_t size = 0;  ///< bytes of one
};

Pages pages_of(const Connection& connection) {
  const auto number = [&connection](std::string_view pragma) {
    Statement row = connection.prepare(pragma);
    return row.step() ? row.integer(0) : 0;
  };
  return {number("PRAGMA page_count"), number("PRAGMA freelist_count"), number("PRAGMA page_size")};
}

/// Number of the row of a job that is running in the attempt of the claim.
std::optional<std::int64_t> held_job(Connection& connection, const Claim& claim) {
  static const std::string kSql =
      "SELECT seq FROM jobs WHERE id = ? AND attempt = ? AND " + may(JobEvent::requeue);
  Statement row = connection.query(kSql, claim.id, claim.attempt);
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

/// Number of the row of a job that is running in the attempt of the claim, under a lease that has not run
/// out: a job whose lease has run out may have been given up.
std::optional<std::int64_t> leased_job(Connection& connection, const Claim& claim, Time now) {
  static const std::string kSql =
      "SELECT seq FROM jobs WHERE id = ? AND attempt = ? AND lease_until_us >= ? AND " +
      may(JobEvent::finish);
  Statement row = connection.query(kSql, claim.id, claim.attempt, to_row(now));
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

Status lost_claim(const Claim& claim) {
  return {StatusCode::conflict, "job " + claim.id + " is no longer " +
                                    std::string(to_string(JobState::running)) + " in attempt " +
                                    std::to_string(claim.attempt)};
}

void end_job(Connection& connection, std::int64_t job, JobEvent event, Time now) {
  connection.run("UPDATE jobs SET status = ?, finished_us = ? WHERE seq = ?", to_string(state_after(event)),
                 to_row(now), job);
}

/// Ends a job that this program computed, and counts what that took.
void end_computed_job(Connection& connection, std::int64_t job, JobEvent event, const WorkUsage& usage,
                      Time now) {
  connection.run(
      "UPDATE jobs SET status = ?, finished_us = ?, program = ?, cpu_us = ?, peak_bytes = ?,"
      " factorizations = ? WHERE seq = ?",
      to_string(state_after(event)), to_row(now), api::program_text(), usage.cpu_us, usage.peak_bytes,
      usage.factorizations, job);
  static const std::string kAdd =
      "INSERT INTO usage (owner, hour, label, jobs, cpu_us, peak_bytes, factorizations)"
      " SELECT owner, ?, ifnull(label, ''), 1, ?, ?, ? FROM jobs WHERE seq = ? " +
      std::string(kAddUsage);
  connection.run(kAdd, hour_of(now), usage.cpu_us, usage.peak_bytes, usage.factorizations, job);
}

/// Puts a job back at its place in the queue.
void put_back(Connection& connection, std::int64_t job) {
  static const std::string kSql =
      "UPDATE jobs SET " + becomes(JobEvent::requeue) + ", started_us = NULL WHERE seq = ?";
  connection.run(kSql, job);
}

void insert_failure(Connection& connection, std::int64_t job, const JobFailure& failure) {
  connection.run("INSERT INTO failures (job, code, detail, reached) VALUES (?, ?, ?, ?)", job, failure.code,
                 failure.detail, text_or_null(failure.reached));
}

std::optional<Submitted> find_key_in(const Connection& connection, const IdempotencyKey& key,
                                     std::string_view owner) {
  Statement row = connection.query(
      "SELECT idempotency_keys.fingerprint, jobs.id FROM idempotency_keys JOIN jobs ON jobs.seq = job"
      " WHERE idempotency_keys.owner = ? AND idempotency_keys.key = ?",
      owner, key.key);
  return row.step() ? std::optional(known_key(row, key)) : std::nullopt;
}

/// See JobSubmission::find_result().
std::optional<KnownJob> find_result_in(const Connection& connection, std::string_view content_key,
                                       std::string_view owner, const Annotations& annotations) {
  static const std::string kSql =
      "SELECT seq, id, label, metadata, NULL FROM jobs INDEXED BY jobs_by_content WHERE content_key = ?1"
      " AND owner = ?2 AND content_key <> '' AND status = " +
      literal(JobState::successful) + " ORDER BY label IS ?3 AND metadata IS ?4 DESC, seq DESC LIMIT 1";
  Statement row = connection.query(kSql, content_key, owner, text_or_null(annotations.label),
                                   text_or_null(annotations.metadata));
  return row.step() ? std::optional(KnownJob{row.integer(0), row.text(1), row.annotations(2)}) : std::nullopt;
}

/// Inserts a job with its request; returns the number of its row.
std::int64_t insert_job(Connection& connection, const NewJob& job) {
  const std::optional<Lease>& lease = job.lease;
  connection.run(
      "INSERT INTO jobs (id, title, analysis_type, created_us, owner, content_key, status, attempt,"
      " started_us, worker, lease_until_us, label, metadata, callback, crashes, request_sha256)"
      " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      job.id, job.title, job.analysis_type, to_row(job.created), job.owner, job.content_key,
      to_string(lease ? JobState::running : JobState::accepted), job.attempt + (lease ? 1 : 0),
      lease ? std::optional(to_row(job.created)) : std::nullopt,
      lease ? std::optional<std::string_view>(lease->worker) : std::nullopt,
      lease ? std::optional(to_row(lease->until)) : std::nullopt, text_or_null(job.annotations.label),
      text_or_null(job.annotations.metadata), text_or_null(job.annotations.callback), job.crashes,
      text_or_null(job.request_sha256));
  const std::int64_t row = connection.last_row();
  connection.run("INSERT INTO requests (job, document) VALUES (?, ?)", row, job.document);
  return row;
}

/// Inserts a job and makes it successful with a copy of everything that belongs to the result of another job.
void copy_job(Connection& connection, NewJob job, std::int64_t original) {
  static const std::string kBranches = "INSERT INTO branches (job, points, " + std::string(kBranchColumns) +
                                       ") SELECT ?, points, " + kBranchColumns +
                                       " FROM branches WHERE job = ?";
  static const std::string kPoints = "INSERT INTO critical_points (job, number, " +
                                     std::string(kCriticalPointColumns) + ") SELECT ?, number, " +
                                     kCriticalPointColumns + " FROM critical_points WHERE job = ?";
  job.lease = Lease{"", job.created};  // only a running job gets a result
  const std::int64_t row = insert_job(connection, job);
  for (const std::string_view sql :
       {std::string_view("INSERT INTO results SELECT ?, document, critical_load_factor, critical_type,"
                         " termination, wall_time_s FROM results WHERE job = ?"),
        std::string_view("INSERT INTO result_pieces (job, number, bytes) SELECT ?, number, bytes"
                         " FROM result_pieces WHERE job = ?"),
        std::string_view(kBranches),
        std::string_view("INSERT INTO branch_series SELECT ?, branch, kind, number, id, samples"
                         " FROM branch_series WHERE job = ?"),
        std::string_view(kPoints)}) {
    connection.run(sql, row, original);
  }
  connection.run("UPDATE jobs SET program = (SELECT program FROM jobs WHERE seq = ?) WHERE seq = ?", original,
                 row);
  end_job(connection, row, JobEvent::finish, job.created);
}

class SqliteSubmission final : public JobSubmission {
 public:
  SqliteSubmission(Connection& connection, const NewJob& job) : JobSubmission(job), connection_(connection) {}

 private:
  std::optional<Submitted> find_key() override {
    return find_key_in(connection_, *job_.idempotency, job_.owner);
  }
  std::optional<KnownJob> find_result() override {
    return find_result_in(connection_, job_.content_key, job_.owner, job_.annotations);
  }
  Status admit(const Usage& addition) override {
    return sqlite::admit(connection_, job_.owner, job_.quotas, addition, job_.created);
  }
  void insert() override { insert_job(connection_, job_); }
  void insert_copy(const KnownJob& original) override { copy_job(connection_, job_, original.row); }
  void insert_key(const std::string& id) override {
    connection_.run(
        "INSERT INTO idempotency_keys (owner, key, fingerprint, job, created_us)"
        " SELECT ?, ?, ?, seq, ? FROM jobs WHERE id = ?",
        job_.owner, job_.idempotency->key, job_.idempotency->fingerprint, to_row(job_.created), id);
  }

  Connection& connection_;
};

/// Query for the oldest job that fulfils a condition, of the next owner by name after the parameter.
std::string next_of(const std::string& waits) {
  return "SELECT jobs.id, jobs.attempt, requests.document, jobs.created_us, jobs.seq, jobs.owner FROM jobs"
         " JOIN requests ON requests.job = jobs.seq WHERE jobs.seq = (SELECT seq FROM jobs WHERE " +
         waits + " AND owner = coalesce((SELECT min(owner) FROM jobs WHERE " + waits +
         " AND owner > ?1), (SELECT min(owner) FROM jobs WHERE " + waits + ")) ORDER BY seq LIMIT 1)";
}

/// Finds the oldest accepted job of the next owner, by name, after `last` that has one; sets `last`.
std::optional<Claim> next_in_turn(const Connection& connection, const OwnersInTurn& owners, std::string& last,
                                  std::int64_t& row) {
  static const std::string kWaits = may(JobEvent::claim);
  static const std::string kOfAll = next_of(kWaits);
  static const std::string kOfFew =
      next_of(kWaits + " AND owner NOT IN (SELECT value FROM json_each(?3))" +
              " AND owner NOT IN (SELECT owner FROM jobs INDEXED BY jobs_by_lease WHERE " +
              may(JobEvent::requeue) + " GROUP BY owner HAVING count(*) >= ?2)");
  Statement found = owners.most == 0 ? connection.query(kOfAll, last)
                                     : connection.query(kOfFew, last, static_cast<std::int64_t>(owners.most),
                                                        nlohmann::json(owners.except).dump());
  if (!found.step()) {
    return std::nullopt;
  }
  row = found.integer(4);
  last = found.text(5);
  return Claim{found.text(0), found.whole(1) + 1, found.text(2), found.time(3), last};
}

/// A job whose lease has run out.
struct LateJob {
  std::int64_t row = 0;
  std::string id;
  LostLease lost;
};

/// Takes back every running job whose lease ends before `ended_before`; see lost_job().
Recovery take_back(Connection& connection, Time ended_before, std::string_view rescuer, int max_crashes,
                   Time now) {
  static const std::string kSql =
      "SELECT seq, id, crashes, worker FROM jobs INDEXED BY jobs_by_lease WHERE " + may(JobEvent::requeue) +
      " AND lease_until_us < ? ORDER BY seq";
  std::vector<LateJob> jobs;
  Statement late = connection.query(kSql, to_row(ended_before));
  while (late.step()) {
    jobs.push_back(
        {late.integer(0), late.text(1), lost_job(late.text(3), rescuer, late.integer(2), max_crashes)});
  }
  Recovery recovery;
  for (const auto& [row, id, lost] : jobs) {
    if (lost.crashed) {
      connection.run("UPDATE jobs SET crashes = crashes + 1 WHERE seq = ?", row);
    }
    if (lost.given_up) {
      insert_failure(connection, row, {"crashed", crashed_detail(max_crashes, "job"), ""});
      end_job(connection, row, JobEvent::fail, now);
    } else {
      put_back(connection, row);
    }
    (lost.given_up ? recovery.failed : recovery.requeued).push_back(id);
  }
  return recovery;
}

class SqliteStore final : public Store {
 public:
  SqliteStore(Descriptor lock, std::unique_ptr<Connection> writer, const std::string& path)
      : lock_(std::move(lock)),
        database_(std::move(writer), path),
        sweeps_(sweeps_in(database_)),
        deliveries_(deliveries_in(database_)),
        ledger_(ledger_in(database_)) {}

  using Store::submit;
  StatusOr<Submitted> submit(const NewJob& job, const std::function<void()>& queued) override {
    const auto work = [&](Connection& connection) { return SqliteSubmission(connection, job).run(); };
    return database_.write<Submitted>(work, Durability::synced, queued, job.patient);
  }

  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey& key, std::string_view owner) override {
    return database_.read<std::optional<Submitted>>(
        [&](const Connection& connection) { return find_key_in(connection, key, owner); });
  }

  StatusOr<std::vector<UsedKey>> keys(std::string_view id) override {
    return database_.read<std::vector<UsedKey>>([&](const Connection& connection) {
      return used_keys(
          connection.query("SELECT key, fingerprint, idempotency_keys.created_us FROM idempotency_keys"
                           " JOIN jobs ON jobs.seq = job WHERE jobs.id = ? ORDER BY key",
                           id));
    });
  }

  Status add_key(std::string_view id, const UsedKey& used) override {
    return database_.write_only([&](Connection& connection) {
      connection.run(
          "INSERT OR IGNORE INTO idempotency_keys (owner, key, fingerprint, job, created_us)"
          " SELECT owner, ?, ?, seq, ? FROM jobs WHERE id = ?",
          used.key.key, used.key.fingerprint, to_row(used.first_used), id);
      return Status();
    });
  }

  using Store::claim;
  StatusOr<std::optional<Claim>> claim(const Lease& lease, Time now, const OwnersInTurn& owners) override {
    using Outcome = StatusOr<std::optional<Claim>>;
    static const std::string kSql =
        "UPDATE jobs SET " + becomes(JobEvent::claim) +
        ", attempt = ?, started_us = ?, worker = ?, lease_until_us = ? WHERE seq = ?";
    return database_.write<std::optional<Claim>>(
        [&](Connection& connection) -> Outcome {
          std::int64_t row = 0;
          std::optional<Claim> claim = next_in_turn(connection, owners, last_owner_, row);
          if (!claim) {
            return claim;
          }
          connection.run(kSql, claim->attempt, to_row(now), lease.worker, to_row(lease.until), row);
          return claim;
        },
        Durability::unsynced);
  }

  StatusOr<std::vector<std::string>> renew(const std::vector<Claim>& claims, Time until, Time now) override {
    return database_.write<std::vector<std::string>>(
        [&](Connection& connection) -> StatusOr<std::vector<std::string>> {
          std::vector<std::string> lost;
          for (const Claim& claim : claims) {
            const std::optional<std::int64_t> job = leased_job(connection, claim, now);
            if (!job) {
              lost.push_back(claim.id);
              continue;
            }
            connection.run("UPDATE jobs SET lease_until_us = ? WHERE seq = ?", to_row(until), *job);
          }
          return lost;
        },
        Durability::unsynced);
  }

  using Store::finish;
  Status finish(const Claim& claim, const JobResult& result, const WorkUsage& usage, Time now) override {
    return database_.write_only([&](Connection& connection) {
      const std::optional<std::int64_t> job = leased_job(connection, claim, now);
      if (!job) {
        return lost_claim(claim);
      }
      const Summary& summary = result.summary;
      const bool critical = summary.critical_load_factor && summary.critical_type;
      connection.run(
          "INSERT INTO results (job, document, critical_load_factor, critical_type, termination,"
          " wall_time_s) VALUES (?, ?, ?, ?, ?, ?)",
          *job, first_piece(result.document), critical ? summary.critical_load_factor : std::nullopt,
          critical ? std::optional(api::name_of(api::kCriticalTypes, *summary.critical_type)) : std::nullopt,
          summary.termination, result.wall_time_s);
      insert_document_rest(connection, *job, result.document);
      insert_path(connection, *job, result.branches, result.critical_points);
      end_computed_job(connection, *job, JobEvent::finish, usage, now);
      return Status();
    });
  }

  using Store::fail;
  Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached,
              const WorkUsage& usage, Time now) override {
    return database_.write_only([&](Connection& connection) {
      const std::optional<std::int64_t> job = leased_job(connection, claim, now);
      if (!job) {
        return lost_claim(claim);
      }
      insert_failure(connection, *job, failure);
      insert_path(connection, *job, reached.branches, reached.critical_points);
      end_computed_job(connection, *job, JobEvent::fail, usage, now);
      return Status();
    });
  }

  Status requeue(const Claim& claim) override {
    return database_.write_only([&](Connection& connection) {
      const std::optional<std::int64_t> job = held_job(connection, claim);
      if (!job) {
        return lost_claim(claim);
      }
      put_back(connection, *job);
      return Status();
    });
  }

  StatusOr<Recovery> recover(int max_crashes, Time now) override {
    return database_.write<Recovery>([&](Connection& connection) -> StatusOr<Recovery> {
      return take_back(connection, Time::max(), "", max_crashes, now);
    });
  }

  StatusOr<Recovery> rescue(std::string_view worker, int max_crashes, Time now) override {
    return database_.write<Recovery>([&](Connection& connection) -> StatusOr<Recovery> {
      return take_back(connection, now, worker, max_crashes, now);
    });
  }

  StatusOr<Dismissal> dismiss(std::string_view id, Time now) override {
    return database_.write<Dismissal>([&](Connection& connection) -> StatusOr<Dismissal> {
      Statement row = connection.query("SELECT seq, status FROM jobs WHERE id = ?", id);
      if (!row.step()) {
        return Dismissal{};
      }
      const Dismissal dismissal{true, row.state(1)};
      if (const auto after = next_state(dismissal.before, JobEvent::dismiss)) {
        connection.run("UPDATE jobs SET status = ?, finished_us = ? WHERE seq = ?", to_string(*after),
                       to_row(now), row.integer(0));
      }
      return dismissal;
    });
  }

  using Store::remove;
  StatusOr<bool> remove(std::string_view id, std::optional<Time> noted) override {
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      if (noted) {
        connection.run(
            "INSERT INTO audit (owner, at_us, event, sweep, entry)"
            " SELECT owner, ?, 'deleted', 0, id FROM jobs WHERE id = ?",
            to_row(*noted), id);
      }
      connection.run("DELETE FROM jobs WHERE id = ?", id);
      return connection.changes() > 0;
    });
  }

  StatusOr<bool> set_key(std::string_view id, std::string_view sha256) override {
    return database_.write<bool>([&](Connection& connection) -> StatusOr<bool> {
      connection.run("UPDATE jobs SET key_sha256 = ? WHERE id = ?", sha256, id);
      return connection.changes() > 0;
    });
  }

  StatusOr<std::optional<std::string>> owner_by_key(std::string_view id, std::string_view sha256) override {
    return database_.read<std::optional<std::string>>(
        [&](const Connection& connection) -> std::optional<std::string> {
          Statement row =
              connection.query("SELECT owner FROM jobs WHERE id = ? AND key_sha256 = ?", id, sha256);
          return row.step() ? std::optional(row.text(0)) : std::nullopt;
        });
  }

  StatusOr<int> retire(std::chrono::seconds age, int most, Time now) override {
    return database_.write<int>([&](Connection& connection) -> StatusOr<int> {
      connection.run(
          "INSERT INTO audit (owner, at_us, event, sweep, entry) SELECT owner, ?, 'retired', 0, id FROM jobs"
          " WHERE finished_us < ? ORDER BY finished_us LIMIT ?",
          to_row(now), to_row(now - age), most);
      connection.run(
          "DELETE FROM jobs WHERE seq IN (SELECT seq FROM jobs WHERE finished_us < ? ORDER BY finished_us"
          " LIMIT ?)",
          to_row(now - age), most);
      return static_cast<int>(connection.changes());
    });
  }

  Status forget_keys(std::chrono::seconds age, Time now) override {
    return database_.write_only([&](Connection& connection) {
      connection.run("DELETE FROM idempotency_keys WHERE created_us < ?", to_row(now - age));
      return Status();
    });
  }

  Status probe(Time now) override {
    return database_.write_only([&](Connection& connection) {
      connection.run("INSERT OR REPLACE INTO probes (number, at_us) VALUES (1, ?)", to_row(now));
      return Status();
    });
  }

  /// Shrinks a file of which a quarter is unused. Small transactions, since each page that moves takes room
  /// in the write-ahead log first.
  StatusOr<std::uint64_t> give_back_space() override {
    StatusOr<Pages> pages = database_.read<Pages>(pages_of);
    bool shrunk = false;
    for (int i = 0; i < kShrinksAtOnce && pages.ok() && pages->free > pages->all / 4; ++i) {
      const std::int64_t before = pages->all;
      const Status status = database_.write_only(
          [](Connection& connection) {
            connection.execute("PRAGMA incremental_vacuum(" + std::to_string(kPagesAtOnce) + ")");
            return Status();
          },
          Durability::unsynced);
      if (!status.ok()) {
        break;
      }
      pages = database_.read<Pages>(pages_of);
      if (pages.ok() && pages->all == before) {
        break;  // made by a version whose stores do not shrink
      }
      shrunk = true;
    }
    if (shrunk) {
      database_.empty_log_next();
      static_cast<void>(database_.write_only([](Connection&) { return Status(); }, Durability::unsynced));
    }
    return pages.ok() ? StatusOr<std::uint64_t>(static_cast<std::uint64_t>(pages->free * pages->size))
                      : pages.status();
  }

  StatusOr<std::optional<std::string>> find_result(std::string_view content_key,
                                                   std::string_view owner) override {
    return database_.read<std::optional<std::string>>(
        [&](const Connection& connection) -> std::optional<std::string> {
          auto same = find_result_in(connection, content_key, owner, {});
          return same ? std::optional(std::move(same->id)) : std::nullopt;
        });
  }

  StatusOr<std::int64_t> waiting() override {
    return database_.read<std::int64_t>([](const Connection& connection) {
      static const std::string kSql = "SELECT count(*) FROM jobs WHERE " + may(JobEvent::claim);
      Statement row = connection.prepare(kSql);
      row.step();
      return row.integer(0);
    });
  }

  StatusOr<std::optional<Time>> oldest_waiting(Time /*now*/) override {
    return database_.read<std::optional<Time>>([](const Connection& connection) {
      static const std::string kSql = "SELECT min(created_us) FROM jobs WHERE " + may(JobEvent::claim);
      Statement row = connection.prepare(kSql);
      row.step();
      return row.optional_time(0);
    });
  }

  StatusOr<std::vector<std::string>> owners() override {
    return database_.read<std::vector<std::string>>([](const Connection& connection) {
      Statement row = connection.prepare("SELECT owner FROM owners ORDER BY owner");
      std::vector<std::string> all;
      while (row.step()) {
        all.push_back(row.text(0));
      }
      return all;
    });
  }

  StatusOr<std::optional<Job>> get(std::string_view id) override {
    return database_.read<std::optional<Job>>([&](const Connection& connection) -> std::optional<Job> {
      Statement row = connection.query("SELECT " + std::string(kJobColumns) +
                                           ", (SELECT reached FROM failures WHERE failures.job = jobs.seq)"
                                           " FROM jobs WHERE jobs.id = ?",
                                       id);
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

  StatusOr<JobPage> list(const ListQuery& query) override {
    return database_.read<JobPage>([&](const Connection& connection) {
      static const ListedTable kJobs{"jobs", kJobColumns, kJobColumnCount, ""};
      auto [jobs, next] = read_page<Job>(connection, kJobs, query, read_job);
      return JobPage{std::move(jobs), next};
    });
  }

  StatusOr<std::optional<std::string>> request(std::string_view id) override {
    return database_.read<std::optional<std::string>>(
        [&](const Connection& connection) -> std::optional<std::string> {
          Statement row =
              connection.query("SELECT document FROM requests JOIN jobs ON seq = job WHERE id = ?", id);
          return row.step() ? std::optional(row.text(0)) : std::nullopt;
        });
  }

  StatusOr<DocumentPiece> result_piece(std::string_view id, std::size_t offset, std::size_t most) override {
    return database_.read<DocumentPiece>([&](const Connection& connection) -> DocumentPiece {
      Statement row = connection.query("SELECT job FROM results JOIN jobs ON seq = job WHERE id = ?", id);
      return row.step() ? read_document_piece(connection, row.integer(0), offset, most) : DocumentPiece{};
    });
  }

  StatusOr<StoredPath> path(std::string_view id) override {
    return database_.read<StoredPath>([&](const Connection& connection) -> StoredPath {
      Statement row = connection.query("SELECT seq FROM jobs WHERE id = ?", id);
      if (!row.step()) {
        return {};
      }
      return read_path(connection, row.integer(0));
    });
  }

  void write_metrics(std::string& text) const override { database_.write_metrics(text); }
  SweepStore& sweeps() override { return *sweeps_; }
  DeliveryStore& deliveries() override { return *deliveries_; }
  LedgerStore& ledger() override { return *ledger_; }

 private:
  Descriptor lock_;         ///< lock of the file
  std::string last_owner_;  ///< whose job was claimed last; only the writing thread uses it
  Database database_;
  std::unique_ptr<SweepStore> sweeps_;
  std::unique_ptr<DeliveryStore> deliveries_;
  std::unique_ptr<LedgerStore> ledger_;
};

}  // namespace

StatusOr<Descriptor> lock_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (file.get() < 0) {
    return Status(StatusCode::io_error, path + ": " + std::generic_category().message(errno));
  }
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    return Status(StatusCode::unavailable, path + ": the store is in use by another process");
  }
  return file;
}

StatusOr<std::unique_ptr<Store>> open_store(const std::string& path, Time now,
                                            std::span<const Migration> migrations) {
  StatusOr<Descriptor> lock = lock_file(path);
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

}  // namespace snapthrough::server::sqlite
