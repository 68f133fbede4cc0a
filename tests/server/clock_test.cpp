/// @file
/// A wall clock that is set while the service runs.

#include <gmock/gmock.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/server/support/eventually.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SetClock : public ServiceTest {
 protected:
  void SetUp() override {
    workers_ = 1;
    Environment environment = Environment::system();
    environment.now = [this, system = environment.now] { return system() + ahead_.load(); };
    service_ = std::make_unique<Service>(config(), environment, local_runners(gated(solver_)), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  void set_clock(std::chrono::hours ahead) {
    const std::size_t before = told();
    ahead_ = ahead;
    ASSERT_TRUE(eventually([&] { return told() > before; })) << "the service notes it";
  }
  [[nodiscard]] json status(const std::string& job) const { return json::parse(get(port(), job).body); }
  [[nodiscard]] double waiting_sum() const {
    const std::string text = get(port(), "/metrics").body;
    const std::string name = "\nsnapthrough_job_waiting_seconds_sum ";
    return std::stod(text.substr(text.find(name) + name.size()));
  }

  std::atomic<std::chrono::microseconds> ahead_{std::chrono::microseconds(0)};
  std::shared_ptr<GatedSolver> solver_ = std::make_shared<GatedSolver>();

 private:
  [[nodiscard]] std::size_t told() const {
    const std::string text = log_text_.text();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("\"event\":\"clock\"", at)) != std::string::npos; ++at) {
      ++count;
    }
    return count;
  }
};

TEST_F(SetClock, ForwardItNeitherRestartsWorkNorRemovesResults) {
  const std::string running = submit("runs");
  solver_->wait_started(1);
  const std::string ended = submit("ended");
  ASSERT_EQ(post(port(), ended + "/dismiss", "").status, 200);
  set_clock(std::chrono::hours(24 * 60));
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // two rounds of the upkeep
  EXPECT_EQ(get(port(), ended).status, 200) << "kept for thirty days by any clock that went on evenly";
  EXPECT_EQ(status(running)["status"], "running");
  solver_->open();
  EXPECT_TRUE(eventually([&] { return status(running)["status"] == "successful"; }));
  EXPECT_EQ(status(running)["attempt"], 1);
}

TEST_F(SetClock, BackItRestartsNothingAndNoWaitIsNegative) {
  const std::string running = submit("runs");
  solver_->wait_started(1);
  const std::string waiting = submit("waits");
  set_clock(std::chrono::hours(-24));
  solver_->open();
  EXPECT_TRUE(eventually([&] { return status(waiting)["status"] == "successful"; }));
  EXPECT_EQ(status(running)["attempt"], 1);
  EXPECT_EQ(status(running)["status"], "successful");
  EXPECT_GE(waiting_sum(), 0.0);
}

}  // namespace
}  // namespace snapthrough::server::test
