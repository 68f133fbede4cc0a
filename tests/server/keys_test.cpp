/// @file
/// Keys that expire and permit a part, and keys of one job, on every driver of the store.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "server/digest.h"
#include "server/front/gateway.h"
#include "server/resources/job_key.h"
#include "server/settings.h"
#include "tests/server/support/owners.h"
#include "tests/server/support/process.h"
#include "tests/server/support/running_service.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using http::ApiKey;
using http::Request;
using http::Response;
using http::Scope;
using http::Scopes;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kJob = "/v1/jobs/" + id_number(1);
const std::string kOtherJob = "/v1/jobs/" + id_number(2);
const std::string kNoJob = "/v1/jobs/" + id_number(9);
const Lease kLease{"worker", at_second(1'000'000)};

/// The kind of a response's problem, with its status; "200" for a response that is none.
std::string outcome(const Response& response) {
  const std::string status = std::to_string(response.status);
  if (response.content_type != "application/problem+json") {
    return status;
  }
  const std::string type = json::parse(response.body)["type"];
  return status + " " + type.substr(type.rfind(':') + 1);
}

class Keys : public StoreTest {
 protected:
  void ask_for(std::vector<ApiKey> keys) {
    keys_ = std::make_unique<http::KeyRing>(std::move(keys));
    jobs_ = std::make_unique<JobService>(*store_, environment_, log_);
    http::ServiceFacts facts;
    facts.metrics = [] { return "a_metric 1\n"; };
    facts.not_ready = [] { return ""; };
    routes_ = std::make_unique<http::Routes>(*jobs_, http::WaitLimits{}, facts);
    gateway_ = std::make_unique<http::Gateway>(*routes_, environment_, log_, *keys_, metrics_);
  }
  Response serve(const std::string& method, const std::string& path, const std::string& key) {
    Request request;
    request.method = method;
    request.path = path;
    request.remote = "192.0.2.1";
    if (!key.empty()) {
      request.headers = {{"Authorization", "Bearer " + key}};
    }
    return gateway_->serve(std::move(request));
  }
  std::string told(const std::string& method, const std::string& path, const std::string& key) {
    return outcome(serve(method, path, key));
  }
  /// Adds a job of ann that has its result.
  void add_job(int number) {
    NewJob job = new_job(id_number(number), number);
    job.owner = "ann";
    ASSERT_TRUE(store_->submit(job).ok());
    const auto claim = store_->claim(kLease, at_second(50));
    ASSERT_TRUE(claim.ok() && claim->has_value());
    ASSERT_TRUE(store_->finish(**claim, sample_result(), at_second(60)).ok());
  }
  /// Makes a key of a job with a key of the service.
  std::string job_key(const std::string& job, const std::string& key = "alice") {
    const Response response = serve("POST", job + "/key", key);
    EXPECT_EQ(response.status, 201) << response.body;
    EXPECT_EQ(response.header("Cache-Control"), "no-store");
    const json document = json::parse(response.body);
    EXPECT_EQ(document["job"], job.substr(job.rfind('/') + 1));
    EXPECT_TRUE(http::is_job_key(document["key"].get<std::string>())) << document;
    return document["key"];
  }

  FakeWorld world_;
  Environment environment_ = world_.environment();
  std::ostringstream log_text_;
  Log log_{LogLevel::debug, environment_.now, log_text_};
  http::RequestMetrics metrics_;
  std::unique_ptr<http::KeyRing> keys_;
  std::unique_ptr<JobService> jobs_;
  std::unique_ptr<http::Routes> routes_;
  std::unique_ptr<http::Gateway> gateway_;
};

