#pragma once
/// @file
/// A job and what is kept of it. Plain data.

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

/// What one owner may have at most; 0: any amount. Work that would lead beyond it is not stored; what was
/// accepted is computed and stored whatever its size.
struct Quotas {
  std::int64_t jobs_waiting = 0;     ///< accepted jobs
  std::int64_t points_waiting = 0;   ///< points of accepted and running sweeps that have no row yet
  std::int64_t bytes_kept = 0;       ///< of requests, results, sweeps and their rows
  std::int64_t points_per_hour = 0;  ///< of sweeps, handed in or tried again

  [[nodiscard]] bool any() const {
    return jobs_waiting > 0 || points_waiting > 0 || bytes_kept > 0 || points_per_hour > 0;
  }
};

/// What a client wants with a job or sweep. It has no part in what is computed.
struct Annotations {
  std::string label;          ///< empty: none
  std::string metadata;       ///< JSON object of texts; empty: none
  std::string callback = {};  ///< address that is told of the end (jobs/callback.h); empty: none

  bool operator==(const Annotations&) const = default;
};

/// What is known of a job without its documents.
struct Job {
  std::string id;
  JobState state = JobState::accepted;
  int attempt = 0;          ///< how often it was claimed
  int crashes = 0;          ///< how many of these claims ended with the death of the process
  std::string owner;        ///< name of the key that handed it in; empty: none was asked for
  std::string content_key;  ///< see NewJob
  std::string title;
  std::string analysis_type;
  Time created;
  std::optional<Time> started;        ///< of the latest claim
  std::optional<Time> finished;       ///< exactly in a final state
  std::optional<JobFailure> failure;  ///< exactly when failed; list() leaves out what was reached
  Annotations annotations;
};

/// What makes a repeated submission the same one.
struct IdempotencyKey {
  std::string key;          ///< as the client gave it
  std::string fingerprint;  ///< of the document it came with
};

/// Who works on a job, and until when that holds unless it is renewed.
struct Lease {
  std::string worker;  ///< the instance of the service
  Time until;
};

/// A job as it is handed in.
struct NewJob {
  std::string id;             ///< from new_id()
  std::string title;          ///< of the model, for lists
  std::string analysis_type;  ///< e.g. "path"
  std::string document;       ///< the request, JSON text as received
  Time created;
  std::string owner = {};        ///< see Job
  std::string content_key = {};  ///< equal for requests with equal results; empty: its result is not reused
  std::optional<IdempotencyKey> idempotency = {};
  bool patient = false;  ///< its outcome may come at once: the commit may wait a millisecond for it
  bool reuse = false;    ///< the result of a successful job of the same owner and content will do
  Quotas quotas = {};    ///< of the owner
  std::optional<Lease> lease = {};  ///< set: a worker has it already, the job begins running in attempt 1
  Annotations annotations = {};
};

/// What became of a submission.
struct Submitted {
  enum class Kind {
    created,
    reused,       ///< `id` is a successful job of the same content; its annotations are those that were given
    copied,       ///< `id` is the new job: successful, with the result of one that was annotated otherwise
    repeated,     ///< the idempotency key was used with the same document: `id` is that job
    key_conflict  ///< the idempotency key was used with another document
  } kind = Kind::created;
  std::string id;
};

/// What a worker holds of a job it works on, and what proves that it still does: a job that was given to
/// somebody else has a higher attempt.
struct Claim {
  std::string id;
  int attempt = 0;
  std::string document = {};  ///< the request
  Time created = {};          ///< the job was handed in then
};

/// What a finished job leaves: the document that is served, and its parts for queries.
struct JobResult {
  std::string document;  ///< result document, JSON text
  double wall_time_s = 0.0;
  Summary summary;
  std::vector<Branch> branches;
  std::vector<CriticalPoint> critical_points;
};

/// The stored path of a job: series without loss, critical points without their monitor values and state.
struct StoredPath {
  std::vector<Branch> branches;
  std::vector<CriticalPoint> critical_points;
};

}  // namespace snapthrough::server
