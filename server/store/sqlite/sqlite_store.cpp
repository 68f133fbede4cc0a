#include "server/store/sqlite/sqlite_store.h"

#include <sqlite3.h>

#include <mutex>
#include <utility>

#include "server/store/sqlite/connection.h"
#include "server/store/sqlite/file_lock.h"
#include "server/store/sqlite/rows.h"

namespace snapthrough::server::sqlite {
namespace {

Status to_status(const Error& error) {
  switch (error.code() & 0xFF) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_FULL:
    case SQLITE_NOMEM:
      return {StatusCode::unavailable, error.what()};
    case SQLITE_NOTADB:
      return {StatusCode::unsupported, error.what()};
    default:
      return {StatusCode::io_error, error.what()};
  }
}

/// Read-only connections that are not in use; one is opened when none is free.
class ReaderPool {
 public:
  explicit ReaderPool(std::string path) : path_(std::move(path)) {}

  template <class Use>
  auto with(const Use& use) {
    std::unique_ptr<Connection> reader = take();
    auto result = use(*reader);
    const std::lock_guard guard(mutex_);
    idle_.push_back(std::move(reader));  // not after an exception: that connection is dropped
    return result;
  }

 private:
  std::unique_ptr<Connection> take() {
    {
      const std::lock_guard guard(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Connection> reader = std::move(idle_.back());
        idle_.pop_back();
        return reader;
      }
    }
    return std::make_unique<Connection>(path_, Access::read_only);
  }

  std::string path_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Connection>> idle_;
};

class SqliteStore final : public Store {
 public:
  SqliteStore(FileLock lock, std::unique_ptr<Connection> writer, const std::string& path)
      : lock_(std::move(lock)), writer_(std::move(writer)), readers_(path) {}

  Status submit(const NewJob& job) override;
  StatusOr<std::optional<Claim>> claim(Time now) override;
  Status finish(const Claim& claim, const JobResult& result, Time now) override;
  Status fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) override;
  Status requeue(const Claim& claim) override;
  StatusOr<Recovery> recover(int max_crashes, Time now) override;
  StatusOr<std::optional<Job>> get(std::string_view id) override;
  StatusOr<JobPage> list(const JobQuery& query) override;
  StatusOr<std::optional<std::string>> request(std::string_view id) override;
  StatusOr<std::optional<std::string>> result(std::string_view id) override;
  StatusOr<StoredPath> path(std::string_view id) override;

 private:
  /// Runs `work(connection)` in a write transaction; errors become a status.
  template <class T, class Work>
  T write(const Work& work) {
    const std::lock_guard guard(writer_mutex_);
    try {
      Transaction transaction(*writer_);
      T outcome = work(*writer_);
      if (outcome.ok()) {
        transaction.commit();
      }
      return outcome;
    } catch (const Error& error) {
      return to_status(error);
    }
  }

  template <class T, class Work>
  StatusOr<T> read(const Work& work) {
    try {
      return readers_.with([&](const Connection& connection) -> T { return work(connection); });
    } catch (const Error& error) {
      return to_status(error);
    }
  }

  StatusOr<std::optional<std::string>> document(const char* table, std::string_view id);

  FileLock lock_;
  std::mutex writer_mutex_;
  std::unique_ptr<Connection> writer_;
  ReaderPool readers_;
};

