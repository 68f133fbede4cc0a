#pragma once
/// @file
/// A store of any driver, for tests of what all drivers must do.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/store/store.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {

struct StoreDriver {
  const char* name;
  std::function<StatusOr<std::unique_ptr<Store>>(const TempDir&)> open;
};

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

  TempDir folder_;
  std::unique_ptr<Store> store_;
};

}  // namespace snapthrough::server::test
