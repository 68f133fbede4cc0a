#include "server/store/driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace snapthrough::server {

const char* const kJobColumns =
    "jobs.id, jobs.status, jobs.attempt, jobs.crashes, jobs.title, jobs.analysis_type, jobs.created_us,"
    " jobs.started_us, jobs.finished_us, jobs.owner, jobs.label, jobs.metadata, jobs.callback,"
    " (SELECT code FROM failures WHERE failures.job = jobs.seq),"
    " (SELECT detail FROM failures WHERE failures.job = jobs.seq), jobs.content_key, jobs.request_sha256,"
    " jobs.program, jobs.cpu_us, jobs.peak_bytes, jobs.factorizations";

const char* const kSweepColumns =
    "sweeps.id, sweeps.status, sweeps.owner, sweeps.title, sweeps.points, sweeps.created_us,"
    " sweeps.started_us, sweeps.finished_us, sweeps.analysis_type, sweeps.label, sweeps.metadata,"
    " sweeps.callback, sweeps.request_sha256";

const char* const kBranchColumns =
    "branch, parent, load_factor, arc_length, negative_eigenvalues, stiffness_ratio, fields";

const char* const kCriticalPointColumns =
    "branch, type, load_factor, error_estimate, arc_length, negative_before, negative_after, multiplicity,"
    " imperfection, fields";

namespace {

/// Inverse of with_nan(). @param count length of the series; a series that was not stored has no known values
std::vector<std::optional<double>> without_nan(std::span<const double> values, std::size_t count) {
  std::vector<std::optional<double>> known(count);
  for (std::size_t i = 0; i < count && i < values.size(); ++i) {
    if (!std::isnan(values[i])) {
      known[i] = values[i];
    }
  }
  return known;
}

/// Reads the fields without a column of their own; rows of earlier versions have none.
template <class T>
void read_fields(const Row& row, int column, T& object) {
  if (row.is_null(column)) {
    return;
  }
  try {
    api::read_stored_fields(row.text(column), object);
  } catch (const std::runtime_error& error) {
    row.refuse(error.what());
  }
}

}  // namespace

std::string literal(JobState state) { return "'" + std::string(to_string(state)) + "'"; }

std::string status_in(std::span<const JobState> states) {
  if (states.size() == 1) {
    return "status = " + literal(states.front());
  }
  std::string list;
  for (const JobState state : states) {
    list += (list.empty() ? "" : ", ") + literal(state);
  }
  return "status IN (" + list + ")";
}

std::string numbered(char mark, int first, int count) {
  std::string list;
  for (int number = first; number < first + count; ++number) {
    list += (list.empty() ? "" : ", ") + std::string(1, mark) + std::to_string(number);
  }
  return list;
}

std::optional<std::int64_t> Row::optional_integer(int column) const {
  return is_null(column) ? std::nullopt : std::optional(integer(column));
}

std::optional<double> Row::optional_real(int column) const {
  return is_null(column) ? std::nullopt : std::optional(real(column));
}

Time Row::time(int column) const { return Time(std::chrono::microseconds(integer(column))); }

std::optional<Time> Row::optional_time(int column) const {
  return is_null(column) ? std::nullopt : std::optional(time(column));
}

JobState Row::state(int column) const {
  const std::optional<JobState> state = job_state_from(text(column));
  if (!state) {
    refuse("unknown status in the store: " + text(column));
  }
  return *state;
}

Annotations Row::annotations(int column) const { return {text(column), text(column + 1), text(column + 2)}; }

Job read_job(const Row& row) {
  Job job;
  job.id = row.text(0);
  job.state = row.state(1);
  job.attempt = row.whole(2);
  job.crashes = row.whole(3);
  job.title = row.text(4);
  job.analysis_type = row.text(5);
  job.created = row.time(6);
  job.started = row.optional_time(7);
  job.finished = row.optional_time(8);
  job.owner = row.text(9);
  job.annotations = row.annotations(10);
  if (!row.is_null(13)) {
    job.failure = JobFailure{row.text(13), row.text(14), ""};
  }
  job.content_key = row.text(15);
  job.request_sha256 = row.text(16);
  job.program = row.text(17);
  job.usage = read_work_usage(row, 18);
  return job;
}

