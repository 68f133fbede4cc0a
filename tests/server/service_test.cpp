/// @file
/// The service as a client sees it, with a solver that the test controls.

#include <gmock/gmock.h>

#include <future>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>

#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

Result solved(const Model&, const Analysis&, const Hooks&) {
  const JobResult sample = sample_result();
  Result result;
  result.summary = sample.summary;
  result.branches = sample.branches;
  result.critical_points = sample.critical_points;
  return result;
}

Result not_converged(const Model&, const Analysis&, const Hooks&) {
  Result result;
  result.branches = sample_result().branches;
  result.failure = Failure{"no_convergence", "no equilibrium at load factor 3"};
  return result;
}

const Headers kAsync{"Content-Type: application/json", "Prefer: respond-async"};

TEST_F(ServiceTest, IsAlive) {
  start(solved);
  const Reply reply = get(port(), "/livez");
  EXPECT_EQ(reply.status, 200);
  EXPECT_FALSE(reply.header("Date").empty());
  EXPECT_FALSE(reply.header("X-Request-Id").empty());
}

TEST_F(ServiceTest, ASmallJobIsAnsweredWithItsResultAtOnce) {
  start(solved);
  const Reply reply = post(port(), "/v1/jobs", column_request());
  ASSERT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(json::parse(reply.body)["summary"]["critical_load_factor"], 66.2628);
  const std::string job = reply.header("Location");
  EXPECT_THAT(job, StartsWith("/v1/jobs/"));
  EXPECT_EQ(reply.header("Content-Location"), job + "/result");
  const Reply stored = get(port(), job + "/result");
  EXPECT_EQ(stored.status, 200);
  EXPECT_EQ(stored.body, reply.body);
  EXPECT_EQ(stored.header("ETag"), reply.header("ETag"));
  EXPECT_EQ(get(port(), job + "/request").body, column_request());
  const json status = json::parse(get(port(), job).body);
  EXPECT_EQ(status["status"], "successful");
  EXPECT_EQ(status["progress"], 100);
  EXPECT_EQ("/v1/jobs/" + status["id"].get<std::string>(), job);
  EXPECT_FALSE(status["finished"].is_null());
}

TEST_F(ServiceTest, AnEtagThatMatchesSavesTheBody) {
  start(solved);
  const Reply reply = post(port(), "/v1/jobs", column_request());
  const std::string etag = reply.header("ETag");
  EXPECT_THAT(etag, StartsWith("\""));
  const std::string result = reply.header("Location") + "/result";
  EXPECT_EQ(get(port(), result, {"If-None-Match: \"other\", " + etag}).status, 304);
  EXPECT_EQ(get(port(), result, {"If-None-Match: *"}).status, 304);
  EXPECT_EQ(get(port(), result, {"If-None-Match: \"other\""}).status, 200);
}

TEST_F(ServiceTest, AnAsynchronousJobIsCreatedAndCanBeWaitedFor) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const Reply reply = post(port(), "/v1/jobs", column_request(), kAsync);
  ASSERT_EQ(reply.status, 201) << reply.body;
  EXPECT_EQ(reply.header("Preference-Applied"), "respond-async");
  const std::string job = reply.header("Location");
  EXPECT_EQ("/v1/jobs/" + json::parse(reply.body)["id"].get<std::string>(), job);
  solver->wait_started(1);
  const json running = json::parse(get(port(), job).body);
  EXPECT_EQ(running["status"], "running");
  EXPECT_THAT(running["message"].get<std::string>(), HasSubstr("step 7, load factor 3.5"));
  const Reply early = get(port(), job + "/result");
  EXPECT_EQ(early.status, 404);
  EXPECT_EQ(early.header("Retry-After"), "1");
  EXPECT_EQ(json::parse(early.body)["type"], "urn:snapthrough:problem:result-not-ready");
  std::jthread opener([&] { solver->open(); });
  const json done = json::parse(get(port(), job, {"Prefer: wait=60"}).body);
  EXPECT_EQ(done["status"], "successful");
}

TEST_F(ServiceTest, AWaitThatEndsFirstGivesTheStatus) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const Reply reply =
      post(port(), "/v1/jobs", column_request(), {"Content-Type: application/json", "Prefer: wait=0"});
  EXPECT_EQ(reply.status, 201);
  solver->open();
}

