/// What is known of jobs: verbs that read.

#include <algorithm>
#include <utility>

#include "server/store/postgresql/jobs.h"
#include "server/store/postgresql/list.h"

namespace snapthrough::server::postgresql {

StatusOr<std::optional<std::string>> PostgresqlStore::find_result(std::string_view content_key,
                                                                  std::string_view owner) {
  static constexpr std::string_view kSql =
      "SELECT id FROM jobs WHERE content_key = $1 AND content_key <> '' AND owner = $2"
      " AND status = 'successful' ORDER BY (label IS NULL AND metadata IS NULL) DESC, seq DESC LIMIT 1";
  return database_.read<std::optional<std::string>>(
      [&](Connection& connection) -> std::optional<std::string> {
        const Rows rows = connection.run(kSql, Parameters().add(content_key).add(owner));
        return rows.empty() ? std::nullopt : std::optional(rows.text(0, 0));
      });
}

StatusOr<std::int64_t> PostgresqlStore::waiting() {
  return database_.read<std::int64_t>([](Connection& connection) {
    return connection.run("SELECT count(*) FROM jobs WHERE status = 'accepted'").integer(0, 0);
  });
}

StatusOr<std::optional<Time>> PostgresqlStore::oldest_waiting() {
  return database_.read<std::optional<Time>>([](Connection& connection) {
    const Rows rows = connection.run("SELECT min(created_us) FROM jobs WHERE status = 'accepted'");
    return optional_time_in(rows, 0, 0);
  });
}

StatusOr<std::vector<std::string>> PostgresqlStore::owners() {
  return database_.read<std::vector<std::string>>([](Connection& connection) {
    return connection.run("SELECT DISTINCT owner FROM owner_bytes ORDER BY owner").texts(0);
  });
}

StatusOr<std::optional<Job>> PostgresqlStore::get(std::string_view id) {
  static const std::string kSql = "SELECT " + std::string(kJobColumns) +
                                  ", (SELECT reached FROM failures WHERE failures.job = jobs.seq)"
                                  " FROM jobs WHERE jobs.id = $1";
  return database_.read<std::optional<Job>>([&](Connection& connection) -> std::optional<Job> {
    const Rows rows = connection.run(kSql, Parameters().add(id));
    if (rows.empty()) {
      return std::nullopt;
    }
    Job job = read_job(rows, 0);
    if (job.failure) {
      job.failure->reached = rows.text(0, kJobColumnCount);
    }
    return job;
  });
}

StatusOr<JobPage> PostgresqlStore::list(const ListQuery& query) {
  return database_.read<JobPage>([&](Connection& connection) {
    static const ListedTable kJobs{"jobs", kJobColumns, kJobColumnCount, ""};
    auto [jobs, next] = read_page<Job>(connection, kJobs, query, read_job);
    return JobPage{std::move(jobs), next};
  });
}

StatusOr<std::optional<std::string>> PostgresqlStore::request(std::string_view id) {
  return database_.read<std::optional<std::string>>(
      [&](Connection& connection) -> std::optional<std::string> {
        const Rows rows = connection.run("SELECT document FROM requests JOIN jobs ON seq = job WHERE id = $1",
                                         Parameters().add(id));
        return rows.empty() ? std::nullopt : std::optional(rows.text(0, 0));
      });
}

StatusOr<DocumentPiece> PostgresqlStore::result_piece(std::string_view id, std::size_t offset,
                                                      std::size_t most) {
  static constexpr std::string_view kSql =
      "SELECT size, packed, result_pieces.bytes FROM jobs JOIN results ON results.job = seq"
      " LEFT JOIN result_pieces ON result_pieces.job = seq AND number = $2 WHERE id = $1";
  return database_.read<DocumentPiece>([&](Connection& connection) -> DocumentPiece {
    const auto number = static_cast<std::int64_t>(std::min<std::size_t>(offset / kPiece, INT32_MAX));
    const Rows rows = connection.run(kSql, Parameters().add(id).add(number));
    if (rows.empty()) {
      return {};
    }
    DocumentPiece piece{"", static_cast<std::size_t>(rows.integer(0, 0))};
    if (!rows.is_null(0, 2)) {
      const std::string bytes = rows.boolean(0, 1) ? unpacked(rows.text(0, 2)) : rows.text(0, 2);
      piece.bytes = bytes.substr(std::min(offset % kPiece, bytes.size()), most);
    }
    return piece;
  });
}

StatusOr<StoredPath> PostgresqlStore::path(std::string_view id) {
  return database_.read<StoredPath>([&](Connection& connection) { return read_path(connection, id); });
}

}  // namespace snapthrough::server::postgresql
