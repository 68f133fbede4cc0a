#include "server/resources/records.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/csv_field.h"
#include "server/environment.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::ordered_json;

/// A quota with what an owner has of it.
struct Account {
  const char* member;  ///< name in documents
  const char* header;  ///< name in headers
  std::int64_t quota;  ///< 0: none
  std::int64_t has;
  const char* more;  ///< further parameters of the policy
};

std::array<Account, 4> accounts(const Quotas& quotas, const Usage& has) {
  return {
      Account{"jobs_waiting", "jobs-waiting", quotas.jobs_waiting, has.jobs, ""},
      Account{"points_waiting", "points-waiting", quotas.points_waiting, has.points, ""},
      Account{"points_per_hour", "points-per-hour", quotas.points_per_hour, has.points_this_hour, ";w=3600"},
      Account{"bytes_kept", "bytes-kept", quotas.bytes_kept, has.bytes, ";qu=\"content-bytes\""}};
}

double seconds_of(const WorkUsage& usage) { return static_cast<double>(usage.cpu_us) * 1e-6; }

/// Adds the members of a row or of the totals.
void add_counts(const UsageRow& row, ordered_json& document) {
  document["jobs"] = row.jobs;
  document["points"] = row.points;
  document.update(work_json(row.work));
}

UsageRow total_of(std::span<const UsageRow> rows) {
  UsageRow total;
  for (const UsageRow& row : rows) {
    total.jobs += row.jobs;
    total.points += row.points;
    total.work.add(row.work);
  }
  return total;
}

std::string to_text(const ordered_json& document) {
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

ordered_json work_json(const WorkUsage& usage) {
  return {{"cpu_seconds", seconds_of(usage)},
          {"peak_bytes", usage.peak_bytes > 0 ? ordered_json(usage.peak_bytes) : ordered_json()},
          {"factorizations", usage.factorizations}};
}

void add_provenance(const std::string& program, const std::string& request_sha256, Response& response) {
  if (!program.empty()) {
    const ordered_json read = ordered_json::parse(program);
    const auto text = [&](const char* name) { return read.value(name, std::string("unknown")); };
    response.headers.emplace_back("X-Program", text("name") + "/" + text("version") + " (" + text("build") +
                                                   "; " + text("target") + ")");
  }
  if (!request_sha256.empty()) {
    response.headers.emplace_back("X-Request-SHA256", request_sha256);
  }
}

void add_balance(const Quotas& quotas, const Balance& balance, Response& response) {
  std::string policy;
  std::string left;
  for (const Account& account : accounts(quotas, balance.has)) {
    if (account.quota == 0) {
      continue;
    }
    const std::string name = (policy.empty() ? "\"" : ", \"") + std::string(account.header) + "\"";
    policy += name + ";q=" + std::to_string(account.quota) + account.more;
    left += name + ";r=" + std::to_string(std::max<std::int64_t>(0, account.quota - account.has));
    if (account.quota == quotas.points_per_hour && balance.until_more.count() > 0 &&
        std::string_view(account.header) == "points-per-hour") {
      left += ";t=" + std::to_string(balance.until_more.count());
    }
  }
  if (!policy.empty()) {
    response.headers.emplace_back("RateLimit-Policy", policy);
    response.headers.emplace_back("RateLimit", left);
  }
}

std::string usage_document(const UsageQuery& query, std::span<const UsageRow> rows, const Quotas& quotas,
                           const Balance& balance) {
  ordered_json totals;
  add_counts(total_of(rows), totals);
  ordered_json list = ordered_json::array();
  for (const UsageRow& row : rows) {
    ordered_json one{{"hour", rfc3339(row.hour)},
                     {"label", row.label.empty() ? ordered_json() : ordered_json(row.label)}};
    add_counts(row, one);
    list.push_back(std::move(one));
  }
  ordered_json left;
  for (const Account& account : accounts(quotas, balance.has)) {
    left[account.member] = {{"used", account.has},
                            {"quota", account.quota == 0 ? ordered_json() : ordered_json(account.quota)}};
  }
  return to_text({{"owner", query.owner},
                  {"from", rfc3339(query.from)},
                  {"to", rfc3339(query.to)},
                  {"count", rows.size()},
                  {"totals", std::move(totals)},
                  {"rows", std::move(list)},
                  {"balance", std::move(left)}});
}

std::string usage_csv(std::span<const UsageRow> rows) {
  std::string text = "hour,label,jobs,points,cpu_seconds,peak_bytes,factorizations\n";
  for (const UsageRow& row : rows) {
    text += rfc3339(row.hour) + ",";
    api::append_csv_text(text, row.label);
    for (const std::string& number :
         {std::to_string(row.jobs), std::to_string(row.points), ordered_json(seconds_of(row.work)).dump(),
          row.work.peak_bytes > 0 ? std::to_string(row.work.peak_bytes) : std::string(),
          std::to_string(row.work.factorizations)}) {
      text += "," + number;
    }
    text += "\n";
  }
  return text;
}

std::string deletion_sentence(const AuditEntry& entry) {
  const std::string what = entry.sweep ? "The sweep " : "The job ";
  return what + entry.id + " was deleted at " + rfc3339(entry.at) +
         (entry.event == AuditEvent::retired ? ", when its time of retention ended." : " by its owner.");
}

}  // namespace snapthrough::server::http
