/// @file
/// What all clients share, one party cannot take: time and turns for reading, memory for bodies, streams.

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

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

class SharedPools : public ServiceTest {
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
  using Sockets = std::vector<std::unique_ptr<Socket>>;
  /// Bodies of 100 kB of which 80 kB are sent, of these owners in turn.
  Sockets unfinished(std::size_t count, const std::vector<Headers>& owners) const {
    Sockets senders;
    for (std::size_t i = 0; i < count; ++i) {
      senders.push_back(std::make_unique<Socket>(port()));
      senders.back()->send(posted("/v1/jobs", std::string(80'000, ' '), owners[i % owners.size()], 100'000));
    }
    return senders;
  }
  static std::ptrdiff_t answered(const Sockets& senders) {
    return std::count_if(senders.begin(), senders.end(), [](const auto& one) { return one->readable(); });
  }
  static Result quick(const Model&, const Analysis&, const Hooks&) { return {}; }
};

TEST_F(SharedPools, ReadingEndsAtItsLimit) {
  ServiceConfig hasty = keyed();
  hasty.listener.times.reading = 200ms;
  start_with(hasty);
  for (const char* target : {"/v1/check", "/v1/jobs"}) {
    const Reply reply = post(port(), target, costly_request(), kAnn);
    EXPECT_EQ(reply.status, 422) << target << reply.body;
    EXPECT_THAT(reply.body, HasSubstr("too-costly-to-read")) << target;
  }
  EXPECT_EQ(json::parse(get(port(), "/v1/jobs", kAnn).body)["jobs"].size(), 0U);
}

/// Processor time in s of the threads of this process that have a lower priority than the others.
double time_of_low_threads() {
  double ticks = 0.0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(task.path() / "stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::vector<std::string> of_thread((std::istream_iterator<std::string>(fields)), {});
    if (of_thread.size() > 16 && std::stoi(of_thread[16]) > ::getpriority(PRIO_PROCESS, 0)) {
      ticks += std::stod(of_thread[11]) + std::stod(of_thread[12]);
    }
  }
  return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

TEST_F(SharedPools, PartiesThatUseMuchAreServedWithALowPriority) {
  ServiceConfig hasty = keyed();
  hasty.listener.times.reading = 1500ms;
  start_with(hasty);
  const std::string costly = costly_request();
  const auto status_for = [&](const Headers& owner) {
    return post(port(), "/v1/check", costly, owner).status;
  };
  EXPECT_EQ(status_for(kAnn), 422);
  EXPECT_EQ(time_of_low_threads(), 0.0) << "nobody had used much before";
  EXPECT_EQ(status_for(kBob), 422);
  EXPECT_EQ(time_of_low_threads(), 0.0);
  for (int i = 0; i < 20 && time_of_low_threads() == 0.0; ++i) {  // as often as a busy machine needs
    EXPECT_EQ(status_for(kAnn), 422);
  }
  EXPECT_GT(time_of_low_threads(), 0.0);
}

TEST_F(SharedPools, OneReadersDocumentsLeaveTurnsToOthersAndDoNotHoldTheEnd) {
  ServiceConfig patient = keyed();
  patient.listener.threads = 4;
  patient.listener.times.reading = 3600s;
  start_with(patient);
  std::vector<std::unique_ptr<Socket>> costly;
  for (int i = 0; i < 8; ++i) {
    costly.push_back(std::make_unique<Socket>(port()));
    costly.back()->send(posted("/v1/check", costly_request(), kAnn));
  }
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(post(port(), "/v1/jobs", column_request(std::to_string(i)), kBob).status, 200);
  }
  service_.reset();  // does not wait for the hours that reading may take
  for (const auto& socket : costly) {
    const Reply reply = socket->receive();
    EXPECT_TRUE(reply.status == 503 || reply.status == 0) << reply.status;
  }
}

TEST_F(SharedPools, ReadingEndsWhenItsClientHasGone) {
  ServiceConfig patient = keyed();
  patient.listener.threads = 4;
  patient.listener.times.reading = 3600s;
  start_with(patient);
  for (int i = 0; i < 3; ++i) {
    Socket(port()).send(posted("/v1/check", costly_request(), kAnn));
  }
  EXPECT_EQ(post(port(), "/v1/jobs", column_request(), kAnn).status, 200)
      << "the one turn of the party is free again";
}

TEST_F(SharedPools, LongWorkOfOneOwnerOnAllWorkersDoesNotStopOthers) {
  const auto solver = std::make_shared<GatedSolver>();
  ServiceConfig narrow = keyed();
  narrow.workers = 1;
  narrow.jobs.spare_after = 100ms;
  start_with(narrow, gated(solver));
  const auto submitted = [&](const std::string& target, const std::string& body, Headers headers) {
    headers.emplace_back("Prefer: respond-async");
    return post(port(), target, body, headers).header("Location");
  };
  const auto status = [&](const std::string& path, const Headers& headers) -> std::string {
    return json::parse(get(port(), path, headers).body)["status"];
  };
  const std::string first = submitted("/v1/jobs", column_request("first"), kAnn);
  solver->wait_started(1);
  const std::string second = submitted("/v1/jobs", column_request("second"), kAnn);
  const std::string of_bob = submitted("/v1/jobs", column_request("third"), kBob);
  solver->wait_started(2);
  EXPECT_EQ(status(of_bob, kBob), "running");
  EXPECT_EQ(status(second, kAnn), "accepted") << "the spare worker works for others than those who run";
  solver->open();
  for (const auto& [path, headers] :
       {std::pair(first, kAnn), std::pair(second, kAnn), std::pair(of_bob, kBob)}) {
    EXPECT_TRUE(eventually([&] { return status(path, headers) == "successful"; })) << path;
  }
}

/// Uses the processor for that long, whatever else runs on the machine.
void use_processor(std::chrono::duration<double> time) {
  const auto used = [] {
    timespec spent{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
    return std::chrono::seconds(spent.tv_sec) + std::chrono::nanoseconds(spent.tv_nsec);
  };
  for (const auto begin = used(); used() - begin < time;) {
  }
}

TEST_F(SharedPools, LongWorkDoesNotFillTheSpareWorkersForWhoUsesMuch) {
  const auto gate = std::make_shared<GatedSolver>();
  ServiceConfig narrow = keyed();
  narrow.keys.push_back({"cid", "4c26d9074c27d89ede59270c0ac14b71e071b15239519f75474b2f3ba63481f5"});
  narrow.keys.push_back({"dora", "69db31976ead37b85cc42a49c95fd06eec99cfd9b7ff219a25c0f59cb4049343"});
  narrow.workers = 1;
  narrow.jobs.spare_workers = 2;
  narrow.jobs.spare_after = 100ms;
  start_with(narrow, [gate](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    if (model.title == "short") {
      return Result{};
    }
    if (model.title == "costly") {
      use_processor(2.5s);
      return Result{};
    }
    return (*gate)(model, analysis, hooks);
  });
  const auto submitted = [&](const std::string& title, const std::string& key) {
    return post(port(), "/v1/jobs", column_request(title),
                {"Content-Type: application/json", "Prefer: respond-async", "Authorization: Bearer " + key})
        .header("Location");
  };
  const auto status = [&](const std::string& path, const std::string& key) -> std::string {
    return json::parse(get(port(), path, {"Authorization: Bearer " + key}).body)["status"];
  };
  submitted("held", "alice");
  gate->wait_started(1);
  submitted("held", "carol");
  gate->wait_started(2);
  const std::string costly = submitted("costly", "bob");
  EXPECT_TRUE(eventually([&] { return status(costly, "bob") == "successful"; }));
  // half of the spare workers have been at long work for over a second now, and Bob has used much
  const std::string waits = submitted("short", "bob");
  const std::string goes = submitted("short", "dora");
  EXPECT_TRUE(eventually([&] { return status(goes, "dora") == "successful"; }));
  EXPECT_EQ(status(waits, "bob"), "accepted");
  EXPECT_TRUE(eventually([&] { return status(waits, "bob") == "successful"; }))
      << "what Bob used is forgotten";
  gate->open();
}

TEST_F(SharedPools, LongJobsOnAllWorkersDoNotStopSweeps) {
  const auto solver = std::make_shared<GatedSolver>();
  ServiceConfig narrow = keyed();
  narrow.workers = 1;
  narrow.jobs.spare_after = 100ms;
  start_with(narrow, gated(solver));
  Headers async = kAnn;
  async.emplace_back("Prefer: respond-async");
  EXPECT_EQ(post(port(), "/v1/jobs", column_request("first"), async).status, 201);
  solver->wait_started(1);
  EXPECT_EQ(post(port(), "/v1/sweeps", column_sweep(2), kBob).status, 201);
  solver->wait_started(2);
  solver->open();
}

TEST_F(SharedPools, AKeyIsJudgedBeforeTheBodyComes) {
  start_with(keyed());
  for (const char* expectation : {"X: y", "Expect: 100-continue"}) {
    Socket socket(port());
    socket.send(posted("/v1/jobs", "", {"Content-Type: application/json", expectation}, 900'000));
    const Reply reply = socket.receive();
    EXPECT_EQ(reply.status, 401) << expectation;
    EXPECT_EQ(reply.header("WWW-Authenticate"), "Bearer");
  }
  Socket known(port());
  known.send(posted("/v1/jobs", "",
                    {"Content-Type: application/json", "Authorization: Bearer bob", "Expect: 100-continue"},
                    column_request().size()));
  EXPECT_EQ(known.receive(true).status, 100);
  known.send(column_request());
  EXPECT_EQ(known.receive().status, 200);
}

TEST_F(SharedPools, OnePartyHasHalfOfTheMemoryForBodies) {
  ServiceConfig small = keyed();
  small.listener.limits.body_bytes = 100'000;
  small.listener.limits.buffered_bytes = 600'000;
  start_with(small);
  const auto senders = unfinished(12, {kAnn});
  EXPECT_TRUE(eventually([&] { return answered(senders) >= 8; }))
      << "three or four of 80 kB fit into half of 600 kB";
  std::string large = column_request();
  large.append(90'000 - large.size(), ' ');
  EXPECT_EQ(post(port(), "/v1/jobs", large, kBob).status, 200);
}

TEST_F(SharedPools, HoweverMuchTwoPartiesTakeMemoryIsLeftForAThird) {
  ServiceConfig small = keyed();
  small.keys.push_back({"cid", "4c26d9074c27d89ede59270c0ac14b71e071b15239519f75474b2f3ba63481f5"});
  small.listener.limits.body_bytes = 100'000;
  small.listener.limits.buffered_bytes = 600'000;
  start_with(small);
  const auto senders = unfinished(24, {kAnn, kBob});
  EXPECT_TRUE(eventually([&] { return answered(senders) >= 18; }))
      << "half of 600 kB holds three or four of 80 kB, half of the rest one or two";
  std::string body = column_request();
  body.append(50'000 - body.size(), ' ');
  EXPECT_EQ(post(port(), "/v1/jobs", body, {"Content-Type: application/json", "Authorization: Bearer carol"})
                .status,
            200);
}

TEST_F(SharedPools, OnePartyHasAQuarterOfTheStreams) {
  ServiceConfig few = keyed();
  few.listener.streams = 8;
  auto solver = std::make_shared<GatedSolver>();
  service_ = std::make_unique<Service>(few, Environment::system(), local_runners(gated(solver)), log_);
  ASSERT_TRUE(service_->start().ok());
  const auto job_of = [&](const char* key) {
    return post(port(), "/v1/jobs", column_request(),
                {"Content-Type: application/json", "Prefer: respond-async",
                 std::string("Authorization: Bearer ") + key})
        .header("Location");
  };
  const auto stream = [&](const std::string& job, const char* key) {
    auto socket = std::make_unique<Socket>(port());
    socket->send("GET " + job + "/events HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + key +
                 "\r\n\r\n");
    const int status = socket->receive(true).status;
    return std::pair(status, std::move(socket));
  };
  const std::string anns = job_of("alice");
  std::vector<std::pair<int, std::unique_ptr<Socket>>> open;
  for (int i = 0; i < 4; ++i) {
    open.push_back(stream(anns, "alice"));
    EXPECT_EQ(open.back().first, i < 2 ? 200 : 503) << i;
  }
  open.push_back(stream(job_of("bob"), "bob"));
  EXPECT_EQ(open.back().first, 200);
  solver->open();
}

}  // namespace
}  // namespace snapthrough::server::test
