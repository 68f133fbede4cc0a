#pragma once
/// @file
/// Keys that give access to the service.

#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// A configured bearer key, stored as its digest.
struct ApiKey {
  std::string owner;   ///< owner of the key and of the jobs submitted with it
  std::string sha256;  ///< digest of the key, 64 lower-case hexadecimal digits
};

/// @brief The accepted keys. Thread-safe.
class KeyRing {
 public:
  explicit KeyRing(std::vector<ApiKey> keys = {}) : open_(keys.empty()), keys_(std::move(keys)) {}

  /// Returns whether the service has no keys: everybody has access, and jobs have no owner. Constant.
  [[nodiscard]] bool open() const { return open_; }
  /// Replaces the accepted keys. @pre keys.empty() == open()
  void replace(std::vector<ApiKey> keys);
  /// Returns the owner of the request's key (Authorization: Bearer, else RhinoComputeKey); nullopt without a
  /// known key.
  [[nodiscard]] std::optional<std::string> owner(const Request& request) const;

 private:
  const bool open_;
  mutable std::shared_mutex mutex_;
  std::vector<ApiKey> keys_;
};

}  // namespace snapthrough::server::http
