/// @file
/// Clients that end their sending side or leave, and requests that wait for a thread of the front.

#include <gmock/gmock.h>

#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/front/turns.h"
#include "tests/server/support/costly.h"
#include "tests/server/support/eventually.h"
#include "tests/server/support/owners.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

const Headers kAnn{"Content-Type: application/json", "Authorization: Bearer alice"};
const Headers kBob{"Content-Type: application/json", "Authorization: Bearer bob"};

/// Holds one thread, the next that passes after hold_next(), until it is opened.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    if (state_ == State::holds_next) {
      set(State::holds);
      changed_.wait(lock, [this] { return state_ == State::open; });
    }
  }
  void hold_next() {
    const std::lock_guard guard(mutex_);
    set(State::holds_next);
  }
  void open() {
    const std::lock_guard guard(mutex_);
    set(State::open);
  }
  void wait_until_it_holds() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return state_ == State::holds; });
  }

 private:
  enum class State { open, holds_next, holds };
  void set(State state) {
    state_ = state;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::open;
};

class FrontLimits : public ServiceTest {
 protected:
  ServiceConfig keyed() const {
    ServiceConfig keyed = config();
    keyed.keys = ann_and_bob();
    keyed.listener.limits.body_bytes = 4'000'000;
    return keyed;
  }
  void start_with(const ServiceConfig& config, SolveFunction solver = quick) {
    service_ =
        std::make_unique<Service>(config, Environment::system(), local_runners(std::move(solver)), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  /// Starts with one thread of the front, which passes the gate with each request: its id is random.
  void start_gated(ServiceConfig config) {
    config.listener.threads = 1;
    Environment environment = Environment::system();
    environment.random_bits = [this, bits = environment.random_bits] {
      gate_.pass();
      return bits();
    };
    service_ = std::make_unique<Service>(config, environment, local_runners(quick), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  static Result quick(const Model&, const Analysis&, const Hooks&) { return {}; }
  [[nodiscard]] int ready() const { return get(port(), "/readyz").status; }

  Gate gate_;
};

TEST_F(FrontLimits, ADocumentThatAStopCutsShortIsNotRefusedForGood) {
  ServiceConfig patient = keyed();
  patient.listener.times.reading = 3600s;
  patient.listener.times.drain = 60s;
  start_with(patient);
  Socket socket(port());
  socket.send(posted("/v1/check", costly_request(), kAnn));
  service_.reset();
  const Reply reply = socket.receive();
  EXPECT_EQ(reply.status, 503);
  EXPECT_EQ(json::parse(reply.body)["type"], "urn:snapthrough:problem:not-ready");
  EXPECT_EQ(reply.header("Retry-After"), "5");
}

TEST_F(FrontLimits, AClientThatEndedItsSendingSideGetsItsAnswer) {
  start_gated(keyed());
  gate_.hold_next();
  std::vector<std::unique_ptr<Socket>> halves;
  for (int i = 0; i < 3; ++i) {  // the first is worked on, others wait in the row
    halves.push_back(std::make_unique<Socket>(port()));
    halves.back()->send(posted("/v1/jobs", column_request(std::to_string(i)), kAnn));
    halves.back()->end_sending();
    if (i == 0) {
      gate_.wait_until_it_holds();
    }
  }
  for (std::size_t i = 1; i < halves.size(); ++i) {
    EXPECT_EQ(halves[i]->receive().status, 100) << "the service asks whether the client still waits";
  }
  gate_.open();
  for (const auto& half : halves) {
    Reply reply = half->receive();
    if (reply.status == 100) {  // asked at the next look of its work
      reply = half->receive();
    }
    EXPECT_EQ(reply.status, 200) << reply.body;
    EXPECT_TRUE(half->at_end());
  }
}

TEST_F(FrontLimits, AWaitForAJobAndAStreamOutliveTheSendingSide) {
  auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string job = submit();
  solver->wait_started(1);
  Socket waiting(port());
  waiting.send("GET " + job + " HTTP/1.1\r\nHost: localhost\r\nPrefer: wait=60\r\n\r\n");
  Socket stream(port());
  follow(stream, job);
  waiting.end_sending();
  stream.end_sending();
  Reply reply = waiting.receive();
  EXPECT_EQ(reply.status, 100) << "the service asks whether the client still waits";
  EXPECT_THAT(stream.read_until(": still there"), HasSubstr(": still there"));
  solver->open();
  reply = waiting.receive();
  EXPECT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(json::parse(reply.body)["status"], "successful");
  EXPECT_THAT(stream.rest(), HasSubstr("successful"));
}

TEST_F(FrontLimits, AStreamWhoseClientHasLeftEnds) {
  auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string job = submit();
  const auto streams = [&] {
    const std::string text = get(port(), "/metrics").body;
    return text.substr(text.find("\nsnapthrough_streams ") + 21, 1);
  };
  {
    Socket stream(port());
    follow(stream, job);
    EXPECT_EQ(streams(), "1");
  }
  EXPECT_TRUE(eventually([&] { return streams() == "0"; }));
  solver->open();
}

TEST_F(FrontLimits, ItIsNotReadyWhileRequestsWaitTooLongForAThread) {
  ServiceConfig narrow = keyed();
  narrow.listener.times.thread = 100ms;
  start_gated(narrow);
  EXPECT_EQ(ready(), 200);
  gate_.hold_next();
  Socket first(port());
  first.send(posted("/v1/jobs", column_request("first"), kAnn));
  gate_.wait_until_it_holds();
  Socket own(port());
  own.send(posted("/v1/check", column_request(), kAnn));
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(ready(), 200) << "a party that waits for itself does not make the service unready";
  Socket other(port());
  other.send(posted("/v1/check", column_request(), kBob));
  EXPECT_TRUE(eventually([&] { return ready() == 503; }));
  const Reply reply = get(port(), "/readyz");
  EXPECT_THAT(reply.body, HasSubstr("requests wait for a thread for longer than 100 ms"));
  EXPECT_EQ(reply.header("Retry-After"), "5");
  gate_.open();
  EXPECT_EQ(first.receive().status, 200);
  EXPECT_EQ(own.receive().status, 200);
  EXPECT_EQ(other.receive().status, 200);
  EXPECT_EQ(ready(), 200);
}

TEST(Turns, WaitsForOthersCountWaitsForItselfDoNot) {
  using http::Turns;
  const Turns::Clock::time_point start{};
  Turns turns(2, 1);
  EXPECT_TRUE(turns.take(1, "a", start));
  EXPECT_FALSE(turns.take(2, "a", start));
  EXPECT_EQ(turns.longest_wait(start + 9s), 0s) << "a has its part";
  EXPECT_TRUE(turns.take(3, "b", start));
  EXPECT_FALSE(turns.take(4, "c", start + 1s));
  EXPECT_FALSE(turns.take(5, "c", start + 3s));
  EXPECT_EQ(turns.longest_wait(start + 9s), 8s);
  EXPECT_EQ(turns.pass("b", start + 10s)->who, 4U);
  EXPECT_EQ(turns.longest_wait(start + 11s), 0s);
  EXPECT_EQ(turns.pass("a", start + 12s)->who, 2U);
  EXPECT_EQ(turns.pass("a", start + 13s), std::nullopt);
  EXPECT_EQ(turns.longest_wait(start + 19s), 0s) << "c has its part, and there is a free turn";
}

}  // namespace
}  // namespace snapthrough::server::test