TEST_P(Keys, AKeyIsRefusedFromTheInstantOfItsExpiryOn) {
  std::vector<ApiKey> keys = ann_and_bob();
  keys[0].expires = at_second(100);
  ask_for(keys);
  world_.microseconds = at_second(100).time_since_epoch().count() - 1;
  EXPECT_EQ(told("GET", "/v1/jobs", "alice"), "200");
  world_.microseconds = at_second(100).time_since_epoch().count();
  const Response refused = serve("GET", "/v1/jobs", "alice");
  EXPECT_EQ(outcome(refused), "401 key-expired");
  EXPECT_THAT(refused.body, HasSubstr("This key expired at " + rfc3339(at_second(100)) + "."));
  EXPECT_EQ(refused.header("WWW-Authenticate"), "Bearer");
  EXPECT_EQ(told("POST", "/v1/jobs", "alice"), "401 key-expired");
  EXPECT_EQ(told("GET", "/v1/jobs", "carol"), "401 unauthorized")
      << "nobody learns of keys that are not known";
  EXPECT_EQ(told("GET", "/v1/jobs", ""), "401 unauthorized");
  EXPECT_EQ(told("GET", "/v1/jobs", "bob"), "200");
  EXPECT_EQ(told("GET", "/livez", "alice"), "200") << "needs no key";
}

TEST_P(Keys, AnExpiredKeyCountsForItsAddress) {
  std::vector<ApiKey> keys = ann_and_bob();
  keys[0].expires = at_second(0);
  ask_for(keys);
  Request request;
  request.remote = "192.0.2.1";
  request.headers = {{"Authorization", "Bearer alice"}};
  EXPECT_EQ(gateway_->caller_of(request).party, "address 192.0.2.1");
  request.headers = {{"Authorization", "Bearer bob"}};
  EXPECT_EQ(gateway_->caller_of(request).party, "owner bob");
  request.headers = {{"Authorization", "Bearer " + http::new_job_key(environment_)}};
  EXPECT_EQ(gateway_->caller_of(request).party, "address 192.0.2.1");
}

/// The scopes of which an operation needs one, as the manual has them; none: it needs no key.
Scopes published_scopes(const std::string& method, const std::string& path) {
  static const std::set<std::string> kPublic{"GET /livez", "GET /readyz", "GET /v1/openapi.json",
                                             "GET /v1/hops", "GET /v1/hops/{id}"};
  static const std::set<std::string> kComputed{"POST /v1/check", "POST /v1/convert", "POST /v1/plot"};
  const std::string operation = method + " " + path;
  if (kPublic.contains(operation)) {
    return {};
  }
  if (path == "/metrics") {
    return {Scope::metrics};
  }
  if (kComputed.contains(operation)) {
    return {Scope::read, Scope::submit};
  }
  return method == "GET" ? Scopes{Scope::read} : Scopes{Scope::submit};
}

/// Replaces {id} by a job or sweep that is not there, and {n} by a number.
std::string target_of(std::string path) {
  for (const auto& [name, value] :
       {std::pair<std::string, std::string>("{id}", id_number(9)), {"{n}", "0"}}) {
    if (const std::size_t at = path.find(name); at != std::string::npos) {
      path.replace(at, name.size(), value);
    }
  }
  return path;
}

TEST_P(Keys, EachOperationNeedsOneOfItsScopes) {
  std::vector<ApiKey> keys;
  const std::vector<std::pair<std::string, Scope>> scopes{
      {"read", Scope::read}, {"submit", Scope::submit}, {"metrics", Scope::metrics}};
  for (const auto& [name, scope] : scopes) {
    keys.push_back({"ann", sha256_hex(name), std::nullopt, {scope}});
  }
  keys.push_back({"ann", sha256_hex("all")});
  ask_for(keys);
  for (const auto& [method, path] : http::Routes::resources()) {
    SCOPED_TRACE(method + " " + path);
    const std::string target = target_of(path);
    const Scopes needed = published_scopes(method, path);
    EXPECT_EQ(serve(method, target, "").status == 401, !needed.empty());
    EXPECT_NE(serve(method, target, "all").status, 401);
    EXPECT_NE(serve(method, target, "all").status, 403);
    for (const auto& [name, scope] : scopes) {
      for (const std::string& one :
           method == "GET" ? std::vector<std::string>{"GET", "HEAD"} : std::vector<std::string>{method}) {
        const Response response = serve(one, target, name);
        EXPECT_NE(response.status, 401);
        EXPECT_EQ(response.status == 403, !needed.empty() && !needed.has(scope)) << one << " with " << name;
      }
    }
  }
  const std::string detail = json::parse(serve("GET", "/v1/jobs", "metrics").body)["detail"];
  EXPECT_EQ(detail, "This needs a key with the scope read; this key has metrics.");
  EXPECT_EQ(told("POST", "/v1/jobs", "read"), "403 scope-missing");
  EXPECT_THAT(serve("POST", "/v1/check", "metrics").body, HasSubstr("read or submit"));
}

