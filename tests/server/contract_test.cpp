/// @file
/// The published document against what the service and the reader of requests do, in both directions.

#include <gmock/gmock.h>
#include <algorithm>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "api/api.h"
#include "api/openapi/document.h"
#include "server/resources/embedded.h"
#include "server/resources/routes.h"
#include "solver/solve.h"
#include "tests/server/support/json_schema.h"
#include "tests/server/support/owners.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;

const json& description() {
  static const json document = json::parse(api::openapi_document());
  return document;
}

std::string lower(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::tolower(c));
  }
  return text;
}

TEST(Contract, EveryRouteIsPublishedAndNothingElse) {
  std::set<std::string> routes;
  for (const auto& [method, path] : http::Routes::resources()) {
    routes.insert(lower(method) + " " + path);
  }
  std::set<std::string> published;
  for (const auto& [path, operations] : description()["paths"].items()) {
    for (const auto& [method, operation] : operations.items()) {
      if (method != "parameters") {
        published.insert(method + " " + path);
        EXPECT_TRUE(operation.contains("operationId")) << path;
      }
    }
  }
  EXPECT_EQ(routes, published);
}

TEST(Contract, EveryReferenceLeadsSomewhere) {
  const std::string text(api::openapi_document());
  const std::regex reference(R"re("\$ref": ?"#([^"]*)")re");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), reference); it != std::sregex_iterator();
       ++it) {
    EXPECT_TRUE(description().contains(json::json_pointer((*it)[1].str()))) << (*it)[1].str();
  }
}

/// A code of findings that is of a rule between several fields at some pointers.
struct Rule {
  std::string_view code;
  std::regex pointer;  ///< the fields that the code is about; those of the rule stand in the comment
};

const std::vector<Rule>& rules_between_fields() {
  static const std::vector<Rule> kRules{
      {"out_of_range", std::regex(".*/(range|load_factor)")},           // lower and upper end
      {"out_of_range", std::regex("/analysis/step")},                   // min, initial, max
      {"out_of_range", std::regex("/model/sections/[0-9]+")},           // E A, E I, G shear_area
      {"out_of_range", std::regex("/model/sections/[0-9]+/strength")},  // times area; both strengths
      {"out_of_range", std::regex(".*/shape/(thickness|web|flange|root_radius)")},  // dimensions of a shape
      {"out_of_range", std::regex(".*/curve/direction")},  // direction and positions of nodes
      // layers that follow one another, strengths, weights and water; the diameter of a section; ids
      {"out_of_range", std::regex("/model/(soils/.*|foundations/[0-9]+/(soil|member|diameter))")},
      {"bad_id", std::regex("/model/foundations/[0-9]+/id")},  // those that soil gives are longer
      // depth and diameter of a pipe, unit weights of its soil
      {"out_of_range", std::regex("/model/foundations/[0-9]+/pipe(/depth|/soil/(total_)?unit_weight)?")},
      {"missing_field", std::regex("/model/(soils/.*|foundations/[0-9]+(/diameter)?)")},
      {"not_supported", std::regex("/model/foundations/[0-9]+/(soil|member|base)")},
      // as many as places
      {"out_of_range",
       std::regex("/analysis/start/members/.*/(u|v|rotation|axial_force|shear_force|bending_moment)")},
      // amount of a load and factor of its case
      {"out_of_range", std::regex("/model/load_cases/[0-9]+/loads/[0-9]+/.*")},
      // all values along a member; the first force of a table
      {"out_of_range", std::regex("/model/foundations/[0-9]+/(law/)?(stiffness|capacity|factor)(/along)?")},
      {"out_of_range", std::regex(".*/law/points/[0-9]+/1")},
      {"empty", std::regex(".*/law/points")},                                // points beside the origin
      {"empty", std::regex("/model/supports")},                              // or springs or foundations
      {"empty", std::regex("/model/members")},                               // reactions of all members
      {"ambiguous", std::regex("/model/springs/[0-9]+/(to|displacement)")},  // at, to and displacement
      {"ambiguous", std::regex("/model/sections/[0-9]+/(density|nu)")},      // mass and density; nu and G
      {"ambiguous", std::regex("/model/load_cases/.*/pattern")},             // grows of the case and pattern
      {"ambiguous", std::regex("/model/foundations/[0-9]+/(component|side)")},   // and direction
      {"out_of_range", std::regex(".*/outline/rounding")},                       // sides of a polyline
      {"ambiguous", std::regex(".*/outline")},                                   // side, direction, gap
      {"not_supported", std::regex(".*/outline")},                               // reaction
      {"missing_field", std::regex("/model/sections/[0-9]+/(mass|expansion)")},  // sections and loads
      {"too_many", std::regex(".*/(points_per_member|elements)")},  // times members, of all members
      {"too_many", std::regex("/model/imperfections/.*")},          // of one type
  };
  return kRules;
}

