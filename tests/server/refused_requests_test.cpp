/// @file
/// Requests that are refused: the right status, the right pointer, and nothing stored.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "solver/solve.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::StartsWith;

class RefusedRequests : public ServiceTest {
 protected:
  void SetUp() override { start(solve); }
  void TearDown() override {
    EXPECT_TRUE(json::parse(get(port(), "/v1/jobs").body)["jobs"].empty()) << "something was stored";
  }
  /// A valid document with one thing made wrong.
  static json document() { return json::parse(column_request()); }
  /// Posts it and expects 422; the pointers of the findings.
  std::vector<std::string> pointers(const json& wrong) {
    const Reply reply = post(port(), "/v1/jobs", wrong.dump());
    EXPECT_EQ(reply.status, 422) << reply.body;
    EXPECT_EQ(reply.header("Content-Type"), "application/problem+json");
    EXPECT_EQ(reply.header("Location"), "");
    const json problem = json::parse(reply.body);
    EXPECT_EQ(problem["type"], "urn:snapthrough:problem:invalid-request");
    std::vector<std::string> found;
    for (const json& error : problem["errors"]) {
      EXPECT_FALSE(error["code"].get<std::string>().empty());
      EXPECT_FALSE(error["detail"].get<std::string>().empty());
      found.push_back(error["pointer"]);
    }
    return found;
  }
};

TEST_F(RefusedRequests, MalformedJson) {
  for (const char* body :
       {"{\"model\": ", "", "not json", "{\"a\": 1, \"a\": 2}", "{}x", "[1,]", "\xff\xfe{}"}) {
    const Reply reply = post(port(), "/v1/jobs", body);
    EXPECT_EQ(reply.status, 400) << body;
    EXPECT_EQ(json::parse(reply.body)["type"], "urn:snapthrough:problem:malformed-json");
  }
  EXPECT_EQ(post(port(), "/v1/jobs", std::string(40'000, '[')).status, 400);
}

TEST_F(RefusedRequests, UnknownField) {
  json wrong = document();
  wrong["model"]["sections"][0]["Ei"] = 1;
  EXPECT_THAT(pointers(wrong), Contains("/model/sections/0/Ei"));
}

TEST_F(RefusedRequests, MissingNode) {
  json wrong = document();
  wrong["model"]["members"][0]["end"] = "nowhere";
  EXPECT_THAT(pointers(wrong), Contains("/model/members/0/end"));
}

TEST_F(RefusedRequests, ZeroLength) {
  json wrong = document();
  wrong["model"]["nodes"][1]["x"] = 0;
  EXPECT_THAT(pointers(wrong), Contains(StartsWith("/model/members/0")));
}

TEST_F(RefusedRequests, NegativeBendingStiffness) {
  json wrong = document();
  wrong["model"]["sections"][0]["EI"] = -1;
  EXPECT_THAT(pointers(wrong), Contains("/model/sections/0/EI"));
}

TEST_F(RefusedRequests, Mechanism) {
  json wrong = document();
  wrong["model"]["supports"][0]["fixed"] = {"y", "rotation"};  // the load drives it along its axis
  EXPECT_FALSE(pointers(wrong).empty());
}

TEST_F(RefusedRequests, TwoFindingsAtOnce) {
  json wrong = document();
  wrong["model"]["sections"][0]["EI"] = -1;
  wrong["model"]["members"][0]["start"] = "nowhere";
  const std::vector<std::string> found = pointers(wrong);
  EXPECT_THAT(found, Contains("/model/sections/0/EI"));
  EXPECT_THAT(found, Contains("/model/members/0/start"));
}

TEST_F(RefusedRequests, AnotherMediaType) {
  for (const Headers& headers : {Headers{}, Headers{"Content-Type: text/plain"},
                                 Headers{"Content-Type: application/x-www-form-urlencoded"},
                                 Headers{"Content-Type: multipart/form-data; boundary=x"}}) {
    EXPECT_EQ(post(port(), "/v1/jobs", column_request(), headers).status, 415);
  }
}

TEST_F(RefusedRequests, ABodyOverTheLimitIsNotEvenRead) {
  Socket socket(port());
  socket.send(
      "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: "
      "100001\r\n\r\n");
  EXPECT_EQ(socket.receive().status, 413);  // before a byte of the body
  EXPECT_EQ(post(port(), "/v1/jobs", std::string(3'000'000, ' ')).status,
            413);  // the sender reads it all the same
}

TEST_F(RefusedRequests, MoreKeysThanTheLimit) {
  ServiceConfig small = config();
  small.jobs.json_keys = 20;
  service_ = std::make_unique<Service>(small, Environment::system(), local_runners(solve), log_);
  ASSERT_TRUE(service_->start().ok());
  EXPECT_EQ(json::parse(get(port(), "/v1/limits").body)["json_keys"], 20);
  for (const char* path : {"/v1/jobs", "/v1/sweeps"}) {
    const Reply reply = post(port(), path, document().dump());
    EXPECT_EQ(reply.status, 400);
    const json error = json::parse(reply.body)["errors"][0];
    EXPECT_EQ(error["code"], "too_many_keys");
    EXPECT_THAT(error["detail"].get<std::string>(), testing::HasSubstr("at most 20 keys (json_keys)"));
  }
}

TEST_F(RefusedRequests, BytesThatAreNoRequest) {
  const auto answer = [&](const std::string& bytes) {
    Socket socket(port());
    socket.send(bytes);
    const Reply reply = socket.receive();
    EXPECT_TRUE(socket.at_end());
    EXPECT_EQ(json::parse(reply.body)["status"], reply.status);
    return reply.status;
  };
  EXPECT_EQ(answer("\x16\x03\x01 hello\r\n\r\n"), 400);
  EXPECT_EQ(answer("FOO / HTTP/1.1\r\n\r\n"), 501);
  EXPECT_EQ(answer("GET / HTTP/1.12\r\n\r\n"), 400);  // which the library finds
  EXPECT_EQ(answer("POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n1;a\r\n"),
            400);
  EXPECT_EQ(answer("POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\n\r\n"), 411);
  EXPECT_EQ(answer("GET /" + std::string(5000, 'a') + " HTTP/1.1\r\n\r\n"), 414);
  EXPECT_EQ(answer("GET / HTTP/1.1\r\nA: " + std::string(20'000, 'a') + "\r\n\r\n"), 431);
}

}  // namespace
}  // namespace snapthrough::server::test
