/// @file
/// The real program: exit statuses, streams, signals.

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/server/support/client.h"
#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Executable : public testing::Test {
 protected:
  int run(const std::vector<std::string>& arguments, const std::string& input = "") {
    Process process(folder_, arguments, input);
    const int status = process.wait();
    out_ = process.out();
    err_ = process.err();
    return status;
  }
  std::string request_file(const std::string& text) {
    write_file(folder_.file("request.json"), text);
    return folder_.file("request.json");
  }
  /// Starts the service on a free port; waits until it listens.
  std::unique_ptr<Process> serve() {
    auto service = std::make_unique<Process>(
        folder_, std::vector<std::string>{"serve", "--listen", "127.0.0.1:0", "--store",
                                          folder_.file("jobs.db"), "--workers", "1"});
    port_ = listening_port(*service);
    EXPECT_GT(port_, 0) << service->err();
    return service;
  }

  TempDir folder_;
  std::string out_;
  std::string err_;
  int port_ = 0;
};

TEST_F(Executable, SolveWritesTheResult) {
  EXPECT_EQ(run({"solve", request_file(column_request())}), 0) << err_;
  const json result = json::parse(out_);
  EXPECT_TRUE(result["summary"].contains("critical_load_factor"));
  EXPECT_GE(result["diagnostics"]["wall_time_s"].get<double>(), 0.0);
}

TEST_F(Executable, SolveWritesEachWarningToStandardError) {
  ASSERT_EQ(run({"solve", request_file(column_request())}), 0) << err_;
  const json result = json::parse(out_);
  std::string expected;
  for (const json& warning : result["warnings"]) {
    expected += "Warning: " + warning["detail"].get<std::string>() + " [" +
                warning["code"].get<std::string>() + "]\n";
  }
  EXPECT_THAT(expected, HasSubstr("[large_strain]"));
  EXPECT_EQ(err_, expected);
}

TEST_F(Executable, SolveReadsStandardInput) { EXPECT_EQ(run({"solve", "-"}, column_request()), 0) << err_; }

TEST_F(Executable, CheckAcceptsAValidRequest) {
  EXPECT_EQ(run({"check", request_file(column_request())}), 0);
  EXPECT_THAT(out_, HasSubstr("valid"));
  EXPECT_EQ(run({"check", "-"}, column_request()), 0);
}

TEST_F(Executable, AWrongRequestIsStatus2WithOneLineForEachFinding) {
  json wrong = json::parse(column_request());
  wrong["model"]["sections"][0]["EI"] = -1;
  wrong["model"]["members"][0]["end"] = "nowhere";
  for (const char* command : {"solve", "check"}) {
    EXPECT_EQ(run({command, request_file(wrong.dump())}), 2);
    EXPECT_THAT(out_, IsEmpty());
    std::istringstream lines(err_);
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_THAT(line, StartsWith("/model/sections/0/EI: "));
    EXPECT_THAT(line, testing::EndsWith("]"));
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_THAT(line, StartsWith("/model/members/0/end: "));
    EXPECT_FALSE(std::getline(lines, line)) << line;
  }
}

/// A wrong request of each kind, on the command line.
TEST_F(Executable, EveryKindOfBadInputIsStatus2) {
  const auto status = [&](const std::function<void(json&)>& spoil) {
    json wrong = json::parse(column_request());
    spoil(wrong);
    return run({"solve", "-"}, wrong.dump());
  };
  EXPECT_EQ(run({"solve", "-"}, "{\"model\":"), 2);
  EXPECT_THAT(err_, HasSubstr("["));
  EXPECT_EQ(status([](json& d) { d["modell"] = 1; }), 2);
  EXPECT_THAT(err_, StartsWith("/modell: "));
  EXPECT_EQ(status([](json& d) { d["model"]["members"][0]["start"] = "x"; }), 2);
  EXPECT_EQ(status([](json& d) { d["model"]["nodes"][1]["x"] = 0; }), 2);
  EXPECT_EQ(status([](json& d) { d["model"]["sections"][0]["EI"] = -1; }), 2);
  EXPECT_EQ(status([](json& d) { d["model"]["supports"] = json::array(); }), 2);
}

TEST_F(Executable, AnythingElseIsStatus1) {
  EXPECT_EQ(run({"solve", folder_.file("missing.json")}), 1);
  EXPECT_THAT(err_, HasSubstr("missing.json"));
  EXPECT_EQ(run({"solve", "/"}), 1);
  EXPECT_EQ(run({"solve"}), 1);
  EXPECT_EQ(run({"frobnicate"}), 1);
  EXPECT_EQ(run({}), 1);
  EXPECT_EQ(run({"serve", "--listen", "nonsense"}), 1);
  EXPECT_EQ(run({"serve", "--listen", "0.0.0.0:0"}), 1);
  EXPECT_THAT(err_, HasSubstr("listener.host"));
  EXPECT_EQ(run({"serve", "--workers", "0"}), 1);
  EXPECT_EQ(run({"serve", "--log-level", "loud"}), 1);
  EXPECT_EQ(run({"serve", "--listen", "127.0.0.1:0", "--store", "/no/such/folder/x.db"}), 1);
}

