/// @file
/// Callbacks: what is told of the end of a job or sweep, to whom, how often, and what it must not delay.

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "api/openapi/document.h"
#include "server/jobs/callback.h"
#include "server/webhooks/post.h"
#include "server/webhooks/signature.h"
#include "tests/server/support/json_schema.h"
#include "tests/server/support/receiver.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kSecret = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw";
const std::string kJson = "Content-Type: application/json";

std::string with_callback(const std::string& address, const std::string& member = "request",
                          const std::string& document = column_request()) {
  return "{\"callback\": \"" + address + "\", \"" + member + "\": " + document + "}";
}

/// Whether a document is as it is published.
bool published(const char* name, const json& document) {
  static const json description = json::parse(api::openapi_document());
  const Schemas schemas(description);
  return schemas.valid(schemas.named(name), document);
}

Result failing(const Model&, const Analysis&, const Hooks&) {
  Result result;
  result.failure = Failure{"no_convergence", "as it was told"};
  return result;
}

class Callback : public ServiceTest {
 protected:
  /// A service that may tell these hosts, soon and often.
  void start_telling(const std::vector<std::string>& hosts, SolveFunction solver = solve) {
    ServiceConfig telling = config();
    telling.jobs.callback_hosts = hosts;
    telling.callback_secret_file = folder_.file("secret");
    std::ofstream(telling.callback_secret_file) << kSecret << "\n";
    telling.callback_times = times_;
    service_ =
        std::make_unique<Service>(telling, Environment::system(), local_runners(std::move(solver)), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  /// Hands in a job without waiting; its id.
  std::string add(const std::string& body, const std::string& path = "/v1/jobs") {
    const Reply reply = post(port(), path, body, {kJson, "Prefer: respond-async", "Cache-Control: no-cache"});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return json::parse(reply.body)["id"];
  }
  /// The value of a metric, once it is that or after kPatience.
  double metric(const std::string& name, double expected) {
    double value = -1.0;
    (void)eventually([&] {
      const std::string text = get(port(), "/metrics").body;
      const std::size_t at = text.find("\nsnapthrough_" + name + " ");
      value = at == std::string::npos ? -1.0 : std::stod(text.substr(text.find(' ', at) + 1));
      return value == expected;
    });
    return value;
  }

  WebhookTimes times_{std::chrono::hours(1),
                      std::chrono::milliseconds(10),
                      {std::chrono::milliseconds(20), std::chrono::milliseconds(20)}};
};

/// The expected value is from hmac, hashlib and base64 of Python.
TEST(WebhookSignature, IsThatOfAnotherImplementation) {
  const std::optional<std::string> key = webhook_key(" " + std::string(kSecret) + "\r\n");
  ASSERT_TRUE(key);
  EXPECT_EQ(key->size(), 24U);
  EXPECT_EQ(webhook_signature(*key, "msg_p5jXN8AQM9LWM0D4loKWxJek", 1614265330, R"({"test": 2432232314})"),
            "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=");
}

TEST(WebhookSignature, KeysHaveTheirFormAndLength) {
  for (const std::string text : {"", "whsec_", "MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw",
                                 "whsec_MfKQ9r8GKYqrTwjUPD8=", "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaS",
                                 "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLa!!"}) {
    EXPECT_FALSE(webhook_key(text)) << text;
  }
  EXPECT_EQ(webhook_key("whsec_" + std::string(84, 'A') + "AA==")->size(), 64U);
  EXPECT_FALSE(webhook_key("whsec_" + std::string(84, 'A') + "AAA="));
}

TEST(CallbackAddress, BeginsWithAListedOrigin) {
  const std::vector<std::string> hosts{"hooks.example", "hooks.example:8443", "127.0.0.1:9000", "[::1]:9000"};
  for (const char* good :
       {"https://hooks.example/", "https://hooks.example/a?b=%20", "https://hooks.example:8443/a",
        "http://127.0.0.1:9000/", "https://127.0.0.1:9000/", "http://[::1]:9000/x"}) {
    EXPECT_FALSE(check_callback(good, hosts)) << good;
  }
  for (const char* bad :
       {"", "/", "https://hooks.example", "http://hooks.example/", "https://HOOKS.example/",
        "https://hooks.example@evil.example/", "https://hooks.example.evil.example/",
        "https://hooks.example:443/", "https://user@hooks.example/", "http://127.0.0.1/",
        "http://127.0.0.2:9000/", "http://localhost:9000/", "ftp://hooks.example/",
        "https://hooks.example/a b", "https://hooks.example/a#b", "https://hooks.example/\r\nX: y",
        "https://hooks.example/\xc3\xa4", " https://hooks.example/"}) {
    const std::optional<Finding> finding = check_callback(bad, hosts);
    ASSERT_TRUE(finding) << bad;
    EXPECT_EQ(finding->pointer, "/callback");
    EXPECT_EQ(finding->code, "not_allowed");
  }
  EXPECT_EQ(check_callback("https://hooks.example/" + std::string(2000, 'x'), hosts)->code, "out_of_range");
}

TEST(CallbackAddress, HostsOfTheListAreExact) {
  for (const char* good :
       {"hooks.example", "hooks.example:8443", "127.0.0.1", "localhost:1", "[::1]", "[::1]:65535"}) {
    EXPECT_TRUE(is_callback_host(good)) << good;
  }
  for (const char* bad : {"", "*", "*.example", "https://hooks.example", "hooks.example/", "hooks.example:",
                          "hooks.example:0", "hooks.example:080", "hooks.example:65536", "hooks.example:80x",
                          "HOOKS.example", "::1", "[::1", "[hooks]", "a b", "user@hooks.example", ":80"}) {
    EXPECT_FALSE(is_callback_host(bad)) << bad;
  }
}

TEST_F(Callback, ARefusedAddressIsAFindingThatNamesTheRule) {
  start_telling({"hooks.example"});
  for (const auto& [path, member, document] :
       {std::tuple{"/v1/jobs", "request", column_request()}, {"/v1/sweeps", "sweep", column_sweep(2)}}) {
    const Reply reply = post(port(), path, with_callback("http://hooks.example/a", member, document));
    EXPECT_EQ(reply.status, 422);
    const json error = json::parse(reply.body)["errors"].at(0);
    EXPECT_EQ(error["pointer"], "/callback");
    EXPECT_THAT(error["detail"], HasSubstr("https://hooks.example/"));
  }
  EXPECT_THAT(post(port(), "/v1/check", with_callback("http://other/")).body, HasSubstr("/callback"));
  EXPECT_THAT(post(port(), "/v1/jobs", "{\"callback\": 7, \"request\": " + column_request() + "}").body,
              HasSubstr("expected a string"));
}

TEST_F(Callback, WithoutHostsEveryAddressIsRefused) {
  start(solve);
  const Reply reply = post(port(), "/v1/jobs", with_callback("https://hooks.example/"));
  EXPECT_EQ(reply.status, 422);
  EXPECT_THAT(reply.body, HasSubstr("callback_hosts is empty"));
}

TEST_F(Callback, WithoutAUsableSecretTheServiceDoesNotStart) {
  ServiceConfig wrong = config();
  wrong.jobs.callback_hosts = {"*"};
  std::vector<std::string> fields;
  for (const ConfigMistake& mistake : wrong.check()) {
    fields.push_back(mistake.field);
  }
  EXPECT_THAT(fields, ElementsAre("jobs.callback_hosts", "callback_secret_file"));
  wrong.jobs.callback_hosts = {"hooks.example"};
  wrong.callback_secret_file = folder_.file("none");
  Service service(wrong, Environment::system(), local_runners(solve), log_);
  EXPECT_THAT(service.start().message(), HasSubstr("callback_secret_file"));
}

TEST_F(Callback, AnEndIsToldWithItsStatusAndASignature) {
  Receiver receiver;
  start_telling({receiver.host()});
  const std::string id = add(with_callback(receiver.address()));
  const Told told = receiver.wait_for(1).at(0);
  EXPECT_EQ(told.target, "POST /ended?x=1");
  const json status = json::parse(told.body);
  EXPECT_TRUE(published("Job", status));
  EXPECT_TRUE(published("AnnotatedRequest", json::parse(with_callback(receiver.address()))));
  EXPECT_EQ(status["id"], id);
  EXPECT_EQ(status["status"], "successful");
  EXPECT_EQ(status["callback"], receiver.address());
  EXPECT_EQ(told.body, get(port(), "/v1/jobs/" + id).body);
  EXPECT_EQ(told.headers.at("content-type"), "application/json");
  EXPECT_EQ(told.headers.at("webhook-id").substr(0, 37), id + "-");
  EXPECT_EQ(told.headers.at("webhook-signature"),
            webhook_signature(*webhook_key(kSecret), told.headers.at("webhook-id"),
                              std::stoll(told.headers.at("webhook-timestamp")), told.body));
  EXPECT_EQ(metric("callbacks_delivered_total", 1), 1);
  EXPECT_EQ(metric("callbacks_waiting", 0), 0);
  EXPECT_EQ(receiver.told().size(), 1U);
}

TEST_F(Callback, AKnownResultIsToldOfItsNewJob) {
  Receiver receiver;
  start_telling({receiver.host()});
  const Reply plain = post(port(), "/v1/jobs", column_request());
  const Reply again = post(port(), "/v1/jobs", with_callback(receiver.address()));
  EXPECT_EQ(again.header("X-Cache"), "hit");
  EXPECT_EQ(again.body, plain.body);
  EXPECT_NE(again.header("Location"), plain.header("Location"));
  EXPECT_EQ("/v1/jobs/" + json::parse(receiver.wait_for(1).at(0).body)["id"].get<std::string>(),
            again.header("Location"));
}

TEST_F(Callback, WhatIsNotTakenIsToldAgainUnderTheSameId) {
  Receiver receiver([](int number) {
    return number == 0 ? response(500) : number == 1 ? std::string() : response(200);
  });
  times_.attempt = std::chrono::seconds(1);
  times_.pauses = std::vector<std::chrono::milliseconds>(1000, std::chrono::milliseconds(20));
  start_telling({receiver.host()});
  add(with_callback(receiver.address()));
  const std::vector<Told> told = receiver.wait_for(3);
  ASSERT_GE(told.size(), 3U);
  for (const Told& one : told) {
    EXPECT_EQ(one.headers.at("webhook-id"), told[0].headers.at("webhook-id"));
    EXPECT_EQ(one.body, told[0].body);
  }
  EXPECT_EQ(metric("callbacks_delivered_total", 1), 1);
  EXPECT_GE(metric("callback_attempts_failed_total", 2), 2)
      << "more if the receiver had no processor for 1 s";
}

TEST_F(Callback, ItIsGivenUpAfterTheLastPauseAndRedirectsAreNotFollowed) {
  Receiver elsewhere;
  Receiver receiver([&](int) { return response(307, "Location: " + elsewhere.address() + "\r\n"); });
  start_telling({receiver.host(), elsewhere.host()});
  add(with_callback(receiver.address()));
  EXPECT_EQ(metric("callbacks_given_up_total", 1), 1);
  EXPECT_EQ(metric("callbacks_waiting", 0), 0);
  EXPECT_EQ(receiver.told().size(), 3U);
  EXPECT_EQ(elsewhere.told().size(), 0U);
  EXPECT_THAT(log_text_.text(), HasSubstr("\"outcome\":\"given_up\""));
}

TEST_F(Callback, WhatWaitsSurvivesARestart) {
  std::atomic<bool> up = false;
  Receiver receiver([&](int) { return response(up ? 200 : 503); });
  times_.pauses = std::vector<std::chrono::milliseconds>(1000, std::chrono::milliseconds(50));
  start_telling({receiver.host()});
  const std::string id = add(with_callback(receiver.address()));
  const std::string first = receiver.wait_for(1).at(0).headers.at("webhook-id");
  service_.reset();
  const std::size_t before = receiver.told().size();
  up = true;
  start_telling({receiver.host()});
  const std::vector<Told> told = receiver.wait_for(before + 1);
  EXPECT_EQ(told.at(before).headers.at("webhook-id"), first);
  EXPECT_EQ(json::parse(told.at(before).body)["id"], id);
  EXPECT_EQ(metric("callbacks_waiting", 0), 0);
}

TEST_F(Callback, FailedAndDismissedJobsAreTold) {
  Receiver receiver;
  start_telling({receiver.host()}, failing);
  add(with_callback(receiver.address()));
  EXPECT_EQ(json::parse(receiver.wait_for(1).at(0).body)["error"]["code"], "no_convergence");
  service_.reset();
  const auto solver = std::make_shared<GatedSolver>();
  start_telling({receiver.host()}, gated(solver));
  const std::string id = add(with_callback(receiver.address(), "request", column_request("other")));
  solver->wait_started(1);
  EXPECT_EQ(post(port(), "/v1/jobs/" + id + "/dismiss", "").status, 200);
  const json told = json::parse(receiver.wait_for(2).at(1).body);
  EXPECT_EQ(told["id"], id);
  EXPECT_EQ(told["status"], "dismissed");
}

TEST_F(Callback, ASweepIsToldOnce) {
  Receiver receiver;
  start_telling({receiver.host()});
  const std::string id = add(with_callback(receiver.address(), "sweep", column_sweep(5)), "/v1/sweeps");
  const json told = json::parse(receiver.wait_for(1).at(0).body);
  EXPECT_EQ(told["id"], id);
  EXPECT_EQ(told["status"], "successful");
  EXPECT_EQ(told["counts"]["remaining"], 0);
  EXPECT_TRUE(published("Sweep", told));
  EXPECT_EQ(metric("callbacks_delivered_total", 1), 1);
  EXPECT_EQ(metric("callbacks_waiting", 0), 0);
  EXPECT_EQ(receiver.told().size(), 1U);
}

TEST_F(Callback, AReceiverThatStallsDelaysNeitherJobsNorOthersNorTheEnd) {
  Receiver silent([](int) { return std::string(); });
  Receiver receiver;
  start_telling({silent.host(), receiver.host()});
  add(with_callback(silent.address()));
  add(with_callback(silent.address()));
  ASSERT_EQ(silent.wait_for(2).size(), 2U);
  add(with_callback(silent.address()));
  EXPECT_EQ(post(port(), "/v1/jobs", with_callback(receiver.address())).status, 200);
  EXPECT_EQ(receiver.wait_for(1).size(), 1U);
  service_.reset();  // all this during an attempt that may take an hour
  EXPECT_EQ(silent.told().size(), 2U) << "of one owner";
  start_telling({receiver.host()});
  EXPECT_EQ(metric("callbacks_waiting", 3), 3) << "what was cut is not lost, nor counted as an attempt";
}

TEST_F(Callback, AnAttemptEndsHoweverSlowlyTheReceiverAnswers) {
  times_.attempt = std::chrono::milliseconds(300);
  Receiver receiver([](int number) {
    return number == 0 ? std::string("HTTP/1.1 200 OK\r\nX-Long: ") + Receiver::kDrip : response(200);
  });
  start_telling({receiver.host()});
  add(with_callback(receiver.address()));
  EXPECT_GE(receiver.wait_for(2).size(), 2U);
  EXPECT_GE(metric("callback_attempts_failed_total", 1), 1);
}

/// The library holds a lock while it connects, so that its own stop() would wait for that.
TEST(CallbackPost, OneThatCanNotConnectIsCut) {
  const Descriptor full(::socket(AF_INET, SOCK_STREAM, 0));
  ASSERT_EQ(::listen(full.get(), 0), 0);
  const int port = http::port_of(full.get());
  std::vector<Descriptor> queue;  // the kernel answers no more than these
  for (int i = 0; i < 4; ++i) {
    queue.emplace_back(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    (void)::connect(queue.back().get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  Poster poster("http://127.0.0.1:" + std::to_string(port), std::chrono::hours(1));
  std::atomic<bool> done = false;
  const std::jthread post([&] {
    sigset_t signals;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    EXPECT_EQ(poster.post("/", "{}", {}).status, 0);
    done = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(done) << "it was connected or refused";
  EXPECT_TRUE(eventually([&] {  // the kernel goes on for two minutes
    poster.cut_late(true);
    return done.load();
  }));
}

TEST_F(Callback, TheBodyOfAResponseIsNotReadToItsEnd) {
  Receiver receiver([](int) {
    return "HTTP/1.1 200 OK\r\nContent-Length: 1000000000000\r\n\r\n" + std::string(100'000, 'x') +
           Receiver::kDrip;
  });
  start_telling({receiver.host()});
  add(with_callback(receiver.address()));
  EXPECT_EQ(metric("callbacks_delivered_total", 1), 1);
}

}  // namespace
}  // namespace snapthrough::server::test
