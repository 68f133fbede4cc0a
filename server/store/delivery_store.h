#pragma once
/// @file
/// What the service needs from a database to tell callbacks. Same promises as Store (server/store/store.h).

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/environment.h"
#include "server/status.h"

namespace snapthrough::server {

/// The end of a job or sweep that its callback has not been told.
struct Delivery {
  std::int64_t number = 0;  ///< another for each end
  std::string id;           ///< of the job or sweep
  bool sweep = false;
  std::string address;
  int attempts = 0;  ///< that failed
};

/// @brief The deliveries that wait. Whatever verb ends a job or sweep with a callback adds one, which is due
/// at once. It goes with its job or sweep when that is removed, and when a sweep is tried again.
class DeliveryStore {
 public:
  DeliveryStore() = default;
  DeliveryStore(const DeliveryStore&) = delete;
  DeliveryStore& operator=(const DeliveryStore&) = delete;
  DeliveryStore(DeliveryStore&&) = delete;
  DeliveryStore& operator=(DeliveryStore&&) = delete;
  virtual ~DeliveryStore() = default;

  /// The delivery to addresses of an origin ("https://host") that is due for the longest time; empty when
  /// none is. It is the caller's: nobody else is given it for as long as `hold`.
  virtual StatusOr<std::optional<Delivery>> next(std::string_view origin, std::chrono::milliseconds hold,
                                                 Time now) = 0;
  /// Notes an attempt that failed; the next is due after that pause. Survives the death of the process.
  virtual Status postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) = 0;
  /// Removes a delivery, done or given up. Survives the death of the process.
  virtual Status remove(std::int64_t number) = 0;
  virtual StatusOr<std::int64_t> waiting() = 0;
};

}  // namespace snapthrough::server
