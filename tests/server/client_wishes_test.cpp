/// @file
/// What clients may ask for beside an analysis: the shape of an answer, labels and metadata, filters of
/// lists, use from pages of other origins.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "api/api.h"
#include "server/front/cross_origin.h"
#include "server/jobs/envelope.h"
#include "server/resources/prefer.h"
#include "solver/solve.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kJson = "Content-Type: application/json";

std::string annotated(const std::string& member, const std::string& document, const std::string& label,
                      const std::string& metadata = R"({"team": "a/b", "run": "7"})") {
  return "{\"label\": \"" + label + "\",\n \"" + member + "\" : " + document +
         " , \"metadata\": " + metadata + "}";
}

class ClientWishes : public ServiceTest {
 protected:
  Reply prefer(const std::string& preference, const std::string& title = "column",
               const std::string& key = "") {
    Headers headers{kJson, "Prefer: " + preference};
    if (!key.empty()) {
      headers.push_back("Idempotency-Key: " + key);
    }
    return post(port(), "/v1/jobs", column_request(title), headers);
  }
  static bool is_job(const Reply& reply) { return json::parse(reply.body).contains("attempt"); }
  static bool is_result(const Reply& reply) { return json::parse(reply.body).contains("summary"); }
  std::vector<std::string> titles(const std::string& target, const char* list = "jobs") {
    const Reply reply = get(port(), target);
    EXPECT_EQ(reply.status, 200) << reply.body;
    std::vector<std::string> found;
    const json document = json::parse(reply.body);
    for (const json& one : document.at(list)) {
      found.push_back(one.at("title"));
    }
    return found;
  }
};

/// With respond-async a job that was known already came back as its result.
TEST_F(ClientWishes, AJobThatIsAskedForIsAnsweredWhateverIsKnown) {
  start(solve);
  for (const char* preference : {"return=minimal", "respond-async", "respond-async, wait=20",
                                 "return=minimal; x=1, wait=20", "respond-async, return=representation"}) {
    SCOPED_TRACE(preference);
    const std::string title = preference;
    const Reply fresh = prefer(preference, title);
    EXPECT_EQ(fresh.status, 201) << fresh.body;
    EXPECT_TRUE(is_job(fresh));
    EXPECT_EQ(fresh.header("X-Cache"), "miss");
    ASSERT_EQ(get(port(), fresh.header("Location"), {"Prefer: wait=60"}).status, 200);
    const Reply known = prefer(preference, title);
    EXPECT_EQ(known.status, 200) << known.body;
    EXPECT_TRUE(is_job(known));
    EXPECT_EQ(known.header("X-Cache"), "hit");
    EXPECT_EQ(known.header("Location"), fresh.header("Location"));
    EXPECT_EQ(json::parse(known.body)["status"], "successful");
  }
  EXPECT_EQ(prefer("return=minimal, wait=7").header("Preference-Applied"), "return=minimal, wait=7");
  EXPECT_EQ(prefer("respond-async, return=representation").header("Preference-Applied"), "respond-async");
  EXPECT_EQ(prefer("wait=100").header("Preference-Applied"), "wait=60");
}

TEST_F(ClientWishes, AWaitIsForTheEndOfTheJobThatIsAnswered) {
  start(solve);
  const Reply reply = prefer("return=minimal, wait=60");
  EXPECT_EQ(reply.status, 201);
  EXPECT_EQ(json::parse(reply.body)["status"], "successful");
}

TEST_F(ClientWishes, AResultThatIsAskedForIsAResultOr202) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const Reply early = prefer("return=representation, wait=0", "column", "k");
  EXPECT_EQ(early.status, 202) << early.body;
  EXPECT_TRUE(is_job(early));
  EXPECT_EQ(early.header("Retry-After"), "1");
  EXPECT_EQ(early.header("Preference-Applied"), "wait=0");
  EXPECT_EQ(prefer("wait=0", "column", "k").status, 201);  // without a wish: as ever
  solver->open();
  const Reply late = prefer("return=representation", "column", "k");
  EXPECT_EQ(late.status, 200) << late.body;
  EXPECT_TRUE(is_result(late));
  EXPECT_EQ(late.header("Preference-Applied"), "return=representation");
  EXPECT_EQ(late.header("Location"), early.header("Location"));
  EXPECT_TRUE(is_result(prefer("wait=0", "column", "k")));
  const Reply job = prefer("return=minimal", "column", "k");
  EXPECT_EQ(job.status, 200);
  EXPECT_TRUE(is_job(job));
}

