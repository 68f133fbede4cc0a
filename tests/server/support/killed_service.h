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
    std::vector<std::string> arguments{
        "serve",         "--listen", "127.0.0.1:0",     "--store", folder_.file("jobs.db"), "--workers", "2",
        "--max-crashes", "50",       "--ballast-bytes", "0"};
    arguments.insert(arguments.end(), more_arguments_.begin(), more_arguments_.end());
    auto service = std::make_unique<Process>(folder_, arguments);
    port_ = listening_port(*service);
    EXPECT_GT(port_, 0) << service->err();
    return service;
  }

  TempDir folder_;
  std::vector<std::string> more_arguments_;
  int port_ = 0;
};

}  // namespace snapthrough::server::test