std::optional<WorkUsage> read_work_usage(const Row& row, int column) {
  return row.is_null(column) ? std::nullopt
                             : std::optional(WorkUsage{row.integer(column), row.integer(column + 1),
                                                       row.integer(column + 2)});
}

SweepRecord read_sweep(const Row& row) {
  SweepRecord sweep;
  sweep.id = row.text(0);
  sweep.state = row.state(1);
  sweep.owner = row.text(2);
  sweep.title = row.text(3);
  sweep.points = row.integer(4);
  sweep.created = row.time(5);
  sweep.started = row.optional_time(6);
  sweep.finished = row.optional_time(7);
  sweep.analysis_type = row.text(8);
  sweep.annotations = row.annotations(9);
  sweep.request_sha256 = row.text(12);
  return sweep;
}

Submitted known_key(const Row& row, const IdempotencyKey& key) {
  const bool same = row.text(0) == key.fingerprint;
  return {same ? Submitted::Kind::repeated : Submitted::Kind::key_conflict, row.text(1)};
}

UsedKey read_used_key(const Row& row) { return {{row.text(0), row.text(1)}, row.time(2)}; }

Branch read_branch(const Row& row) {
  Branch branch;
  branch.id = row.whole(0);
  branch.parent = row.is_null(1) ? std::nullopt : std::optional(row.whole(1));
  branch.load_factor = row.series(2);
  branch.arc_length = row.series(3);
  for (const double count : row.series(4)) {
    branch.negative_eigenvalues.push_back(static_cast<int>(count));
  }
  branch.stiffness_ratio = without_nan(row.series(5), branch.load_factor.size());
  read_fields(row, 6, branch);
  return branch;
}

CriticalPoint read_critical_point(const Row& row) {
  const std::optional<CriticalType> type = api::value_of(api::kCriticalTypes, row.text(1));
  if (!type) {
    row.refuse("unknown kind of critical point in the store: " + row.text(1));
  }
  CriticalPoint point;
  point.branch = row.whole(0);
  point.type = *type;
  point.load_factor = row.real(2);
  point.error_estimate = row.optional_real(3);
  point.arc_length = row.real(4);
  point.negative_before = row.whole(5);
  point.negative_after = row.whole(6);
  point.multiplicity = row.whole(7);
  point.imperfection = row.optional_real(8);
  read_fields(row, 9, point);
  return point;
}

std::vector<double> with_nan(std::span<const std::optional<double>> values) {
  std::vector<double> all;
  all.reserve(values.size());
  for (const std::optional<double>& value : values) {
    all.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return all;
}

ListBounds bounds_of(const ListQuery& query) {
  using Place = std::pair<std::int64_t, std::int64_t>;
  const Place last =
      query.before ? Place(to_row(query.before->created), query.before->number) : Place(INT64_MAX, INT64_MAX);
  return {query.created_after ? to_row(*query.created_after) : INT64_MIN,
          query.created_before ? std::min(last, Place(to_row(*query.created_before), INT64_MIN)) : last};
}

Status check_applied(const Row& row, std::size_t applied, std::span<const Migration> known) {
  const std::string name = row.text(1);
  if (applied >= known.size()) {
    return {StatusCode::unsupported,
            "the store was written by a newer version of the program: it has schema step " + name +
                ", this program knows " + std::to_string(known.size()) + " steps"};
  }
  if (row.integer(0) != known[applied].version || row.text(2) != known[applied].checksum) {
    return {StatusCode::unsupported, "the store's schema step " + name +
                                         " differs from this program's step " +
                                         std::string(known[applied].name)};
  }
  return {};
}

}  // namespace snapthrough::server
