/// @file
/// Analyses that take all memory, never end, crash or talk nonsense: each is one job that ends with its code,
/// and nobody else notices. HOSTILE sets how many (60); scripts/fault.sh passes its argument on.

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "tests/recorded.h"
#include "tests/server/support/client.h"
#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/sanitizer.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// What a hostile analysis does (tests/hostile/hostile_main.cpp), and what its job comes to.
struct Kind {
  std::string deed;
  std::string code;  ///< empty: it is successful
  int kills = 0;     ///< of the process that computes it, from outside
  bool dismiss = false;
};

std::vector<Kind> kinds() {
  std::vector<Kind> all{{"endless", "time_limit"},  {"asleep", "time_limit"},
                        {"half", "time_limit"},     {"endless", "dismissed", 0, true},
                        {"told", "crashed", 3},     {"slow", "", 1},
                        {"abort", "crashed"},       {"stack", "crashed"},
                        {"exit", "crashed"},        {"noise", "crashed"},
                        {"record", "crashed"},      {"close", "crashed"},
                        {"throw", "internal_error"}};
  if (!kSanitized) {  // no bound, no filter of calls
    all.push_back({"memory", "memory_limit"});
    all.push_back({"states", "memory_limit"});
    all.push_back({"connect", "crashed"});
  }
  return all;
}

/// A request of the kind: of the hostile program's, or one that any program would fail at.
std::string hostile_request(const Kind& kind, int number) {
  json request = json::parse(column_request("hostile:" + kind.deed + " " + std::to_string(number)));
  if (kind.deed == "states") {
    request["model"]["title"] = "states " + std::to_string(number);
    request["analysis"]["stop"]["steps"] = 4000;
    request["analysis"]["step"] = {{"initial", 1e-3}, {"max", 1e-3}};
    request["analysis"]["output"] = {{"states", "all"}, {"points_per_member", 2001}};
  }
  return request.dump();
}

struct Latencies {
  std::mutex mutex;
  std::vector<double> milliseconds;

  [[nodiscard]] double quantile(double part) {
    std::sort(milliseconds.begin(), milliseconds.end());
    return milliseconds.empty()
               ? 0.0
               : milliseconds[static_cast<std::size_t>(part * static_cast<double>(milliseconds.size() - 1))];
  }
};

class HostileAnalysis : public testing::Test {
 protected:
  static constexpr int kWorkers = 6;
  static constexpr int kHostileClients = 4;
  static constexpr int kOrdinaryClients = 2;
  static constexpr int kSweepPoints = 20;