TEST_F(Executable, HelpAndVersionAreStatus0) {
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_THAT(out_, HasSubstr("solve"));
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_THAT(out_, StartsWith("snapthrough "));
}

TEST_F(Executable, TheServiceSolvesStopsOnSigtermAndKeepsItsResult) {
  auto service = serve();
  const Reply reply = post(port_, "/v1/jobs", column_request());
  ASSERT_EQ(reply.status, 200) << reply.body;
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(), 0);
  service = serve();
  EXPECT_EQ(get(port_, reply.header("Location") + "/result").body, reply.body);
  service->signal(SIGINT);
  EXPECT_EQ(service->wait(), 0);
}

/// The archive for any Linux starts its program so.
TEST_F(Executable, AServiceThatALoaderStartedHasRunners) {
  const std::string loader = "/lib64/ld-linux-x86-64.so.2";
  if (!std::filesystem::exists(loader)) {
    GTEST_SKIP() << "this machine's loader has another name";
  }
  const Process service(folder_,
                        {"--argv0", SNAPTHROUGH_EXECUTABLE, SNAPTHROUGH_EXECUTABLE, "serve", "--listen",
                         "127.0.0.1:0", "--store", folder_.file("jobs.db"), "--workers", "1"},
                        "", loader);
  const int port = listening_port(service);
  ASSERT_GT(port, 0) << service.err();
  const Reply reply = post(port, "/v1/jobs", column_request());
  EXPECT_EQ(reply.status, 200) << reply.body;
  EXPECT_TRUE(json::parse(reply.body)["summary"].contains("critical_load_factor"));
}

TEST_F(Executable, AKilledServiceKeepsWhatItAcknowledged) {
  auto service = serve();
  std::vector<std::string> jobs;
  for (int i = 0; i < 20; ++i) {
    jobs.push_back(
        post(port_, "/v1/jobs", column_request(), {"Content-Type: application/json", "Prefer: respond-async"})
            .header("Location"));
  }
  service->signal(SIGKILL);
  EXPECT_EQ(service->wait(), 1000 + SIGKILL);
  service = serve();
  for (const std::string& job : jobs) {
    EXPECT_EQ(json::parse(get(port_, job, {"Prefer: wait=60"}).body)["status"], "successful") << job;
  }
}

TEST_F(Executable, ABackupOfARunningServiceIsAStoreThatAnswers) {
  auto service = serve();
  const Reply reply = post(port_, "/v1/jobs", column_request());
  ASSERT_EQ(reply.status, 200);
  const std::string copy = folder_.file("copy.db");
  const Process backup(folder_, {"backup", "--store", folder_.file("jobs.db"), copy});
  ASSERT_EQ(const_cast<Process&>(backup).wait(), 0) << backup.err();
  service->signal(SIGKILL);
  service->wait();
  Process restored(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", copy});
  EXPECT_EQ(get(listening_port(restored), reply.header("Location") + "/result").body, reply.body);
}

TEST_F(Executable, SettingsComeFromFileEnvironmentAndFlagsInThatOrder) {
  write_file(folder_.file("a.toml"),
             "workers = 1\nmax_queue = 7\nlog_level = \"info\"\nlisten = \"127.0.0.1:0\"\n");
  ::setenv("SNAPTHROUGH_MAX_QUEUE", "8", 1);
  Process service(folder_, {"serve", "--config", folder_.file("a.toml"), "--workers", "2", "--store",
                            folder_.file("jobs.db")});
  const int port = listening_port(service);
  ::unsetenv("SNAPTHROUGH_MAX_QUEUE");
  const json limits = json::parse(get(port, "/v1/limits").body);
  EXPECT_EQ(limits["queue"], 8);
  EXPECT_EQ(limits["workers"], 2);
}

TEST_F(Executable, AWrongSettingIsNamedWithItsPlace) {
  write_file(folder_.file("a.toml"), "workers = 1\nworkerss = 2\nmax_queue = \"many\"\n");
  EXPECT_EQ(run({"serve", "--config", folder_.file("a.toml")}), 1);
  EXPECT_THAT(err_, HasSubstr("a.toml:2: workerss: there is no such setting"));
  EXPECT_THAT(err_, HasSubstr("a.toml:3: max_queue: expected a whole number, got many"));
  EXPECT_EQ(run({"serve", "--max-queue", "0"}), 1);
  EXPECT_THAT(err_, HasSubstr("jobs.queue"));
}

TEST_F(Executable, HealthAsksTheService) {
  auto service = serve();
  const std::string address = "127.0.0.1:" + std::to_string(port_);
  EXPECT_EQ(Process(folder_, {"health", address}).wait(), 0);
  EXPECT_EQ(Process(folder_, {"health", address, "--ready"}).wait(), 0);
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(), 0);
  EXPECT_EQ(Process(folder_, {"health", address}).wait(), 1);
}

}  // namespace
}  // namespace snapthrough::server::test