TEST_F(ClientWishes, TheFirstOfSeveralPreferencesOfANameCounts) {
  const auto read = [](const std::string& text) {
    http::Request request;
    request.headers = {{"Prefer", text}};
    return http::read_preferences(request).return_shape;
  };
  EXPECT_EQ(read("return=minimal, return=representation"), http::ReturnPreference::minimal);
  EXPECT_EQ(read("RETURN = \"representation\""), http::ReturnPreference::representation);
  EXPECT_EQ(read("return=whatever"), std::nullopt);
  EXPECT_EQ(read("return"), std::nullopt);
}

TEST_F(ClientWishes, LabelsAndMetadataAreShownAndTheRequestStaysAsItWas) {
  start(solve);
  const Reply reply = post(port(), "/v1/jobs", annotated("request", column_request(), "campaign 1"),
                           {kJson, "Prefer: return=minimal"});
  ASSERT_EQ(reply.status, 201) << reply.body;
  const json job = json::parse(reply.body);
  EXPECT_EQ(job["label"], "campaign 1");
  EXPECT_EQ(job["metadata"], json::parse(R"({"run": "7", "team": "a/b"})"));
  const std::string at = reply.header("Location");
  EXPECT_EQ(get(port(), at + "/request").body, column_request());
  EXPECT_EQ(json::parse(get(port(), at).body)["label"], "campaign 1");
  EXPECT_FALSE(json::parse(get(port(), submit("other")).body).contains("label"));
}

TEST_F(ClientWishes, AnotherLabelIsAnotherJobWithTheSameResult) {
  start(solve);
  const Reply plain = post(port(), "/v1/jobs", column_request());
  ASSERT_EQ(plain.status, 200) << plain.body;
  const Reply first = post(port(), "/v1/jobs", annotated("request", column_request(), "one"));
  EXPECT_EQ(first.status, 200);
  EXPECT_EQ(first.header("X-Cache"), "hit");
  EXPECT_EQ(first.body, plain.body) << "the result is computed once";
  EXPECT_NE(first.header("Location"), plain.header("Location"));
  const std::string csv = "/result?format=csv";
  EXPECT_EQ(get(port(), first.header("Location") + csv).body,
            get(port(), plain.header("Location") + csv).body);
  const Reply again = post(port(), "/v1/jobs", annotated("request", column_request(), "one"));
  EXPECT_EQ(again.header("Location"), first.header("Location"));
  EXPECT_EQ(post(port(), "/v1/jobs", column_request()).header("Location"), plain.header("Location"));
  const Headers keyed{kJson, "Prefer: return=minimal", "Idempotency-Key: k"};
  const Reply second = post(port(), "/v1/jobs", annotated("request", column_request(), "two"), keyed);
  EXPECT_EQ(second.status, 201);
  EXPECT_EQ(json::parse(second.body)["status"], "successful");
  EXPECT_EQ(post(port(), "/v1/jobs", annotated("request", column_request(), "two"), keyed).status, 200);
  EXPECT_EQ(post(port(), "/v1/jobs", annotated("request", column_request(), "three"), keyed).status, 422);
  EXPECT_EQ(titles("/v1/jobs").size(), 3U);
  EXPECT_EQ(titles("/v1/jobs?label=one").size(), 1U);
}

