#include "server/jobs/job_service.h"

#include <utility>

#include "api/api.h"
#include "server/jobs/content_key.h"
#include "server/jobs/least_memory.h"
#include "server/jobs/repetition.h"

namespace snapthrough::server {
namespace {

std::string_view analysis_name(AnalysisType type) {
  switch (type) {
    case AnalysisType::buckling:
      return "buckling";
    case AnalysisType::critical:
      return "critical";
    case AnalysisType::path:
      return "path";
    case AnalysisType::static_:
      return "static";
  }
  return "";
}

NewJob new_job(const Order& order, const api::Request& request, std::string key, const Environment& world) {
  NewJob job;
  job.id = new_id(world);
  job.title = request.model.title;
  job.analysis_type = analysis_name(request.analysis.type);
  job.document = order.document;
  job.created = world.now();
  job.owner = order.owner;
  job.content_key = std::move(key);
  job.reuse = order.reuse && order.idempotency_key.has_value();  // without a key it was looked for already
  job.idempotency = key_of(order);
  return job;
}

}  // namespace

/// Keeps others from using an idempotency key at the same time.
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
      limits_(limits),
      sweeps_({store_.sweeps(), environment_, log_, limits_, health_, handoffs_, completions_, metrics_}),
      context_{store_,    environment_, log_,      limits_, health_,  waiting_,           completions_,
               handoffs_, active_,      progress_, sweeps_, metrics_, new_id(environment)} {}

StatusOr<Submission> JobService::submit(const Order& order) {
  if (Status status = health_.takes_work(); !status.ok()) {
    return status;
  }
  const KeyInUse in_use(*this, order);
  if (in_use.by_another()) {
    return Submission{Submission::Kind::key_in_use};
  }
  api::ReadOutcome read = api::read_request(order.document);
  if (read.malformed || !read.findings.empty() || !read.request) {
    return Submission{read.malformed ? Submission::Kind::malformed : Submission::Kind::invalid,
                      std::move(read.findings)};
  }
  if (std::vector<Finding> findings =
          check_memory(read.request->model, read.request->analysis, limits_.job_memory);
      !findings.empty()) {
    return Submission{Submission::Kind::invalid, std::move(findings)};
  }
  std::string key = content_key(*read.request->document);
  if (order.reuse && !order.idempotency_key) {
    StatusOr<std::optional<std::string>> known = store_.find_result(key, order.owner);
    if (!known.ok()) {
      return known.status();
    }
    if (known->has_value()) {
      return Submission{Submission::Kind::reused, {}, **known};
    }
  }
  if (waiting_ >= limits_.queue) {
    return known_or_full(store_, order);
  }
  return store_new(order, *std::move(read.request), std::move(key));
}

StatusOr<Submission> JobService::store_new(const Order& order, const api::Request& request, std::string key) {
  NewJob job = new_job(order, request, std::move(key), environment_);
  job.quotas = limits_.quotas;
  std::promise<bool> stored;
  Handoff handoff{{job.id, 1, job.document, job.created}, stored.get_future().share()};
  const Lease lease = context_.new_lease();
  // With a key it may be a repetition, with a quota of bytes be refused: nobody shall solve it then.
  if (!order.idempotency_key && job.quotas.bytes_kept == 0 && handoffs_.offer(handoff)) {
    job.lease = lease;
    job.patient = order.waits;
  }
  bool queued = false;
  const StatusOr<Submitted> submitted = store_.submit(job, [&] {
    queued = true;
    stored.set_value(true);
  });
  if (!queued) {
    stored.set_value(false);
  }
  const bool created = submitted.ok() && submitted->kind == Submitted::Kind::created;
  if (!submitted.ok()) {
    health_.writable = health_.writable && submitted.status().code() != StatusCode::unavailable;
    return submitted.status();
  }
  if (submitted->kind == Submitted::Kind::key_conflict) {
    return Submission{Submission::Kind::key_conflict};
  }
  if (!created) {
    const bool reused = submitted->kind == Submitted::Kind::reused;
    return Submission{reused ? Submission::Kind::reused : Submission::Kind::repeated, {}, submitted->id};
  }
  log_accepted(job, order.request_id);
  if (!job.lease) {
    ++waiting_;
    handoffs_.ring();
  }
  return Submission{Submission::Kind::stored, {}, std::move(job.id)};
}

void JobService::log_accepted(const NewJob& job, std::string_view request_id) {
  log_.write(LogLevel::info, "job",
             {{"job", std::string_view(job.id)},
              {"status", to_string(JobState::accepted)},
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

StatusOr<Dismissal> JobService::dismiss(const std::string& id) {
  StatusOr<Dismissal> dismissal = store_.dismiss(id, environment_.now());
  if (!dismissal.ok() || !dismissal->found || is_final(dismissal->before)) {
    return dismissal;
  }
  if (dismissal->before == JobState::accepted) {
    --waiting_;
  }
  metrics_.job_ended("dismissed");
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
  const StatusOr<bool> removed = store_.remove(id);
  if (removed.ok() && *removed) {
    log_.write(LogLevel::info, "job",
               {{"job", std::string_view(id)}, {"status", std::string_view("removed")}});
  }
  return removed.status();
}

}  // namespace snapthrough::server
