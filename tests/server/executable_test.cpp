/// @file
/// The real program: exit statuses, streams, signals.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/server/support/client.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_file(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// The program, started with its streams in files of a folder.
class Process {
 public:
  Process(const TempDir& folder, const std::vector<std::string>& arguments, const std::string& input = "")
      : out_(folder.file("out")), err_(folder.file("err")) {
    write_file(folder.file("in"), input);
    std::vector<std::string> words{SNAPTHROUGH_EXECUTABLE};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
      argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const std::string in = folder.file("in");
    id_ = ::fork();
    if (id_ == 0) {
      redirect(in, O_RDONLY, STDIN_FILENO);
      redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
      redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
  }
  ~Process() {
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  Process(Process&&) = delete;
  Process& operator=(Process&&) = delete;

  void signal(int number) const { ::kill(id_, number); }
  /// Exit status; 1000 plus the signal when one ended it.
  int wait() {
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  [[nodiscard]] std::string out() const { return read_file(out_); }
  [[nodiscard]] std::string err() const { return read_file(err_); }

 private:
  static void redirect(const std::string& path, int flags, int target) {
    ::dup2(::open(path.c_str(), flags, 0600), target);
  }
  std::string out_;
  std::string err_;
  pid_t id_ = -1;
};

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
    port_ = 0;
    for (int i = 0; i < 200 && port_ == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::istringstream lines(service->err());
      for (std::string line; std::getline(lines, line);) {
        const json entry = json::parse(line, nullptr, false);
        port_ = entry.is_object() && entry["event"] == "listening" ? entry["port"].get<int>() : port_;
      }
    }
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
  EXPECT_THAT(err_, IsEmpty());
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
    EXPECT_EQ(json::parse(get(port_, job, {"Prefer: wait=30"}).body)["status"], "successful") << job;
  }
}

}  // namespace
}  // namespace snapthrough::server::test
