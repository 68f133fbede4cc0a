#include "server/sweeps/sweep_service.h"

#include <algorithm>
#include <utility>

#include "api/provenance.h"
#include "server/digest.h"
#include "server/jobs/envelope.h"
#include "server/jobs/memory.h"
#include "server/jobs/submission.h"

namespace snapthrough::server {

StatusOr<Submission> SweepService::submit(const Order& order) {
  if (Status status = world_.health.takes_work(); !status.ok()) {
    return status;
  }
  const LargeDocument room(order.document.size());
  const Envelope envelope = open_envelope(order.document, "sweep", world_.limits);
  if (envelope.malformed) {
    return Submission{Submission::Kind::malformed, envelope.findings};
  }
  api::SweepOutcome read =
      api::read_sweep_document(envelope.document, static_cast<std::uint64_t>(world_.limits.sweep_points));
  if (std::vector<Finding> findings = in_envelope(envelope, std::move(read.findings)); !findings.empty()) {
    return Submission{Submission::Kind::invalid, std::move(findings)};
  }
  const StatusOr<std::int64_t> waiting = world_.store.unfinished();
  if (!waiting.ok()) {
    return waiting.status();
  }
  if (*waiting >= world_.limits.sweeps) {
    return known_or_full(world_.store, order);
  }
  if (Status status = world_.health.take_room(order.document.size()); !status.ok()) {
    return status;
  }
  NewSweep sweep{new_id(world_.environment), read.sweep->title(),
                 std::string(envelope.text), static_cast<std::int64_t>(read.sweep->size()),
                 world_.environment.now(),   order.owner};
  sweep.item_points = static_cast<std::int64_t>(read.sweep->item_size());
  sweep.reuse = order.reuse;
  sweep.idempotency = key_of(order);
  sweep.quotas = world_.limits.quotas;
  sweep.analysis_type = read.sweep->analysis_type();
  sweep.annotations = envelope.annotations;
  sweep.request_sha256 = sha256_hex(api::canonical_text(*envelope.document));
  const StatusOr<Submitted> submitted = world_.store.submit(sweep);
  if (!submitted.ok()) {
    if (submitted.status().code() == StatusCode::unavailable) {
      world_.health.writable = false;
    }
    return submitted.status();
  }
  if (submitted->kind != Submitted::Kind::created) {
    const bool repeated = submitted->kind == Submitted::Kind::repeated;
    return Submission{
        repeated ? Submission::Kind::repeated : Submission::Kind::key_conflict, {}, submitted->id};
  }
  world_.log.write(LogLevel::info, "sweep",
                   {{"sweep", std::string_view(sweep.id)},
                    {"status", to_string(JobState::accepted)},
                    {"points", sweep.points},
                    {"request_id", order.request_id}});
  work_.wake();
  return Submission{Submission::Kind::stored, {}, std::move(sweep.id)};
}

StatusOr<std::optional<SweepRecord>> SweepService::get(const std::string& id, std::string_view owner) {
  StatusOr<std::optional<SweepRecord>> sweep = world_.store.get(id);
  if (sweep.ok() && sweep->has_value() && (*sweep)->owner != owner) {
    return std::optional<SweepRecord>();
  }
  return sweep;
}

StatusOr<SweepChange> SweepService::retry(const std::string& id) {
  if (Status status = world_.health.takes_work(); !status.ok()) {
    return status;
  }
  StatusOr<SweepChange> change = world_.store.retry(id, world_.limits.quotas, world_.environment.now());
  if (change.ok() && change->changed) {
    log_sweep(world_.log, id, to_string(JobState::accepted), "tried again");
    work_.wake();
  }
  return change;
}

Status SweepService::remove(const std::string& id) {
  if (const StatusOr<SweepChange> dismissal = dismiss(id); !dismissal.ok()) {
    return dismissal.status();
  }
  const StatusOr<bool> removed = world_.store.remove(id, world_.environment.now());
  if (removed.ok() && *removed) {
    log_sweep(world_.log, id, "removed");
  }
  return removed.status();
}

}  // namespace snapthrough::server
