#include "server/front/keys.h"

#include <mutex>

#include "server/digest.h"

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

std::optional<std::string> KeyRing::owner(const Request& request) const {
  if (open()) {
    return "";
  }
  const std::optional<std::string_view> given = key_of(request);
  if (!given) {
    return std::nullopt;
  }
  const std::string digest = sha256_hex(trimmed(*given));
  std::optional<std::string> owner;
  const std::shared_lock guard(mutex_);
  for (const ApiKey& key : keys_) {  // compares all keys, so that the time reveals nothing
    if (equal_in_constant_time(key.sha256, digest)) {
      owner = key.owner;
    }
  }
  return owner;
}

}  // namespace snapthrough::server::http