TEST_F(ServiceTest, AFailedAnalysisIsAProblemThatHoldsWhatWasReached) {
  start(not_converged);
  const Reply reply = post(port(), "/v1/jobs", column_request());
  EXPECT_EQ(reply.status, 422);
  EXPECT_EQ(reply.header("Content-Type"), "application/problem+json");
  const json problem = json::parse(reply.body);
  EXPECT_EQ(problem["type"], "urn:snapthrough:problem:analysis-failed");
  EXPECT_EQ(problem["code"], "no_convergence");
  EXPECT_EQ(problem["detail"], "no equilibrium at load factor 3");
  EXPECT_EQ(problem["reached"]["branches"].size(), 2U);
  const std::string job = reply.header("Location");
  EXPECT_EQ(get(port(), job + "/result").status, 422);
  const json status = json::parse(get(port(), job).body);
  EXPECT_EQ(status["status"], "failed");
  EXPECT_EQ(status["error"]["code"], "no_convergence");
}

TEST_F(ServiceTest, AnExceptionOfTheSolverFailsTheJobOnly) {
  int calls = 0;
  workers_ = 1;
  start([&](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    if (++calls == 1) {
      throw std::runtime_error("broken");
    }
    return solved(model, analysis, hooks);
  });
  const Reply reply = post(port(), "/v1/jobs", column_request());
  EXPECT_EQ(reply.status, 500);
  EXPECT_EQ(json::parse(reply.body)["code"], "internal_error");
  EXPECT_EQ(post(port(), "/v1/jobs", column_request()).status, 200);
}

TEST_F(ServiceTest, ListsJobsInPages) {
  const auto solver = std::make_shared<GatedSolver>();
  solver->open();
  start(gated(solver));
  std::vector<std::string> jobs;
  for (int i = 0; i < 3; ++i) {
    jobs.push_back(post(port(), "/v1/jobs", column_request("job " + std::to_string(i))).header("Location"));
  }
  const Reply first = get(port(), "/v1/jobs?limit=2&status=successful");
  ASSERT_EQ(first.status, 200);
  const json page = json::parse(first.body);
  ASSERT_EQ(page["jobs"].size(), 2U);
  EXPECT_EQ(page["jobs"][0]["title"], "job 2");
  EXPECT_EQ(page["jobs"][1]["title"], "job 1");
  const std::string link = first.header("Link");
  EXPECT_THAT(link, HasSubstr("rel=\"next\""));
  const Reply second = get(port(), link.substr(1, link.find('>') - 1));
  ASSERT_EQ(second.status, 200) << link;
  EXPECT_EQ(json::parse(second.body)["jobs"].size(), 1U);
  EXPECT_EQ(second.header("Link"), "");
  EXPECT_TRUE(json::parse(get(port(), "/v1/jobs?status=failed").body)["jobs"].empty());
}

TEST_F(ServiceTest, RefusesWrongListParameters) {
  start(solved);
  for (const char* query :
       {"limit=0", "limit=1001", "limit=x", "limit=", "cursor=x", "status=done", "stauts=failed"}) {
    const Reply reply = get(port(), "/v1/jobs?" + std::string(query));
    EXPECT_EQ(reply.status, 400) << query;
    EXPECT_EQ(reply.header("Content-Type"), "application/problem+json");
  }
}

TEST_F(ServiceTest, WhatIsNotThereIsAProblem) {
  start(solved);
  const std::string missing = "/v1/jobs/" + id_number(1);
  for (const std::string& path :
       {std::string("/nothing"), std::string("/v1"), std::string("/v1/jobs/"), missing, missing + "/result",
        missing + "/request", missing + "/result/x", std::string("/v1/jobs/%2e%2e%2f"),
        std::string("/v1//jobs"), std::string("/livez/")}) {
    const Reply reply = get(port(), path);
    EXPECT_EQ(reply.status, 404) << path;
    const json problem = json::parse(reply.body);
    EXPECT_EQ(problem["status"], 404);
    for (const char* member : {"type", "title", "detail", "instance", "request_id"}) {
      EXPECT_TRUE(problem[member].is_string()) << member;
    }
  }
}

