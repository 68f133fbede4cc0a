#pragma once
/// @file
/// Decisions of drivers about submissions: quotas of the owner, repetitions, reuse of results.

#include <cstdint>
#include <optional>
#include <string>

#include "server/jobs/job.h"
#include "server/status.h"

namespace snapthrough::server {

/// What an owner has, or what a request adds to it.
struct Usage {
  std::int64_t jobs = 0;    ///< accepted jobs
  std::int64_t points = 0;  ///< points of unfinished sweeps, without a row
  std::int64_t bytes = 0;
  std::int64_t points_this_hour = 0;  ///< points handed in during the last sixty minutes
};

/// `waiting_quota`, `storage_quota` or `rate_quota`, with the name of the quota, when `has` and `more`
/// together exceed one.
[[nodiscard]] Status check_quotas(const Quotas& quotas, const Usage& has, const Usage& more);

/// A successful job whose result serves for another job.
struct KnownJob {
  std::int64_t row = 0;
  std::string id;
  Annotations annotations;  ///< without the callback
};

/// @brief The statements of a submission, in one transaction. A submission calls each at most once.
class JobSubmission {
 public:
  explicit JobSubmission(const NewJob& job) : job_(job) {}
  JobSubmission(const JobSubmission&) = delete;
  JobSubmission& operator=(const JobSubmission&) = delete;
  JobSubmission(JobSubmission&&) = delete;
  JobSubmission& operator=(JobSubmission&&) = delete;
  virtual ~JobSubmission() = default;

  /// Decides and stores; see Store::submit().
  [[nodiscard]] StatusOr<Submitted> run();

 protected:
  /// What the idempotency key of the job was used for; empty for a new key.
  virtual std::optional<Submitted> find_key() = 0;
  /// The newest successful job of the same content and owner, of those with the same annotations if any.
  virtual std::optional<KnownJob> find_result() = 0;
  /// Counts the addition, or returns the quota that forbids it.
  virtual Status admit(const Usage& addition) = 0;
  virtual void insert() = 0;
  /// Inserts the job, successful, with a copy of everything that belongs to the result of another job.
  virtual void insert_copy(const KnownJob& original) = 0;
  /// Stores the idempotency key with the id of the job that it stands for.
  virtual void insert_key(const std::string& id) = 0;

  const NewJob& job_;
};

}  // namespace snapthrough::server
