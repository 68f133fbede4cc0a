/// @file
/// Kills the service again and again while clients use it, and checks what it promised them.
/// KILLS sets how often (20); scripts/crash.sh passes its argument on.

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <system_error>
#include <thread>

#include "tests/server/support/client.h"
#include "tests/server/support/killed_service.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

/// What clients were told.
struct Told {
  std::mutex mutex;
  std::set<std::string> jobs;
  std::set<std::string> removed;
  std::map<std::string, std::string> results;  ///< body that was answered, by job
  std::map<std::string, std::string> keys;     ///< job, by idempotency key
  std::atomic<int> requests = 0;
};

class Crash : public KilledServiceTest {
 protected:
  /// Uses the service until it is gone.
  void use(unsigned seed) {
    std::mt19937 random(seed);
    const auto pick = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
    try {
      for (int n = 0; n < 100'000; ++n) {
        use_once(pick(10), "c" + std::to_string(seed) + "-" + std::to_string(n));
      }
    } catch (const std::system_error&) {
      // Nobody listens any more.
    }
  }

  void use_once(int what, const std::string& name) {
    Headers headers{"Content-Type: application/json"};
    if (what < 6) {
      headers.emplace_back("Prefer: respond-async");
    }
    if (what == 2 || what == 7) {
      headers.push_back("Idempotency-Key: " + name);
    }
    const Reply reply = post(port_, "/v1/jobs", column_request(name), headers);
    ++told_.requests;
    const std::string job = reply.header("Location");
    if (reply.status != 200 && reply.status != 201) {
      return;
    }
    {
      const std::lock_guard guard(told_.mutex);
      told_.jobs.insert(job);
      if (reply.status == 200 && !reply.body.empty()) {
        told_.results[job] = reply.body;
      }
      if (what == 2 || what == 7) {
        told_.keys[name] = job;
      }
    }
    if (what == 3) {
      call(port_, "POST", job + "/dismiss", "", {});
    }
    if (what == 4) {
      {
        const std::lock_guard guard(told_.mutex);
        told_.jobs.erase(job);  // from now on either answer is right
      }
      if (call(port_, "DELETE", job, "", {}).status == 204) {
        const std::lock_guard guard(told_.mutex);
        told_.removed.insert(job);
      }
    }
  }

  /// How long after it listened the service took up work, if any waited (seconds).
  static double pick_up_delay(const std::string& log) {
    const auto seconds = [](const std::string& time) {
      return std::stod(time.substr(11, 2)) * 3600 + std::stod(time.substr(14, 2)) * 60 +
             std::stod(time.substr(17, 9));
    };
    double listening = -1.0;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      const json entry = json::parse(line, nullptr, false);
      if (!entry.is_object()) {
        continue;
      }
      if (entry["event"] == "job" && entry["status"] == "running") {
        return listening < 0 ? 0.0 : seconds(entry["time"]) - listening;
      }
      listening = entry["event"] == "listening" ? seconds(entry["time"]) : listening;
    }
    return 0.0;
  }

  void note_ends(const std::string& log) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      const json entry = json::parse(line, nullptr, false);
      if (entry.is_object() && entry["event"] == "job" &&
          (entry["status"] == "successful" || entry["status"] == "failed" ||
           entry["status"] == "dismissed")) {
        ++completions_[entry["job"]];
      }
    }
  }

  void wait_until_all_ended() {
    for (int i = 0; i < 1200; ++i) {
      const bool waiting =
          !json::parse(get(port_, "/v1/jobs?status=accepted&limit=1").body)["jobs"].empty() ||
          !json::parse(get(port_, "/v1/jobs?status=running&limit=1").body)["jobs"].empty();
      if (!waiting) {
        return;
      }
      std::this_thread::sleep_for(milliseconds(50));
    }
    FAIL() << "some jobs never end";
  }

  void check_promises() {
    int successful = 0;
    for (const std::string& job : told_.jobs) {
      const Reply reply = get(port_, job);
      ASSERT_EQ(reply.status, 200) << job << " was acknowledged";
      const std::string status = json::parse(reply.body)["status"];
      const Reply result = get(port_, job + "/result");
      EXPECT_EQ(result.status == 200, status == "successful") << job << " " << status;
      EXPECT_TRUE(status == "successful" || status == "dismissed" || status == "failed") << job << status;
      successful += status == "successful" ? 1 : 0;
      if (told_.results.contains(job)) {
        EXPECT_EQ(result.body, told_.results[job]) << job;
      }
    }
    for (const std::string& job : told_.removed) {
      EXPECT_EQ(get(port_, job).status, 404) << job;
    }
    for (const auto& [key, job] : told_.keys) {
      const Reply again = post(port_, "/v1/jobs", column_request(key),
                               {"Content-Type: application/json", "Idempotency-Key: " + key});
      EXPECT_EQ(again.header("Location"), job);
    }
    for (const auto& [job, count] : completions_) {
      EXPECT_EQ(count, 1) << job << " ended more than once";
    }
    std::printf("%zu acknowledged jobs, %d successful, %zu removed, %d requests\n", told_.jobs.size(),
                successful, told_.removed.size(), told_.requests.load());
  }

  Told told_;
  std::map<std::string, int> completions_;
};

TEST_F(Crash, EveryAcknowledgedJobIsThereAndEndsOnce) {
  const char* wanted = std::getenv("KILLS");
  const int kills = wanted == nullptr ? 20 : std::atoi(wanted);
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  double slowest = 0.0;
  for (int kill = 0; kill < kills && !HasFailure(); ++kill) {
    const auto service = serve();
    std::vector<std::jthread> clients;
    for (unsigned i = 0; i < 4; ++i) {
      clients.emplace_back([this, name = static_cast<unsigned>(kill) * 10 + i] { use(name); });
    }
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(20, 400)(random)));
    service->signal(SIGKILL);
    service->wait();
    clients.clear();
    slowest = std::max(slowest, pick_up_delay(service->err()));
    note_ends(service->err());
  }
  const auto service = serve();
  wait_until_all_ended();
  note_ends(service->err());
  check_promises();
  Process backup(folder_, {"backup", "--store", folder_.file("jobs.db"), folder_.file("copy.db")});
  EXPECT_EQ(backup.wait(), 0) << "integrity check: " << backup.err();
  EXPECT_LT(slowest, 1.0);
  std::printf("%d kills, work taken up at most %.3f s after the start\n", kills, slowest);
}

}  // namespace
}  // namespace snapthrough::server::test