/// Whether a finding is of a rule between several fields, which a schema does not say.
bool needs_several_fields(const Finding& finding) {
  static const std::set<std::string> kCodes{"unknown_reference", "duplicate_id",   // ids of other entities
                                            "invalid_pointer",   "no_such_place",  // sensitivities
                                            "unreached_node",    "zero_length",
                                            "coincident_points",  // positions of several nodes or points
                                            "needs_one_sided",    // gap and reaction
                                            "needs_member",       // component and location of a monitor
                                            "not_fixed",          // fixed and displacement of a support
                                            "enters_obstacle",    // supports and rigid foundations
                                            "no_load",           "mechanism",  // the model as a whole
                                            "no_mass",                         // masses and frequencies
                                            "no_weight",                       // cables and self weight
                                            "unsupported",     // pairs of fields that do not go together
                                            "not_supported",   // imperfections and the analysis
                                            "not_increasing",  // one fraction and the one before
                                            "too_many_findings"};
  if (kCodes.contains(finding.code)) {
    return true;
  }
  return std::any_of(rules_between_fields().begin(), rules_between_fields().end(),
                     [&](const Rule& rule) {
                       return rule.code == finding.code && std::regex_match(finding.pointer, rule.pointer);
                     }) ||
         finding.detail.starts_with("no number of elements for member");  // ids of members
}

/// Whether the schema and the reader agree about a document, as far as a schema can.
testing::AssertionResult agree(const Schemas& schemas, const json& document) {
  const bool valid = schemas.valid(schemas.named("Request"), document);
  const api::ReadOutcome read = api::read_request(document.dump());
  for (const Finding& finding : read.findings) {
    if (valid && !needs_several_fields(finding)) {
      return testing::AssertionFailure() << "the schema takes what the reader refuses: " << finding.pointer
                                         << " " << finding.code << ": " << finding.detail << "\n"
                                         << document.dump();
    }
  }
  if (!valid && read.findings.empty()) {
    return testing::AssertionFailure() << "the reader takes what the schema refuses\n" << document.dump();
  }
  return testing::AssertionSuccess();
}

/// Makes one random change somewhere in the document.
void spoil(json& value, std::mt19937& random) {
  const auto deeper = [&] { return random() % 4 != 0 && !value.empty() && value.is_structured(); };
  if (deeper()) {
    auto member = value.begin();
    std::advance(member, static_cast<std::ptrdiff_t>(random() % value.size()));
    return spoil(*member, random);
  }
  const std::vector<json> others{1,          2.5,     "a", nullptr, true, json::array(), json::object(),
                                 "rotation", "normal"};
  switch (random() % 4) {
    case 0:
      value = others[random() % others.size()];
      break;
    case 1:
      if (value.is_object() && !value.empty()) {
        auto member = value.begin();
        std::advance(member, static_cast<std::ptrdiff_t>(random() % value.size()));
        value.erase(member);
      }
      break;
    case 2:
      if (value.is_object()) {
        static const std::vector<std::string> kNames{"id",     "range", "pattern", "extra",
                                                     "member", "order", "EA",      "E"};
        value[kNames[random() % kNames.size()]] = others[random() % others.size()];
      }
      break;
    default:
      if (value.is_array() && !value.empty()) {
        value.push_back(value[0]);
      }
  }
}

TEST(Contract, TheReaderTakesTheShapeOfWhateverTheSchemaMakes) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const Schemas schemas(description());
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    const json document = schemas.make(schemas.named("Request"), random);
    ASSERT_TRUE(schemas.valid(schemas.named("Request"), document)) << document.dump();
    EXPECT_TRUE(agree(schemas, document));
  }
}

