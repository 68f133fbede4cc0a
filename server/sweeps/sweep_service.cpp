#include "server/sweeps/sweep_service.h"

#include <algorithm>
#include <utility>

#include "server/jobs/envelope.h"
#include "server/jobs/large_document.h"
#include "server/jobs/repetition.h"

namespace snapthrough::server {
namespace {

/// Rows that say that the store did not take them.
std::vector<PointRow> not_stored(std::vector<PointRow> rows, const Status& status) {
  for (PointRow& row : rows) {
    row = {row.point, {"", "not_stored", "the row could not be stored: " + status.message()}};
  }
  return rows;
}

}  // namespace

StatusOr<Submission> SweepService::submit(const Order& order) {
  if (Status status = world_.health.takes_work(); !status.ok()) {
    return status;
  }
  const LargeDocument room(order.document.size());
  const Envelope envelope = open_envelope(order.document, "sweep", world_.limits.callback_hosts);
  if (envelope.malformed) {
    return Submission{Submission::Kind::malformed, envelope.findings};
  }
  api::SweepOutcome read =
      api::read_sweep_document(envelope.document, static_cast<std::uint64_t>(world_.limits.sweep_points));
  if (std::vector<Finding> findings = in_envelope(envelope, std::move(read.findings)); !findings.empty()) {
    return Submission{Submission::Kind::invalid, std::move(findings)};
  }
  const StatusOr<std::int64_t> waiting = unfinished();
  if (!waiting.ok()) {
    return waiting.status();
  }
  if (*waiting >= world_.limits.sweeps) {
    return known_or_full(world_.store, order);
  }
  NewSweep sweep{new_id(world_.environment), read.sweep->title(),
                 std::string(envelope.text), static_cast<std::int64_t>(read.sweep->size()),
                 world_.environment.now(),   order.owner};
  sweep.reuse = order.reuse;
  sweep.idempotency = key_of(order);
  sweep.quotas = world_.limits.quotas;
  sweep.analysis_type = read.sweep->analysis_type();
  sweep.annotations = envelope.annotations;
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
  wake();
  return Submission{Submission::Kind::stored, {}, std::move(sweep.id)};
}

StatusOr<std::int64_t> SweepService::unfinished() {
  const StatusOr<std::vector<std::string>> ids = world_.store.unfinished();
  return ids.ok() ? StatusOr<std::int64_t>(static_cast<std::int64_t>(ids->size())) : ids.status();
}

StatusOr<std::optional<SweepRecord>> SweepService::get(const std::string& id, std::string_view owner) {
  StatusOr<std::optional<SweepRecord>> sweep = world_.store.get(id);
  if (sweep.ok() && sweep->has_value() && (*sweep)->owner != owner) {
    return std::optional<SweepRecord>();
  }
  return sweep;
}

StatusOr<SweepChange> SweepService::dismiss(const std::string& id) {
  StatusOr<SweepChange> change = world_.store.dismiss(id, world_.environment.now());
  if (change.ok() && change->changed) {
    scheduler_.remove(id);
    unloaded_ = true;  // there is room now, and it may be tried again already
    world_.completions.announce(id);
    log_sweep(id, to_string(JobState::dismissed));
  }
  return change;
}

StatusOr<SweepChange> SweepService::retry(const std::string& id) {
  if (Status status = world_.health.takes_work(); !status.ok()) {
    return status;
  }
  StatusOr<SweepChange> change = world_.store.retry(id, world_.limits.quotas);
  if (change.ok() && change->changed) {
    log_sweep(id, to_string(JobState::accepted), "tried again");
    wake();
  }
  return change;
}

Status SweepService::remove(const std::string& id) {
  if (const StatusOr<SweepChange> dismissal = dismiss(id); !dismissal.ok()) {
    return dismissal.status();
  }
  const StatusOr<bool> removed = world_.store.remove(id);
  if (removed.ok() && *removed) {
    log_sweep(id, "removed");
  }
  return removed.status();
}

/// Workers that sleep look at the store.
void SweepService::wake() {
  unloaded_ = true;
  world_.handoffs.ring();
}

/// Gives the scheduler the oldest sweeps that it does not have.
void SweepService::load() {
  const std::unique_lock lock(loading_, std::try_to_lock);
  if (!lock.owns_lock() || !unloaded_.exchange(false)) {
    return;  // somebody is at it
  }
  const StatusOr<std::vector<std::string>> ids = world_.store.unfinished();
  bool all = ids.ok();
  for (const std::string& id : ids.ok() ? *ids : std::vector<std::string>()) {
    if (scheduler_.has(id)) {
      continue;
    }
    all = scheduler_.has_room() && load_one(id) && all;
    if (!scheduler_.has_room()) {
      break;
    }
  }
  if (!all && scheduler_.has_room()) {
    unloaded_ = true;  // the store failed: to be tried again
  }
}

/// False when the store failed.
bool SweepService::load_one(const std::string& id) {
  StatusOr<std::optional<OpenSweep>> open = world_.store.open(id);
  if (!open.ok() || !open->has_value()) {
    return open.ok();  // it has ended meanwhile
  }
  OpenSweep found = **open;
  const api::SweepOutcome read = api::read_sweep(found.document);
  if (!read.sweep || read.sweep->size() != found.done.size()) {
    log_sweep(id, "not_readable", "this version does not accept the stored document any more");
    return dismiss(id).ok();
  }
  scheduler_.add(std::make_shared<ActiveSweep>(id, *read.sweep, std::move(found)));
  return true;
}

std::optional<Chunk> SweepService::take() {
  if (unloaded_ && scheduler_.has_room()) {
    load();
  }
  while (std::optional<Chunk> chunk = scheduler_.take()) {
    const std::string& id = chunk->sweep->id;
    StatusOr<PointClaim> claim = world_.store.claim(id, chunk->points(), world_.environment.now());
    if (claim.ok()) {
      chunk->claim = std::move(claim).value();
      if (scheduler_.has_units()) {
        world_.handoffs.ring();  // the next worker
      }
      return chunk;
    }
    if (claim.status().code() != StatusCode::conflict) {
      scheduler_.give_back(*chunk, chunk->units, 0.0);
      log_sweep(id, "claim", claim.status().message());
      return std::nullopt;
    }
    scheduler_.remove(chunk->sweep);
  }
  return std::nullopt;
}

Status SweepService::settle(const Chunk& chunk, const std::vector<PointRow>& rows,
                            const std::vector<std::uint64_t>& rest, double seconds) {
  StatusOr<SweepRecord> record = world_.store.put(chunk.claim, rows, world_.environment.now());
  if (!record.ok() && record.status().code() == StatusCode::io_error) {
    record = world_.store.put(chunk.claim, not_stored(rows, record.status()), world_.environment.now());
  }
  if (record.ok()) {
    scheduler_.give_back(chunk, rest, seconds);
    stored(*record, rows);
    return {};
  }
  if (record.status().code() == StatusCode::unavailable) {
    world_.health.writable = false;
    return record.status();
  }
  // Dismissed or removed meanwhile, or the store is broken: then the next start takes it up again. One that
  // was tried again since is another.
  scheduler_.remove(chunk.sweep);
  return record.status();
}

void SweepService::stored(const SweepRecord& record, const std::vector<PointRow>& rows) {
  for (const PointRow& row : rows) {
    world_.metrics.point_ended(row.reused             ? "reused"
                               : row.outcome.failed() ? std::string_view(row.outcome.code)
                                                      : to_string(JobState::successful));
  }
  if (!is_final(record.state)) {
    news_.pass_on(record.id, record);
    return;
  }
  scheduler_.remove(record.id);
  unloaded_ = true;  // there is room now
  world_.completions.announce(record.id);
  world_.log.write(record.failed > 0 ? LogLevel::warning : LogLevel::info, "sweep",
                   {{"sweep", std::string_view(record.id)},
                    {"status", to_string(record.state)},
                    {to_string(JobState::successful), record.successful},
                    {to_string(JobState::failed), record.failed},
                    {"reused", record.reused}});
}

void SweepService::log_sweep(std::string_view id, std::string_view status, std::string_view detail) {
  world_.log.write(LogLevel::info, "sweep", {{"sweep", id}, {"status", status}, {"detail", detail}});
}

}  // namespace snapthrough::server
