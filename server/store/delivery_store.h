#pragma once
/// @file
/// Verbs of a store of deliveries to callbacks. Thread safety, atomicity and time: see Store (store/store.h).

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/environment.h"
#include "server/status.h"

namespace snapthrough::server {

/// End of a job or sweep that has not been posted to its callback.
struct Delivery {
  std::int64_t number = 0;  ///< unique for each end
  std::string id;           ///< id of the job or sweep
  bool sweep = false;
  std::string address;
  int attempts = 0;   ///< attempts that failed
  std::string owner;  ///< owner of the job or sweep
};

/// What the caller of DeliveryStore::next() is sending.
struct UnderWay {
  std::vector<std::int64_t> numbers;  ///< deliveries that it has
  std::vector<std::string> owners;    ///< owners of which it takes no more now
};

/// @brief Deliveries that wait. A verb that ends a job or sweep with a callback adds a delivery that is due
/// at once. A delivery goes when its job or sweep is removed, or its sweep is tried again.
class DeliveryStore {
 public:
  DeliveryStore() = default;
  DeliveryStore(const DeliveryStore&) = delete;
  DeliveryStore& operator=(const DeliveryStore&) = delete;
  DeliveryStore(DeliveryStore&&) = delete;
  DeliveryStore& operator=(DeliveryStore&&) = delete;
  virtual ~DeliveryStore() = default;

  /// Delivery to an address of the origin ("https://host") that has been due for the longest time, of those
  /// that are not under way, nor of an owner that is named there; empty when none is due. No other process
  /// gets it for as long as `hold`.
  virtual StatusOr<std::optional<Delivery>> next(std::string_view origin, const UnderWay& under_way,
                                                 std::chrono::milliseconds hold, Time now) = 0;
  /// Returns what the other next() returns to a caller that is sending nothing.
  StatusOr<std::optional<Delivery>> next(std::string_view origin, std::chrono::milliseconds hold, Time now) {
    return next(origin, UnderWay{}, hold, now);
  }
  /// Counts a failed attempt; the delivery is due again after `pause`. Survives the death of the process.
  virtual Status postpone(std::int64_t number, std::chrono::milliseconds pause, Time now) = 0;
  /// Removes a delivery that was made or given up. Survives the death of the process.
  virtual Status remove(std::int64_t number) = 0;
  virtual StatusOr<std::int64_t> waiting() = 0;
};

}  // namespace snapthrough::server