TEST(Contract, SchemaAndReaderAgreeAboutSpoiltDocuments) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const Schemas schemas(description());
  std::vector<json> good{json::parse(column_request())};
  for (const http::Example& example : http::embedded_examples()) {
    good.push_back(json::parse(example.document));
    EXPECT_TRUE(schemas.valid(schemas.named("Request"), good.back())) << example.name;
  }
  int refused = 0;
  for (int i = 0; i < 4000 && !HasFailure(); ++i) {
    json document =
        i % 3 == 0 ? schemas.make(schemas.named("Request"), random) : good[random() % good.size()];
    spoil(document, random);
    refused += schemas.valid(schemas.named("Request"), document) ? 0 : 1;
    EXPECT_TRUE(agree(schemas, document));
  }
  EXPECT_GT(refused, 1000);
}

class ContractOverHttp : public ServiceTest {
 protected:
  /// Whether the response is one that the document has for this operation.
  void expect_published(const std::string& method, const std::string& path, const Reply& reply) {
    SCOPED_TRACE(method + " " + path + " -> " + std::to_string(reply.status) + " " +
                 reply.body.substr(0, 300));
    const json& responses = description()["paths"][path][lower(method)]["responses"];
    const std::string status = std::to_string(reply.status);
    ASSERT_TRUE(responses.contains(status));
    seen_.insert(lower(method) + " " + path);
    const json& response = schemas_.dereferenced(responses[status]);
    if (!response.contains("content")) {
      EXPECT_EQ(reply.body, "");
      return;
    }
    std::string type = reply.header("Content-Type");
    type = type.substr(0, type.find(';'));
    const json& content = response["content"];
    ASSERT_TRUE(content.contains(type)) << type;
    if (type == "application/json" || type == "application/problem+json") {
      EXPECT_TRUE(schemas_.valid(content[type]["schema"], json::parse(reply.body)));
    }
    if (type == "application/problem+json") {
      EXPECT_EQ(json::parse(reply.body)["status"], reply.status);
    }
  }
  void use(const std::string& method, const std::string& path, const std::string& target,
           const std::string& body = "", const Headers& headers = {"Content-Type: application/json"}) {
    expect_published(method, path, call(port(), method, target, body, headers));
  }