  void SetUp() override {
    service_ = std::make_unique<Process>(
        folder_,
        std::vector<std::string>{"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db"),
                                 "--ballast-bytes", "0", "--workers", std::to_string(kWorkers),
                                 "--spare-workers", "0", "--max-run-s", kSanitized ? "10" : "3",
                                 "--max-job-memory-bytes", "67108864"},
        "", SNAPTHROUGH_HOSTILE_EXECUTABLE);
    port_ = listening_port(*service_);
    ASSERT_GT(port_, 0) << service_->err();
    expected_ = json::parse(post(port_, "/v1/jobs", column_request("expected")).body)["summary"];
    expected_rows_ = sweep_rows("expected");
    ASSERT_EQ(expected_rows_.size(), static_cast<std::size_t>(kSweepPoints));
  }

  [[nodiscard]] json sweep_rows(const std::string& title) const {
    const Reply created = post(port_, "/v1/sweeps", column_sweep(kSweepPoints, title),
                               {"Content-Type: application/json", "Cache-Control: no-cache"});
    EXPECT_EQ(created.status, 201) << created.body;
    const std::string sweep = created.header("Location");
    json status;
    for (int i = 0; i < 3 && (i == 0 || status["status"] == "running"); ++i) {
      status = json::parse(get(port_, sweep, {"Prefer: wait=60"}).body);
    }
    EXPECT_EQ(status["status"], "successful") << status.dump();
    return json::parse(get(port_, sweep + "/table").body)["rows"];
  }

  /// Ordinary jobs at a steady pace, each with the right answer; now and then a sweep.
  void use(int client, const std::stop_token& stop, Latencies& latencies) {
    for (int n = 0; !stop.stop_requested(); ++n) {
      const std::string title = "ordinary " + std::to_string(client) + " " + std::to_string(ordinary_++);
      const auto start = steady_clock::now();
      const Reply reply = post(port_, "/v1/jobs", column_request(title),
                               {"Content-Type: application/json", "Prefer: wait=60"});
      const std::chrono::duration<double, std::milli> time = steady_clock::now() - start;
      ASSERT_EQ(reply.status, 200) << reply.body;
      EXPECT_EQ(json::parse(reply.body)["summary"], expected_) << title;
      {
        const std::lock_guard guard(latencies.mutex);
        latencies.milliseconds.push_back(time.count());
      }
      if (client == 0 && n % 100 == 50) {
        EXPECT_EQ(sweep_rows(title), expected_rows_);
      }
      std::this_thread::sleep_for(milliseconds(20));
    }
  }

  /// The process that computes the job, as its progress says; 0 when it is not known.
  [[nodiscard]] pid_t runner_of(const std::string& job) const {
    static const std::regex kStep("step ([0-9]+)");
    const std::string message = json::parse(get(port_, job).body)["message"];
    std::smatch found;
    const pid_t process = std::regex_search(message, found, kStep) ? std::stoi(found[1]) : 0;
    const std::vector<pid_t> runners = service_->started();
    return std::find(runners.begin(), runners.end(), process) == runners.end() ? 0 : process;
  }
  [[nodiscard]] std::string status_of(const std::string& job) const {
    return json::parse(get(port_, job).body)["status"];
  }
  /// Kills that many runners of a job, or fewer if it ends before.
  void kill_runners_of(const std::string& job, int kills) const {
    pid_t last = 0;
    EXPECT_TRUE(eventually([&] {
      const pid_t process = kills > 0 ? runner_of(job) : 0;
      if (process != 0 && process != last) {
        ::kill(process, SIGKILL);
        last = process;
        --kills;
      }
      const std::string status = kills > 0 ? status_of(job) : "";
      return status != "accepted" && status != "running";
    }));
  }
  void dismiss_when_it_runs(const std::string& job) const {
    EXPECT_TRUE(eventually([&] { return status_of(job) != "accepted"; }));
    EXPECT_EQ(call(port_, "POST", job + "/dismiss", "", {}).status, 200);
  }

  void harm(const Kind& kind, int number) {
    const Reply created = post(port_, "/v1/jobs", hostile_request(kind, number),
                               {"Content-Type: application/json", "Prefer: respond-async"});
    ASSERT_EQ(created.status, 201) << created.body;
    const std::string job = created.header("Location");
    kill_runners_of(job, kind.kills);
    if (kind.dismiss) {
      dismiss_when_it_runs(job);
    }
    const json status = json::parse(get(port_, job, {"Prefer: wait=60"}).body);
    const std::string code = status.contains("error") ? status["error"]["code"] : status["status"];
    const bool takes_memory = kind.deed == "states" || kind.deed == "memory";
    const bool time_came_first = takes_memory && code == "time_limit";  // on a busy machine
    EXPECT_TRUE(time_came_first || code == (kind.code.empty() ? "successful" : kind.code))
        << kind.deed << ": " << status.dump();
    const std::lock_guard guard(mutex_);
    ++ended_[kind.deed + (kind.dismiss ? ", dismissed" : "") + ": " + code];
  }

  /// Sockets, pipes and the like. Files are the store's: a connection for each read at the same time, kept.
  [[nodiscard]] int descriptors() const {
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator("/proc/" + std::to_string(service_->id()) + "/fd")) {
      std::error_code gone;
      const std::string target = std::filesystem::read_symlink(entry.path(), gone).string();
      count += gone || target.starts_with("/") ? 0 : 1;
    }
    return count;
  }
  /// Descriptors of the service without those of its runners: two sockets and the process of each.
  [[nodiscard]] int own_descriptors() const {
    constexpr int kOfARunner = 3;
    return descriptors() - kOfARunner * static_cast<int>(service_->started().size());
  }
  /// Waits until nothing is left over: as many descriptors as before, and at most two living runners a
  /// worker, of which one gives way (decision 39).
  void check_nothing_leaked(int before) const {
    const auto dead = [](pid_t process) {
      return read_file("/proc/" + std::to_string(process) + "/stat").find(") Z ") != std::string::npos;
    };
    std::vector<pid_t> runners;
    EXPECT_TRUE(eventually([&] {
      runners = service_->started();
      return own_descriptors() <= before && runners.size() >= kWorkers && runners.size() <= 2 * kWorkers &&
             std::none_of(runners.begin(), runners.end(), dead);
    }));
    EXPECT_LE(own_descriptors(), before);
    EXPECT_GE(runners.size(), static_cast<std::size_t>(kWorkers));
    EXPECT_LE(runners.size(), static_cast<std::size_t>(2 * kWorkers));
    EXPECT_TRUE(std::none_of(runners.begin(), runners.end(), dead)) << "a process that nobody waited for";
  }
  void check_service_is_the_same() const {
    EXPECT_EQ(::waitpid(service_->id(), nullptr, WNOHANG), 0) << "the service ended: " << service_->err();
    const std::string log = service_->err();
    const std::string listening = R"("event":"listening")";
    EXPECT_EQ(log.find(listening), log.rfind(listening));
    EXPECT_EQ(get(port_, "/livez").status, 200);
  }

  /// The ordinary load for as long as `other` takes.
  template <class Function>
  void among_ordinary_jobs(Latencies& latencies, Function other) {
    std::vector<std::jthread> clients;
    for (int i = 0; i < kOrdinaryClients; ++i) {
      clients.emplace_back([&, i](const std::stop_token& stop) { use(i, stop, latencies); });
    }
    other();
  }

  TempDir folder_;
  std::unique_ptr<Process> service_;
  int port_ = 0;
  json expected_;
  json expected_rows_;
  std::atomic<int> ordinary_ = 0;
  std::mutex mutex_;
  std::map<std::string, int> ended_;  ///< hostile jobs, by deed and code
};

