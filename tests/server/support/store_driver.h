#pragma once
/// @file
/// A store of any driver, for tests of what all drivers must do.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/store/store.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {

struct StoreDriver {
  const char* name;
  std::function<StatusOr<std::unique_ptr<Store>>(const TempDir&)> open;
  bool shared = false;  ///< several processes may use a store at the same time
};

inline void PrintTo(const StoreDriver& driver, std::ostream* out) { *out << driver.name; }

/// Every driver there is.
[[nodiscard]] std::vector<StoreDriver> store_drivers();
/// What a test of a driver is called.
inline std::string driver_name(const testing::TestParamInfo<StoreDriver>& driver) {
  return driver.param.name;
}

/// The whole result document; nothing when there is none.
inline std::optional<std::string> result_of(Store& store, std::string_view id) {
  std::string document;
  DocumentPiece piece = *store.result_piece(id, 0, std::string::npos);
  while (!piece.bytes.empty()) {
    document += piece.bytes;
    piece = *store.result_piece(id, document.size(), std::string::npos);
  }
  EXPECT_EQ(document.size(), piece.size);
  return piece.size == 0 ? std::nullopt : std::optional(document);
}

/// A fresh store of the driver that is the parameter.
class StoreTest : public testing::TestWithParam<StoreDriver> {
 protected:
  void SetUp() override { reopen(); }
  void reopen() {
    store_.reset();
    StatusOr<std::unique_ptr<Store>> opened = GetParam().open(folder_);
    ASSERT_TRUE(opened.ok()) << opened.status().message();
    store_ = std::move(opened).value();
  }
  /// What the next process finds, whose predecessor died with leases that end before that time.
  Recovery recover(int max_crashes, Time now) {
    const StatusOr<Recovery> known = store_->recover(max_crashes, now);
    EXPECT_TRUE(known.ok()) << known.status().message();
    const StatusOr<Recovery> found = GetParam().shared ? store_->rescue("next", max_crashes, now) : known;
    EXPECT_TRUE(found.ok()) << found.status().message();
    return found.ok() ? *found : Recovery{};
  }
  std::int64_t recover_sweeps(int max_crashes, Time now) {
    SweepStore& sweeps = store_->sweeps();
    const StatusOr<std::int64_t> known = sweeps.recover(max_crashes, now);
    const StatusOr<std::int64_t> found = GetParam().shared ? sweeps.rescue("next", max_crashes, now) : known;
    EXPECT_TRUE(found.ok()) << found.status().message();
    return found.ok() ? *found : -1;
  }

  TempDir folder_;
  std::unique_ptr<Store> store_;
};

}  // namespace snapthrough::server::test
