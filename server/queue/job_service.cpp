#include "server/queue/job_service.h"

#include <utility>

#include "api/api.h"
#include "api/names.h"
#include "api/provenance.h"
#include "server/digest.h"
#include "server/jobs/content_key.h"
#include "server/jobs/envelope.h"
#include "server/jobs/memory.h"
#include "server/jobs/submission.h"

namespace snapthrough::server {
namespace {

NewJob new_job(const Order& order, const api::Request& request, const Envelope& envelope,
               const Environment& world) {
  NewJob job;
  job.id = new_id(world);
  job.title = request.model.title;
  job.analysis_type = api::name_of(api::kAnalysisTypes, request.analysis.type);
  job.document = envelope.text;
  job.created = world.now();
  job.owner = order.owner;
  const std::string canonical = api::canonical_text(*request.document);
  job.content_key = content_key(canonical);
  job.request_sha256 = sha256_hex(canonical);
  job.reuse =
      order.reuse && order.idempotency_key.has_value();  // without a key submit() looks for a result first
  job.idempotency = key_of(order);
  job.annotations = envelope.annotations;
  return job;
}

}  // namespace

/// Reserves the idempotency key of an order for as long as it exists.
class JobService::KeyInUse {
 public:
  KeyInUse(JobService& jobs, const Order& order) : jobs_(jobs), used_(order.idempotency_key.has_value()) {
    if (used_) {
      entry_ = {order.owner, std::string(*order.idempotency_key)};
      const std::lock_guard guard(jobs_.keys_mutex_);
      taken_ = jobs_.keys_in_use_.insert(entry_).second;
    }
  }
  ~KeyInUse() {
    if (taken_) {
      const std::lock_guard guard(jobs_.keys_mutex_);
      jobs_.keys_in_use_.erase(entry_);
    }
  }
  KeyInUse(const KeyInUse&) = delete;
  KeyInUse& operator=(const KeyInUse&) = delete;
  KeyInUse(KeyInUse&&) = delete;
  KeyInUse& operator=(KeyInUse&&) = delete;

  [[nodiscard]] bool by_another() const { return used_ && !taken_; }

