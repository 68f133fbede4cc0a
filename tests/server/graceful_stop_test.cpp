/// @file
/// What clients with open connections see when the service stops: answers, and an announced close, no reset.

#include <gmock/gmock.h>

#include <future>
#include <system_error>
#include <thread>

#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using std::chrono_literals::operator""ms;

const std::string kGet = "GET /v1/limits HTTP/1.1\r\nHost: localhost\r\n\r\n";

Result solved(const Model&, const Analysis&, const Hooks&) { return {}; }

class GracefulStop : public ServiceTest {
 protected:
  /// @param settle see http::ClientTimes
  void start_with(std::chrono::milliseconds settle, SolveFunction solver = solved) {
    ServiceConfig changed = config();
    changed.listener.times.settle = settle;
    changed.listener.times.drain = kPatience;
    service_ =
        std::make_unique<Service>(changed, Environment::system(), local_runners(std::move(solver)), log_);
    ASSERT_TRUE(service_->start().ok());
    port_ = service_->port();
  }
  /// Returns whether the service's port refuses connections, since its listening socket is closed.
  [[nodiscard]] bool refuses() const {
    try {
      const Socket socket(port_);
      return false;
    } catch (const std::system_error&) {
      return true;
    }
  }
  /// The status of the answer to a request; 0 unless the answer announces the close that follows.
  static int last_answer(Socket& socket) {
    socket.send(kGet);
    const Reply reply = socket.receive();
    return reply.header("Connection") == "close" && !socket.was_reset() ? reply.status : 0;
  }

  int port_ = 0;
};

TEST_F(GracefulStop, ARequestThatIsUnderWayWhenTheListenerClosesIsAnswered) {
  start_with(kPatience);
  Socket kept(port_);
  kept.send(kGet);
  EXPECT_EQ(kept.receive().status, 200);
  Socket fresh(port_);
  const std::jthread stop([&] { service_->stop(); });
  ASSERT_TRUE(eventually([&] { return refuses(); }));
  EXPECT_EQ(last_answer(kept), 200);
  EXPECT_EQ(last_answer(fresh), 200);
}

/// From the first moment on: the listener is open as long as analyses come to their end.
TEST_F(GracefulStop, AnswersAnnounceItWhileTheListenerIsOpen) {
  std::promise<void> end;
  start_with(500ms, [&, ended = end.get_future().share()](const Model&, const Analysis&, const Hooks&) {
    ended.wait();
    return Result();
  });
  const std::string job = submit();
  Socket kept(port_);
  kept.send(kGet);
  EXPECT_EQ(kept.receive().header("Connection"), "keep-alive");
  const std::jthread stop([&] { service_->stop(); });
  ASSERT_TRUE(eventually([&] { return get(port_, "/readyz").status == 503; }));
  EXPECT_EQ(last_answer(kept), 200);
  Socket another(port_);
  EXPECT_EQ(last_answer(another), 200);
  EXPECT_EQ(get(port_, job).status, 200);
  end.set_value();
}

/// The next request of the connection, which is longer than what is read at a time, has not been read when
/// the first one is answered: a close() would reset the connection.
TEST_F(GracefulStop, AnAnswerIsNotDestroyedByWhatFollowsItsRequest) {
  const auto solver = std::make_shared<GatedSolver>();
  start_with(500ms, gated(solver));
  const std::string job = submit();
  solver->wait_started(1);
  const std::string body(90'000, ' ');
  Socket waiting(port_);
  waiting.send("GET " + job + " HTTP/1.1\r\nHost: localhost\r\nPrefer: wait=60\r\n\r\n" +
               "POST /v1/check HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
               "Content-Length: " +
               std::to_string(body.size()) + "\r\n\r\n" + body);
  const std::jthread stop([&] { service_->stop(); });
  const Reply reply = waiting.receive();
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.header("Connection"), "close");
  EXPECT_FALSE(waiting.was_reset());
}

}  // namespace
}  // namespace snapthrough::server::test