  void use_sweeps() {
    const Headers headers{"Content-Type: application/json", "Idempotency-Key: s"};
    for (const char* body : {"", "{", "{}", "[]"}) {
      use("POST", "/v1/sweeps", "/v1/sweeps", body);
    }
    use("POST", "/v1/sweeps", "/v1/sweeps", column_sweep(2), {"Content-Type: text/plain"});
    use("POST", "/v1/sweeps", "/v1/sweeps", column_sweep(3), headers);
    use("POST", "/v1/sweeps", "/v1/sweeps", column_sweep(3), headers);  // known
    use("POST", "/v1/sweeps", "/v1/sweeps", column_sweep(4), headers);  // another document
    use("POST", "/v1/check", "/v1/check", column_sweep(3));
    EXPECT_TRUE(schemas_.valid(schemas_.named("SweepDocument"), json::parse(column_sweep(3))));
    json failing = json::parse(column_sweep(3));
    failing["parameters"][0]["range"]["from"] = -1;  // not a stiffness
    const std::string sweep = post(port(), "/v1/sweeps", failing.dump()).header("Location");
    const std::string missing = "/v1/sweeps/00000000-0000-7000-8000-000000000000";
    for (const std::string& at : {sweep, missing}) {
      expect_published("GET", "/v1/sweeps/{id}", get(port(), at, {"Prefer: wait=60"}));
      use("GET", "/v1/sweeps/{id}/request", at + "/request");
      use("GET", "/v1/sweeps/{id}/table", at + "/table");
      use("GET", "/v1/sweeps/{id}/table", at + "/table?format=csv&status=failed&first=1&count=1");
      use("GET", "/v1/sweeps/{id}/table", at + "/table?format=ndjson");
      use("GET", "/v1/sweeps/{id}/table", at + "/table?format=xml");
      use("GET", "/v1/sweeps/{id}/table", at + "/table?rows=1");
      use("GET", "/v1/sweeps/{id}/table", at + "/table", "", {"If-None-Match: *"});
      use("GET", "/v1/sweeps/{id}/table.csv", at + "/table.csv");
      use("GET", "/v1/sweeps/{id}/table.csv", at + "/table.csv?format=csv");
      use("GET", "/v1/sweeps/{id}/points/{n}/request", at + "/points/0/request");
      use("GET", "/v1/sweeps/{id}/points/{n}/request", at + "/points/9/request");
      use("POST", "/v1/sweeps/{id}/points/{n}/job", at + "/points/0/job", "", {});  // not a stiffness
      use("POST", "/v1/sweeps/{id}/points/{n}/job", at + "/points/2/job", "", {});
      use("POST", "/v1/sweeps/{id}/points/{n}/job", at + "/points/1/job", "", {"Prefer: respond-async"});
      use("GET", "/v1/sweeps/{id}/table", at + "/table?format=csv&links=true");
      use("GET", "/v1/sweeps/{id}/table", at + "/table?format=csv&links=yes");
      use("GET", "/v1/sweeps/{id}/events", at + "/events");
      use("GET", "/v1/sweeps/{id}/events", at + "/events", "", {"Last-Event-ID: 1000000000000"});
      use("POST", "/v1/sweeps/{id}/dismiss", at + "/dismiss");
      use("POST", "/v1/sweeps/{id}/retry", at + "/retry?status=failed");
      use("POST", "/v1/sweeps/{id}/retry", at + "/retry?status=all");
      expect_published("GET", "/v1/sweeps/{id}", get(port(), at, {"Prefer: wait=60"}));
      use("DELETE", "/v1/sweeps/{id}", at);
    }
    const std::string annotated =
        "{\"sweep\": " + column_sweep(2) + R"(, "label": "a", "metadata": {"k": "v"}})";
    EXPECT_TRUE(schemas_.valid(schemas_.named("AnnotatedSweep"), json::parse(annotated)));
    use("POST", "/v1/sweeps", "/v1/sweeps", annotated);
    use("GET", "/v1/sweeps", "/v1/sweeps?limit=1");
    use("GET", "/v1/sweeps", "/v1/sweeps?limit=0");
  }

  void use_tools() {
    const Headers drawing{"Content-Type: image/vnd.dxf"};
    const std::string line =
        "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nwall\n10\n0\n20\n0\n11\n1\n21\n0\n0\nENDSEC\n";
    use("POST", "/v1/convert", "/v1/convert", line, drawing);
    use("POST", "/v1/convert", "/v1/convert?layer=wall&tolerance=0.1", line, drawing);
    const Reply twice = post(port(), "/v1/convert?join_tees=true",
                             "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nwall\n10\n0\n20\n0\n11\n1\n21\n0\n"
                             "0\nLINE\n8\nwall\n10\n1\n20\n0\n11\n0\n21\n0\n0\nENDSEC\n",
                             drawing);
    expect_published("POST", "/v1/convert", twice);
    const json& headers = description()["paths"]["/v1/convert"]["post"]["responses"]["200"]["headers"];
    EXPECT_TRUE(schemas_.valid(headers["X-Warnings"]["schema"]["contentSchema"],
                               json::parse(twice.header("X-Warnings"))));
    use("POST", "/v1/convert", "/v1/convert?join_tees=yes", line, drawing);
    use("POST", "/v1/convert", "/v1/convert?layer=roof", line, drawing);
    use("POST", "/v1/convert", "/v1/convert?layers=wall", line, drawing);
    use("POST", "/v1/convert", "/v1/convert", "0\nCIRCLE\n", drawing);
    const json& converts = description()["paths"]["/v1/convert"]["post"]["requestBody"]["content"];
    const json& soil = converts["application/json"]["example"];
    EXPECT_TRUE(schemas_.valid(schemas_.named("SoilDocument"), soil));
    use("POST", "/v1/convert", "/v1/convert", soil.dump());
    std::string form;
    for (const auto& [name, table] : converts["multipart/form-data"]["example"].items()) {
      form += "--x\r\nContent-Disposition: form-data; name=\"" + name + "\"\r\n\r\n" +
              table.get<std::string>() + "\r\n";
    }
    const Headers tables{"Content-Type: multipart/form-data; boundary=x"};
    use("POST", "/v1/convert", "/v1/convert", form + "--x--", tables);
    use("POST", "/v1/convert", "/v1/convert", form, tables);
    use("POST", "/v1/convert", "/v1/convert", line, {"Content-Type: text/plain"});
    const json& plots = description()["paths"]["/v1/plot"]["post"]["requestBody"]["content"];
    const json& table = plots["application/json"]["example"];
    EXPECT_TRUE(schemas_.valid(schemas_.named("FigureDocument"), table));
    use("POST", "/v1/plot", "/v1/plot", table.dump());
    use("POST", "/v1/plot", "/v1/plot?kind=model", column_request());
    use("POST", "/v1/plot", "/v1/plot?kind=pie", table.dump());
    use("POST", "/v1/plot", "/v1/plot", "{}", {"Content-Type: text/plain"});
    for (const char* body : {"", "{", "{}", "[]"}) {
      use("POST", "/v1/convert", "/v1/convert", body);
      use("POST", "/v1/plot", "/v1/plot", body);
    }
  }

