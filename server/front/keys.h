#pragma once
/// @file
/// Who may use the service.

#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// A bearer key as it is configured: its digest, never the key.
struct ApiKey {
  std::string owner;   ///< name of whom it was given to; jobs belong to it
  std::string sha256;  ///< of the key, 64 lower-case hexadecimal digits
};

/// @brief The keys that are accepted. Thread-safe.
class KeyRing {
 public:
  explicit KeyRing(std::vector<ApiKey> keys = {}) : open_(keys.empty()), keys_(std::move(keys)) {}

  /// Without keys everybody may do everything, and jobs have no owner. Does not change.
  [[nodiscard]] bool open() const { return open_; }
  /// These are accepted from now on, and no others. @pre they are empty exactly when open()
  void replace(std::vector<ApiKey> keys);
  /// The owner of the key that came with the request (Authorization: Bearer, else RhinoComputeKey); nothing
  /// when it has none that is known.
  [[nodiscard]] std::optional<std::string> owner(const Request& request) const;

 private:
  const bool open_;
  mutable std::shared_mutex mutex_;
  std::vector<ApiKey> keys_;
};

}  // namespace snapthrough::server::http
