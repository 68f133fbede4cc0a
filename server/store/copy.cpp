#include "server/store/copy.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "api/names.h"
#include "api/point_outcome.h"
#include "api/sweep.h"

namespace snapthrough::server {
namespace {

constexpr int kPage = 500;
/// Number of points whose rows are read and stored at a time.
constexpr std::uint64_t kPointsAtOnce = 4096;
/// Holder of the leases of a copy. A lease ends when the work ended in the source: the copy, which stores by
/// the times of the source, holds it until then, and a service takes back what a copy that was cut short
/// left.
constexpr const char* kHolder = "copy";

/// Entry to copy and its place in the order of arrival.
struct Entry {
  Time created;
  std::string id;
  bool sweep = false;
};

/// Every job (or sweep) of an owner, page by page.
template <class List, class Items>
Status add_all(const std::string& owner, bool sweep, const List& list, const Items& items,
               std::vector<Entry>& entries) {
  ListQuery query;
  query.owner = owner;
  query.limit = kPage;
  do {
    const auto page = list(query);
    if (!page.ok()) {
      return page.status();
    }
    for (const auto& one : items(*page)) {
      entries.push_back({one.created, one.id, sweep});
    }
    query.before = page->next;
  } while (query.before);
  return {};
}

StatusOr<std::vector<Entry>> entries_of(Store& store) {
  const StatusOr<std::vector<std::string>> owners = store.owners();
  if (!owners.ok()) {
    return owners.status();
  }
  std::vector<Entry> entries;
  for (const std::string& owner : *owners) {
    Status status = add_all(
        owner, false, [&](const ListQuery& query) { return store.list(query); },
        [](const JobPage& page) -> auto& { return page.jobs; }, entries);
    if (status.ok()) {
      status = add_all(
          owner, true, [&](const ListQuery& query) { return store.sweeps().list(query); },
          [](const SweepPage& page) -> auto& { return page.sweeps; }, entries);
    }
    if (!status.ok()) {
      return status;
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.created, std::string_view(a.id)) < std::pair(b.created, std::string_view(b.id));
  });
  return entries;
}

Status missing(const std::string& id) {
  return {StatusCode::conflict, id + " is gone from the source: is it still in use?"};
}

StatusOr<std::string> whole_result(Store& store, const std::string& id) {
  std::string document;
  for (;;) {
    const StatusOr<DocumentPiece> piece = store.result_piece(id, document.size(), std::size_t{1} << 22);
    if (!piece.ok()) {
      return piece.status();
    }
    if (piece->bytes.empty()) {
      return document.size() == piece->size ? StatusOr<std::string>(std::move(document)) : missing(id);
    }
    document += piece->bytes;
  }
}

/// Summary and wall time in a result document.
JobResult result_of(std::string document, StoredPath path) {
  const nlohmann::json read = nlohmann::json::parse(document, nullptr, false);
  const nlohmann::json summary =
      read.is_object() ? read.value("summary", nlohmann::json()) : nlohmann::json();
  const auto field = [&](const char* name) {
    return summary.is_object() ? summary.value(name, nlohmann::json()) : nlohmann::json();
  };
  JobResult result;
  if (const auto load = field("critical_load_factor"); load.is_number()) {
    result.summary.critical_load_factor = load.get<double>();
  }
  if (const auto type = field("critical_type"); type.is_string()) {
    result.summary.critical_type = api::value_of(api::kCriticalTypes, type.get<std::string>());
  }
  if (const auto termination = field("termination"); termination.is_string()) {
    result.summary.termination = termination.get<std::string>();
  }
  if (read.is_object() && read.contains("wall_time_s") && read["wall_time_s"].is_number()) {
    result.wall_time_s = read["wall_time_s"].get<double>();
  }
  result.document = std::move(document);
  result.branches = std::move(path.branches);
  result.critical_points = std::move(path.critical_points);
  return result;
}

/// Ends a job in the target with the outcome that it has in the source.
Status end_job(Store& from, Store& to, const Job& job, const Claim& claim) {
  StatusOr<StoredPath> path = from.path(job.id);
  if (!path.ok()) {
    return path.status();
  }
  if (job.state == JobState::dismissed) {
    return to.dismiss(job.id, *job.finished).status();
  }
  if (job.state == JobState::failed) {
    return to.fail(claim, job.failure.value_or(JobFailure{"unknown", "", ""}), *path, *job.finished);
  }
  StatusOr<std::string> document = whole_result(from, job.id);
  if (!document.ok()) {
    return document.status();
  }
  return to.finish(claim, result_of(*std::move(document), *std::move(path)), *job.finished);
}

Status copy_job(Store& from, Store& to, const Job& job) {
  const StatusOr<std::optional<std::string>> request = from.request(job.id);
  if (!request.ok() || !*request) {
    return request.ok() ? missing(job.id) : request.status();
  }
  NewJob copy{job.id, job.title, job.analysis_type, **request, job.created, job.owner, job.content_key};
  copy.annotations = job.annotations;
  copy.attempt = job.attempt;
  copy.crashes = job.crashes;
  const bool ended = is_final(job.state);
  if (ended) {
    copy.annotations.callback.clear();  // the source has told it
  }
  if (ended && job.attempt > 0) {
    copy.attempt = job.attempt - 1;
    copy.lease = Lease{kHolder, *job.finished};
  }
  const StatusOr<Submitted> submitted = to.submit(copy);
  return submitted.ok() && ended ? end_job(from, to, job, {job.id, job.attempt}) : submitted.status();
}

/// Time of the source at which rows of a sweep are stored.
Time stored_at(const SweepRecord& sweep) {
  return sweep.finished.value_or(sweep.started.value_or(sweep.created));
}

/// Claims on all items of a sweep in the target, a pack of points each.
StatusOr<std::vector<ItemClaim>> claim_all(Store& to, const SweepRecord& sweep, std::uint64_t item_points) {
  const Time started = sweep.started.value_or(sweep.created);
  const std::uint64_t most = std::max<std::uint64_t>(1, kPointsAtOnce / item_points);
  const std::uint64_t items = static_cast<std::uint64_t>(sweep.points) / item_points;
  std::vector<ItemClaim> claims;
  for (std::uint64_t claimed = 0; claimed < items; claimed += claims.back().items.count) {
    StatusOr<std::optional<ItemClaim>> claim =
        to.sweeps().claim(sweep.id, most, {kHolder, stored_at(sweep)}, started);
    if (!claim.ok() || !*claim) {
      return claim.ok() ? Status(StatusCode::conflict, "others use the target") : claim.status();
    }
    claims.push_back(**std::move(claim));
  }
  return claims;
}

/// Stores the rows of a sweep. All items are claimed before rows are stored, since items without rows are
/// given out again.
Status copy_rows(Store& from, Store& to, const SweepRecord& sweep, std::uint64_t item_points) {
  const StatusOr<std::vector<ItemClaim>> claims = claim_all(to, sweep, item_points);
  if (!claims.ok()) {
    return claims.status();
  }
  for (const ItemClaim& claim : *claims) {
    const ItemRun& run = claim.items;
    std::vector<PointRow> rows;
    Status status = from.sweeps().each_row(sweep.id, {run.first * item_points, run.count * item_points, {}},
                                           [&](std::uint64_t point, const api::PointOutcome& outcome) {
                                             rows.push_back({point, outcome});
                                             return true;
                                           });
    if (status.ok()) {
      status = to.sweeps().put(claim, rows, stored_at(sweep)).status();
    }
    if (!status.ok()) {
      return status;
    }
  }
  return {};
}

Status copy_sweep(Store& from, Store& to, const SweepRecord& sweep) {
  const StatusOr<std::optional<std::string>> document = from.sweeps().document(sweep.id);
  if (!document.ok() || !*document) {
    return document.ok() ? missing(sweep.id) : document.status();
  }
  const api::SweepOutcome read = api::read_sweep(**document);
  const std::uint64_t item_points = read.sweep ? read.sweep->item_size() : 1;
  NewSweep copy{sweep.id, sweep.title, **document, sweep.points, sweep.created, sweep.owner};
  copy.item_points = static_cast<std::int64_t>(item_points);
  copy.analysis_type = sweep.analysis_type;
  copy.annotations = sweep.annotations;
  const bool ended = is_final(sweep.state);
  if (ended) {
    copy.annotations.callback.clear();
  }
  if (const StatusOr<Submitted> submitted = to.sweeps().submit(copy); !submitted.ok()) {
    return submitted.status();
  }
  if (Status status = sweep.done() > 0 ? copy_rows(from, to, sweep, item_points) : Status(); !status.ok()) {
    return status;
  }
  return sweep.state == JobState::dismissed ? to.sweeps().dismiss(sweep.id, *sweep.finished).status()
                                            : Status();
}

/// Whether an entry of the target has all that the source has.
bool is_whole(const Job& source, const Job& target) {
  return is_final(target.state) || !is_final(source.state);
}
bool is_whole(const SweepRecord& source, const SweepRecord& target) {
  return is_final(target.state) || (!is_final(source.state) && target.done() >= source.done());
}

/// Whether the target has the whole entry; an entry that lacks something is removed.
template <class Record, class Remove>
StatusOr<bool> is_there(const Record& source, const StatusOr<std::optional<Record>>& target,
                        const Remove& remove) {
  if (!target.ok()) {
    return target.status();
  }
  if (!*target) {
    return false;
  }
  if (is_whole(source, **target)) {
    return true;
  }
  const StatusOr<bool> removed = remove();
  return removed.ok() ? StatusOr<bool>(false) : removed.status();
}

StatusOr<bool> remove_from(Store& to, const std::string& id) { return to.remove(id); }
/// Removes a sweep with its rows, so that its id is free.
StatusOr<bool> remove_from(SweepStore& to, const std::string& id) {
  StatusOr<bool> more = to.remove(id);
  while (more.ok() && *more) {
    more = to.purge(static_cast<int>(kPointsAtOnce));
  }
  return more;
}

/// Copies the idempotency keys of an entry. The target keeps those that it has.
template <class AnyStore>
Status copy_keys(AnyStore& from, AnyStore& to, const std::string& id) {
  const StatusOr<std::vector<UsedKey>> keys = from.keys(id);
  if (!keys.ok()) {
    return keys.status();
  }
  for (const UsedKey& key : *keys) {
    if (Status status = to.add_key(id, key); !status.ok()) {
      return status;
    }
  }
  return {};
}

/// Copies an entry; returns false when the target had it.
template <class Record, class AnyStore, class Copy>
StatusOr<bool> copy_one(AnyStore& from, AnyStore& to, const std::string& id, const Copy& copy) {
  const StatusOr<std::optional<Record>> source = from.get(id);
  if (!source.ok() || !*source) {
    return source.ok() ? missing(id) : source.status();
  }
  const StatusOr<bool> there = is_there<Record>(**source, to.get(id), [&] { return remove_from(to, id); });
  if (!there.ok()) {
    return there.status();
  }
  Status status = *there ? Status() : copy(**source);
  if (status.ok()) {
    status = copy_keys(from, to, id);
  }
  return status.ok() ? StatusOr<bool>(!*there) : Status(status.code(), id + ": " + status.message());
}

}  // namespace

Status copy_store(Store& from, Store& to, CopyCounts& counts,
                  const std::function<void(const CopyCounts&)>& tell) {
  const StatusOr<std::vector<Entry>> entries = entries_of(from);
  if (!entries.ok()) {
    return entries.status();
  }
  counts.all = static_cast<std::int64_t>(entries->size());
  for (const Entry& entry : *entries) {
    const StatusOr<bool> copied =
        entry.sweep
            ? copy_one<SweepRecord>(from.sweeps(), to.sweeps(), entry.id,
                                    [&](const SweepRecord& sweep) { return copy_sweep(from, to, sweep); })
            : copy_one<Job>(from, to, entry.id, [&](const Job& job) { return copy_job(from, to, job); });
    if (!copied.ok()) {
      return copied.status();
    }
    (*copied ? entry.sweep ? counts.sweeps : counts.jobs : counts.there) += 1;
    tell(counts);
  }
  return {};
}

}  // namespace snapthrough::server
