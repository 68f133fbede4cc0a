#include "server/store/postgresql/rows.h"

#include <zstd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "api/names.h"
#include "api/stored_fields.h"
#include "server/store/known_values.h"

namespace snapthrough::server::postgresql {
namespace {

/// Fast, and a third of the size of a document of numbers.
constexpr int kZstdLevel = 1;

constexpr std::string_view kJobOf = "(SELECT seq FROM jobs WHERE id = $1)";

CriticalType critical_type_in(const Rows& rows, int row, int column) {
  const std::optional<CriticalType> type = api::value_of(api::kCriticalTypes, rows.text(row, column));
  if (!type) {
    throw Error("XX001", "unknown kind of critical point in the store: " + rows.text(row, column));
  }
  return *type;
}

std::optional<int> optional_int(const Rows& rows, int row, int column) {
  return rows.is_null(row, column) ? std::nullopt
                                   : std::optional(static_cast<int>(rows.integer(row, column)));
}

void add_series(std::vector<Statement>& statements, std::string_view job, int branch, const char* kind,
                const std::vector<NamedSeries>& all) {
  static const std::string kSql =
      "INSERT INTO branch_series (job, branch, kind, number, id, samples) VALUES (" + std::string(kJobOf) +
      ", $2, $3, $4, $5, $6)";
  int number = 0;
  for (const NamedSeries& series : all) {
    Parameters row;
    row.add(job).add(branch).add(kind).add(number++).add_bytes(series.id).add_series(series.values);
    statements.push_back({kSql, std::move(row)});
  }
}

Annotations annotations_in(const Rows& rows, int row, int column) {
  return {rows.text(row, column), rows.text(row, column + 1), rows.text(row, column + 2)};
}

/// Fields without a column; none in rows that were stored before there were any.
template <class T>
void read_fields(const Rows& rows, int row, int column, T& object) {
  if (rows.is_null(row, column)) {
    return;
  }
  try {
    api::read_stored_fields(rows.text(row, column), object);
  } catch (const std::runtime_error& error) {
    throw Error("XX001", error.what());
  }
}

Branch read_branch(const Rows& rows, int row) {
  Branch branch;
  branch.id = static_cast<int>(rows.integer(row, 0));
  branch.parent = optional_int(rows, row, 1);
  branch.load_factor = rows.series(row, 2);
  branch.arc_length = rows.series(row, 3);
  for (const double count : rows.series(row, 4)) {
    branch.negative_eigenvalues.push_back(static_cast<int>(count));
  }
  branch.stiffness_ratio = without_nan(rows.series(row, 5), branch.load_factor.size());
  read_fields(rows, row, 6, branch);
  return branch;
}

CriticalPoint read_critical_point(const Rows& rows, int row) {
  CriticalPoint point;
  point.branch = static_cast<int>(rows.integer(row, 0));
  point.type = critical_type_in(rows, row, 1);
  point.load_factor = rows.real(row, 2);
  point.error_estimate = rows.optional_real(row, 3);
  point.arc_length = rows.real(row, 4);
  point.negative_before = static_cast<int>(rows.integer(row, 5));
  point.negative_after = static_cast<int>(rows.integer(row, 6));
  point.multiplicity = static_cast<int>(rows.integer(row, 7));
  point.imperfection = rows.optional_real(row, 8);
  read_fields(rows, row, 9, point);
  return point;
}

}  // namespace

const char* const kJobColumns =
    "jobs.id, jobs.status, jobs.attempt, jobs.crashes, jobs.title, jobs.analysis_type, jobs.created_us,"
    " jobs.started_us, jobs.finished_us, jobs.owner, jobs.label, jobs.metadata, jobs.callback,"
    " (SELECT code FROM failures WHERE failures.job = jobs.seq),"
    " (SELECT detail FROM failures WHERE failures.job = jobs.seq), jobs.content_key";

const char* const kSweepColumns =
    "sweeps.id, sweeps.status, sweeps.owner, sweeps.title, sweeps.points,"
    " (SELECT ARRAY[sum(successful), sum(failed), sum(reused)]::bigint[] FROM sweep_counts"
    " WHERE sweep = sweeps.seq),"
    " sweeps.created_us, sweeps.started_us, sweeps.finished_us, sweeps.analysis_type, sweeps.label,"
    " sweeps.metadata, sweeps.callback";

std::optional<std::int64_t> Clock::at(Time now) const {
  return of_caller_ ? std::optional(std::int64_t{now.time_since_epoch().count()}) : std::nullopt;
}

std::string literal(JobState state) { return "'" + std::string(to_string(state)) + "'"; }

std::int64_t microseconds(std::chrono::microseconds duration) { return duration.count(); }

Time time_in(const Rows& rows, int row, int column) {
  return Time(std::chrono::microseconds(rows.integer(row, column)));
}

std::optional<Time> optional_time_in(const Rows& rows, int row, int column) {
  return rows.is_null(row, column) ? std::nullopt : std::optional(time_in(rows, row, column));
}

JobState state_in(const Rows& rows, int row, int column) {
  const std::optional<JobState> state = job_state_from(rows.text(row, column));
  if (!state) {
    throw Error("XX001", "unknown status in the store: " + rows.text(row, column));
  }
  return *state;
}

std::optional<Submitted> known_key(const Rows& rows, const IdempotencyKey& key) {
  if (rows.empty()) {
    return std::nullopt;
  }
  const bool same = rows.text(0, 0) == key.fingerprint;
  return Submitted{same ? Submitted::Kind::repeated : Submitted::Kind::key_conflict, rows.text(0, 1)};
}

Job read_job(const Rows& rows, int row) {
  Job job;
  job.id = rows.text(row, 0);
  job.state = state_in(rows, row, 1);
  job.attempt = static_cast<int>(rows.integer(row, 2));
  job.crashes = static_cast<int>(rows.integer(row, 3));
  job.title = rows.text(row, 4);
  job.analysis_type = rows.text(row, 5);
  job.created = time_in(rows, row, 6);
  job.started = optional_time_in(rows, row, 7);
  job.finished = optional_time_in(rows, row, 8);
  job.owner = rows.text(row, 9);
  job.annotations = annotations_in(rows, row, 10);
  if (!rows.is_null(row, 13)) {
    job.failure = JobFailure{rows.text(row, 13), rows.text(row, 14), ""};
  }
  job.content_key = rows.text(row, 15);
  return job;
}

SweepRecord read_sweep(const Rows& rows, int row) {
  SweepRecord sweep;
  sweep.id = rows.text(row, 0);
  sweep.state = state_in(rows, row, 1);
  sweep.owner = rows.text(row, 2);
  sweep.title = rows.text(row, 3);
  sweep.points = rows.integer(row, 4);
  const std::vector<std::int64_t> counts = rows.integers(row, 5);
  sweep.successful = counts.at(0);
  sweep.failed = counts.at(1);
  sweep.reused = counts.at(2);
  sweep.created = time_in(rows, row, 6);
  sweep.started = optional_time_in(rows, row, 7);
  sweep.finished = optional_time_in(rows, row, 8);
  sweep.analysis_type = rows.text(row, 9);
  sweep.annotations = annotations_in(rows, row, 10);
  return sweep;
}

void add_path(std::vector<Statement>& statements, std::string_view job, const std::vector<Branch>& branches,
              const std::vector<CriticalPoint>& critical_points) {
  static const std::string kBranch =
      "INSERT INTO branches (job, branch, parent, load_factor, arc_length, negative_eigenvalues,"
      " stiffness_ratio, fields) VALUES (" +
      std::string(kJobOf) + ", $2, $3, $4, $5, $6, $7, $8)";
  static const std::string kPoint =
      "INSERT INTO critical_points (job, number, branch, type, load_factor, error_estimate, arc_length,"
      " negative_before, negative_after, multiplicity, imperfection, fields) VALUES (" +
      std::string(kJobOf) + ", $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12)";
  for (const Branch& branch : branches) {
    const std::vector<double> negative(branch.negative_eigenvalues.begin(),
                                       branch.negative_eigenvalues.end());
    Parameters row;
    row.add(job).add(branch.id).add(branch.parent).add_series(branch.load_factor);
    row.add_series(branch.arc_length).add_series(negative).add_series(with_nan(branch.stiffness_ratio));
    row.add(api::stored_fields(branch));
    statements.push_back({kBranch, std::move(row)});
    add_series(statements, job, branch.id, "monitor", branch.monitors);
    add_series(statements, job, branch.id, "contact_fraction", branch.contact_fraction);
  }
  int number = 0;
  for (const CriticalPoint& point : critical_points) {
    Parameters row;
    row.add(job).add(number++).add(point.branch).add(api::name_of(api::kCriticalTypes, point.type));
    row.add(point.load_factor).add(point.error_estimate).add(point.arc_length).add(point.negative_before);
    row.add(point.negative_after).add(point.multiplicity).add(point.imperfection);
    row.add(api::stored_fields(point));
    statements.push_back({kPoint, std::move(row)});
  }
}

StoredPath read_path(Connection& connection, std::string_view job) {
  const Parameters id = Parameters().add(job);
  const std::vector<Rows> all = connection.run_all(std::vector<Statement>{
      {"SELECT branch, parent, load_factor, arc_length, negative_eigenvalues, stiffness_ratio, fields"
       " FROM branches JOIN jobs ON seq = job WHERE id = $1 ORDER BY branch",
       id},
      {"SELECT branch, kind, branch_series.id, samples FROM branch_series JOIN jobs ON seq = job"
       " WHERE jobs.id = $1 ORDER BY branch, kind, number",
       id},
      {"SELECT branch, type, load_factor, error_estimate, arc_length, negative_before, negative_after,"
       " multiplicity, imperfection, fields FROM critical_points JOIN jobs ON seq = job WHERE id = $1"
       " ORDER BY number",
       id}});
  StoredPath path;
  for (int row = 0; row < all[0].count(); ++row) {
    path.branches.push_back(read_branch(all[0], row));
  }
  for (int row = 0; row < all[1].count(); ++row) {
    const auto branch = std::find_if(path.branches.begin(), path.branches.end(),
                                     [&](const Branch& one) { return one.id == all[1].integer(row, 0); });
    auto& series = all[1].text(row, 1) == "monitor" ? branch->monitors : branch->contact_fraction;
    series.push_back({all[1].text(row, 2), all[1].series(row, 3)});
  }
  for (int row = 0; row < all[2].count(); ++row) {
    path.critical_points.push_back(read_critical_point(all[2], row));
  }
  return path;
}

void add_document(std::vector<Statement>& statements, std::string_view job, const JobResult& result) {
  static const std::string kResult =
      "INSERT INTO results (job, size, packed, critical_load_factor, critical_type, termination, wall_time_s)"
      " VALUES (" +
      std::string(kJobOf) + ", $2, $3, $4, $5, $6, $7)";
  static const std::string kPieceSql =
      "INSERT INTO result_pieces (job, number, bytes) VALUES (" + std::string(kJobOf) + ", $2, $3)";
  const Summary& summary = result.summary;
  const bool critical = summary.critical_load_factor && summary.critical_type;
  const std::string_view document = result.document;
  const bool pack = document.size() > kPiece;
  Parameters row;
  row.add(job).add(static_cast<std::int64_t>(document.size())).add(pack);
  row.add(critical ? summary.critical_load_factor : std::nullopt);
  row.add(critical ? std::optional(api::name_of(api::kCriticalTypes, *summary.critical_type)) : std::nullopt);
  row.add(summary.termination).add(result.wall_time_s);
  statements.push_back({kResult, std::move(row)});
  int number = 0;
  for (std::size_t offset = 0; offset < document.size(); offset += kPiece) {
    const std::string_view piece = document.substr(offset, kPiece);
    Parameters part;
    part.add(job).add(number++).add_bytes(pack ? packed(piece) : std::string(piece));
    statements.push_back({kPieceSql, std::move(part)});
  }
}

std::string packed(std::string_view bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kZstdLevel));
  return frame;
}

std::string unpacked(std::string_view frame) {
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) {
    throw Error("XX001", "packed bytes in the store are damaged");
  }
  std::string bytes(size, '\0');
  if (ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size()) != size) {
    throw Error("XX001", "packed bytes in the store are damaged");
  }
  return bytes;
}

}  // namespace snapthrough::server::postgresql
