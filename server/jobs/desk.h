#pragma once
/// @file
/// What a caller can do with jobs, whatever the protocol: hand one in, look at it, dismiss it.

#include <atomic>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "server/environment.h"
#include "server/jobs/notices.h"
#include "server/jobs/work.h"
#include "server/log/log.h"
#include "server/store/store.h"
#include "solver/model/check.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// A request document and how it was handed in.
struct Order {
  std::string_view document;
  std::string_view request_id = {};                      ///< for the log
  std::string owner = {};                                ///< see Job
  std::optional<std::string_view> idempotency_key = {};  ///< a second order with it is the first
  bool waits = false;                                    ///< the caller waits for the outcome
  bool reuse = true;                                     ///< a stored result of the same request will do
};

/// What became of an order.
struct Submission {
  enum class Kind {
    stored,        ///< `id` is a new job
    repeated,      ///< `id` is the job of the same idempotency key
    reused,        ///< `id` is a successful job of the same content
    malformed,     ///< not a JSON document, see findings; nothing was stored
    invalid,       ///< see findings; nothing was stored
    key_conflict,  ///< the idempotency key came with another document before
    key_in_use,    ///< a request with this idempotency key is being served at this moment
    queue_full
  } kind = Kind::stored;
  std::vector<Finding> findings = {};
  std::string id = {};
};

/// Bounds on what is kept and worked on.
struct JobLimits {
  int queue = 100'000;                         ///< jobs that may wait, >= 1
  std::chrono::seconds lease{30};              ///< a worker that is silent for so long has lost its job
  std::chrono::seconds longest_run{3600};      ///< of one job
  int max_crashes = 3;                         ///< a job during which the service died so often is given up
  std::chrono::seconds keep_jobs{30 * 86400};  ///< after their end; 0: for ever
  std::chrono::seconds keep_keys{86400};       ///< idempotency keys
};

/// Whether writing to the store works. Thread-safe.
struct StoreHealth {
  std::atomic<bool> writable = true;   ///< the latest write that tells
  std::atomic<bool> has_space = true;  ///< enough for new jobs
  std::atomic<bool> draining = false;  ///< the service is about to stop
};

/// @brief Where jobs are handed in and asked for. Thread-safe; the parts it is given must outlive it.
class JobDesk {
 public:
  JobDesk(Store& store, const Environment& environment, Log& log, JobLimits limits = {});

  /// @brief Reads and checks a request document and, when nothing is wrong, stores it as a job.
  /// The job is durable when this returns an id. `unavailable` when nothing can be stored at the moment.
  StatusOr<Submission> submit(const Order& order);
  /// The job, if there is one and it is the owner's.
  StatusOr<std::optional<Job>> get(const std::string& id, std::string_view owner);
  /// Dismisses a job and stops its analysis. @pre get() found it
  StatusOr<Dismissal> dismiss(const std::string& id);
  /// Removes a job, after stopping its analysis. @pre get() found it
  Status remove(const std::string& id);

  [[nodiscard]] std::optional<Progress> progress(const std::string& id) const { return progress_.get(id); }
  [[nodiscard]] Store& store() { return store_; }
  [[nodiscard]] const Environment& environment() const { return environment_; }
  [[nodiscard]] const JobLimits& limits() const { return limits_; }
  [[nodiscard]] StoreHealth& health() { return health_; }
  /// About how many jobs wait.
  [[nodiscard]] std::int64_t waiting() const { return waiting_; }
  void set_waiting(std::int64_t count) { waiting_ = count; }
  void add_waiting(std::int64_t count) { waiting_ += count; }

  // For the workers.
  [[nodiscard]] JobEnds& ends() { return ends_; }
  [[nodiscard]] WorkExchange& exchange() { return exchange_; }
  [[nodiscard]] ActiveJobs& active() { return active_; }
  [[nodiscard]] ProgressBoard& progress_board() { return progress_; }
  /// A lease from now on, for this instance of the service.
  [[nodiscard]] Lease new_lease() const;

 private:
  class KeyInUse;
  StatusOr<Submission> store_new(const Order& order, api::Request request, std::string key);
  void log_accepted(const NewJob& job, std::string_view request_id);

  Store& store_;
  const Environment& environment_;
  Log& log_;
  const JobLimits limits_;
  const std::string instance_;
  StoreHealth health_;
  std::atomic<std::int64_t> waiting_ = 0;
  std::mutex keys_mutex_;
  std::set<std::pair<std::string, std::string>> keys_in_use_;
  JobEnds ends_;
  WorkExchange exchange_;
  ActiveJobs active_;
  ProgressBoard progress_;
};

}  // namespace snapthrough::server