  void use_components() {
    use("GET", "/v1/hops", "/v1/hops");
    for (const char* name : {"solve-request", "none"}) {
      use("GET", "/v1/hops/{id}", "/v1/hops/" + std::string(name));
    }
    const json item{{"type", "System.String"}, {"data", json(column_request()).dump()}};
    const json value{{"ParamName", "request"}, {"InnerTree", {{"{0}", json::array({item})}}}};
    const json call{{"pointer", "v1/hops/solve-request"}, {"values", json::array({value})}};
    for (const std::string& body : {call.dump(), std::string("{}"), std::string("[]"), std::string("{")}) {
      use("POST", "/v1/hops/{id}", "/v1/hops/solve-request", body);
      use("POST", "/solve", "/solve", body);
    }
    use("POST", "/solve", "/solve", call.dump(), {"Content-Type: text/plain"});
  }

  Schemas schemas_{description()};
  std::set<std::string> seen_;
};

TEST_F(ContractOverHttp, EveryResponseIsAsPublished) {
  start(solve);
  const std::string missing = "/v1/jobs/00000000-0000-7000-8000-000000000000";
  const std::string job = post(port(), "/v1/jobs", column_request()).header("Location");
  for (const std::string& at : {job, missing}) {
    use("GET", "/v1/jobs/{id}", at);
    use("GET", "/v1/jobs/{id}/result", at + "/result");
    use("GET", "/v1/jobs/{id}/result", at + "/result?format=csv");
    use("GET", "/v1/jobs/{id}/result", at + "/result?table=states");
    use("GET", "/v1/jobs/{id}/result", at + "/result?table=static");  // of a path
    use("GET", "/v1/jobs/{id}/result", at + "/result", "", {"Accept: image/png"});
    use("GET", "/v1/jobs/{id}/result", at + "/result", "", {"If-None-Match: *"});
    use("GET", "/v1/jobs/{id}/table.csv", at + "/table.csv");
    use("GET", "/v1/jobs/{id}/table.csv", at + "/table.csv?format=csv");
    use("GET", "/v1/jobs/{id}/request", at + "/request");
    use("GET", "/v1/jobs/{id}/events", at + "/events");
    use("POST", "/v1/jobs/{id}/dismiss", at + "/dismiss");
    use("POST", "/v1/jobs/{id}/key", at + "/key", "", {});
    use("DELETE", "/v1/jobs/{id}", at);
  }
  for (const char* body : {"", "{", "{}", "[]", "{\"model\": {}, \"analysis\": {\"type\": \"path\"}}"}) {
    use("POST", "/v1/jobs", "/v1/jobs", body);
    use("POST", "/v1/check", "/v1/check", body);
  }
  use("POST", "/v1/jobs", "/v1/jobs", column_request());
  use("POST", "/v1/jobs", "/v1/jobs", column_request(),
      {"Content-Type: application/json", "Prefer: respond-async", "Cache-Control: no-cache"});
  use("POST", "/v1/jobs", "/v1/jobs", column_request(), {"Content-Type: text/plain"});
  const std::string annotated =
      "{\"request\": " + column_request() + R"(, "label": "a", "metadata": {"k": "v"}})";
  EXPECT_TRUE(schemas_.valid(schemas_.named("AnnotatedRequest"), json::parse(annotated)));
  for (const char* preference : {"return=minimal", "return=representation", "respond-async"}) {
    use("POST", "/v1/jobs", "/v1/jobs", annotated,
        {"Content-Type: application/json", std::string("Prefer: ") + preference});
  }
  use("POST", "/v1/jobs", "/v1/jobs", column_request("not ready"),
      {"Content-Type: application/json", "Prefer: return=representation, wait=0"});
  use("GET", "/v1/jobs", "/v1/jobs?label=a&analysis=path&created_after=2020-01-01T00:00:00Z");
  use("POST", "/v1/check", "/v1/check", column_request());
  use_sweeps();
  use_tools();
  use_components();
  use("GET", "/v1/jobs", "/v1/jobs?limit=1");
  use("GET", "/v1/jobs", "/v1/jobs?limit=0");
  use("GET", "/v1/usage", "/v1/usage");
  use("GET", "/v1/usage", "/v1/usage?format=csv");
  use("GET", "/v1/usage", "/v1/usage?from=now");
  use("GET", "/v1/audit", "/v1/audit?limit=2");
  use("GET", "/v1/audit", "/v1/audit?limit=0");
  use("GET", "/v1/jobs/{id}", job);  // which was deleted above
  for (const char* path :
       {"/v1/limits", "/v1/openapi.json", "/v1/examples", "/livez", "/readyz", "/metrics"}) {
    use("GET", path, path);
  }
  std::set<std::string> all;
  for (const auto& [method, path] : http::Routes::resources()) {
    all.insert(lower(method) + " " + path);
  }
  EXPECT_EQ(seen_, all) << "an operation was not used";
}

