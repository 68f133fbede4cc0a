#pragma once
/// @file
/// A service on a free port with a store in a temporary folder, and a solver that the test writes.

#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>

#include "server/service.h"
#include "server/worker/local_runner.h"
#include "tests/server/support/client.h"
#include "tests/server/support/eventually.h"
#include "tests/server/support/postgresql.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {

/// A solver that waits until the test opens the gate, or it is asked to stop.
class GatedSolver {
 public:
  Result operator()(const Model&, const Analysis&, const Hooks& hooks) {
    std::unique_lock lock(mutex_);
    ++started_;
    changed_.notify_all();
    if (hooks.on_progress) {
      hooks.on_point({0, 6, 3.25, 0.5, 0, {{"tip", -0.25}}});
      hooks.on_point({0, 7, 3.5, 0.75, 1, {{"tip", -0.5}}});
      hooks.on_progress({0, 7, 3.5, 1});
    }
    Result result;
    result.critical_points = {CriticalPoint{}};
    result.critical_points[0].load_factor = 3.25;
    if (hooks.on_critical) {
      hooks.on_critical(result.critical_points[0]);
      hooks.on_progress({0, 7, 3.5, 1});
    }
    changed_.wait(lock, hooks.stop, [&] { return open_; });
    result.critical_points[0].load_factor = 3.125;
    result.critical_points[0].error_estimate = 1e-4;
    result.summary.termination = "steps";
    if (!open_) {
      result.failure = Failure{"cancelled", "asked to stop"};
    }
    return result;
  }
  void open() {
    const std::lock_guard guard(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  /// Waits until that many analyses have begun.
  void wait_started(int count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return started_ >= count; }))
        << started_ << " of " << count << " analyses have begun";
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool open_ = false;
  int started_ = 0;
};

/// Shared by the test and the service, whose threads may outlive the test's body.
inline SolveFunction gated(std::shared_ptr<GatedSolver> solver) {
  return [solver = std::move(solver)](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return (*solver)(model, analysis, hooks);
  };
}

/// What was written to a stream, to be read while others write. Thread-safe.
class SharedText final : public std::streambuf {
 public:
  [[nodiscard]] std::string text() const {
    const std::lock_guard guard(mutex_);
    return text_;
  }

 protected:
  std::streamsize xsputn(const char* piece, std::streamsize count) override {
    const std::lock_guard guard(mutex_);
    text_.append(piece, static_cast<std::size_t>(count));
    return count;
  }
  int overflow(int letter) override {
    const char piece = static_cast<char>(letter);
    return xsputn(&piece, 1) == 1 ? letter : traits_type::eof();
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

class ServiceTest : public testing::Test {
 protected:
  void start(SolveFunction solver) {
    service_ =
        std::make_unique<Service>(config(), Environment::system(), local_runners(std::move(solver)), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  ServiceConfig config() const {
    ServiceConfig config = ServiceConfig::defaults();
    config.listener.port = 0;
    config.listener.threads = 16;
    config.listener.limits.body_bytes = 100'000;
    config.waits.default_wait = config.waits.longest_wait;  // answers do not depend on how fast they come
    config.store_path = std::getenv("TEST_SHARED_STORES") == nullptr ? folder_.file("store.db")
                                                                     : postgresql_location(folder_.name());
    config.workers = workers_;
    return config;
  }
  [[nodiscard]] int port() const { return service_->port(); }
  /// Submits without waiting; the job's path.
  std::string submit(const std::string& title = "column") {
    const Reply reply = post(port(), "/v1/jobs", column_request(title),
                             {"Content-Type: application/json", "Prefer: respond-async"});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.header("Location");
  }

  /// Begins to follow the events of a job or sweep. @param last_id of the last that was seen
  static void follow(Socket& stream, const std::string& path, const std::string& last_id = "") {
    const std::string seen = last_id.empty() ? "" : "Last-Event-ID: " + last_id + "\r\n";
    stream.send("GET " + path + "/events HTTP/1.1\r\nHost: localhost\r\n" + seen + "\r\n");
    EXPECT_EQ(stream.receive().header("Content-Type"), "text/event-stream");
  }
  /// The events of something that the solver works on and ends when its gate is opened.
  std::string all_events(GatedSolver& solver, const std::string& path) const {
    solver.wait_started(1);
    Socket stream(port());
    follow(stream, path);
    solver.open();
    return stream.rest();
  }

  TempDir folder_;
  int workers_ = 2;
  SharedText log_text_;
  std::ostream log_stream_{&log_text_};
  Log log_{LogLevel::debug, Environment::system().now, log_stream_};
  std::unique_ptr<Service> service_;
};

}  // namespace snapthrough::server::test