TEST_F(ServiceTest, AWrongMethodIsToldWhichAreRight) {
  start(solved);
  const Reply reply = call(port(), "DELETE", "/v1/jobs", "", {});
  EXPECT_EQ(reply.status, 405);
  EXPECT_EQ(reply.header("Allow"), "POST, GET, HEAD");
  EXPECT_EQ(call(port(), "PATCH", "/livez", "x", {}).header("Allow"), "GET, HEAD");
  EXPECT_EQ(call(port(), "HEAD", "/livez", "", {}).status, 200);
}

TEST_F(ServiceTest, TheClientsRequestIdIsKeptWhenItIsHarmless) {
  start(solved);
  EXPECT_EQ(get(port(), "/livez", {"X-Request-Id: abc-1.2_3"}).header("X-Request-Id"), "abc-1.2_3");
  EXPECT_NE(get(port(), "/livez", {"X-Request-Id: a b"}).header("X-Request-Id"), "a b");
  EXPECT_EQ(json::parse(get(port(), "/no", {"X-Request-Id: me"}).body)["request_id"], "me");
}

TEST_F(ServiceTest, OneLogLineForEachRequestAndJobTransition) {
  start(solved);
  EXPECT_EQ(
      post(port(), "/v1/jobs", column_request(), {"Content-Type: application/json", "X-Request-Id: mine"})
          .status,
      200);
  service_->stop();
  std::istringstream lines(log_text_.text());
  std::vector<std::string> seen;
  for (std::string text; std::getline(lines, text);) {
    const json line = json::parse(text);
    if (line["event"] == "job") {
      seen.push_back("job " + line["status"].get<std::string>());
    } else if (line["event"] == "request") {
      seen.push_back("request " + line["request_id"].get<std::string>() + " " +
                     line["route"].get<std::string>());
    }
  }
  EXPECT_THAT(seen, testing::UnorderedElementsAre("job accepted", "job running", "job successful",
                                                  "request mine /v1/jobs"));
}

TEST_F(ServiceTest, ARestartedServiceStillHasTheResult) {
  start(solved);
  const Reply reply = post(port(), "/v1/jobs", column_request());
  ASSERT_EQ(reply.status, 200);
  service_->stop();
  service_.reset();
  start([](const Model&, const Analysis&, const Hooks&) -> Result { throw std::logic_error("not again"); });
  const Reply stored = get(port(), reply.header("Location") + "/result");
  EXPECT_EQ(stored.status, 200);
  EXPECT_EQ(stored.body, reply.body);
}

TEST_F(ServiceTest, StoppingPutsARunningJobBackAndTheNextStartFinishesIt) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string job = submit();
  solver->wait_started(1);
  Socket waiting(port());
  waiting.send("GET " + job + " HTTP/1.1\r\nHost: localhost\r\nPrefer: wait=60\r\n\r\n");
  Socket idle(port());
  service_->stop();
  EXPECT_EQ(waiting.receive().status, 200);  // it is answered, with the status as it is
  EXPECT_TRUE(idle.at_end());
  service_.reset();
  const auto second = std::make_shared<GatedSolver>();
  second->open();
  start(gated(second));
  const json status = json::parse(get(port(), job, {"Prefer: wait=60"}).body);
  EXPECT_EQ(status["status"], "successful");
  EXPECT_EQ(status["attempt"], 2);
}

/// A load balancer must be able to ask while the analyses that run come to their end.
TEST_F(ServiceTest, ItAnswersWhileItWaitsForAnAnalysisThatDoesNotStop) {
  std::promise<void> end;
  start([&, ended = end.get_future().share()](const Model& model, const Analysis& analysis,
                                              const Hooks& hooks) {
    ended.wait();
    return solved(model, analysis, hooks);
  });
  const std::string job = submit();
  const int kept_port = port();
  std::thread stopping([&] { service_->stop(); });
  EXPECT_TRUE(eventually([&] { return get(kept_port, "/readyz").status == 503; }));
  EXPECT_EQ(get(kept_port, "/livez").status, 200);
  EXPECT_EQ(get(kept_port, job).status, 200);
  EXPECT_EQ(post(kept_port, "/v1/jobs", column_request("new"), kAsync).status, 503);
  end.set_value();
  stopping.join();
  EXPECT_THROW(get(kept_port, "/livez"), std::system_error);
}