TEST_F(ClientWishes, WrongAnnotationsAreNamed) {
  start(solve);
  const auto finding = [&](const std::string& body, const char* path = "/v1/jobs") {
    const Reply reply = post(port(), path, body);
    EXPECT_EQ(reply.status, 422) << reply.body;
    const json error = json::parse(reply.body)["errors"][0];
    return error["pointer"].get<std::string>() + " " + error["code"].get<std::string>();
  };
  const std::string request = column_request();
  EXPECT_EQ(finding(annotated("request", request, "")), "/label out_of_range");
  EXPECT_EQ(finding(annotated("request", request, std::string(201, 'x'))), "/label out_of_range");
  EXPECT_EQ(finding(annotated("request", request, "a", "[]")), "/metadata wrong_type");
  EXPECT_EQ(finding(annotated("request", request, "a", R"({"a/b": 1})")), "/metadata/a~1b wrong_type");
  EXPECT_EQ(finding(annotated("request", request, "a", "{\"k\": \"" + std::string(201, 'x') + "\"}")),
            "/metadata/k out_of_range");
  EXPECT_EQ(finding("{\"request\": " + request + ", \"lable\": \"a\"}"), "/lable unknown_field");
  EXPECT_EQ(finding(R"({"request": {"model": 1}, "label": "a"})").substr(0, 9), "/request/");
  EXPECT_EQ(finding(R"({"sweep": 1, "label": "a"})", "/v1/sweeps").substr(0, 6), "/sweep");
  const json checked = json::parse(post(port(), "/v1/check", annotated("request", request, "a")).body);
  EXPECT_EQ(checked["valid"], true);
  EXPECT_EQ(
      json::parse(
          post(port(), "/v1/check", annotated("sweep", column_sweep(3), "")).body)["errors"][0]["pointer"],
      "/label");
}

TEST(Envelope, ManyWrongMembersDoNotFillTheMemory) {
  json envelope{{"request", 1}};
  for (int i = 0; i < 5000; ++i) {
    envelope["k" + std::to_string(i)] = i;
  }
  const Envelope opened = open_envelope(envelope.dump(), "request");
  ASSERT_THAT(opened.findings, testing::SizeIs(api::kMaxFindings + 1));
  EXPECT_EQ(opened.findings.back().code, "too_many_findings");
}

TEST(Envelope, TheDocumentIsTheBytesThatCame) {
  const std::string text =
      " {\"a\\\"}{\" : [\"}\", {\"x\": \"\\\\\"}], \"re\\u0071uest\"\t:\n {\"m\" : 1.0e0, \"s\": \"],\\\"\"} "
      "}";
  EXPECT_EQ(open_envelope(text, "request").text, "{\"m\" : 1.0e0, \"s\": \"],\\\"\"}");
  EXPECT_EQ(open_envelope(R"({"request": 12})", "request").text, "12");
  EXPECT_EQ(open_envelope(R"({"label":"\u00e4", "request": [1,2] , "z":1})", "request").text, "[1,2]");
  EXPECT_EQ(open_envelope("[1]", "request").text, "[1]");
  EXPECT_TRUE(open_envelope("{", "request").malformed);
  EXPECT_EQ(characters("a\xc3\xa4\xf0\x9f\x98\x80"), 3U);
}

TEST_F(ClientWishes, ListsOfJobsAreFilteredAndPagesKeepTheFilters) {
  start(solve);
  for (const char* title : {"1", "2", "3"}) {
    const std::string label = title[0] == '2' ? "b" : "a & b";
    const Reply reply = post(port(), "/v1/jobs", annotated("request", column_request(title), label));
    ASSERT_EQ(reply.status, 200) << reply.body;
  }
  EXPECT_THAT(titles("/v1/jobs"), ElementsAre("3", "2", "1"));
  EXPECT_THAT(titles("/v1/jobs?label=a%20%26%20b"), ElementsAre("3", "1"));
  EXPECT_THAT(titles("/v1/jobs?label=b&status=successful&analysis=path"), ElementsAre("2"));
  EXPECT_THAT(titles("/v1/jobs?analysis=static"), ElementsAre());
  EXPECT_THAT(titles("/v1/jobs?label=b&status=failed"), ElementsAre());
  const Reply page = get(port(), "/v1/jobs?label=a%20%26%20b&limit=1");
  const std::string next = json::parse(page.body)["links"][0]["href"];
  EXPECT_EQ(page.header("Link"), "<" + next + ">; rel=\"next\"");
  EXPECT_THAT(titles(next), ElementsAre("1"));
  const json jobs = json::parse(get(port(), "/v1/jobs").body)["jobs"];
  const std::string middle = jobs[1]["created"];
  EXPECT_THAT(titles("/v1/jobs?created_after=" + middle), ElementsAre("3"));
  EXPECT_THAT(titles("/v1/jobs?created_before=" + middle), ElementsAre("1"));
  EXPECT_THAT(titles("/v1/jobs?created_before=" + middle + "&label=b"), ElementsAre());
  for (const char* wrong :
       {"label=", "analysis=none", "created_after=yesterday", "created_before=2026-02-30T00:00:00Z",
        "cursor=7", "cursor=a.b", "label=a&label=b", "colour=red"}) {
    EXPECT_EQ(get(port(), std::string("/v1/jobs?") + wrong).status, 400) << wrong;
    EXPECT_EQ(get(port(), std::string("/v1/sweeps?") + wrong).status, 400) << wrong;
  }
}

