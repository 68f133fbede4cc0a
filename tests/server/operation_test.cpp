/// @file
/// The real service as its operator sees it: how it stops, what it refuses at the start, what a signal
/// changes.

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "server/digest.h"
#include "tests/server/support/client.h"
#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

const Headers kAsync{"Content-Type: application/json", "Prefer: respond-async"};

class Operation : public testing::Test {
 protected:
  std::unique_ptr<Process> serve(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{
        "serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db"), "--workers", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto service = std::make_unique<Process>(folder_, arguments);
    port_ = listening_port(*service);
    EXPECT_GT(port_, 0) << service->err();
    return service;
  }
  /// What `serve` says on its error stream when it refuses to start with this in the environment.
  std::string refused_with(const std::string& name, const std::string& value) {
    ::setenv(name.c_str(), value.c_str(), 1);
    Process service(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db")});
    ::unsetenv(name.c_str());
    EXPECT_EQ(service.wait(), 1);
    return service.err();
  }
  void write_keys(const std::vector<std::string>& owners, const std::string& more = "") const {
    std::string text = more;
    for (const std::string& owner : owners) {
      text += "\n[[keys]]\nowner = \"" + owner + "\"\nsha256 = \"" + sha256_hex("key of " + owner) + "\"\n";
    }
    write_file(folder_.file("a.toml"), text);
  }
  [[nodiscard]] int status_for(const std::string& owner) const {
    return get(port_, "/v1/jobs", {"Authorization: Bearer key of " + owner}).status;
  }
  static bool wait_for_log(const Process& service, const std::string& text) {
    return eventually([&] { return service.err().find(text) != std::string::npos; });
  }
  /// Times of the log lines that satisfy a condition, in seconds of the day.
  template <class Condition>
  static std::vector<double> times_of(const Process& service, const Condition& holds) {
    std::vector<double> times;
    std::istringstream lines(service.err());
    for (std::string line; std::getline(lines, line);) {
      const json entry = json::parse(line, nullptr, false);
      if (entry.is_object() && holds(entry)) {
        const std::string time = entry["time"];
        times.push_back(std::stod(time.substr(11, 2)) * 3600 + std::stod(time.substr(14, 2)) * 60 +
                        std::stod(time.substr(17, 9)));
      }
    }
    return times;
  }

  TempDir folder_;
  int port_ = 0;
};

/// The delay is longer than the test; a second signal ends it.
TEST_F(Operation, FromSigtermOnItIsNotReadyAndAnswersUntilItIsDrained) {
  const auto service = serve({"--drain-delay-s", "3600"});
  const std::string job = post(port_, "/v1/jobs", column_request()).header("Location");
  const std::string sweep = post(port_, "/v1/sweeps", column_sweep(1000)).header("Location");
  EXPECT_EQ(call(port_, "POST", sweep + "/dismiss", "", {}).status, 200);
  service->signal(SIGTERM);
  ASSERT_TRUE(wait_for_log(*service, "\"stopping\""));
  EXPECT_EQ(Process(folder_, {"health", "127.0.0.1:" + std::to_string(port_), "--ready"}).wait(), 1);
  const Reply ready = get(port_, "/readyz");
  EXPECT_EQ(ready.status, 503);
  EXPECT_THAT(ready.body, HasSubstr("The service is stopping."));
  EXPECT_EQ(get(port_, "/livez").status, 200);
  EXPECT_EQ(get(port_, job + "/result").status, 200);
  for (const char* path : {"/v1/jobs", "/v1/sweeps"}) {
    const std::string body = path == std::string("/v1/jobs") ? column_request("new") : column_sweep(3);
    const Reply refused = post(port_, path, body);
    EXPECT_EQ(refused.status, 503);
    EXPECT_FALSE(refused.header("Retry-After").empty());
    EXPECT_EQ(json::parse(refused.body)["type"], "urn:snapthrough:problem:not-ready") << refused.body;
  }
  EXPECT_EQ(call(port_, "POST", sweep + "/retry", "", {}).status, 503);
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(), 1000 + SIGTERM);
}

