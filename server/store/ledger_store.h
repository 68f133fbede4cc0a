#pragma once
/// @file
/// Records of what owners used and did, which outlive the jobs and sweeps. Thread safety, durability,
/// atomicity and time: see Store (store/store.h).

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "server/status.h"
#include "server/store/admission.h"

namespace snapthrough::server {

/// What an owner's jobs and sweeps with one label used in one hour, counted when their outcomes were stored.
struct UsageRow {
  Time hour;                ///< its beginning, UTC
  std::string label;        ///< empty: work without a label
  std::int64_t jobs = 0;    ///< that ended successful or failed
  std::int64_t points = 0;  ///< points of sweeps, computed or taken from other sweeps
  WorkUsage work;
};

/// Selects rows of usage.
struct UsageQuery {
  std::string owner;
  Time from;  ///< only hours that begin at or after it
  Time to;    ///< and before it
  std::optional<std::string> label = {};
  int limit = 1000;  ///< > 0
};

/// What happened to a job or sweep.
enum class AuditEvent { submitted, dismissed, retried, deleted, retired };

/// Names in the interface and in databases, in the order of AuditEvent. "retired": the service deleted it at
/// the end of its time of retention.
inline constexpr std::array<std::string_view, 5> kAuditEventNames{"submitted", "dismissed", "retried",
                                                                  "deleted", "retired"};
constexpr std::string_view to_string(AuditEvent event) {
  return kAuditEventNames.at(static_cast<std::size_t>(event));
}

struct AuditEntry {
  std::int64_t number = 0;  ///< in the order of events
  Time at;
  AuditEvent event = AuditEvent::submitted;
  bool sweep = false;  ///< false: a job
  std::string id;      ///< id of the job or sweep
};

/// Selects events of an owner, the newest first.
struct AuditQuery {
  std::string owner;
  std::optional<Time> from = {};
  std::optional<Time> to = {};              ///< only earlier events
  std::optional<std::int64_t> before = {};  ///< only events with smaller numbers
  int limit = 100;                          ///< > 0
};

/// What an owner has of what quotas bound, at this moment.
struct Balance {
  Usage has;
  std::chrono::seconds until_more{0};  ///< time after which points of this hour are given back; 0: none are
};

/// Usage and events. Events of one owner are stored with what they tell of, in one transaction.
class LedgerStore {
 public:
  LedgerStore() = default;
  LedgerStore(const LedgerStore&) = delete;
  LedgerStore& operator=(const LedgerStore&) = delete;
  LedgerStore(LedgerStore&&) = delete;
  LedgerStore& operator=(LedgerStore&&) = delete;
  virtual ~LedgerStore() = default;

  /// Rows in the order of hours and labels, one more than the limit when there are more.
  virtual StatusOr<std::vector<UsageRow>> usage(const UsageQuery& query) = 0;
  /// Events, one more than the limit when there are more.
  virtual StatusOr<std::vector<AuditEntry>> events(const AuditQuery& query) = 0;
  /// The deletion of a job or sweep of the owner; empty when none is known.
  virtual StatusOr<std::optional<AuditEntry>> deletion(std::string_view id, std::string_view owner) = 0;
  virtual StatusOr<Balance> balance(std::string_view owner, Time now) = 0;
  /// Removes at most `most` events and rows of usage that are older than `age`; true when there may be more.
  virtual StatusOr<bool> forget(std::chrono::seconds age, int most, Time now) = 0;
};

}  // namespace snapthrough::server
