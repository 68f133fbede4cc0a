#include "server/store/quota_check.h"

#include <string>

namespace snapthrough::server {
namespace {

Status check_one(StatusCode code, const char* name, std::int64_t quota, std::int64_t has, std::int64_t more) {
  if (quota == 0 || more == 0 || has + more <= quota) {
    return {};
  }
  return {code, std::string(name) + " (see /v1/limits) is " + std::to_string(quota) + ": this owner has " +
                    std::to_string(has) + ", and the request adds " + std::to_string(more) + "."};
}

}  // namespace

Status check_quotas(const Quotas& quotas, const Usage& has, const Usage& more) {
  Status status =
      check_one(StatusCode::waiting_quota, "quota_jobs_waiting", quotas.jobs_waiting, has.jobs, more.jobs);
  if (status.ok()) {
    status = check_one(StatusCode::waiting_quota, "quota_points_waiting", quotas.points_waiting, has.points,
                       more.points);
  }
  if (status.ok()) {
    status =
        check_one(StatusCode::storage_quota, "quota_bytes_kept", quotas.bytes_kept, has.bytes, more.bytes);
  }
  return status.ok() ? check_one(StatusCode::rate_quota, "quota_points_per_hour", quotas.points_per_hour,
                                 has.points_this_hour, more.points)
                     : status;
}

}  // namespace snapthrough::server
