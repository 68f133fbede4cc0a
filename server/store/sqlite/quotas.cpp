#include "server/store/sqlite/quotas.h"

#include <string>

namespace snapthrough::server::sqlite {
namespace {

Status check_one(StatusCode code, const char* name, std::int64_t quota, std::int64_t has, std::int64_t more) {
  if (quota == 0 || more == 0 || has + more <= quota) {
    return {};
  }
  return {code, std::string(name) + " (see /v1/limits) is " + std::to_string(quota) + ": this owner has " +
                    std::to_string(has) + ", and the request adds " + std::to_string(more) + "."};
}

}  // namespace

Status check_quotas(const Connection& connection, std::string_view owner, const Quotas& quotas,
                    const Addition& addition) {
  if (!quotas.any()) {
    return {};
  }
  Statement row =
      connection.prepare("SELECT jobs_waiting, points_waiting, bytes_kept FROM owners WHERE owner = ?");
  row.bind(owner);
  const bool known = row.step();
  const auto has = [&](int column) { return known ? row.integer(column) : 0; };
  Status status =
      check_one(StatusCode::waiting_quota, "quota_jobs_waiting", quotas.jobs_waiting, has(0), addition.jobs);
  if (status.ok()) {
    status = check_one(StatusCode::waiting_quota, "quota_points_waiting", quotas.points_waiting, has(1),
                       addition.points);
  }
  return status.ok() ? check_one(StatusCode::storage_quota, "quota_bytes_kept", quotas.bytes_kept, has(2),
                                 addition.bytes)
                     : status;
}

}  // namespace snapthrough::server::sqlite
