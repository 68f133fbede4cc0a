/// @file
/// Processes that are stopped: for good in an orderly way, or for longer than their lease.

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <thread>

#include "tests/server/support/client.h"
#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

class Stopped : public testing::Test {
 protected:
  std::unique_ptr<Process> serve(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{
        "serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db"), "--workers", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto service = std::make_unique<Process>(folder_, arguments);
    port_ = listening_port(*service);
    EXPECT_GT(port_, 0) << service->err();
    return service;
  }
  std::string submit(const std::string& body) const {
    return post(port_, "/v1/jobs", body, {"Content-Type: application/json", "Prefer: respond-async"})
        .header("Location");
  }
  void submit_until_gone(const std::string& name, std::mutex& mutex, std::set<std::string>& told) const {
    try {
      for (int n = 0; n < 100'000; ++n) {
        const std::string job = submit(column_request(name + "-" + std::to_string(n)));
        const std::lock_guard guard(mutex);
        told.insert(job);
      }
    } catch (const std::system_error&) {
      const std::lock_guard guard(mutex);
      told.erase("");  // requests that were not answered any more, for nobody listens
    }
  }
  [[nodiscard]] json status(const std::string& job, const Headers& headers = {}) const {
    return json::parse(get(port_, job, headers).body);
  }
  bool wait_running(const std::string& job) const {
    return eventually([&] { return status(job)["status"] == "running"; });
  }

  TempDir folder_;
  int port_ = 0;
};

TEST_F(Stopped, AWorkerThatSleptPastItsLeaseDoesNotFinishThatAttempt) {
  const auto service = serve({"--lease-s", "1", "--max-crashes", "1000"});  // a lease may be lost for less
  const std::string job = submit(endless_request());
  ASSERT_TRUE(wait_running(job)) << status(job).dump();
  service->signal(SIGSTOP);
  std::this_thread::sleep_for(milliseconds(2500));
  service->signal(SIGCONT);
  EXPECT_TRUE(eventually([&] { return status(job)["attempt"] >= 2; })) << status(job).dump();
  EXPECT_EQ(call(port_, "POST", job + "/dismiss", "", {}).status, 200);
  EXPECT_EQ(service->err().find("\"status\":\"successful\""), std::string::npos);
}

TEST_F(Stopped, DismissingStopsARunningJob) {
  const auto service = serve();
  const std::string job = submit(endless_request());
  ASSERT_TRUE(wait_running(job));
  EXPECT_EQ(json::parse(call(port_, "POST", job + "/dismiss", "", {}).body)["status"], "dismissed");
  EXPECT_EQ(call(port_, "POST", job + "/dismiss", "", {}).status, 200) << "repeatable";
  EXPECT_TRUE(eventually([&] {
    return get(port_, "/metrics").body.find("snapthrough_jobs_running 0") != std::string::npos;
  })) << "it would go on for minutes";
  EXPECT_EQ(get(port_, job + "/result").status, 404);
  EXPECT_EQ(call(port_, "DELETE", job, "", {}).status, 204);
  EXPECT_EQ(get(port_, job).status, 410);
}

/// The end does not wait for the running job, which goes on for minutes.
TEST_F(Stopped, SigtermUnderLoadLosesNothing) {
  auto service = serve();
  const std::string running = submit(endless_request());
  ASSERT_TRUE(wait_running(running));
  std::mutex mutex;
  std::set<std::string> told;
  std::vector<std::jthread> clients;
  for (int client = 0; client < 4; ++client) {
    clients.emplace_back([&, client] { submit_until_gone("c" + std::to_string(client), mutex, told); });
  }
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard guard(mutex);
    return told.size() >= 100;
  }));
  service->signal(SIGTERM);
  EXPECT_TRUE(eventually([&] { return service->has_ended(); }));
  EXPECT_EQ(service->wait(), 0);
  clients.clear();
  service = serve();
  for (const std::string& job : told) {
    EXPECT_EQ(status(job, {"Prefer: wait=60"})["status"], "successful") << job;
  }
  ASSERT_TRUE(wait_running(running)) << status(running).dump();
  EXPECT_GE(status(running)["attempt"], 2);
  call(port_, "DELETE", running, "", {});
}

}  // namespace
}  // namespace snapthrough::server::test