TEST_F(ContractOverHttp, WrongMethodsAreToldTheRightOnes) {
  start(solve);
  for (const auto& [path, operations] : description()["paths"].items()) {
    const std::string target =
        std::regex_replace(std::regex_replace(path, std::regex("\\{id\\}"), "x"), std::regex("\\{n\\}"), "0");
    for (const char* method : {"GET", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"}) {
      if (operations.contains(lower(method))) {
        continue;
      }
      const bool body = std::string(method) == "PUT" || std::string(method) == "PATCH";
      const Reply reply = call(port(), method, target, body ? "{}" : "", {});
      EXPECT_EQ(reply.status, 405) << method << " " << path;
      for (const auto& [published, operation] : operations.items()) {
        std::string upper = published;
        for (char& c : upper) {
          c = static_cast<char>(std::toupper(c));
        }
        EXPECT_TRUE(published == "parameters" || reply.header("Allow").find(upper) != std::string::npos)
            << path;
      }
      EXPECT_TRUE(schemas_.valid(schemas_.named("Problem"), json::parse(reply.body)));
    }
  }
}

TEST_F(ContractOverHttp, AnIdempotencyKeyIsOneJob) {
  start(solve);
  const Headers headers{"Content-Type: application/json", "Prefer: respond-async", "Idempotency-Key: abc"};
  const Reply first = post(port(), "/v1/jobs", column_request("one"), headers);
  const Reply again = post(port(), "/v1/jobs", column_request("one"), headers);
  EXPECT_EQ(again.header("Location"), first.header("Location"));
  EXPECT_EQ(post(port(), "/v1/jobs", column_request("two"), headers).status, 422);
}

TEST_F(ContractOverHttp, TheSameRequestIsAnsweredFromItsResult) {
  start(solve);
  const Reply first = post(port(), "/v1/jobs", column_request());
  EXPECT_EQ(first.header("X-Cache"), "miss");
  json same = json::parse(column_request());
  same["model"]["nodes"][1]["x"] = 1.0;  // was 1
  const Reply again = post(port(), "/v1/jobs", same.dump(2));
  EXPECT_EQ(again.status, 200);
  EXPECT_EQ(again.header("X-Cache"), "hit");
  EXPECT_EQ(again.header("Location"), first.header("Location"));
  EXPECT_EQ(again.body, first.body);
  const Reply fresh = post(port(), "/v1/jobs", column_request(),
                           {"Content-Type: application/json", "Cache-Control: no-cache"});
  EXPECT_EQ(fresh.header("X-Cache"), "miss");
  EXPECT_NE(fresh.header("Location"), first.header("Location"));
}

TEST_F(ContractOverHttp, EventsTellTheLifeOfAJob) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string text = all_events(*solver, submit());
  EXPECT_THAT(text, testing::HasSubstr("event: status\ndata: {\"id\""));
  EXPECT_THAT(text, testing::HasSubstr("event: end\ndata: {\"id\""));
  EXPECT_THAT(text, testing::HasSubstr("\"status\":\"successful\""));
}

