#pragma once
/// @file
/// A store of sweeps of which every verb fails as it is told to.

#include <string>
#include <vector>

#include "server/store/sweep_store.h"

namespace snapthrough::server::test {

class FailingSweepStore final : public SweepStore {
 public:
  explicit FailingSweepStore(StatusCode code) : code_(code) {}

  StatusOr<Submitted> submit(const NewSweep&) override { return status(); }
  StatusOr<std::optional<Submitted>> find_key(const IdempotencyKey&, std::string_view) override {
    return status();
  }
  StatusOr<std::vector<UsedKey>> keys(std::string_view) override { return status(); }
  Status add_key(std::string_view, const UsedKey&) override { return status(); }
  StatusOr<std::int64_t> unfinished() override { return status(); }
  StatusOr<std::vector<std::string>> with_items() override { return status(); }
  StatusOr<std::optional<OpenSweep>> open(std::string_view) override { return status(); }
  StatusOr<std::optional<ItemClaim>> claim(std::string_view, std::uint64_t, const Lease&, Time) override {
    return status();
  }
  StatusOr<std::vector<std::int64_t>> renew(const std::vector<ItemClaim>&, Time, Time) override {
    return status();
  }
  StatusOr<SweepRecord> put(const ItemClaim&, const std::vector<PointRow>&, const WorkUsage&, Time) override {
    return status();
  }
  StatusOr<std::int64_t> recover(int, Time) override { return status(); }
  StatusOr<std::int64_t> rescue(std::string_view, int, Time) override { return status(); }
  StatusOr<SweepChange> dismiss(std::string_view, Time) override { return status(); }
  StatusOr<SweepChange> retry(std::string_view, const Quotas&, Time) override { return status(); }
  StatusOr<bool> remove(std::string_view, std::optional<Time>) override { return status(); }
  StatusOr<int> retire(std::chrono::seconds, Time) override { return status(); }
  StatusOr<bool> purge(int) override { return status(); }
  Status forget_keys(std::chrono::seconds, Time) override { return status(); }
  StatusOr<std::optional<SweepRecord>> get(std::string_view) override { return status(); }
  StatusOr<SweepPage> list(const ListQuery&) override { return status(); }
  StatusOr<std::optional<std::string>> document(std::string_view) override { return status(); }
  Status each_row(std::string_view, const PointQuery&,
                  const std::function<bool(std::uint64_t, const api::PointOutcome&)>&) override {
    return status();
  }
  StatusOr<std::vector<std::optional<std::string>>> find_outputs(const std::vector<std::string>&) override {
    return status();
  }

 private:
  [[nodiscard]] Status status() const { return {code_, "the disk /dev/secret is full"}; }
  StatusCode code_;
};

}  // namespace snapthrough::server::test
