#pragma once
/// @file
/// Jobs as data: what is handed in, stored, claimed and returned.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/environment.h"
#include "server/jobs/state.h"
#include "solver/result.h"

namespace snapthrough::server {

/// Why a job failed.
struct JobFailure {
  std::string code;     ///< e.g. "no_convergence", "internal_error"
  std::string detail;   ///< a sentence
  std::string reached;  ///< result document (JSON text) of what was reached; empty: nothing
};

/// @brief Bounds on what one owner has; 0: no bound. A submission that would exceed one is refused. Accepted
/// work is computed, and its results are stored, whatever they add.
struct Quotas {
  std::int64_t jobs_waiting = 0;     ///< accepted jobs
  std::int64_t points_waiting = 0;   ///< points of accepted and running sweeps that have no row yet
  std::int64_t bytes_kept = 0;       ///< bytes of requests, results, sweeps and their rows
  std::int64_t points_per_hour = 0;  ///< points of sweeps that are handed in or tried again in 60 minutes

  [[nodiscard]] bool any() const {
    return jobs_waiting > 0 || points_waiting > 0 || bytes_kept > 0 || points_per_hour > 0;
  }
};

/// Resources that computing took, of all attempts that came to an outcome.
struct WorkUsage {
  std::int64_t cpu_us = 0;          ///< processor time in microseconds
  std::int64_t peak_bytes = 0;      ///< largest memory use; 0: unknown
  std::int64_t factorizations = 0;  ///< number of factorisations of the tangent stiffness that were counted

  void add(const WorkUsage& more) {
    cpu_us += more.cpu_us;
    peak_bytes = std::max(peak_bytes, more.peak_bytes);
    factorizations += more.factorizations;
  }
  bool operator==(const WorkUsage&) const = default;
};

/// What a client adds to a job or sweep; annotations do not change what is computed.
struct Annotations {
  std::string label;          ///< empty: none
  std::string metadata;       ///< JSON object of texts; empty: none
  std::string callback = {};  ///< address to which the end is posted (jobs/callback.h); empty: none

  bool operator==(const Annotations&) const = default;
};

/// A job without its documents.
struct Job {
  std::string id;
  JobState state = JobState::accepted;
  int attempt = 0;          ///< number of claims
  int crashes = 0;          ///< number of claims that ended with the death of their process
  std::string owner;        ///< name of the API key of the submission; empty: the service asks for no keys
  std::string content_key;  ///< see NewJob
  std::string title;
  std::string analysis_type;
  Time created;
  std::optional<Time> started;        ///< time of the latest claim
  std::optional<Time> finished;       ///< set exactly in a final state
  std::optional<JobFailure> failure;  ///< set exactly when failed; list() leaves `reached` empty
  Annotations annotations;
  std::string request_sha256;  ///< api::request_digest(); empty: an earlier version stored the job
  std::string program;  ///< api::program_text() of the process that computed the outcome; empty: none did
  std::optional<WorkUsage> usage;  ///< what computing took; empty: nothing was computed
};

/// Idempotency key: a later submission with the same key and document is the same job or sweep.
struct IdempotencyKey {
  std::string key;          ///< text that the client gave
  std::string fingerprint;  ///< SHA-256 of the document that came with the key
};

/// Idempotency key of a stored job or sweep.
struct UsedKey {
  IdempotencyKey key;
  Time first_used;
};

/// Lease of a job or of items: after `until`, unless it is renewed, the work may be given to another worker.
struct Lease {
  std::string worker;  ///< name of the instance of the service
  Time until;
};

/// A job that is submitted to a store.
struct NewJob {
  std::string id;             ///< from new_id()
  std::string title;          ///< title of the model, for lists
  std::string analysis_type;  ///< e.g. "path"
  std::string document;       ///< request as received, JSON text
  Time created;
  std::string owner = {};        ///< see Job
  std::string content_key = {};  ///< see content_key(); empty: its result is not reused
  std::optional<IdempotencyKey> idempotency = {};
  bool patient = false;  ///< the commit may wait a millisecond for the outcome, to store both at once
  bool reuse = false;    ///< the result of a successful job of the same owner and content may be used
  Quotas quotas = {};    ///< bounds of the owner
  std::optional<Lease> lease = {};  ///< set: a worker has the job already, which begins running
  Annotations annotations = {};
  int attempt = 0;                  ///< earlier claims, in another store; a lease is one more
  int crashes = 0;                  ///< earlier claims that ended with the death of their process
  std::string request_sha256 = {};  ///< see Job
};

/// Outcome of a submission to a store.
struct Submitted {
  enum class Kind {
    created,
    reused,       ///< `id` is a successful job with the same content and annotations
    copied,       ///< `id` is a new successful job with the result of a job that has other annotations
    repeated,     ///< `id` is the job of an earlier submission with the same key and document
    key_conflict  ///< the key was used with another document
  } kind = Kind::created;
  std::string id;
};

/// Owners whose work a worker may take.
struct OwnersInTurn {
  int most = 0;  ///< not 0: only those for whom fewer tasks of the kind (jobs, chunks of sweeps) run
  std::vector<std::string> except = {};  ///< with `most`: their work is left to other workers
};

/// @brief Claim of a worker on a job. Stores refuse writes under a claim whose attempt is not the job's: the
/// job was given to another worker since.
struct Claim {
  std::string id;
  int attempt = 0;
  std::string document = {};  ///< the request
  Time created = {};          ///< time of submission by the clock of the caller that claims
  std::string owner = {};     ///< see Job
};

/// Result of a job: the document that is served, and its parts for queries.
struct JobResult {
  std::string document;  ///< result document, JSON text
  double wall_time_s = 0.0;
  Summary summary;
  std::vector<Branch> branches;
  std::vector<CriticalPoint> critical_points;
};

/// Stored path of a job: series without loss; critical points without monitor values and state.
struct StoredPath {
  std::vector<Branch> branches;
  std::vector<CriticalPoint> critical_points;
};

}  // namespace snapthrough::server
