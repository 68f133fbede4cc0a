/// Stored parts of a result: document, path, critical points.

#include <zstd.h>

#include <algorithm>
#include <utility>

#include "server/store/postgresql/parts.h"

namespace snapthrough::server::postgresql {
namespace {

/// Level of compression: fast; a document of numbers shrinks to a third.
constexpr int kZstdLevel = 1;

constexpr std::string_view kJobOf = "(SELECT seq FROM jobs WHERE id = $1)";

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

}  // namespace

void add_path(std::vector<Statement>& statements, std::string_view job, const std::vector<Branch>& branches,
              const std::vector<CriticalPoint>& critical_points) {
  static const std::string kBranch = "INSERT INTO branches (job, " + std::string(kBranchColumns) +
                                     ") VALUES (" + std::string(kJobOf) + ", " +
                                     numbered('$', 2, kBranchColumnCount) + ")";
  static const std::string kPoint = "INSERT INTO critical_points (job, number, " +
                                    std::string(kCriticalPointColumns) + ") VALUES (" + std::string(kJobOf) +
                                    ", " + numbered('$', 2, 1 + kCriticalPointColumnCount) + ")";
  for (const Branch& branch : branches) {
    Parameters row = Parameters().add(job);
    add_branch(row, branch);
    statements.push_back({kBranch, std::move(row)});
    add_series(statements, job, branch.id, "monitor", branch.monitors);
    add_series(statements, job, branch.id, "contact_fraction", branch.contact_fraction);
  }
  int number = 0;
  for (const CriticalPoint& point : critical_points) {
    Parameters row = Parameters().add(job).add(number++);
    add_critical_point(row, point);
    statements.push_back({kPoint, std::move(row)});
  }
}

StoredPath read_path(Connection& connection, std::string_view job) {
  static const std::string kBranches = "SELECT " + std::string(kBranchColumns) +
                                       " FROM branches JOIN jobs ON seq = job WHERE id = $1 ORDER BY branch";
  static constexpr std::string_view kSeries =
      "SELECT branch, kind, branch_series.id, samples FROM branch_series JOIN jobs ON seq = job"
      " WHERE jobs.id = $1 ORDER BY branch, kind, number";
  static const std::string kPoints =
      "SELECT " + std::string(kCriticalPointColumns) +
      " FROM critical_points JOIN jobs ON seq = job WHERE id = $1 ORDER BY number";
  const Parameters id = Parameters().add(job);
  const std::vector<Rows> all =
      connection.run_all(std::vector<Statement>{{kBranches, id}, {kSeries, id}, {kPoints, id}});
  StoredPath path;
  for (int row = 0; row < all[0].count(); ++row) {
    path.branches.push_back(read_branch(all[0][row]));
  }
  for (int row = 0; row < all[1].count(); ++row) {
    const ResultRow series = all[1][row];
    const auto branch = std::find_if(path.branches.begin(), path.branches.end(),
                                     [&](const Branch& one) { return one.id == series.integer(0); });
    auto& list = series.text(1) == "monitor" ? branch->monitors : branch->contact_fraction;
    list.push_back({series.text(2), series.series(3)});
  }
  for (int row = 0; row < all[2].count(); ++row) {
    path.critical_points.push_back(read_critical_point(all[2][row]));
  }
  return path;
}

/// Bytes of the longest document that is stored as it is. PostgreSQL would pack longer ones itself, in its
/// process and some ten times slower.
constexpr std::size_t kLongestPlain = 2000;

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
  const bool pack = document.size() > kLongestPlain;
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