TEST_F(ClientWishes, SweepsHaveLabelsAndFiltersToo) {
  start(solve);
  const Reply reply = post(port(), "/v1/sweeps", annotated("sweep", column_sweep(2, "x"), "study"));
  ASSERT_EQ(reply.status, 201) << reply.body;
  ASSERT_EQ(post(port(), "/v1/sweeps", column_sweep(3, "y")).status, 201);
  const json sweep = json::parse(get(port(), reply.header("Location"), {"Prefer: wait=60"}).body);
  EXPECT_EQ(sweep["label"], "study");
  EXPECT_EQ(sweep["metadata"]["run"], "7");
  EXPECT_EQ(sweep["analysis"], "path");
  EXPECT_EQ(get(port(), reply.header("Location") + "/request").body, column_sweep(2, "x"));
  EXPECT_THAT(titles("/v1/sweeps", "sweeps"), ElementsAre("y", "x"));
  EXPECT_THAT(titles("/v1/sweeps?label=study&analysis=path", "sweeps"), ElementsAre("x"));
  EXPECT_THAT(titles("/v1/sweeps?analysis=static", "sweeps"), ElementsAre());
}

TEST(Time, IsReadAsItIsWrittenAndWithOffsets) {
  const Time time = at_second(12345) + std::chrono::microseconds(250'000);
  EXPECT_EQ(time_from(rfc3339(time)), time);
  EXPECT_EQ(time_from("2020-02-29T12:00:00.5+01:30"), *time_from("2020-02-29T10:30:00.500000Z"));
  for (const char* wrong :
       {"", "2020-02-29", "2020-02-29T12:00:00", "2021-02-29T12:00:00Z", "2020-02-29T24:00:00Z",
        "2020-02-29T12:00:00.Z", "2020-02-29T12:00:00.1234567Z", "2020-02-29T12:00:00 01:00",
        "2020-02-29T12:00:0aZ", "1969-12-31T23:59:59Z", "2020-02-29T12:00:00Zz"}) {
    EXPECT_EQ(time_from(wrong), std::nullopt) << wrong;
  }
}

class AllowedOrigins : public ServiceTest {
 protected:
  void start_for(const std::vector<http::ApiKey>& keys) {
    ServiceConfig allowing = config();
    allowing.allowed_origins = {kPage};
    allowing.keys = keys;
    service_ = std::make_unique<Service>(allowing, Environment::system(), local_runners(solve), log_);
    ASSERT_TRUE(service_->start().ok());
  }
  Reply preflight(const std::string& origin, const std::string& target = "/v1/jobs") const {
    return call(port(), "OPTIONS", target, "",
                {"Origin: " + origin, "Access-Control-Request-Method: POST",
                 "Access-Control-Request-Headers: content-type, prefer"});
  }
  static constexpr const char* kPage = "https://app.example";
  const std::string from_page_ = std::string("Origin: ") + kPage;
};

TEST_F(AllowedOrigins, APreflightNeedsNoKeyAndNamesMethodsAndHeaders) {
  // SHA-256 of "alice", from sha256sum.
  start_for({{"ann", "2bd806c97f0e00af1a1fc3328fa763a9269723c8db8fac4f93af71db186d6e90"}});
  const Reply reply = preflight(kPage);
  EXPECT_EQ(reply.status, 204);
  EXPECT_EQ(reply.header("Access-Control-Allow-Origin"), kPage);
  EXPECT_EQ(reply.header("Access-Control-Allow-Methods"), "POST, GET, HEAD");
  for (const char* name : {"Authorization", "Content-Type", "Idempotency-Key", "Prefer", "Last-Event-ID"}) {
    EXPECT_THAT(reply.header("Access-Control-Allow-Headers"), HasSubstr(name));
  }
  EXPECT_EQ(reply.header("Access-Control-Max-Age"), "7200");
  EXPECT_EQ(preflight(kPage, "/v1/jobs/x").header("Access-Control-Allow-Methods"), "GET, HEAD, DELETE");
  const Reply refused = preflight("https://evil.example");
  EXPECT_EQ(refused.status, 401);
  EXPECT_EQ(refused.header("Access-Control-Allow-Origin"), "");
  const Reply unknown = get(port(), "/v1/jobs", {from_page_});
  EXPECT_EQ(unknown.status, 401);
  EXPECT_EQ(unknown.header("Access-Control-Allow-Origin"), kPage) << "a page has to be able to read why";
  EXPECT_EQ(get(port(), "/v1/jobs", {from_page_, "Authorization: Bearer alice"}).status, 200);
}

TEST_F(AllowedOrigins, ResponsesErrorsAndStreamsCanBeReadByTheirPages) {
  start_for({});
  const Reply job = post(port(), "/v1/jobs", column_request(), {kJson, from_page_});
  EXPECT_EQ(job.status, 200) << job.body;
  const std::string at = job.header("Location");
  const std::string large(config().listener.limits.body_bytes + 1, ' ');
  for (const Reply& reply :
       {job, get(port(), at, {from_page_}), get(port(), at + "/events", {from_page_}),
        get(port(), "/v1/jobs/none", {from_page_}), get(port(), "/nothing", {from_page_}),
        post(port(), "/v1/jobs", "{", {kJson, from_page_}),
        post(port(), "/v1/jobs", large, {kJson, from_page_})}) {
    EXPECT_EQ(reply.header("Access-Control-Allow-Origin"), kPage) << reply.status;
    EXPECT_EQ(reply.header("Access-Control-Allow-Credentials"), "");
    for (const char* name : {"Location", "ETag", "Link", "X-Cache", "X-Complete", "X-Request-Id",
                             "X-Warnings", "Preference-Applied", "Retry-After"}) {
      EXPECT_THAT(reply.header("Access-Control-Expose-Headers"), HasSubstr(name));
    }
  }
  EXPECT_EQ(get(port(), "/livez").header("Vary"), "Origin") << "a cache must not give it to a page";
  EXPECT_EQ(get(port(), "/livez").header("Access-Control-Allow-Origin"), "");
}

TEST_F(AllowedOrigins, OtherOriginsAndForeignHostsAreStillRefusedWithoutKeys) {
  start_for({});
  for (const char* origin : {"https://evil.example", "https://app.example.evil.example",
                             "https://app.example:444", "http://app.example", "null", "*"}) {
    const Reply reply = get(port(), "/v1/limits", {std::string("Origin: ") + origin});
    EXPECT_EQ(reply.status, 403) << origin;
    EXPECT_EQ(reply.header("Access-Control-Allow-Origin"), "") << origin;
    EXPECT_EQ(preflight(origin).status, 403) << origin;
  }
  Socket socket(port());
  socket.send("GET /v1/limits HTTP/1.1\r\nHost: evil.example\r\n" + from_page_ + "\r\n\r\n");
  EXPECT_EQ(socket.receive().status, 403);
}

TEST_F(AllowedOrigins, WithoutAnyNothingIsSaidAboutOrigins) {
  start(solve);
  EXPECT_EQ(get(port(), "/v1/limits").header("Vary").find("Origin"), std::string::npos);
  EXPECT_EQ(preflight("http://localhost:" + std::to_string(port())).status, 403);
}

TEST(Origins, AreExact) {
  for (const char* good :
       {"https://app.example", "http://localhost:5173", "http://[::1]:8080", "https://10.0.0.1"}) {
    EXPECT_TRUE(http::is_origin(good)) << good;
  }
  for (const char* wrong :
       {"*", "null", "", "app.example", "https://", "https://app.example/", "https://App.example",
        "https://app.example:443", "http://app.example:80", "https://*.example", "ftp://app.example",
        "https://app.example:", "https://app.example:70000", "https://a@b", "http://[::1", "http://[::1]x"}) {
    EXPECT_FALSE(http::is_origin(wrong)) << wrong;
    ServiceConfig config = ServiceConfig::defaults();
    config.allowed_origins = {wrong};
    EXPECT_EQ(config.check().size(), 1U) << wrong;
  }
}

}  // namespace
}  // namespace snapthrough::server::test