TEST_F(ServiceTest, ManyRequestsShareAConnection) {
  start(solved);
  Socket socket(port());
  const std::string body = column_request();
  for (int i = 0; i < 50; ++i) {
    socket.send(
        "GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\nPOST /v1/jobs HTTP/1.1\r\nHost: localhost\r\n"
        "Content-Type: application/json\r\nContent-Length: " +
        std::to_string(body.size()) + "\r\n\r\n" + body);
    EXPECT_EQ(socket.receive().status, 200);
    EXPECT_EQ(socket.receive().status, 200);
  }
}

TEST_F(ServiceTest, AnUnreadBodyDoesNotBecomeTheNextRequest) {
  start(solved);
  Socket socket(port());
  const std::string smuggled = "GET /smuggled HTTP/1.1\r\nHost: localhost\r\n\r\n";
  socket.send(
      "POST /nowhere HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(smuggled.size()) +
      "\r\n\r\n" + smuggled + "GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(socket.receive().status, 404);
  EXPECT_EQ(socket.receive().status, 200);
}

TEST_F(ServiceTest, AsksForABodyThatTheClientHoldsBack) {
  start(solved);
  Socket socket(port());
  const std::string body = column_request();
  socket.send(
      "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nExpect: "
      "100-continue\r\n"
      "Content-Length: " +
      std::to_string(body.size()) + "\r\n\r\n");
  EXPECT_EQ(socket.receive().status, 100);
  socket.send(body);
  EXPECT_EQ(socket.receive().status, 200);
}

/// As curl, .NET and Node send a body whose length they do not know.
TEST_F(ServiceTest, TakesABodyInChunks) {
  start(solved);
  Socket socket(port());
  const std::string body = column_request();
  socket.send(
      "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "Transfer-Encoding: chunked\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(socket.receive().status, 100);
  for (std::size_t at = 0; at < body.size(); at += 16) {
    const std::string piece = body.substr(at, 16);
    socket.send((piece.size() == 16 ? "10" : std::string(1, "0123456789abcdef"[piece.size()])) + "\r\n" +
                piece + "\r\n");
  }
  socket.send("0\r\n\r\n");
  EXPECT_EQ(socket.receive().status, 200);
}

/// The requests of clients that people have, byte for byte as their sources send them:
/// HttpClient.PostAsJsonAsync of .NET (chunks, since JsonContent has no length; hexadecimal digits in
/// capitals), fetch of a stream in Node (undici), curl -T -, requests and http.client of Python,
/// Invoke-RestMethod, Power Query's Web.Contents.
TEST_F(ServiceTest, TakesTheRequestsOfOtherPeoplesClients) {
  start(solved);
  const std::string body = column_request();
  const std::string host = "Host: localhost:" + std::to_string(port()) + "\r\n";
  std::ostringstream capitals;
  capitals << std::hex << std::uppercase << body.size() << "\r\n" << body << "\r\n0\r\n\r\n";
  std::ostringstream small;
  small << std::hex << body.size() << "\r\n" << body << "\r\n0\r\n\r\n";
  const std::string length = "Content-Length: " + std::to_string(body.size()) + "\r\n";
  const std::string chunks = "Transfer-Encoding: chunked\r\n";
  const std::string requests[] = {
      host + chunks + "Content-Type: application/json; charset=utf-8\r\n\r\n" + capitals.str(),
      host +
          "connection: keep-alive\r\ncontent-type: application/json\r\naccept: */*\r\naccept-language: *\r\n"
          "sec-fetch-mode: cors\r\nuser-agent: node\r\naccept-encoding: br, gzip, deflate\r\n" +
          "transfer-encoding: chunked\r\n\r\n" + small.str(),
      host + "User-Agent: curl/7.88.1\r\nAccept: */*\r\n" + chunks +
          "Content-Type: application/json\r\n\r\n" + small.str(),
      host +
          "User-Agent: python-requests/2.28.1\r\nAccept-Encoding: gzip, deflate\r\nAccept: */*\r\n"
          "Connection: keep-alive\r\n" +
          length + "Content-Type: application/json\r\n\r\n" + body,
      host + "Accept-Encoding: identity\r\n" + length + "Content-Type: application/json\r\n\r\n" + body,
      host +
          "User-Agent: Mozilla/5.0 (Windows NT; Windows NT 10.0; en-US) WindowsPowerShell/5.1\r\n"
          "Content-Type: application/json\r\n" +
          length + "Connection: Keep-Alive\r\n\r\n" + body,
      host +
          "Content-Type: application/json\r\nPrefer: return=minimal\r\nUser-Agent: Microsoft.Data.Mashup\r\n"
          "Accept-Encoding: gzip, deflate\r\n" +
          length + "\r\n" + body};
  for (const std::string& request : requests) {
    Socket socket(port());
    socket.send("POST /v1/jobs HTTP/1.1\r\n" + request);
    const int status = socket.receive().status;
    EXPECT_TRUE(status == 200 || status == 201) << status << '\n' << request;
  }
}

TEST_F(ServiceTest, APortInUseIsReported) {
  start(solved);
  ServiceConfig other = config();
  other.listener.port = port();
  other.store_path = folder_.file("other.db");
  Service second(other, Environment::system(), local_runners(solved), log_);
  const Status status = second.start();
  EXPECT_EQ(status.code(), StatusCode::unavailable);
  EXPECT_THAT(status.message(), HasSubstr(std::to_string(port())));
}

/// The gauge of that name.
double gauge(int port, const std::string& name) {
  const std::string text = get(port, "/metrics").body;
  const std::size_t at = text.find("\n" + name + " ");
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + name.size() + 2));
}