 private:
  JobService& jobs_;
  bool used_;
  bool taken_ = false;
  std::pair<std::string, std::string> entry_;
};

JobService::JobService(Store& store, const Environment& environment, Log& log, JobLimits limits)
    : store_(store),
      environment_(environment),
      log_(log),
      limits_(std::move(limits)),
      instance_(new_id(environment)),
      sweeps_({store_.sweeps(), environment_, log_, limits_, health_, waiting_, handoffs_, completions_,
               metrics_, bell_, instance_}),
      context_{store_,    environment_, log_,      limits_,        health_,  waiting_, completions_,
               handoffs_, active_,      progress_, sweeps_.work(), metrics_, bell_,    instance_} {}

StatusOr<Submission> JobService::submit(const Order& order) {
  if (Status status = health_.takes_work(); !status.ok()) {
    return status;
  }
  const KeyInUse in_use(*this, order);
  if (in_use.by_another()) {
    return Submission{Submission::Kind::key_in_use};
  }
  const LargeDocument room(order.document.size());
  const Envelope envelope = open_envelope(order.document, "request", limits_);
  if (envelope.malformed) {
    return Submission{Submission::Kind::malformed, envelope.findings};
  }
  api::ReadOutcome read = api::read_request_document(envelope.document);
  if (read.request) {
    read.findings = check_memory(read.request->model, read.request->analysis, limits_.job_memory);
  }
  if (std::vector<Finding> findings = in_envelope(envelope, std::move(read.findings)); !findings.empty()) {
    return Submission{Submission::Kind::invalid, std::move(findings)};
  }
  NewJob job = new_job(order, *read.request, envelope, environment_);
  if (order.reuse && !order.idempotency_key) {
    const StatusOr<std::optional<std::string>> known = store_.find_result(job.content_key, order.owner);
    if (!known.ok()) {
      return known.status();
    }
    job.reuse = known->has_value();
    if (known->has_value() && job.annotations == Annotations{}) {
      return Submission{Submission::Kind::reused, {}, **known};
    }
  }
  if (waiting_.value() >= limits_.queue) {
    return known_or_full(store_, order);
  }
  if (Status status = health_.take_room(order.document.size()); !status.ok()) {
    return status;
  }
  return store_new(order, std::move(job));
}

StatusOr<Submission> JobService::store_new(const Order& order, NewJob job) {
  job.quotas = limits_.quotas;
  std::promise<bool> stored;
  Handoff handoff{{job.id, 1, job.document, job.created, job.owner}, stored.get_future().share()};
  const Lease lease = context_.new_lease();
  // A job that may be a repetition, have a stored result or be refused for its bytes is not solved before it
  // is stored.
  if (!order.idempotency_key && !job.reuse && job.quotas.bytes_kept == 0 && handoffs_.offer(handoff)) {
    job.lease = lease;
    job.patient = order.waits;
  }
  bool queued = false;
  WaitingCount::Change change(waiting_);
  const StatusOr<Submitted> submitted = store_.submit(job, [&] {
    queued = true;
    stored.set_value(true);
  });
  if (!queued) {
    stored.set_value(false);
  }
  if (!submitted.ok()) {
    health_.writable = health_.writable && submitted.status().code() != StatusCode::unavailable;
    return submitted.status();
  }
  switch (submitted->kind) {
    case Submitted::Kind::created:
      break;
    case Submitted::Kind::reused:
      return Submission{Submission::Kind::reused, {}, submitted->id};
    case Submitted::Kind::repeated:
      return Submission{Submission::Kind::repeated, {}, submitted->id};
    case Submitted::Kind::key_conflict:
      return Submission{Submission::Kind::key_conflict};
    case Submitted::Kind::copied:
      log_new(job, JobState::successful, order.request_id);
      return Submission{Submission::Kind::copied, {}, submitted->id};
  }
  log_new(job, JobState::accepted, order.request_id);
  if (!job.lease) {
    change.add(1);
    handoffs_.ring();
    bell_.ring();
  }
  return Submission{Submission::Kind::stored, {}, std::move(job.id)};
}

void JobService::log_new(const NewJob& job, JobState state, std::string_view request_id) {
  log_.write(LogLevel::info, "job",
             {{"job", std::string_view(job.id)},
              {"status", to_string(state)},
              {"analysis", std::string_view(job.analysis_type)},
              {"request_id", request_id}});
}

StatusOr<std::optional<Job>> JobService::get(const std::string& id, std::string_view owner) {
  StatusOr<std::optional<Job>> job = store_.get(id);
  if (job.ok() && job->has_value() && (*job)->owner != owner) {
    return std::optional<Job>();
  }
  return job;
}

std::optional<Progress> JobService::progress(const Job& job) const {
  if (job.state != JobState::running) {
    return std::nullopt;
  }
  if (const auto here = progress_.get(job.id, &JobNews::progress); here && *here) {
    return *here;
  }
  NeighbourStore* const others = store_.neighbours();
  if (others == nullptr) {
    return std::nullopt;
  }
  const StatusOr<std::vector<ToldProgress>> told = others->told({job.id});
  return told.ok() && !told->empty() ? std::optional(told->front().progress) : std::nullopt;
}

StatusOr<Dismissal> JobService::dismiss(const std::string& id) {
  WaitingCount::Change change(waiting_);
  StatusOr<Dismissal> dismissal = store_.dismiss(id, environment_.now());
  if (!dismissal.ok() || !dismissal->found || is_final(dismissal->before)) {
    return dismissal;
  }
  if (dismissal->before == JobState::accepted) {
    change.add(-1);
  }
  metrics_.job_ended(to_string(JobState::dismissed));
  active_.stop(id, StopReason::dismissed);
  completions_.announce(id);
  log_.write(LogLevel::info, "job",
             {{"job", std::string_view(id)}, {"status", to_string(JobState::dismissed)}});
  return dismissal;
}

Status JobService::remove(const std::string& id) {
  if (const StatusOr<Dismissal> dismissal = dismiss(id); !dismissal.ok()) {
    return dismissal.status();
  }
  const StatusOr<bool> removed = store_.remove(id, environment_.now());
  if (removed.ok() && *removed) {
    log_.write(LogLevel::info, "job",
               {{"job", std::string_view(id)}, {"status", std::string_view("removed")}});
  }
  return removed.status();
}

}  // namespace snapthrough::server