/// The row number of the claimed job if the claim still holds, i.e. (id, running, attempt) matches.
std::optional<std::int64_t> held_job(Connection& connection, const Claim& claim) {
  Statement row =
      connection.prepare("SELECT seq FROM jobs WHERE id = ? AND status = 'running' AND attempt = ?");
  row.bind(claim.id).bind(claim.attempt);
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

Status lost_claim(const Claim& claim) {
  return {StatusCode::conflict,
          "job " + claim.id + " is no longer running in attempt " + std::to_string(claim.attempt)};
}

void end_job(Connection& connection, std::int64_t job, JobEvent event, Time now) {
  connection.prepare("UPDATE jobs SET status = ?, finished_us = ? WHERE seq = ?")
      .bind(to_string(next_state(JobState::running, event).value()))
      .bind(to_row(now))
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

Status SqliteStore::submit(const NewJob& job) {
  return write<Status>([&](Connection& connection) {
    connection.prepare("INSERT INTO jobs (id, title, analysis_type, created_us) VALUES (?, ?, ?, ?)")
        .bind(job.id)
        .bind(job.title)
        .bind(job.analysis_type)
        .bind(to_row(job.created))
        .run();
    connection.prepare("INSERT INTO requests (job, document) VALUES (?, ?)")
        .bind(connection.last_row())
        .bind(job.document)
        .run();
    return Status();
  });
}

StatusOr<std::optional<Claim>> SqliteStore::claim(Time now) {
  using Outcome = StatusOr<std::optional<Claim>>;
  return write<Outcome>([&](Connection& connection) -> Outcome {
    Statement row = connection.prepare(
        "SELECT jobs.seq, jobs.id, jobs.attempt, requests.document FROM jobs"
        " JOIN requests ON requests.job = jobs.seq WHERE jobs.status = 'accepted' ORDER BY jobs.seq LIMIT 1");
    if (!row.step()) {
      return std::optional<Claim>();
    }
    Claim claim{row.text(1), static_cast<int>(row.integer(2)) + 1, row.text(3)};
    connection.prepare("UPDATE jobs SET status = 'running', attempt = ?, started_us = ? WHERE seq = ?")
        .bind(claim.attempt)
        .bind(to_row(now))
        .bind(row.integer(0))
        .run();
    return std::optional<Claim>(std::move(claim));
  });
}

Status SqliteStore::finish(const Claim& claim, const JobResult& result, Time now) {
  return write<Status>([&](Connection& connection) {
    const std::optional<std::int64_t> job = held_job(connection, claim);
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
        .bind(result.document)
        .bind(critical ? summary.critical_load_factor : std::nullopt)
        .bind(critical ? std::optional(to_row(*summary.critical_type)) : std::nullopt)
        .bind(summary.termination)
        .bind(result.wall_time_s)
        .run();
    insert_path(connection, *job, result.branches, result.critical_points);
    end_job(connection, *job, JobEvent::finish, now);
    return Status();
  });
}

Status SqliteStore::fail(const Claim& claim, const JobFailure& failure, const StoredPath& reached, Time now) {
  return write<Status>([&](Connection& connection) {
    const std::optional<std::int64_t> job = held_job(connection, claim);
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
  return write<Status>([&](Connection& connection) {
    const std::optional<std::int64_t> job = held_job(connection, claim);
    if (!job) {
      return lost_claim(claim);
    }
    connection.prepare("UPDATE jobs SET status = 'accepted', started_us = NULL WHERE seq = ?")
        .bind(*job)
        .run();
    return Status();
  });
}

StatusOr<Recovery> SqliteStore::recover(int max_crashes, Time now) {
  return write<StatusOr<Recovery>>([&](Connection& connection) -> StatusOr<Recovery> {
    Recovery recovery;
    Statement row =
        connection.prepare("SELECT seq, id, crashes FROM jobs WHERE status = 'running' ORDER BY seq");
    std::vector<std::pair<std::int64_t, std::string>> given_up;
    while (row.step()) {
      const bool give_up = row.integer(2) + 1 >= max_crashes;
      (give_up ? recovery.failed : recovery.requeued).push_back(row.text(1));
      if (give_up) {
        given_up.emplace_back(row.integer(0), row.text(1));
      }
    }
    connection.execute("UPDATE jobs SET crashes = crashes + 1 WHERE status = 'running'");
    for (const auto& [job, id] : given_up) {
      insert_failure(connection, job,
                     {"crashed",
                      "the service died " + std::to_string(max_crashes) +
                          " times while it worked on this job; it is not tried again",
                      ""});
      end_job(connection, job, JobEvent::fail, now);
    }
    connection.execute("UPDATE jobs SET status = 'accepted', started_us = NULL WHERE status = 'running'");
    return recovery;
  });
}

StatusOr<std::optional<Job>> SqliteStore::get(std::string_view id) {
  return read<std::optional<Job>>([&](const Connection& connection) -> std::optional<Job> {
    Statement row = connection.prepare("SELECT " + std::string(kJobColumns) +
                                       ", failures.code, failures.detail, failures.reached FROM jobs"
                                       " LEFT JOIN failures ON failures.job = jobs.seq WHERE jobs.id = ?");
    row.bind(id);
    if (!row.step()) {
      return std::nullopt;
    }
    Job job = read_job(row);
    if (!row.is_null(kJobColumnCount)) {
      job.failure =
          JobFailure{row.text(kJobColumnCount), row.text(kJobColumnCount + 1), row.text(kJobColumnCount + 2)};
    }
    return job;
  });
}

StatusOr<JobPage> SqliteStore::list(const JobQuery& query) {
  return read<JobPage>([&](const Connection& connection) {
    std::string sql = "SELECT " + std::string(kJobColumns) + ", jobs.seq FROM jobs WHERE jobs.seq < ?";
    sql += query.state ? " AND jobs.status = ?" : "";
    sql += " ORDER BY jobs.seq DESC LIMIT ?";
    Statement rows = connection.prepare(sql);
    rows.bind(query.before.value_or(INT64_MAX));
    if (query.state) {
      rows.bind(to_string(*query.state));
    }
    rows.bind(query.limit + 1);  // one more, to see whether another page follows
    JobPage page;
    std::int64_t last = 0;
    while (rows.step()) {
      if (static_cast<int>(page.jobs.size()) == query.limit) {
        page.next = last;
        break;
      }
      page.jobs.push_back(read_job(rows));
      last = rows.integer(kJobColumnCount);
    }
    return page;
  });
}

StatusOr<std::optional<std::string>> SqliteStore::document(const char* table, std::string_view id) {
  return read<std::optional<std::string>>([&](const Connection& connection) -> std::optional<std::string> {
    Statement row = connection.prepare("SELECT document FROM " + std::string(table) +
                                       " JOIN jobs ON jobs.seq = job WHERE jobs.id = ?");
    row.bind(id);
    return row.step() ? std::optional(row.text(0)) : std::nullopt;
  });
}

StatusOr<std::optional<std::string>> SqliteStore::request(std::string_view id) {
  return document("requests", id);
}

StatusOr<std::optional<std::string>> SqliteStore::result(std::string_view id) {
  return document("results", id);
}

StatusOr<StoredPath> SqliteStore::path(std::string_view id) {
  return read<StoredPath>([&](const Connection& connection) -> StoredPath {
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
  StatusOr<FileLock> lock = FileLock::acquire(path + ".lock");
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
