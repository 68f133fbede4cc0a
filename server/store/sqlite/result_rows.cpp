/// Stored parts of a result: document, path, critical points.

#include <algorithm>
#include <utility>

#include "server/store/sqlite/parts.h"

namespace snapthrough::server::sqlite {
namespace {

/// Largest number of bytes in a piece of a document.
constexpr std::size_t kStoredBytes = std::size_t{1} << 20;

void insert_series(Connection& connection, std::int64_t job, int branch, std::string_view kind,
                   const std::vector<NamedSeries>& all) {
  int number = 0;
  for (const NamedSeries& series : all) {
    connection
        .prepare(
            "INSERT INTO branch_series (job, branch, kind, number, id, samples) VALUES (?, ?, ?, ?, ?, ?)")
        .add(job)
        .add(branch)
        .add(kind)
        .add(number++)
        .add(series.id)
        .add_series(series.values)
        .run();
  }
}

void insert_branch(Connection& connection, std::int64_t job, const Branch& branch) {
  static const std::string kSql = "INSERT INTO branches (job, points, " + std::string(kBranchColumns) +
                                  ") VALUES (" + numbered('?', 1, 2 + kBranchColumnCount) + ")";
  Statement row = connection.query(kSql, job, static_cast<std::int64_t>(branch.load_factor.size()));
  add_branch(row, branch);
  row.run();
  insert_series(connection, job, branch.id, "monitor", branch.monitors);
  insert_series(connection, job, branch.id, "contact_fraction", branch.contact_fraction);
}

std::vector<NamedSeries> read_series(const Connection& connection, std::int64_t job, int branch,
                                     std::string_view kind) {
  Statement rows = connection.query(
      "SELECT id, samples FROM branch_series WHERE job = ? AND branch = ? AND kind = ? ORDER BY number", job,
      branch, kind);
  std::vector<NamedSeries> all;
  while (rows.step()) {
    all.push_back({rows.text(0), rows.series(1)});
  }
  return all;
}

}  // namespace

void insert_path(Connection& connection, std::int64_t job, const std::vector<Branch>& branches,
                 const std::vector<CriticalPoint>& critical_points) {
  static const std::string kPoint = "INSERT INTO critical_points (job, number, " +
                                    std::string(kCriticalPointColumns) + ") VALUES (" +
                                    numbered('?', 1, 2 + kCriticalPointColumnCount) + ")";
  for (const Branch& branch : branches) {
    insert_branch(connection, job, branch);
  }
  int number = 0;
  for (const CriticalPoint& point : critical_points) {
    Statement row = connection.query(kPoint, job, number++);
    add_critical_point(row, point);
    row.run();
  }
}

StoredPath read_path(const Connection& connection, std::int64_t job) {
  static const std::string kBranches =
      "SELECT " + std::string(kBranchColumns) + " FROM branches WHERE job = ? ORDER BY branch";
  static const std::string kPoints =
      "SELECT " + std::string(kCriticalPointColumns) + " FROM critical_points WHERE job = ? ORDER BY number";
  StoredPath path;
  Statement branches = connection.query(kBranches, job);
  while (branches.step()) {
    Branch& branch = path.branches.emplace_back(read_branch(branches));
    branch.monitors = read_series(connection, job, branch.id, "monitor");
    branch.contact_fraction = read_series(connection, job, branch.id, "contact_fraction");
  }
  Statement points = connection.query(kPoints, job);
  while (points.step()) {
    path.critical_points.push_back(read_critical_point(points));
  }
  return path;
}

std::string_view first_piece(std::string_view document) {
  std::size_t end = std::min(kStoredBytes, document.size());
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (end < document.size() && end > 0 && continues(document[end])) {
    --end;  // a piece that is stored as text ends with a whole character
  }
  return document.substr(0, end);
}

void insert_document_rest(Connection& connection, std::int64_t job, std::string_view document) {
  std::string_view rest = document.substr(first_piece(document).size());
  for (std::int64_t number = 0; !rest.empty(); ++number) {
    const std::string_view bytes = rest.substr(0, kStoredBytes);
    connection.prepare("INSERT INTO result_pieces (job, number, bytes) VALUES (?, ?, ?)")
        .add(job)
        .add(number)
        .add_blob(bytes)
        .run();
    rest.remove_prefix(bytes.size());
  }
}

DocumentPiece read_document_piece(const Connection& connection, std::int64_t job, std::size_t offset,
                                  std::size_t most) {
  DocumentPiece piece;
  std::size_t first = 0;
  piece.bytes = connection.part("results", "document", job, offset, most, first);
  Statement rest = connection.query("SELECT sum(length(bytes)) FROM result_pieces WHERE job = ?", job);
  rest.step();
  piece.size = first + static_cast<std::size_t>(rest.integer(0));
  if (offset < first || offset >= piece.size) {
    return piece;
  }
  const std::size_t beyond = offset - first;
  Statement row = connection.query("SELECT seq FROM result_pieces WHERE job = ? AND number = ?", job,
                                   static_cast<std::int64_t>(beyond / kStoredBytes));
  row.step();
  std::size_t size = 0;
  piece.bytes = connection.part("result_pieces", "bytes", row.integer(0), beyond % kStoredBytes, most, size);
  return piece;
}

}  // namespace snapthrough::server::sqlite
