#pragma once
/// @file
/// A store of deliveries of which every verb fails as it is told to.

#include "server/store/delivery_store.h"

namespace snapthrough::server::test {

class FailingDeliveryStore final : public DeliveryStore {
 public:
  explicit FailingDeliveryStore(StatusCode code) : code_(code) {}

  using DeliveryStore::next;
  StatusOr<std::optional<Delivery>> next(std::string_view, const UnderWay&, std::chrono::milliseconds,
                                         Time) override {
    return status();
  }
  Status postpone(std::int64_t, std::chrono::milliseconds, Time) override { return status(); }
  Status remove(std::int64_t) override { return status(); }
  StatusOr<std::int64_t> waiting() override { return status(); }

 private:
  [[nodiscard]] Status status() const { return {code_, "the disk /dev/secret is full"}; }
  StatusCode code_;
};

}  // namespace snapthrough::server::test
