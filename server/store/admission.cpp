#include "server/store/admission.h"

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

StatusOr<Submitted> JobSubmission::run() {
  if (job_.idempotency) {
    if (const std::optional<Submitted> known = find_key()) {
      return *known;
    }
  }
  const std::optional<KnownJob> known = job_.reuse ? find_result() : std::nullopt;
  // The known job has no callback: a new job is made that tells it.
  const bool will_do = known && (job_.annotations == Annotations{} || job_.annotations == known->annotations);
  Submitted submitted{Submitted::Kind::reused, known ? known->id : ""};
  if (!will_do) {
    const Usage addition{job_.lease || known ? 0 : 1, 0, static_cast<std::int64_t>(job_.document.size())};
    if (Status status = admit(addition); !status.ok()) {
      return status;
    }
    submitted = {known ? Submitted::Kind::copied : Submitted::Kind::created, job_.id};
    if (known) {
      insert_copy(*known);
    } else {
      insert();
    }
  }
  if (job_.idempotency) {
    insert_key(submitted.id);
  }
  return submitted;
}

}  // namespace snapthrough::server
