/// @file
/// Who uses much processor time, and who computes and reads for them.

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "server/worker/runners.h"

namespace snapthrough::server::test {
namespace {

using std::chrono_literals::operator""s;
using std::chrono_literals::operator""ms;
using testing::ElementsAre;
using testing::IsEmpty;
using Seconds = RecentUse::Seconds;

const RecentUse::Clock::time_point kStart{1000s};

TEST(RecentUse, HalfIsForgottenEveryTwoSeconds) {
  RecentUse use;
  use.add("ann", Seconds(0.5), kStart);
  EXPECT_TRUE(use.is_much("ann", kStart + 1400ms));  // 0.5 2^-0.7 = 0.31
  EXPECT_FALSE(use.is_much("ann", kStart + 1600ms));
  EXPECT_FALSE(use.is_much("bob", kStart));
  use.add("ann", Seconds(0.2), kStart + 2s);
  EXPECT_TRUE(use.is_much("ann", kStart + 2s));  // 0.25 and 0.2
  EXPECT_THAT(use.of_much(kStart + 2s), ElementsAre("ann"));
  EXPECT_THAT(use.of_much(kStart + 10s), IsEmpty());
}

TEST(RecentUse, ATwentiethOfAProcessorIsNotMuch) {
  RecentUse use;
  for (int i = 0; i < 600; ++i) {
    use.add("ann", Seconds(0.005), kStart + i * 100ms);
    ASSERT_FALSE(use.is_much("ann", kStart + i * 100ms));
  }
}

/// Counts its tasks.
class CountingRunner final : public Runner {
 public:
  struct Counts {
    int made = 0;
    int tasks = 0;
    int tasks_of_low = 0;
  };
  explicit CountingRunner(Counts& counts) : counts_(counts) { ++counts_.made; }
  JobRun run_job(std::string_view /*request*/, const Hooks& /*hooks*/) override {
    ++(low_ ? counts_.tasks_of_low : counts_.tasks);
    return {};
  }
  WorkUsage run_items(const ItemTask& /*task*/) override { return {}; }
  void give_way() override { low_ = true; }

 private:
  Counts& counts_;
  bool low_ = false;
};

TEST(Runners, OwnersWhoUseMuchHaveARunnerThatGivesWay) {
  CountingRunner::Counts counts;
  const RunnerFactory make = [&] { return std::make_unique<CountingRunner>(counts); };
  RecentUse use;
  Runners runners(make, use);
  EXPECT_EQ(counts.made, 0);
  (void)runners.of("ann").run_job("", {});
  runners.note("ann", {.cpu_us = 5'000'000, .peak_bytes = 0, .factorizations = 0}, 0.0);
  (void)runners.of("ann").run_job("", {});
  (void)runners.of("bob").run_job("", {});
  runners.note("bob", {}, 5.0);  // its process could not tell what it took
  (void)runners.of("bob").run_job("", {});
  EXPECT_EQ(counts.made, 2);
  EXPECT_EQ(counts.tasks, 2);
  EXPECT_EQ(counts.tasks_of_low, 2);
}

}  // namespace
}  // namespace snapthrough::server::test