/// What was acknowledged is known, also while nothing new is taken.
TEST_F(ServiceTest, AnAcknowledgedIdempotencyKeyIsKnownWhileTheQueueIsFull) {
  const auto solver = std::make_shared<GatedSolver>();
  ServiceConfig small = config();
  small.workers = 1;
  small.jobs.queue = 1;
  service_ = std::make_unique<Service>(small, Environment::system(), local_runners(gated(solver)), log_);
  ASSERT_TRUE(service_->start().ok());
  submit("held");
  solver->wait_started(1);
  const Headers keyed{"Content-Type: application/json", "Prefer: respond-async", "Idempotency-Key: \"k1\""};
  Reply first = post(port(), "/v1/jobs", column_request("waiting"), keyed);
  EXPECT_TRUE(eventually([&] {  // a count of waiting jobs may include one just begun
    if (first.status == 429) {
      first = post(port(), "/v1/jobs", column_request("waiting"), keyed);
    }
    return first.status != 429;
  }));
  EXPECT_EQ(first.status, 201) << first.body;
  EXPECT_EQ(post(port(), "/v1/jobs", column_request("another"),
                 {"Content-Type: application/json", "Prefer: respond-async"})
                .status,
            429);
  const Reply again = post(port(), "/v1/jobs", column_request("waiting"), keyed);
  EXPECT_NE(again.status, 429);
  EXPECT_EQ(again.header("Location"), first.header("Location"));
  EXPECT_EQ(post(port(), "/v1/jobs", column_request("other document"), keyed).status, 422);
  solver->open();
}

/// Connections of clients that left while their answers waited were kept to the end of the wait.
TEST_F(ServiceTest, AClientThatLeavesWhileItsAnswerWaitsIsLetGo) {
  const auto solver = std::make_shared<GatedSolver>();
  ServiceConfig patient = config();
  patient.waits.longest_wait = std::chrono::hours(1);
  service_ = std::make_unique<Service>(patient, Environment::system(), local_runners(gated(solver)), log_);
  ASSERT_TRUE(service_->start().ok());
  const std::string job = submit();
  solver->wait_started(1);
  const double before = gauge(port(), "snapthrough_connections");
  constexpr double kAll = 100.0 + 1.0;  // with the one that asks
  {
    std::vector<std::unique_ptr<Socket>> waiting;
    for (int i = 0; i < 100; ++i) {
      waiting.push_back(std::make_unique<Socket>(port()));
      waiting.back()->send("GET " + job + " HTTP/1.1\r\nHost: localhost\r\nPrefer: wait=3600\r\n\r\n");
    }
    EXPECT_TRUE(eventually([&] { return gauge(port(), "snapthrough_connections") >= kAll; }));
  }
  EXPECT_TRUE(eventually([&] { return gauge(port(), "snapthrough_connections") <= before; }));
  solver->open();
  EXPECT_EQ(json::parse(get(port(), job, {"Prefer: wait=60"}).body)["status"], "successful");
}

