#pragma once
/// @file
/// The real service on one store, to be killed and started again.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/server/support/process.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {

class KilledServiceTest : public testing::Test {
 protected:
  std::unique_ptr<Process> serve() {
    auto service = std::make_unique<Process>(
        folder_,
        std::vector<std::string>{"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db"),
                                 "--workers", "2", "--max-crashes", "50", "--ballast-bytes", "0"});
    port_ = listening_port(*service);
    EXPECT_GT(port_, 0) << service->err();
    return service;
  }

  TempDir folder_;
  int port_ = 0;
};

}  // namespace snapthrough::server::test