/// How often a text occurs.
int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST_F(ContractOverHttp, CriticalPointsAreToldAsTheyAreFound) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string job = submit();
  solver->wait_started(1);
  Socket stream(port());
  follow(stream, job);
  const std::string early = stream.read_until("\"final\":false}\n\n");
  EXPECT_THAT(early, testing::HasSubstr("event: critical_point\ndata: {\"branch\":0"));
  EXPECT_THAT(early, testing::HasSubstr("\"load_factor\":3.25,"));
  EXPECT_THAT(early, testing::HasSubstr("\"error_estimate\":null"));
  EXPECT_EQ(json::parse(get(port(), job).body)["status"], "running");
  // Who comes back is not told again what was seen; who comes late is told all.
  const std::string mark = "\nevent: critical_point";
  const std::string before = early.substr(0, early.find(mark));
  const std::string id = before.substr(before.rfind("id: ") + 4);
  Socket again(port());
  follow(again, job, id);
  const std::string seen = again.read_until("event: progress");  // the news after the point
  EXPECT_EQ(count_of(seen, "critical_point"), 0) << seen;
  solver->open();
  for (Socket* one : {&stream, &again}) {
    const std::string rest = one->rest();
    EXPECT_EQ(count_of(rest, "event: critical_point"), 1) << rest;
    EXPECT_THAT(rest, testing::HasSubstr("\"load_factor\":3.125,"));
    EXPECT_THAT(rest, testing::HasSubstr("\"error_estimate\":0.0001,\"final\":true}"));
    EXPECT_THAT(rest, testing::HasSubstr("event: end\n"));
  }
}

/// The data of the events of that kind.
std::vector<json> events_of(const std::string& text, const std::string& kind) {
  std::vector<json> found;
  const std::string mark = "event: " + kind + "\ndata: ";
  for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    found.push_back(json::parse(text.substr(begin, text.find("\n\n", begin) - begin)));
  }
  return found;
}

/// Ids of all events in their order.
std::vector<std::uint64_t> ids_of(const std::string& text) {
  std::vector<std::uint64_t> ids;
  for (std::size_t at = text.find("id: "); at != text.npos; at = text.find("\nid: ", at + 1)) {
    ids.push_back(std::stoull(text.substr(text.find_first_of("0123456789", at))));
  }
  return ids;
}

TEST_F(ContractOverHttp, PointsOfThePathAreToldAsItGrowsAndToThoseWhoComeLate) {
  const auto solver = std::make_shared<GatedSolver>();
  start(gated(solver));
  const std::string job = submit();
  solver->wait_started(1);
  Socket late(port());
  follow(late, job);
  const std::string early = late.read_until("event: progress");
  const std::vector<json> points = events_of(early, "points");
  ASSERT_EQ(points.size(), 1U) << early;
  EXPECT_EQ(points[0], json::parse(R"({"branch": [0, 0], "step": [6, 7], "load_factor": [3.25, 3.5],
    "arc_length": [0.5, 0.75], "negative_eigenvalues": [0, 1],
    "monitors": [{"id": "tip", "values": [-0.25, -0.5]}]})"));
  const std::string before = early.substr(0, early.find("\nevent: points"));
  Socket again(port());
  follow(again, job, before.substr(before.rfind("id: ") + 4));
  EXPECT_TRUE(events_of(again.read_until("event: progress"), "points").empty()) << "seen already";
  solver->open();
  const std::string all = early + late.rest();
  const std::vector<std::uint64_t> ids = ids_of(all);
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  EXPECT_GT(all.rfind("event: end"), all.rfind("event: critical_point")) << "end is the last";
}