TEST_P(Keys, AKeyOfAJobReadsThatJobAndNothingElse) {
  add_job(1);
  add_job(2);
  ask_for(ann_and_bob());
  const std::string key = job_key(kJob);
  const std::set<std::string> readable{"", "/result", "/table.csv", "/request", "/events"};
  for (const std::string& part : readable) {
    for (const char* method : {"GET", "HEAD"}) {
      EXPECT_EQ(told(method, kJob + part, key), "200") << method << part;
      EXPECT_EQ(told(method, kOtherJob + part, key), "401 unauthorized") << method << part;
      EXPECT_EQ(told(method, kNoJob + part, key), "401 unauthorized") << method << part;
    }
  }
  for (const auto& [method, path] : http::Routes::resources()) {
    SCOPED_TRACE(method + " " + path);
    const bool of_job = path.starts_with("/v1/jobs/{id}") && readable.contains(path.substr(13));
    if (published_scopes(method, path).empty() || (method == "GET" && of_job)) {
      continue;
    }
    std::string target = path.starts_with("/v1/jobs/{id}") ? kJob + path.substr(13) : target_of(path);
    const Response response = serve(method, target, key);
    EXPECT_EQ(response.status, 403) << response.body;
    EXPECT_THAT(response.body, HasSubstr("key of a job"));
  }
  EXPECT_EQ(told("GET", "/v1/jobs/x", key), "403 scope-missing") << "no id";
  EXPECT_EQ(told("GET", kJob + "/", key), "403 scope-missing");
  EXPECT_EQ(told("GET", kJob, "alice"), "200") << "it is there still";
}

TEST_P(Keys, ARequestWithTheKeyOfAJobIsOneOfItsOwner) {
  add_job(1);
  ask_for(ann_and_bob());
  const std::string key = job_key(kJob);
  EXPECT_THAT(serve("GET", kJob, key).body, HasSubstr(id_number(1)));
  EXPECT_THAT(log_text_.str(), HasSubstr("\"ann\""));
  EXPECT_THAT(log_text_.str(), AllOf(Not(HasSubstr(key)), Not(HasSubstr(sha256_hex(key)))));
  std::string metrics;
  metrics_.write(metrics);
  EXPECT_THAT(metrics, AllOf(Not(HasSubstr(key)), Not(HasSubstr(sha256_hex(key)))));
  Request hops;
  hops.method = "GET";
  hops.path = kJob;
  hops.headers = {{"RhinoComputeKey", key}};
  EXPECT_EQ(gateway_->serve(hops).status, 200);
}

TEST_P(Keys, AnotherTextIsNoKeyOfAJob) {
  add_job(1);
  ask_for(ann_and_bob());
  const std::string key = job_key(kJob);
  for (const std::string& wrong : {http::new_job_key(environment_), key.substr(4), key.substr(0, 67),
                                   key + "0", "job_" + std::string(64, 'A'), std::string("job_")}) {
    EXPECT_EQ(told("GET", kJob, wrong), "401 unauthorized") << wrong;
  }
}

TEST_P(Keys, AKeyOfAJobEndsWithItsSuccessorAndWithTheJob) {
  add_job(1);
  ask_for(ann_and_bob());
  const std::string first = job_key(kJob);
  const std::string second = job_key(kJob);
  EXPECT_NE(first, second);
  EXPECT_EQ(told("GET", kJob, first), "401 unauthorized");
  EXPECT_EQ(told("GET", kJob, second), "200");
  EXPECT_EQ(told("DELETE", kJob, "alice"), "204");
  EXPECT_EQ(told("GET", kJob, second), "401 unauthorized");
}

