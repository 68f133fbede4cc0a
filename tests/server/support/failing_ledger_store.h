#pragma once
/// @file
/// A ledger whose database fails.

#include "server/store/ledger_store.h"

namespace snapthrough::server::test {

/// Every verb returns a status of the code.
class FailingLedgerStore final : public LedgerStore {
 public:
  explicit FailingLedgerStore(StatusCode code) : code_(code) {}

  StatusOr<std::vector<UsageRow>> usage(const UsageQuery&) override { return status(); }
  StatusOr<std::vector<AuditEntry>> events(const AuditQuery&) override { return status(); }
  StatusOr<std::optional<AuditEntry>> deletion(std::string_view, std::string_view) override {
    return status();
  }
  StatusOr<Balance> balance(std::string_view, Time) override { return status(); }
  StatusOr<bool> forget(std::chrono::seconds, int, Time) override { return status(); }

 private:
  [[nodiscard]] Status status() const { return {code_, "the disk /dev/secret is full"}; }
  StatusCode code_;
};

}  // namespace snapthrough::server::test