/// With the process that computes it.
TEST_F(ContractOverHttp, AFollowerSeesThePathOfARunnerGrow) {
  ServiceConfig with_runners = config();
  with_runners.runner_executable = SNAPTHROUGH_EXECUTABLE;
  service_ = std::make_unique<Service>(with_runners, Environment::system(), RunnerFactory(), log_);
  ASSERT_TRUE(service_->start().ok());
  json request = json::parse(column_request());
  request["analysis"]["stop"] = {{"steps", 100'000}};
  request["analysis"]["step"] = {{"initial", 1e-4}, {"max", 1e-4}};
  const Reply reply =
      post(port(), "/v1/jobs", request.dump(), {"Content-Type: application/json", "Prefer: respond-async"});
  ASSERT_EQ(reply.status, 201) << reply.body;
  const std::string job = reply.header("Location");
  Socket stream(port());
  follow(stream, job);
  std::string text;
  while (events_of(text, "points").size() < 5) {
    const std::string more = stream.read_until("\n\n");
    ASSERT_FALSE(more.empty());
    text += more;
  }
  int step = -1;
  double arc_length = -1.0;
  for (const json& points : events_of(text, "points")) {
    for (std::size_t i = 0; i < points["step"].size(); ++i) {
      EXPECT_GT(points["step"][i], step);
      EXPECT_GT(points["arc_length"][i], arc_length);
      step = points["step"][i];
      arc_length = points["arc_length"][i];
    }
    EXPECT_EQ(points["monitors"][0]["id"], "tip");
    EXPECT_EQ(points["monitors"][0]["values"].size(), points["step"].size());
  }
  EXPECT_EQ(post(port(), job + "/dismiss", "").status, 200);
  EXPECT_THAT(stream.rest(), testing::HasSubstr("event: end\n"));
}

TEST_F(ContractOverHttp, AStrangersJobIsNotThere) {
  ServiceConfig keyed = config();
  keyed.keys = ann_and_bob();
  service_ = std::make_unique<Service>(keyed, Environment::system(), local_runners(solve), log_);
  ASSERT_TRUE(service_->start().ok());
  const std::string json_type = "Content-Type: application/json";
  EXPECT_EQ(post(port(), "/v1/jobs", column_request()).status, 401);
  EXPECT_EQ(get(port(), "/v1/jobs", {"RhinoComputeKey: alice"}).status, 200);
  EXPECT_EQ(get(port(), "/v1/jobs", {"RhinoComputeKey: wrong"}).status, 401);
  EXPECT_EQ(get(port(), "/v1/jobs", {"Authorization: Basic x", "RhinoComputeKey: alice"}).status, 401);
  EXPECT_EQ(get(port(), "/v1/hops").status, 200);
  EXPECT_EQ(get(port(), "/v1/jobs", {"Authorization: Bearer wrong"}).status, 401);
  const Reply mine = post(port(), "/v1/jobs", column_request(), {json_type, "Authorization: Bearer alice"});
  ASSERT_EQ(mine.status, 200) << mine.body;
  const std::string job = mine.header("Location");
  for (const std::string& target : {job, job + "/result", job + "/request", job + "/events"}) {
    EXPECT_EQ(get(port(), target, {"Authorization: Bearer bob"}).status, 404) << target;
  }
  EXPECT_EQ(call(port(), "DELETE", job, "", {"Authorization: Bearer bob"}).status, 404);
  EXPECT_EQ(call(port(), "POST", job + "/dismiss", "", {"Authorization: Bearer bob"}).status, 404);
  EXPECT_TRUE(json::parse(get(port(), "/v1/jobs", {"Authorization: Bearer bob"}).body)["jobs"].empty());
  EXPECT_EQ(
      post(port(), "/v1/jobs", column_request(), {json_type, "Authorization: Bearer bob"}).header("X-Cache"),
      "miss");
  EXPECT_EQ(get(port(), job, {"Authorization: Bearer alice"}).status, 200);
  for (const char* key : {"alice", "bob", "wrong"}) {
    use("POST", "/v1/jobs/{id}/key", job + "/key", "", {std::string("Authorization: Bearer ") + key});
  }
  EXPECT_EQ(get(port(), "/livez").status, 200);
}

}  // namespace
}  // namespace snapthrough::server::test
