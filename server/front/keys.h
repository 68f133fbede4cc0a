#pragma once
/// @file
/// Keys that give access to the service.

#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include "server/environment.h"
#include "server/resources/message.h"
#include "server/resources/scopes.h"

namespace snapthrough::server::http {

/// A configured bearer key, stored as its digest.
struct ApiKey {
  std::string owner;                 ///< owner of the key and of the jobs submitted with it
  std::string sha256;                ///< digest of the key, 64 lower-case hexadecimal digits
  std::optional<Time> expires = {};  ///< instant from which on it is refused; nullopt: never
  Scopes scopes = Scopes::all();     ///< what it permits
};

/// What the key of a request opens.
struct Access {
  std::optional<std::string> owner;  ///< owner of an accepted key; nullopt: none; "": the service has no keys
  Scopes scopes;                     ///< what the accepted key permits; all in a service without keys
  std::optional<Time> expired;       ///< instant at which the key expired; set: `owner` is nullopt
  std::string job_key_sha256;        ///< digest of a key with the form of a job's; "": it has another form
};

/// @brief The accepted keys. Thread-safe.
class KeyRing {
 public:
  explicit KeyRing(std::vector<ApiKey> keys = {}) : open_(keys.empty()), keys_(std::move(keys)) {}

  /// Returns whether the service has no keys: everybody has access, and jobs have no owner. Constant.
  [[nodiscard]] bool open() const { return open_; }
  /// Replaces the accepted keys. @pre keys.empty() == open()
  void replace(std::vector<ApiKey> keys);
  /// Returns what the request's key (Authorization: Bearer, else RhinoComputeKey) opens at a time. A
  /// configured key counts as such whatever its form.
  [[nodiscard]] Access access(const Request& request, Time now) const;

 private:
  const bool open_;
  mutable std::shared_mutex mutex_;
  std::vector<ApiKey> keys_;
};

}  // namespace snapthrough::server::http