TEST_F(Operation, WhatRunsGoesOnDuringTheDelayAndIsGivenBackAfterIt) {
  const auto service = serve({"--drain-delay-s", "1"});
  const std::string job = post(port_, "/v1/jobs", endless_request(), kAsync).header("Location");
  ASSERT_TRUE(eventually([&] { return json::parse(get(port_, job).body)["status"] == "running"; }));
  Socket waiting(port_);
  waiting.send("GET " + job + " HTTP/1.1\r\nHost: localhost\r\nPrefer: wait=60\r\n\r\n");
  service->signal(SIGTERM);
  EXPECT_EQ(json::parse(waiting.receive().body)["status"], "accepted") << "told when it was given back";
  EXPECT_EQ(service->wait(), 0);
  const auto stopping = times_of(*service, [](const json& entry) { return entry["event"] == "stopping"; });
  const auto given_back = times_of(
      *service, [](const json& entry) { return entry["event"] == "job" && entry["status"] == "accepted"; });
  ASSERT_EQ(stopping.size(), 1U);
  ASSERT_EQ(given_back.size(), 2U) << "it was accepted when it was handed in, too";
  const double midnight = given_back[1] < stopping[0] ? 86'400.0 : 0.0;
  EXPECT_GE(given_back[1] - stopping[0] + midnight, 0.99) << service->err();
}

TEST_F(Operation, ASecondSigtermEndsItAtOnce) {
  const auto service = serve({"--drain-delay-s", "60"});
  service->signal(SIGTERM);
  ASSERT_TRUE(wait_for_log(*service, "\"stopping\""));
  service->signal(SIGHUP);
  std::this_thread::sleep_for(milliseconds(100));
  EXPECT_EQ(get(port_, "/livez").status, 200) << "SIGHUP means nothing any more";
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(), 1000 + SIGTERM);
}

TEST_F(Operation, AMisspeltVariableIsRefusedWithTheNearestName) {
  EXPECT_THAT(refused_with("SNAPTHROUGH_WORKER", "2"),
              HasSubstr("SNAPTHROUGH_WORKER: there is no such setting; the nearest is SNAPTHROUGH_WORKERS"));
  EXPECT_THAT(refused_with("SNAPTHROUGH_MAX_QUEU", "2"), HasSubstr("the nearest is SNAPTHROUGH_MAX_QUEUE"));
  EXPECT_THAT(refused_with("SNAPTHROUGH_WORKERS", "x"), HasSubstr("SNAPTHROUGH_WORKERS: expected a whole"));
  write_file(folder_.file("a.toml"), "wokers = 1\n");
  EXPECT_THAT(refused_with("SNAPTHROUGH_CONFIG", folder_.file("a.toml")),
              HasSubstr("a.toml:1: wokers: there is no such setting; the nearest is workers"));
}

TEST_F(Operation, SighupReadsTheKeysAgain) {
  write_keys({"ann", "bob"});
  const auto service = serve({"--config", folder_.file("a.toml")});
  EXPECT_EQ(status_for("bob"), 200);
  EXPECT_EQ(status_for("eve"), 401);
  Socket kept(port_);
  const std::string request =
      "GET /v1/jobs HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer key of bob\r\n\r\n";
  kept.send(request);
  EXPECT_EQ(kept.receive().status, 200);
  write_keys({"ann", "eve"}, "max_queue = 7\n");
  service->signal(SIGHUP);
  ASSERT_TRUE(wait_for_log(*service, "\"reload\""));
  EXPECT_EQ(status_for("ann"), 200);
  EXPECT_EQ(status_for("eve"), 200);
  EXPECT_EQ(status_for("bob"), 401);
  kept.send(request);
  EXPECT_EQ(kept.receive().status, 401) << "on an open connection, too";
  EXPECT_TRUE(wait_for_log(*service, "used from the next start on")) << "the queue's length is not reloaded";
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(), 0);
}

TEST_F(Operation, AFileThatIsBrokenLeavesTheKeysAsTheyAre) {
  write_keys({"ann"});
  const auto service = serve({"--config", folder_.file("a.toml")});
  const auto reload = [&](const std::string& text, const std::string& said) {
    write_file(folder_.file("a.toml"), text);
    service->signal(SIGHUP);
    EXPECT_TRUE(wait_for_log(*service, said)) << service->err();
    EXPECT_EQ(status_for("ann"), 200);
    EXPECT_EQ(get(port_, "/v1/jobs").status, 401);
  };
  reload("[[keys]\nowner = ", "Error while parsing");
  reload("[[keys]]\nowner = \"ann\"\nsha256 = \"1\"\n", "must be 64 lower-case hexadecimal digits");
  reload("workers = 2\n", "whether keys are asked for at all");
  EXPECT_THAT(service->err(), Not(HasSubstr("\"level\":\"info\",\"event\":\"reload\"")));
}

TEST_F(Operation, SighupWithoutAFileEndsItLikeSigterm) {
  const auto service = serve();
  service->signal(SIGHUP);
  EXPECT_EQ(service->wait(), 0);
  EXPECT_THAT(service->err(), HasSubstr("\"stopped\""));
}

}  // namespace
}  // namespace snapthrough::server::test
