#pragma once
/// @file
/// Documents and headers about what was used, what is left, what was deleted, and what made an answer.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job.h"
#include "server/resources/message.h"
#include "server/store/ledger_store.h"

namespace snapthrough::server::http {

/// Returns `{"cpu_seconds", "peak_bytes", "factorizations"}`; peak_bytes is null where it is not known.
[[nodiscard]] nlohmann::ordered_json work_json(const WorkUsage& usage);

/// @brief Adds the headers X-Program and X-Request-SHA256, for forms of an answer that cannot hold them.
/// @param program api::program_text(); "": not known, no header
void add_provenance(const std::string& program, const std::string& request_sha256, Response& response);

/// @brief Adds the headers RateLimit-Policy and RateLimit (IETF draft "RateLimit header fields for HTTP") for
/// each quota that is set.
void add_balance(const Quotas& quotas, const Balance& balance, Response& response);

/// Returns the document of GET /v1/usage.
[[nodiscard]] std::string usage_document(const UsageQuery& query, std::span<const UsageRow> rows,
                                         const Quotas& quotas, const Balance& balance);
/// Returns the rows of usage as CSV.
[[nodiscard]] std::string usage_csv(std::span<const UsageRow> rows);

/// Returns a sentence about a deletion.
[[nodiscard]] std::string deletion_sentence(const AuditEntry& entry);

}  // namespace snapthrough::server::http