/// Without keys whoever reaches the port may do everything: pages of other sites must not reach it.
TEST_F(ServiceTest, WithoutKeysOnlyLocalNamesAndPagesOfItsOwnAreAnswered) {
  start(gated(std::make_shared<GatedSolver>()));
  const auto status = [&](const std::string& host, const std::string& origin = "") {
    Socket socket(port());
    socket.send("GET /v1/limits HTTP/1.1\r\nHost: " + host + "\r\n" +
                (origin.empty() ? "" : "Origin: " + origin + "\r\n") + "Connection: close\r\n\r\n");
    return socket.receive().status;
  };
  for (const char* host :
       {"localhost", "localhost:8080", "127.0.0.1:8080", "127.0.0.1", "[::1]:8080", "LocalHost"})
    EXPECT_EQ(status(host), 200) << host;
  for (const char* host :
       {"evil.example", "127.0.0.1.evil.example", "localhost.evil.example:8080", "192.0.2.1"})
    EXPECT_EQ(status(host), 403) << host;
  EXPECT_EQ(status("localhost:8080", "http://localhost:8080"), 200);
  for (const char* origin : {"http://evil.example", "null", "https://localhost:8080", "http://localhost:9"})
    EXPECT_EQ(status("localhost:8080", origin), 403) << origin;
}

TEST_F(ServiceTest, ALongHeaderThatIsAllowedIsServed) {
  start(gated(std::make_shared<GatedSolver>()));
  EXPECT_EQ(get(port(), "/livez", {"X-Long: " + std::string(8000, 'x')}).status, 200);
  EXPECT_EQ(get(port(), "/livez", {"X-Long: " + std::string(16'000, 'x')}).status, 200);
  EXPECT_EQ(get(port(), "/livez", {"X-Long: " + std::string(17'000, 'x')}).status, 431);
}

/// Numbers that are random once the test lets them be: requests without an identifier wait for theirs.
struct GatedNumbers {
  std::mutex mutex;
  std::condition_variable changed;
  bool open = true;
  int asked = 0;

  std::uint64_t operator()() {
    std::unique_lock lock(mutex);
    ++asked;
    changed.notify_all();
    changed.wait(lock, [&] { return open; });
    return Environment::system().random_bits();
  }
  void set(bool is_open) {
    const std::lock_guard guard(mutex);
    open = is_open;
    asked = 0;
    changed.notify_all();
  }
  bool wait_asked() {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, kPatience, [&] { return asked > 0; });
  }
};

/// One request at a time is worked on here; it is stopped, and others wait behind it.
TEST_F(ServiceTest, ProbesDoNotWaitForRequestsThatAreWorkedOn) {
  const auto numbers = std::make_shared<GatedNumbers>();
  Environment environment = Environment::system();
  environment.random_bits = [numbers] { return (*numbers)(); };
  ServiceConfig narrow = config();
  narrow.listener.threads = 1;
  service_ = std::make_unique<Service>(narrow, environment, local_runners(solved), log_);
  ASSERT_TRUE(service_->start().ok());
  const std::string list = "GET /v1/jobs HTTP/1.1\r\nHost: localhost\r\n\r\n";
  numbers->set(false);
  Socket first(port());
  first.send(list);
  ASSERT_TRUE(numbers->wait_asked());
  Socket second(port());
  second.send(list);
  {
    Socket leaves(port());
    leaves.send(list);
    EXPECT_EQ(get(port(), "/livez", {"X-Request-Id: a"}).status, 200);
  }
  Socket last(port());
  last.send(list);
  for (const char* probe : {"/livez", "/readyz"}) {
    EXPECT_EQ(get(port(), probe, {"X-Request-Id: a"}).status, 200) << probe;
  }
  numbers->set(true);
  for (Socket* waiting : {&first, &second, &last}) {
    EXPECT_EQ(waiting->receive().status, 200);
  }
  EXPECT_EQ(get(port(), "/v1/jobs").status, 200);  // the turn of the one that left was passed on
}

TEST_F(ServiceTest, AnIdempotencyKeyThatIsEmptyIsRefused) {
  start(gated(std::make_shared<GatedSolver>()));
  const Headers empty{"Content-Type: application/json", "Idempotency-Key: "};
  EXPECT_EQ(post(port(), "/v1/jobs", column_request(), empty).status, 400);
}

}  // namespace
}  // namespace snapthrough::server::test
