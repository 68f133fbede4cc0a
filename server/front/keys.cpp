#include "server/front/keys.h"

#include <mutex>

#include "server/digest.h"

namespace snapthrough::server::http {

void KeyRing::replace(std::vector<ApiKey> keys) {
  const std::lock_guard guard(mutex_);
  keys_ = std::move(keys);
}

std::optional<std::string> KeyRing::owner(const Request& request) const {
  if (open()) {
    return "";
  }
  const std::string_view value = request.header("Authorization").value_or("");
  const std::size_t space = value.find(' ');
  if (space == std::string_view::npos || !equal_ignoring_case(value.substr(0, space), "Bearer")) {
    return std::nullopt;
  }
  const std::string digest = sha256_hex(trimmed(value.substr(space + 1)));
  std::optional<std::string> owner;
  const std::shared_lock guard(mutex_);
  for (const ApiKey& key : keys_) {  // all of them, so that the time does not tell which
    if (equal_in_constant_time(key.sha256, digest)) {
      owner = key.owner;
    }
  }
  return owner;
}

}  // namespace snapthrough::server::http
