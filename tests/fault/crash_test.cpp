/// @file
/// Kills the service, and as often a runner, again and again while clients use it, and checks what it
/// promised them. KILLS sets how often (20); scripts/fault.sh passes its argument on.

#include <gmock/gmock.h>
#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <system_error>
#include <thread>

#include "server/jobs/limits.h"
#include "tests/recorded.h"
#include "tests/server/support/client.h"
#include "tests/server/support/killed_service.h"
#include "tests/server/support/receiver.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/sanitizer.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr int kSweepPoints = 20;

/// What clients were told.
struct Promises {
  std::mutex mutex;
  std::set<std::string> jobs;
  std::set<std::string> removed;
  std::map<std::string, std::string> results;  ///< body that was answered, by job
  std::map<std::string, std::string> keys;     ///< job, by idempotency key
  std::map<std::string, std::string> sweeps;   ///< idempotency key of each
  std::set<std::string> callbacks;             ///< jobs and sweeps whose ends are to be told
  std::atomic<int> requests = 0;
};

/// A sweep of its own content: points one by one, or every other time a curve.
std::string sweep_of(const std::string& name, bool followed) {
  return followed ? followed_sweep(kSweepPoints, name) : column_sweep(kSweepPoints, name);
}

class Crash : public KilledServiceTest {
 protected:
  Crash() {
    std::ofstream(folder_.file("secret")) << "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw\n";
    more_arguments_ = {"--callback-hosts", receiver_.host(), "--callback-secret-file",
                       folder_.file("secret")};
  }
  /// The document in an envelope with a callback.
  [[nodiscard]] std::string with_callback(const std::string& member, const std::string& document) const {
    return R"({"callback": ")" + receiver_.address() + R"(", ")" + member + R"(": )" + document + "}";
  }
  /// The first number that a statement on the store gives; no service runs.
  std::int64_t query(const std::string& statement) const {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(folder_.file("jobs.db").c_str(), &database), SQLITE_OK);
    std::int64_t number = -1;
    const auto take = [](void* out, int, char** texts, char**) {
      *static_cast<std::int64_t*>(out) = std::atoll(texts[0]);
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(database, statement.c_str(), take, &number, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
    return number;
  }
  /// From now on the store keeps count of the rows that workers have come with, those that were there too.
  void count_rows() {
    const auto service = serve();
    service->signal(SIGTERM);
    ASSERT_EQ(service->wait(), 0);
    query(
        "CREATE TABLE computed (sweep INTEGER, point INTEGER);"
        "CREATE TRIGGER count_computed BEFORE INSERT ON sweep_points BEGIN"
        " INSERT INTO computed VALUES (NEW.sweep, NEW.point); END;");
  }
  /// Kills a runner that lives, whichever.
  bool kill_runner(const Process& service, std::mt19937& random) const {
    const std::vector<pid_t> runners = service.started();
    return !runners.empty() && ::kill(runners[random() % runners.size()], SIGKILL) == 0;
  }

  /// Uses the service until it is gone.
  void use(unsigned seed) {
    std::mt19937 random(seed);
    const auto pick = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
    try {
      for (int n = 0; n < 100'000; ++n) {
        const std::string name = "c" + std::to_string(seed) + "-" + std::to_string(n);
        pick(10) == 0 ? submit_sweep(name) : use_once(pick(10), name);
      }
    } catch (const std::system_error&) {
      // Nobody listens any more.
    }
  }

  [[nodiscard]] Reply post_sweep(const std::string& name) const {
    const bool followed = name.size() % 2 == 0;
    return post(port_, "/v1/sweeps", with_callback("sweep", sweep_of(name, followed)),
                {"Content-Type: application/json", "Cache-Control: no-cache", "Idempotency-Key: " + name});
  }
  void submit_sweep(const std::string& name) {
    const Reply reply = post_sweep(name);
    if (reply.status == 201) {
      const std::lock_guard guard(told_.mutex);
      told_.sweeps[reply.header("Location")] = name;
      told_.callbacks.insert(reply.header("Location"));
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
    const bool calls_back = what == 1 || what == 3 || what == 8;
    const std::string request = column_request(name);
    const Reply reply =
        post(port_, "/v1/jobs", calls_back ? with_callback("request", request) : request, headers);
    ++told_.requests;
    const std::string job = reply.header("Location");
    if (reply.status != 200 && reply.status != 201) {
      return;
    }
    {
      const std::lock_guard guard(told_.mutex);
      told_.jobs.insert(job);
      if (calls_back) {
        told_.callbacks.insert(job);
      }
      if (reply.status == 200 && reply.whole && !reply.body.empty()) {
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
    const auto none = [&](const std::string& status) {
      return json::parse(get(port_, "/v1/jobs?limit=1&status=" + status).body)["jobs"].empty();
    };
    bool ended = false;
    for (int i = 0; i < static_cast<int>(4 * kSlowdown) && !ended; ++i) {
      ended = eventually([&] { return none("accepted") && none("running"); });
    }
    EXPECT_TRUE(ended) << "some jobs never end";
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
      EXPECT_EQ(get(port_, job).status, 410) << job;
    }
    for (const auto& [key, job] : told_.keys) {
      const Reply again = post(port_, "/v1/jobs", column_request(key),
                               {"Content-Type: application/json", "Idempotency-Key: " + key});
      EXPECT_EQ(again.header("Location"), job);
    }
    for (const auto& [job, count] : completions_) {
      EXPECT_EQ(count, 1) << job << " ended more than once";
    }
    record_figure("jobs_acknowledged", told_.jobs.size());
    record_figure("jobs_successful", successful);
    record_figure("jobs_removed", told_.removed.size());
    record_figure("requests", told_.requests.load());
  }

  void check_sweeps() {
    for (const auto& [sweep, key] : told_.sweeps) {
      json status;
      for (int i = 0; i < 20 && (status.is_null() || !status["finished"].is_string()); ++i) {
        const Reply reply = get(port_, sweep, {"Prefer: wait=60"});
        ASSERT_EQ(reply.status, 200) << sweep << " was acknowledged";
        status = json::parse(reply.body);
      }
      EXPECT_EQ(status["status"], "successful") << status.dump();
      EXPECT_EQ(status["counts"]["successful"], kSweepPoints) << status.dump();
      EXPECT_EQ(json::parse(get(port_, sweep + "/table").body)["rows"].size(), kSweepPoints * 1UL);
      EXPECT_EQ(post_sweep(key).header("Location"), sweep);
    }
  }

  /// Each end is told, as it is now, and nothing else.
  void check_callbacks() {
    std::map<std::string, std::string> ends;  ///< status by path
    std::size_t deliveries = 0;
    for (int i = 0; i < 1200 && ends.size() < told_.callbacks.size(); ++i) {
      std::this_thread::sleep_for(milliseconds(i == 0 ? 0 : 100));
      const std::vector<Told> told = receiver_.told();
      for (; deliveries < told.size(); ++deliveries) {
        const json document = json::parse(told[deliveries].body);
        const std::string path =
            (document.contains("counts") ? "/v1/sweeps/" : "/v1/jobs/") + document["id"].get<std::string>();
        if (told_.callbacks.contains(path)) {  // others were acknowledged to a client that did not hear it
          ends[path] = document["status"];
        }
      }
    }
    for (const std::string& path : told_.callbacks) {
      EXPECT_EQ(ends[path], json::parse(get(port_, path).body)["status"].get<std::string>()) << path;
    }
    record_figure("ends_told", ends.size());
    record_figure("deliveries", deliveries);
  }

  Receiver receiver_;
  Promises told_;
  std::map<std::string, int> completions_;
};

TEST_F(Crash, EveryAcknowledgedJobIsThereAndEndsOnce) {
  const char* wanted = std::getenv("KILLS");
  const int kills = wanted == nullptr ? 20 : std::atoi(wanted);
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  double slowest = 0.0;
  int runners_killed = 0;
  count_rows();
  for (int kill = 0; kill < kills && !HasFailure(); ++kill) {
    const auto service = serve();
    std::vector<std::jthread> clients;
    for (unsigned i = 0; i < 4; ++i) {
      clients.emplace_back([this, name = static_cast<unsigned>(kill) * 10 + i] { use(name); });
    }
    const auto pause = [&] {
      std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(10, 200)(random)));
    };
    pause();
    runners_killed += kill_runner(*service, random) ? 1 : 0;
    pause();
    service->signal(SIGKILL);
    service->wait();
    clients.clear();
    slowest = std::max(slowest, pick_up_delay(service->err()));
    note_ends(service->err());
  }
  const auto service = serve();
  wait_until_all_ended();
  check_sweeps();
  note_ends(service->err());
  check_promises();
  check_callbacks();
  Process backup(folder_, {"backup", "--store", folder_.file("jobs.db"), folder_.file("copy.db")});
  EXPECT_EQ(backup.wait(), 0) << "integrity check: " << backup.err();
  const std::chrono::duration<double> lease = JobLimits().lease;
  EXPECT_LT(slowest, lease.count() / 2.0)
      << "work is not taken up only when the lease of the dead one is over";
  service->signal(SIGTERM);
  EXPECT_EQ(service->wait(), 0);
  const std::int64_t rows = query("SELECT count(*) FROM sweep_points");
  EXPECT_GE(rows, static_cast<std::int64_t>(kSweepPoints * told_.sweeps.size()));
  EXPECT_EQ(query("SELECT count(*) FROM computed"), rows) << "points were computed that had a row";
  record_figure("kills_of_the_service", kills);
  record_figure("kills_of_runners", runners_killed);
  record_figure("sweeps", told_.sweeps.size());
  record_figure("rows", rows);
  record_figure("longest_until_work_is_taken_up_s", slowest);
}

}  // namespace
}  // namespace snapthrough::server::test
