#include "server/store/sqlite/rows.h"

#include <stdexcept>
#include <utility>

#include "api/names.h"
#include "api/stored_fields.h"
#include "server/store/known_values.h"

namespace snapthrough::server::sqlite {
namespace {

CriticalType critical_type_in(const Statement& row, int column) {
  const std::optional<CriticalType> type = api::value_of(api::kCriticalTypes, row.text(column));
  if (!type) {
    throw Error(0, "unknown kind of critical point in the store: " + row.text(column));
  }
  return *type;
}

std::optional<int> optional_int(const Statement& row, int column) {
  return row.is_null(column) ? std::nullopt : std::optional(static_cast<int>(row.integer(column)));
}

void insert_series(Connection& connection, std::int64_t job, int branch, std::string_view kind,
                   const std::vector<NamedSeries>& all) {
  int number = 0;
  for (const NamedSeries& series : all) {
    connection
        .prepare(
            "INSERT INTO branch_series (job, branch, kind, number, id, samples) VALUES (?, ?, ?, ?, ?, ?)")
        .bind(job)
        .bind(branch)
        .bind(kind)
        .bind(number++)
        .bind(series.id)
        .bind_series(series.values)
        .run();
  }
}

void insert_branch(Connection& connection, std::int64_t job, const Branch& branch) {
  const std::vector<double> negative(branch.negative_eigenvalues.begin(), branch.negative_eigenvalues.end());
  connection
      .prepare(
          "INSERT INTO branches (job, branch, parent, points, load_factor, arc_length, negative_eigenvalues,"
          " stiffness_ratio, fields) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(job)
      .bind(branch.id)
      .bind(branch.parent)
      .bind(static_cast<std::int64_t>(branch.load_factor.size()))
      .bind_series(branch.load_factor)
      .bind_series(branch.arc_length)
      .bind_series(negative)
      .bind_series(with_nan(branch.stiffness_ratio))
      .bind(api::stored_fields(branch))
      .run();
  insert_series(connection, job, branch.id, "monitor", branch.monitors);
  insert_series(connection, job, branch.id, "contact_fraction", branch.contact_fraction);
}

void insert_critical_point(Connection& connection, std::int64_t job, int number, const CriticalPoint& point) {
  connection
      .prepare(
          "INSERT INTO critical_points (job, number, branch, type, load_factor, error_estimate, arc_length,"
          " negative_before, negative_after, multiplicity, imperfection, fields)"
          " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(job)
      .bind(number)
      .bind(point.branch)
      .bind(api::name_of(api::kCriticalTypes, point.type))
      .bind(point.load_factor)
      .bind(point.error_estimate)
      .bind(point.arc_length)
      .bind(point.negative_before)
      .bind(point.negative_after)
      .bind(point.multiplicity)
      .bind(point.imperfection)
      .bind(api::stored_fields(point))
      .run();
}

/// Fields without a column; none in rows that were stored before there were any.
template <class T>
void read_fields(const Statement& row, int column, T& object) {
  if (row.is_null(column)) {
    return;
  }
  try {
    api::read_stored_fields(row.text(column), object);
  } catch (const std::runtime_error& error) {
    throw Error(0, error.what());
  }
}

std::vector<NamedSeries> read_series(const Connection& connection, std::int64_t job, int branch,
                                     std::string_view kind) {
  Statement rows = connection.prepare(
      "SELECT id, samples FROM branch_series WHERE job = ? AND branch = ? AND kind = ? ORDER BY number");
  rows.bind(job).bind(branch).bind(kind);
  std::vector<NamedSeries> all;
  while (rows.step()) {
    all.push_back({rows.text(0), rows.series(1)});
  }
  return all;
}

}  // namespace

const char* const kJobColumns =
    "jobs.id, jobs.status, jobs.attempt, jobs.crashes, jobs.title, jobs.analysis_type, jobs.created_us,"
    " jobs.started_us, jobs.finished_us, jobs.owner, jobs.label, jobs.metadata, jobs.callback,"
    " (SELECT code FROM failures WHERE failures.job = jobs.seq),"
    " (SELECT detail FROM failures WHERE failures.job = jobs.seq), jobs.content_key";

std::int64_t to_row(Time time) { return time.time_since_epoch().count(); }

Time time_in(const Statement& row, int column) {
  return Time(std::chrono::microseconds(row.integer(column)));
}

std::optional<Time> optional_time_in(const Statement& row, int column) {
  return row.is_null(column) ? std::nullopt : std::optional(time_in(row, column));
}

JobState state_in(const Statement& row, int column) {
  const std::optional<JobState> state = job_state_from(row.text(column));
  if (!state) {
    throw Error(0, "unknown status in the store: " + row.text(column));
  }
  return *state;
}

std::string literal(JobState state) { return "'" + std::string(to_string(state)) + "'"; }

const std::string& unfinished_condition() {
  static const std::string kCondition =
      "status IN (" + literal(JobState::accepted) + ", " + literal(JobState::running) + ")";
  return kCondition;
}

Annotations annotations_in(const Statement& row, int column) {
  return {row.text(column), row.text(column + 1), row.text(column + 2)};
}

std::optional<std::string_view> text_or_null(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<Submitted> known_key(Statement& row, const IdempotencyKey& key) {
  if (!row.step()) {
    return std::nullopt;
  }
  const bool same = row.text(0) == key.fingerprint;
  return Submitted{same ? Submitted::Kind::repeated : Submitted::Kind::key_conflict, row.text(1)};
}

Job read_job(const Statement& row) {
  Job job;
  job.id = row.text(0);
  job.state = state_in(row, 1);
  job.attempt = static_cast<int>(row.integer(2));
  job.crashes = static_cast<int>(row.integer(3));
  job.title = row.text(4);
  job.analysis_type = row.text(5);
  job.created = time_in(row, 6);
  job.started = optional_time_in(row, 7);
  job.finished = optional_time_in(row, 8);
  job.owner = row.text(9);
  job.annotations = annotations_in(row, 10);
  if (!row.is_null(13)) {
    job.failure = JobFailure{row.text(13), row.text(14), ""};
  }
  job.content_key = row.text(15);
  return job;
}

void insert_path(Connection& connection, std::int64_t job, const std::vector<Branch>& branches,
                 const std::vector<CriticalPoint>& critical_points) {
  for (const Branch& branch : branches) {
    insert_branch(connection, job, branch);
  }
  int number = 0;
  for (const CriticalPoint& point : critical_points) {
    insert_critical_point(connection, job, number++, point);
  }
}

std::vector<Branch> read_branches(const Connection& connection, std::int64_t job) {
  Statement rows = connection.prepare(
      "SELECT branch, parent, load_factor, arc_length, negative_eigenvalues, stiffness_ratio, fields"
      " FROM branches WHERE job = ? ORDER BY branch");
  rows.bind(job);
  std::vector<Branch> branches;
  while (rows.step()) {
    Branch branch;
    branch.id = static_cast<int>(rows.integer(0));
    branch.parent = optional_int(rows, 1);
    branch.load_factor = rows.series(2);
    branch.arc_length = rows.series(3);
    for (const double count : rows.series(4)) {
      branch.negative_eigenvalues.push_back(static_cast<int>(count));
    }
    branch.stiffness_ratio = without_nan(rows.series(5), branch.load_factor.size());
    read_fields(rows, 6, branch);
    branch.monitors = read_series(connection, job, branch.id, "monitor");
    branch.contact_fraction = read_series(connection, job, branch.id, "contact_fraction");
    branches.push_back(std::move(branch));
  }
  return branches;
}

std::vector<CriticalPoint> read_critical_points(const Connection& connection, std::int64_t job) {
  Statement rows = connection.prepare(
      "SELECT branch, type, load_factor, error_estimate, arc_length, negative_before, negative_after,"
      " multiplicity, imperfection, fields FROM critical_points WHERE job = ? ORDER BY number");
  rows.bind(job);
  std::vector<CriticalPoint> points;
  while (rows.step()) {
    CriticalPoint point;
    point.branch = static_cast<int>(rows.integer(0));
    point.type = critical_type_in(rows, 1);
    point.load_factor = rows.real(2);
    point.error_estimate = rows.optional_real(3);
    point.arc_length = rows.real(4);
    point.negative_before = static_cast<int>(rows.integer(5));
    point.negative_after = static_cast<int>(rows.integer(6));
    point.multiplicity = static_cast<int>(rows.integer(7));
    point.imperfection = rows.optional_real(8);
    read_fields(rows, 9, point);
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace snapthrough::server::sqlite
