/// Keys of one job, and refusals of keys.

#include <nlohmann/json.hpp>
#include <utility>

#include "server/digest.h"
#include "server/resources/documents.h"
#include "server/resources/job_key.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {

Response Routes::create_job_key(const Request& request, const std::string& id) {
  if (request.owner.empty()) {
    return simple_problem(request, 409, "no-keys", "No keys",
                          "This service asks for no keys: the job is read without one.");
  }
  const StatusOr<std::optional<Job>> job = jobs_.get(id, request.owner);
  if (!job.ok() || !job->has_value()) {
    return job.ok() ? job_missing(request, id) : store_trouble(request, job.status());
  }
  const std::string key = new_job_key(jobs_.environment());
  const StatusOr<bool> stored = jobs_.store().set_key(id, sha256_hex(key));
  if (!stored.ok()) {
    return store_trouble(request, stored.status());
  }
  if (!*stored) {  // deleted meanwhile
    return job_missing(request, id);
  }
  Response response = json_response(201, nlohmann::ordered_json{{"key", key}, {"job", id}}.dump());
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

std::optional<Response> Routes::admit_job_key(Request& request, const std::string& id) {
  if (request.job_key_sha256.empty()) {
    return std::nullopt;
  }
  StatusOr<std::optional<std::string>> owner = jobs_.store().owner_by_key(id, request.job_key_sha256);
  if (!owner.ok()) {
    return store_trouble(request, owner.status());
  }
  if (!owner->has_value()) {
    return unauthorized(request, "unauthorized", "Unauthorized",
                        "The key is that of one job, and not of this one. It ends when the job is removed or "
                        "gets another key.");
  }
  request.owner = *std::move(owner).value();
  return std::nullopt;
}

}  // namespace snapthrough::server::http
