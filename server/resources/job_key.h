#pragma once
/// @file
/// The key of one job: its form, and what it permits.

#include <string>
#include <string_view>

#include "server/environment.h"

namespace snapthrough::server::http {

/// Returns a new key: "job_" and 64 lower-case hexadecimal digits, which are 256 random bits.
[[nodiscard]] std::string new_job_key(const Environment& environment);

/// Returns whether a text has the form of new_job_key().
[[nodiscard]] bool is_job_key(std::string_view text);

/// Returns whether a request is one that the key of a job permits, if it is the key of the job that the path
/// names: GET and HEAD of the job's status, result, table.csv, request and events.
[[nodiscard]] bool job_key_permits(std::string_view method, std::string_view path);

}  // namespace snapthrough::server::http