TEST_P(Keys, OnlyTheOwnerOfAJobMakesItsKey) {
  add_job(1);
  ask_for(ann_and_bob());
  EXPECT_EQ(told("POST", kJob + "/key", "bob"), "404 no-such-job");
  EXPECT_EQ(told("POST", kJob + "/key", ""), "401 unauthorized");
  EXPECT_EQ(told("POST", kNoJob + "/key", "alice"), "404 no-such-job");
  EXPECT_EQ(told("POST", kJob + "/key", job_key(kJob)), "403 scope-missing");
}

TEST_P(Keys, AServiceWithoutKeysMakesNone) {
  ask_for({});
  ASSERT_TRUE(store_->submit(new_job(id_number(1))).ok());
  EXPECT_EQ(told("POST", kJob + "/key", ""), "409 no-keys");
  EXPECT_EQ(told("GET", kJob, http::new_job_key(environment_)), "200")
      << "whatever key comes is not looked at";
}

TEST_P(Keys, AConfiguredKeyMayHaveTheFormOfAJobs) {
  const std::string key = http::new_job_key(environment_);
  ask_for({{"ann", sha256_hex(key)}});
  EXPECT_EQ(told("GET", "/v1/jobs", key), "200");
}

TEST_P(Keys, TheStoreKeepsTheKeyOfAJobAsLongAsTheJob) {
  add_job(1);
  add_job(2);
  EXPECT_EQ(*store_->owner_by_key(id_number(1), "digest"), std::nullopt);
  EXPECT_EQ(*store_->owner_by_key(id_number(1), ""), std::nullopt);
  EXPECT_FALSE(*store_->set_key(id_number(9), "digest"));
  EXPECT_TRUE(*store_->set_key(id_number(1), "digest"));
  reopen();
  EXPECT_EQ(*store_->owner_by_key(id_number(1), "digest"), "ann");
  EXPECT_EQ(*store_->owner_by_key(id_number(2), "digest"), std::nullopt);
  EXPECT_EQ(*store_->owner_by_key(id_number(9), "digest"), std::nullopt);
  EXPECT_TRUE(*store_->set_key(id_number(1), "another"));
  EXPECT_EQ(*store_->owner_by_key(id_number(1), "digest"), std::nullopt);
  EXPECT_EQ(*store_->owner_by_key(id_number(1), "another"), "ann");
  EXPECT_EQ(*store_->retire(std::chrono::seconds(1), 10, at_second(1000)), 2);
  EXPECT_EQ(*store_->owner_by_key(id_number(1), "another"), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(Drivers, Keys, testing::ValuesIn(store_drivers()), driver_name);

/// Reads [[keys]] tables.
class KeySettings : public testing::Test {
 protected:
  /// The keys of a file whose text begins with owner and digest of a key.
  std::vector<ApiKey> keys(const std::string& more) {
    const std::string file = folder_.file("a.toml");
    write_file(file, "[[keys]]\nowner = \"ann\"\nsha256 = \"" + sha256_hex("alice") + "\"\n" + more);
    auto [config, mistakes] = load_config({file, {}, {}});
    mistakes_.clear();
    for (const ConfigMistake& mistake : mistakes) {
      mistakes_ += mistake.field + ": " + mistake.detail + "\n";
    }
    return config.keys;
  }
  std::string mistakes(const std::string& more) {
    keys(more);
    return mistakes_;
  }

  TempDir folder_;
  std::string mistakes_;
};

TEST_F(KeySettings, AKeyExpiresAtADateTimeOrAtMidnightInUtc) {
  EXPECT_EQ(keys("")[0].expires, std::nullopt);
  for (const auto& [text, time] : {std::pair("2027-03-31T00:00:00Z", "2027-03-31T00:00:00Z"),
                                   {"2027-03-31", "2027-03-31T00:00:00Z"},
                                   {"2027-03-31T00:00:00.25+01:30", "2027-03-30T22:30:00.25Z"},
                                   {"2027-03-31 23:00:00-05:00", "2027-04-01T04:00:00Z"}}) {
    const std::vector<ApiKey> read = keys("expires = " + std::string(text));
    EXPECT_THAT(mistakes_, IsEmpty());
    ASSERT_EQ(read.size(), 1U);
    EXPECT_EQ(read[0].expires, time_from(time)) << text;
  }
}

TEST_F(KeySettings, AKeyHasTheScopesThatItNamesOrAll) {
  EXPECT_EQ(keys("")[0].scopes, Scopes::all());
  EXPECT_EQ(keys("scopes = [\"metrics\"]")[0].scopes, Scopes{Scope::metrics});
  EXPECT_EQ(keys("scopes = [\"submit\", \"read\"]")[0].scopes, (Scopes{Scope::read, Scope::submit}));
}

TEST_F(KeySettings, AMistakeNamesItsLineTheOwnerAndTheRule) {
  for (const char* wrong : {"expires = \"2027-03-31T00:00:00Z\"", "expires = 2027-03-31T00:00:00",
                            "expires = 00:00:00", "expires = 1806451200"}) {
    EXPECT_THAT(mistakes(wrong),
                AllOf(HasSubstr("a.toml:4: keys, owner ann, expires: "), HasSubstr("2027-03-31T00:00:00Z")))
        << wrong;
  }
  for (const char* wrong : {"scopes = []", "scopes = \"read\"", "scopes = [\"write\"]", "scopes = [1]",
                            "scopes = [\"read\", \"Read\"]"}) {
    EXPECT_THAT(mistakes(wrong), AllOf(HasSubstr("a.toml:4: keys, owner ann, scopes: "),
                                       HasSubstr("\"read\", \"submit\" and \"metrics\"")))
        << wrong;
  }
  EXPECT_THAT(mistakes("expiry = 2027-03-31"),
              HasSubstr("a.toml:4: keys, owner ann, expiry: there is no such"));
  EXPECT_THAT(mistakes("[[keys]]\nowner = \"bob\""), HasSubstr("keys, owner bob, sha256: expected a text"));
  EXPECT_THAT(mistakes("[[keys]]\nsha256 = \"0\""), HasSubstr("keys, owner ?, owner: expected a text"));
}

class KeysOverHttp : public ServiceTest {};

TEST_F(KeysOverHttp, AStrangerReadsAResultWithTheKeyOfItsJob) {
  ServiceConfig keyed = config();
  keyed.keys = ann_and_bob();
  keyed.keys[1].scopes = {Scope::read};
  service_ = std::make_unique<Service>(keyed, Environment::system(), local_runners(solve), log_);
  ASSERT_TRUE(service_->start().ok());
  const std::string owner = "Authorization: Bearer alice";
  const Reply mine = post(port(), "/v1/jobs", column_request(), {"Content-Type: application/json", owner});
  ASSERT_EQ(mine.status, 200) << mine.body;
  const std::string job = mine.header("Location");
  const Reply made = post(port(), job + "/key", "", {owner});
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string key = "Authorization: Bearer " + json::parse(made.body)["key"].get<std::string>();
  EXPECT_EQ(get(port(), job + "/result", {key}).body, mine.body);
  Socket stream(port());
  stream.send("GET " + job + "/events HTTP/1.1\r\nHost: localhost\r\n" + key + "\r\n\r\n");
  EXPECT_THAT(stream.rest(), HasSubstr("event: end"));
  // Refused on the head: the body is asked for in vain.
  for (const std::string& refused : {key, std::string("Authorization: Bearer bob")}) {
    Socket client(port());
    client.send("POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\n" + refused +
                "\r\nContent-Type: application/json\r\nContent-Length: 1000\r\nExpect: 100-continue\r\n\r\n");
    EXPECT_EQ(client.receive().status, 403);
  }
  EXPECT_EQ(call(port(), "DELETE", job, "", {key}).status, 403);
  EXPECT_EQ(call(port(), "DELETE", job, "", {owner}).status, 204);
  EXPECT_EQ(get(port(), job, {key}).status, 401);
}

}  // namespace
}  // namespace snapthrough::server::test
