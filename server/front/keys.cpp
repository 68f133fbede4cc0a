#include "server/front/keys.h"

#include <mutex>

#include "server/digest.h"
#include "server/resources/job_key.h"

namespace snapthrough::server::http {

void KeyRing::replace(std::vector<ApiKey> keys) {
  const std::lock_guard guard(mutex_);
  keys_ = std::move(keys);
}

namespace {

/// Returns the key of a request. Hops (Grasshopper) cannot send bearer keys; its own header is read when
/// there is no Authorization.
std::optional<std::string_view> key_of(const Request& request) {
  const std::optional<std::string_view> value = request.header("Authorization");
  if (!value) {
    return request.header("RhinoComputeKey");
  }
  const std::size_t space = value->find(' ');
  if (space == std::string_view::npos || !equal_ignoring_case(value->substr(0, space), "Bearer")) {
    return std::nullopt;
  }
  return value->substr(space + 1);
}

}  // namespace

Access KeyRing::access(const Request& request, Time now) const {
  Access access;
  if (open()) {
    access.owner = "";
    access.scopes = Scopes::all();
    return access;
  }
  const std::optional<std::string_view> given = key_of(request);
  if (!given) {
    return access;
  }
  const std::string_view key = trimmed(*given);
  const std::string digest = sha256_hex(key);
  const std::shared_lock guard(mutex_);
  const ApiKey* known = nullptr;
  for (const ApiKey& one : keys_) {  // compares all keys, so that the time reveals nothing
    if (equal_in_constant_time(one.sha256, digest)) {
      known = &one;
    }
  }
  if (known == nullptr) {
    access.job_key_sha256 = is_job_key(key) ? digest : "";
  } else if (known->expires && now >= *known->expires) {
    access.expired = known->expires;
  } else {
    access.owner = known->owner;
    access.scopes = known->scopes;
  }
  return access;
}

}  // namespace snapthrough::server::http
