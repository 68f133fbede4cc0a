/// A sweep through kills of the service: complete in the end, and nothing that was stored is computed again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

#include "tests/recorded.h"
#include "tests/server/support/client.h"
#include "tests/server/support/killed_service.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

class SweepCrash : public KilledServiceTest {
 protected:
  [[nodiscard]] std::int64_t done(const std::string& sweep) const {
    const json counts = json::parse(get(port_, sweep).body)["counts"];
    return counts["successful"].get<std::int64_t>() + counts["failed"].get<std::int64_t>();
  }
  /// Points that this process has computed and stored; -1 when it does not say.
  [[nodiscard]] std::int64_t solved() const {
    const std::string text = get(port_, "/metrics").body;
    std::smatch found;
    return std::regex_search(
               text, found,
               std::regex("\nsnapthrough_sweep_points_ended_total\\{code=\"successful\"\\} ([0-9]+)"))
               ? std::stoll(found[1])
               : -1;
  }
};

TEST_F(SweepCrash, GoesOnWhereItWasKilled) {
  constexpr int kPoints = 3000;
  const char* wanted = std::getenv("KILLS");
  const int kills = wanted == nullptr ? 5 : std::atoi(wanted);
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::string sweep;
  std::int64_t before = 0;
  int interrupted = 0;
  for (int kill = 0; kill < kills; ++kill) {
    const auto service = serve();
    if (sweep.empty()) {
      const Reply reply = post(port_, "/v1/sweeps", column_sweep(kPoints));
      ASSERT_EQ(reply.status, 201) << reply.body;
      sweep = reply.header("Location");
    }
    EXPECT_GE(done(sweep), before) << "rows that were reported are there";
    // At any moment of a chunk, but after some rows more.
    const std::int64_t enough = before + std::uniform_int_distribution<int>(1, 60)(random);
    EXPECT_TRUE(eventually([&] { return done(sweep) >= enough; }));
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(0, 50)(random)));
    before = done(sweep);
    interrupted += before < kPoints ? 1 : 0;
    service->signal(SIGKILL);
    service->wait();
  }
  const auto service = serve();
  const std::int64_t found = done(sweep);
  EXPECT_GE(found, before);
  json status;
  for (int i = 0; i < 5 && (i == 0 || status["status"] == "running"); ++i) {
    status = json::parse(get(port_, sweep, {"Prefer: wait=60"}).body);
  }
  EXPECT_EQ(status["status"], "successful");
  EXPECT_EQ(status["counts"]["successful"], kPoints);
  EXPECT_GT(solved(), 0);
  EXPECT_LE(solved(), kPoints - before) << "points that were done before were computed again";
  EXPECT_EQ(interrupted, kills) << "kills came after the end";
  EXPECT_GT(found, 0) << "nothing was there before";
  EXPECT_EQ(json::parse(get(port_, sweep + "/table").body)["rows"].size(), static_cast<std::size_t>(kPoints));
  record_figure("kills_while_it_ran", interrupted, " of ", kills);
  record_figure("points_at_the_last_start", found);
  record_figure("points_computed_after_it", solved());
}

}  // namespace
}  // namespace snapthrough::server::test