TEST_F(HostileAnalysis, EachIsOneJobThatEndsWithItsCodeAndNobodyElseNotices) {
  const char* wanted = std::getenv("HOSTILE");
  const int count = wanted == nullptr ? 60 : std::atoi(wanted);
  Latencies alone;
  among_ordinary_jobs(alone,
                      [&] { std::this_thread::sleep_for(std::chrono::seconds(count < 200 ? 2 : 20)); });
  const int before = own_descriptors();
  Latencies among;
  const auto start = steady_clock::now();
  among_ordinary_jobs(among, [&] {
    const std::vector<Kind> all = kinds();
    std::atomic<int> next = 0;
    std::vector<std::jthread> clients;
    for (int i = 0; i < kHostileClients; ++i) {
      clients.emplace_back([&] {
        for (int n = next++; n < count; n = next++) {
          harm(all[static_cast<std::size_t>(n) % all.size()], n);
        }
      });
    }
  });
  const std::chrono::duration<double> took = steady_clock::now() - start;
  check_nothing_leaked(before);
  check_service_is_the_same();
  int ended = 0;
  int ends = 0;
  for (const auto& [what, times] : ended_) {
    record_figure("end_" + std::to_string(++ends), times, " times ", what);
    ended += times;
  }
  EXPECT_EQ(ended, count);
  record_figure("hostile_analyses", count, " in ", took.count(), " s");
  record_figure("ordinary_jobs_alone", alone.milliseconds.size(), ", p50 ", alone.quantile(0.5), " ms, p99 ",
                alone.quantile(0.99), " ms");
  record_figure("ordinary_jobs_among_them", among.milliseconds.size(), ", p50 ", among.quantile(0.5),
                " ms, p99 ", among.quantile(0.99), " ms");
}

}  // namespace
}  // namespace snapthrough::server::test
