/// @file
/// POST /v1/convert and /v1/plot: the bytes of the commands, and a clear refusal of everything else.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "api/openapi/document.h"
#include "server/cli/app.h"
#include "server/resources/message.h"
#include "solver/solve.h"
#include "tests/server/support/owners.h"
#include "tests/server/support/running_service.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using std::chrono_literals::operator""ms;

const std::string kExamples = std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/";
const std::string kDrawing = "image/vnd.dxf";
const std::string kJson = "application/json";
const std::string kForm = "multipart/form-data; boundary=----x";

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A part of a form with the boundary of kForm.
std::string part(const std::string& name, const std::string& content) {
  return "------x\r\nContent-Disposition: form-data; name=\"" + name + "\"; filename=\"" + name +
         ".csv\"\r\nContent-Type: text/csv\r\n\r\n" + content + "\r\n";
}
std::string form(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string body;
  for (const auto& [name, content] : parts) {
    body += part(name, content);
  }
  return body + "------x--\r\n";
}

/// A drawing with these lines between "ENTITIES" and "ENDSEC"; its first entity is on line 6.
std::string drawing(const std::string& entities) {
  return "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}
const std::string kLine = "0\nLINE\n8\nwall\n10\n0\n20\n0\n11\n1\n21\n0\n";

/// A line from (x[0], x[1]) to (x[2], x[3]).
std::string line(const std::array<double, 4>& x, const std::string& layer = "wall") {
  return "0\nLINE\n8\n" + layer + "\n10\n" + json(x[0]).dump() + "\n20\n" + json(x[1]).dump() + "\n11\n" +
         json(x[2]).dump() + "\n21\n" + json(x[3]).dump() + "\n";
}

/// @brief A drawing with four places of each kind that a warning tells, with a tolerance of `unit` / 10 000.
/// @param unit length of the unit; x and y are negative and have more digits than a warning shows
std::string doubtful_drawing(double unit) {
  const std::array<double, 4> lines[] = {
      {0, 0, 4, 0},          {4, 0, 0, 0},          // twice
      {2, 0.00005, 2, 1},                           // an end on the first one, within the tolerance
      {1, 0.002, 1, 2.4},                           // an end almost on it
      {4.00005, 0, 6, 0},    {4.001, 0.001, 6, 3},  // an end that is joined to its end, and one that is not
      {0.5, -1, 0.5, -2.25}, {0, -1.5, 3, -1.5}};   // a crossing
  std::string entities;
  for (int i = 0; i < 4; ++i) {
    const double x = 112.345678912 + 10 * i;
    const double y = 112.345678912;
    const auto placed = [&](const std::array<double, 4>& one) {
      return std::array{-(x + one[0]) * unit, -(y + one[1]) * unit, -(x + one[2]) * unit,
                        -(y + one[3]) * unit};
    };
    for (const auto& one : lines) {
      entities += line(placed(one));
    }
    entities += line(placed(lines[0]), "other");
  }
  return drawing(entities);
}

/// A table of one parameter: the load of three columns.
json small_table() {
  return {{"columns", {"EI", "/summary/critical_load_factor", "error"}},
          {"rows", {{1, 2.5, nullptr}, {2, 5, nullptr}, {3, nullptr, {{"code", "no_start"}}}}}};
}

class Tools : public ServiceTest {
 protected:
  void SetUp() override {
    ServiceConfig large = config();
    large.listener.limits.body_bytes = 8 * 1024 * 1024;
    start_with(large);
  }
  void start_with(const ServiceConfig& config) {
    service_ = std::make_unique<Service>(config, Environment::system(), local_runners(solve), log_);
    const Status status = service_->start();
    ASSERT_TRUE(status.ok()) << status.message();
  }
  Reply sent(const std::string& target, const std::string& body, const std::string& type = kJson) {
    return post(port(), target, body, {"Content-Type: " + type});
  }
  /// What the command line prints; fails the test unless its exit status is 0.
  static std::string printed(const std::vector<std::string>& arguments, const std::string& input = "",
                             std::string* warnings = nullptr) {
    std::vector<const char*> words{"snapthrough"};
    for (const std::string& argument : arguments) {
      words.push_back(argument.c_str());
    }
    std::istringstream in(input);
    std::ostringstream out;
    std::ostringstream err;
    EXPECT_EQ(cli::run(static_cast<int>(words.size()), words.data(), {in, out, err}), 0) << err.str();
    if (warnings != nullptr) {
      *warnings = err.str();
    }
    return out.str();
  }
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name), std::ios::binary) << text;
    return folder_.file(name);
  }
  void expect_bytes(const Reply& reply, const std::string& type, const std::string& body) {
    EXPECT_EQ(reply.status, 200) << reply.body;
    EXPECT_EQ(reply.header("Content-Type"), type);
    EXPECT_EQ(reply.header("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(reply.body, body);
  }
  /// Expects a problem whose first error, if one is asked for, has a place and a code.
  static void expect_problem(const Reply& reply, int status, const std::string& kind,
                             const std::string& place = "-", const std::string& code = "") {
    EXPECT_EQ(reply.status, status) << reply.body;
    const json problem = json::parse(reply.body);
    EXPECT_EQ(problem["type"], "urn:snapthrough:problem:" + kind) << reply.body;
    if (place != "-") {
      ASSERT_TRUE(problem.contains("errors")) << reply.body;
      EXPECT_EQ(problem["errors"][0]["pointer"], place) << reply.body;
      EXPECT_EQ(problem["errors"][0]["code"], code) << reply.body;
      EXPECT_FALSE(problem["errors"][0]["detail"].get<std::string>().empty());
    }
  }
};

TEST_F(Tools, FilesGiveThePartsThatTheCommandPrints) {
  const std::string soil = text_of(kExamples + "convert/pile_soil.json");
  expect_bytes(sent("/v1/convert", soil), kJson, printed({"convert", "soil", "-"}, soil));
  const std::string portal = text_of(kExamples + "convert/portal.dxf");
  const std::string layers =
      printed({"convert", "dxf", "--layer", "column", "--layer", "rafter", "--tolerance", "0.01"}, portal);
  for (const char* type : {"image/vnd.dxf", "application/dxf", "Application/DXF; charset=utf-8"}) {
    expect_bytes(sent("/v1/convert?layer=column&tolerance=0.01&layer=rafter", portal, type), kJson, layers);
  }
  const std::string tables = kExamples + "convert/";
  const auto table = [&](const std::string& name) {
    return std::pair(name, text_of(tables + name + ".csv"));
  };
  const std::vector<std::string> both{
      "convert", "csv", "--nodes", tables + "nodes.csv", "--members", tables + "members.csv"};
  expect_bytes(sent("/v1/convert", form({table("members"), table("nodes")}), kForm), kJson, printed(both));
  std::vector<std::string> all = both;
  all.insert(all.end(), {"--sections", tables + "sections.csv"});
  expect_bytes(sent("/v1/convert", form({table("nodes"), table("members"), table("sections")}),
                    "Multipart/Form-Data; charset=utf-8; boundary=\"----x\""),
               kJson, printed(all));
}

/// What the command would print of the warnings in the header of an answer.
std::string warnings_of(const Reply& reply) {
  std::string lines;
  for (const json& warning : json::parse(reply.header("X-Warnings"))) {
    EXPECT_EQ(warning.size(), 2U) << warning;
    lines += "Warning: " + warning["detail"].get<std::string>() + " [" + warning["code"].get<std::string>() +
             "]\n";
  }
  return lines;
}

// The body stays what a model takes; what it leaves out, and what only looks joined, is told beside it.
TEST_F(Tools, WarningsOfADrawingAreInAHeader) {
  const std::string tee = drawing(line({0, 0, 6, 0}) + line({3, 0, 3, 4}) + line({3, 4, 3, 0}));
  for (const char* query : {"", "?join_tees=false"}) {
    const Reply apart = sent("/v1/convert" + std::string(query), tee, kDrawing);
    expect_bytes(apart, kJson, printed({"convert", "dxf"}, tee));
    EXPECT_EQ(json::parse(apart.body)["members"].size(), 2U);
    EXPECT_EQ(warnings_of(apart),
              "Warning: 1 end lies on a segment that it is not joined to: (3, 0) on the segment of line 6; "
              "join_tees divides the segments there [tee_unjoined]\n"
              "Warning: 1 segment is drawn twice and is left out: line 30 on line 18 from (3, 4) to (3, 0); "
              "each stays once [duplicates_dropped]\n");
  }
  const Reply joined = sent("/v1/convert?join_tees=true&layer=wall", tee, kDrawing);
  expect_bytes(joined, kJson, printed({"convert", "dxf", "--join-tees"}, tee));
  EXPECT_EQ(json::parse(joined.body)["members"].size(), 3U);
  EXPECT_THAT(warnings_of(joined), AllOf(HasSubstr("[duplicates_dropped]"), Not(HasSubstr("tee"))));
  const Reply sound = sent("/v1/convert?join_tees=true", drawing(kLine), kDrawing);
  EXPECT_EQ(sound.status, 200);
  EXPECT_EQ(sound.header("X-Warnings"), "");
  const Reply refused = sent("/v1/convert?layer=roof", tee, kDrawing);
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(refused.header("X-Warnings"), "");
}

// Programs between a client and the service may refuse a head of more than 4 kB. Warnings name places by
// numbers and lines alone, so that no text of a drawing makes them longer.
TEST_F(Tools, WarningsOfAnyDrawingFitIntoAHeader) {
  std::set<std::string> codes;
  for (const double unit : {1.0, 1.23456789e-5, 3.14159265358979e146}) {
    const std::string doubtful = doubtful_drawing(unit);
    const std::string tolerance = json(1e-4 * unit).dump();
    for (const bool join_tees : {false, true}) {
      SCOPED_TRACE(tolerance + (join_tees ? " and join_tees" : ""));
      std::vector<std::string> command{"convert", "dxf", "--tolerance", tolerance};
      if (join_tees) {
        command.emplace_back("--join-tees");
      }
      std::string told;
      const std::string parts = printed(command, doubtful, &told);
      const Reply reply = post(port(),
                               "/v1/convert?tolerance=" + http::percent_encoded(tolerance) +
                                   "&join_tees=" + (join_tees ? "true" : "false"),
                               doubtful, {"Content-Type: " + kDrawing});
      expect_bytes(reply, kJson, parts);
      EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 7) << told;
      told = std::regex_replace(std::regex_replace(told, std::regex("--join-tees"), "join_tees"),
                                std::regex("--tolerance"), "tolerance");
      EXPECT_EQ(warnings_of(reply), told);
      EXPECT_LT(reply.header("X-Warnings").size(), 4096U);
      for (const json& warning : json::parse(reply.header("X-Warnings"))) {
        codes.insert(warning["code"]);
      }
    }
  }
  const json published = json::parse(api::openapi_document())["paths"]["/v1/convert"]["post"]["responses"];
  const json& warnings = published["200"]["headers"]["X-Warnings"]["schema"]["contentSchema"];
  EXPECT_EQ(codes, warnings["items"]["properties"]["code"]["enum"].get<std::set<std::string>>());
}

struct BadFile {
  const char* name;
  std::string type;
  std::string body;
  int status;
  const char* kind;
  std::string place = "-";
  std::string code = {};
};

TEST_F(Tools, WrongFilesAreToldByPlaceAndRule) {
  json soil = json::parse(text_of(kExamples + "convert/pile_soil.json"));
  soil["layers"][1]["phi"] = 60;
  const std::string nodes = "id,x,y\na,0,0\nb,1,0\n";
  const std::string members = "id,start,end,section\nab,a,b,s\n";
  const BadFile files[] = {
      {"phi", kJson, soil.dump(), 422, "invalid-file", "/layers/1/phi", "out_of_range"},
      {"list", kJson, "[]", 422, "invalid-file", "", "wrong_type"},
      {"empty", kJson, "", 400, "malformed-json", "", "malformed"},
      {"nan", kJson, R"({"accuracy": NaN})", 400, "malformed-json", "/accuracy", "malformed"},
      {"huge", kJson, R"({"accuracy": 1e999})", 400, "malformed-json", "/accuracy", "malformed"},
      {"deep", kJson, std::string(100'000, '['), 400, "malformed-json"},
      {"no drawing", kDrawing, "", 422, "invalid-file", "line 0", "malformed"},
      {"circle", kDrawing, drawing("0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n1\n"), 422, "invalid-file", "line 6",
       "unsupported"},
      {"closed", kDrawing, drawing("0\nARC\n10\n0\n20\n0\n40\n1\n50\n0\n51\n360\n"), 422, "invalid-file",
       "line 6", "closed"},
      {"coordinate", kDrawing, drawing("0\nLINE\n8\nw\n10\n1e300\n20\n0\n11\n1\n21\n0\n"), 422,
       "invalid-file", "line 10", "wrong_type"},
      {"bytes", kDrawing, std::string("\xff\x00\xfe", 3), 422, "invalid-file", "line 1", "malformed"},
      {"no form", kForm, "", 400, "malformed-form"},
      {"cut form", kForm, part("nodes", nodes), 400, "malformed-form"},
      {"no boundary", "multipart/form-data", form({}), 400, "malformed-form"},
      {"nothing", kForm, "------x--\r\n", 422, "invalid-file", "nodes", "missing_field"},
      {"one table", kForm, form({{"nodes", nodes}}), 422, "invalid-file", "members", "missing_field"},
      {"other field", kForm, form({{"nodes", nodes}, {"members", members}, {"loads", ""}}), 422,
       "invalid-file", "loads", "unknown_field"},
      {"twice", kForm, form({{"nodes", nodes}, {"members", members}, {"nodes", nodes}}), 422, "invalid-file",
       "nodes", "duplicate"},
      {"number", kForm, form({{"nodes", nodes + "c,1,one\n"}, {"members", members}}), 422, "invalid-file",
       "nodes:4:y", "wrong_type"},
      {"not finite", kForm, form({{"nodes", nodes + "c,nan,1e400\n"}, {"members", members}}), 422,
       "invalid-file", "nodes:4:x", "out_of_range"},
      {"reference", kForm, form({{"nodes", nodes}, {"members", members + "bc,b,c,s\n"}}), 422, "invalid-file",
       "members:3:end", "unknown_reference"},
      {"table alone", "text/csv", nodes, 415, "unsupported-media-type"},
      {"no type", "", nodes, 415, "unsupported-media-type"},
  };
  for (const BadFile& one : files) {
    SCOPED_TRACE(one.name);
    expect_problem(sent("/v1/convert", one.body, one.type), one.status, one.kind, one.place, one.code);
  }
  expect_problem(sent("/v1/convert?layer=roof", drawing(kLine), kDrawing), 422, "invalid-file", "layer",
                 "unknown_reference");
}

TEST_F(Tools, QueryParametersAreThoseOfTheCommands) {
  const std::string sound = drawing(kLine);
  for (const char* query :
       {"tolerance=0", "tolerance=-1", "tolerance=nan", "tolerance=inf", "tolerance=1m", "tolerance=1e151",
        "tolerance=1&tolerance=2", "layers=wall", "form=dxf", "join_tees", "join_tees=", "join_tees=1",
        "join_tees=True", "join-tees=true", "join_tees=true&join_tees=false"}) {
    SCOPED_TRACE(query);
    expect_problem(sent("/v1/convert?" + std::string(query), sound, kDrawing), 400, "invalid-parameter");
  }
  EXPECT_THAT(json::parse(sent("/v1/convert?join_tees=yes", sound, kDrawing).body)["detail"],
              AllOf(HasSubstr("join_tees (true or false)"), HasSubstr("none of them: join_tees=yes")));
  const std::string soil = text_of(kExamples + "convert/pile_soil.json");
  for (const char* query : {"layer=wall", "join_tees=true"}) {
    expect_problem(sent("/v1/convert?" + std::string(query), soil), 400, "invalid-parameter");
  }
  const std::string table = small_table().dump();
  for (const char* query :
       {"kind=pie", "state=-1", "state=1.5", "mode=x", "branch=", "arc-length=1", "dark", "magnify=0",
        "magnify=nan", "width=199", "width=8001", "height=nan", "where=EI", "where=EI=1&where=EI=2",
        "dark=true&dark=false", "scale=2", "request=x", "monitor=", "monitor=a&arc-length=true"}) {
    SCOPED_TRACE(query);
    expect_problem(sent("/v1/plot?" + std::string(query), table), 400, "invalid-parameter");
  }
}

TEST_F(Tools, FiguresAreThoseOfTheCommand) {
  const std::string svg = "image/svg+xml";
  const std::string request = text_of(kExamples + "tunnel_arch.json");
  const std::string result = printed({"solve", "-"}, request);
  const std::string result_file = file("result.json", result);
  const std::string request_file = file("request.json", request);
  const Reply plain = sent("/v1/plot", result);
  expect_bytes(plain, svg, printed({"plot", result_file}));
  EXPECT_EQ(plain.header("Content-Security-Policy"), "default-src 'none'; style-src 'unsafe-inline'");
  const std::string both = R"({"result": )" + result + R"(, "request": )" + request + "}";
  struct Case {
    const char* query;
    std::vector<std::string> options;
  };
  const Case cases[] = {
      {"", {}},
      {"kind=shape&state=0&magnify=2.5", {"--kind", "shape", "--state", "0", "--magnify", "2.5"}},
      {"kind=sections&width=900&height=700.5", {"--kind", "sections", "--width", "900", "--height", "700.5"}},
      {"kind=path&branch=0&monitor=crown&dark=true",
       {"--kind", "path", "--branch", "0", "--monitor", "crown", "--dark"}},
      {"kind=path&arc-length=true&dark=false", {"--kind", "path", "--arc-length"}}};
  for (const Case& one : cases) {
    std::vector<std::string> arguments{"plot", result_file, "--request", request_file};
    arguments.insert(arguments.end(), one.options.begin(), one.options.end());
    expect_bytes(sent("/v1/plot?" + std::string(one.query), both), svg, printed(arguments));
  }
  const std::string table = small_table().dump();
  expect_bytes(
      sent("/v1/plot?x=EI&output=/summary/critical_load_factor&where=EI%3D2", table), svg,
      printed({"plot", "-", "--x", "EI", "--output", "/summary/critical_load_factor", "--where", "EI=2"},
              table));
  expect_bytes(sent("/v1/plot?kind=model", request), svg, printed({"plot", request_file, "--kind", "model"}));
  const std::string pile = text_of(kExamples + "pile_in_soil.json");
  expect_bytes(sent("/v1/plot?kind=law&law=friction", pile), svg,
               printed({"plot", "-", "--kind", "law", "--law", "friction"}, pile));
  expect_bytes(sent("/v1/plot?kind=laws&law=friction", pile), svg,
               printed({"plot", "-", "--kind", "laws", "--law", "friction"}, pile));
  expect_bytes(sent("/v1/plot?kind=stiffness", both), svg,
               printed({"plot", result_file, "--kind", "stiffness"}));
}

// What a drawing gives is a model, and a figure shows it as it is.
TEST_F(Tools, WhatWasConvertedIsDrawnUndeformed) {
  const Reply parts =
      sent("/v1/convert?layer=column&layer=rafter", text_of(kExamples + "convert/portal.dxf"), kDrawing);
  ASSERT_EQ(parts.status, 200) << parts.body;
  const Reply figure = sent("/v1/plot", parts.body);
  expect_bytes(figure, "image/svg+xml", printed({"plot", "-"}, parts.body));
  EXPECT_THAT(figure.body, HasSubstr("Undeformed structure"));
  EXPECT_EQ(sent("/v1/plot", R"({"model": )" + parts.body + "}").body, figure.body);
}

TEST_F(Tools, DocumentsWithoutAFigureAreToldByPointer) {
  const json request = json::parse(column_request());
  json model = request;
  model["model"]["nodes"][1]["x"] = "x";
  json far = request;
  far["model"]["nodes"][1]["x"] = 1e300;
  json alone = request;
  alone["model"]["members"] = json::array();
  json row = small_table();
  row["rows"][1] = 5;
  const json path = {{"summary", json::object()}, {"branches", {json::object()}}};
  struct Case {
    std::string query;
    json body;
    std::string pointer;
  };
  const Case cases[] = {{"", json::array(), ""},
                        {"", 5, ""},
                        {"", nullptr, ""},
                        {"", json::object(), ""},
                        {"", request, "/analysis"},
                        {"", json::parse(column_sweep(2)), "/parameters"},
                        {"kind=model", model, "/model/nodes/1/x"},
                        {"kind=model", far, "/model/nodes/1/x"},
                        {"kind=model", alone, ""},
                        {"kind=model", small_table(), ""},
                        {"kind=heatmap", request["model"], ""},
                        {"kind=law", request, "/model"},
                        {"kind=law", small_table(), ""},
                        {"kind=law", {{"result", path}, {"request", request}}, "/request/model"},
                        {"kind=stiffness", request, "/analysis"},
                        {"kind=frequencies", path, "/branches/0/load_factor"},
                        {"", row, "/rows/1"},
                        {"", {{"result", row}}, "/result/rows/1"},
                        {"", {{"result", small_table()}, {"other", 1}}, "/other"},
                        {"", {{"result", nullptr}}, "/result"},
                        {"", path, "/branches/0/load_factor"},
                        {"", {{"result", path}, {"request", model}}, "/request/model/nodes/1/x"},
                        {"x=t", small_table(), "/columns"},
                        {"magnify=1e300", small_table(), ""}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.query + " " + one.body.dump());
    expect_problem(sent("/v1/plot?" + one.query, one.body.dump()), 422, "no-figure", one.pointer,
                   one.pointer == "/other" ? "unknown_field" : "no_figure");
  }
  for (const std::string& body : {std::string(), std::string("{"), std::string(R"({"rows": [NaN]})"),
                                  std::string("{\"a\": 1, \"a\": 2}"), std::string(100'000, '[')}) {
    expect_problem(sent("/v1/plot", body), 400, "malformed-json");
  }
  expect_problem(sent("/v1/plot", small_table().dump(), "text/plain"), 415, "unsupported-media-type");
}

// Small documents may ask for figures of gigabytes: ground beside a finely sampled curve, once for each
// foundation.
TEST_F(Tools, AFigureHasABound) {
  json request = json::parse(column_request());
  json& model = request["model"];
  model["members"][0]["curve"] = {{"type", "sine"}, {"rise", 0.1}, {"half_waves", 1000}};
  for (int i = 0; i < 2000; ++i) {
    model["foundations"].push_back({{"id", "f" + std::to_string(i)}, {"member", "m"}, {"stiffness", 1}});
  }
  const Reply reply = sent("/v1/plot?kind=model", request.dump());
  expect_problem(reply, 422, "no-figure", "", "no_figure");
  EXPECT_THAT(reply.body, HasSubstr("more than 500000 coordinates"));
  model.erase("foundations");
  EXPECT_EQ(sent("/v1/plot?kind=model", request.dump()).status, 200);
}

TEST_F(Tools, AConversionHasABound) {
  // Each member repeats the name of its layer.
  std::string line = "0\nLWPOLYLINE\n8\n" + std::string(100'000, 'w') + "\n";
  for (int i = 0; i < 20'000; ++i) {
    line += "10\n" + std::to_string(i) + "\n20\n0\n";
  }
  expect_problem(sent("/v1/convert", drawing(line), kDrawing), 422, "invalid-file", "line 10", "bad_id");
  // Layers of soft clay, each of them just above its own transition depth, need a curve at thousands of
  // depths; the first of them ends the conversion.
  json soil = {{"pile", {{"member", "shaft"}, {"diameter", 1}, {"length", 20'000}}},
               {"layers", json::array()},
               {"loading", "cyclic"},
               {"accuracy", 1e-4}};
  double from = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double to = std::pow(1.01, i);
    soil["layers"].push_back({{"type", "soft_clay"},
                              {"from", from},
                              {"to", to},
                              {"gamma", 1e-9},
                              {"Su", 1000},
                              {"eps50", 0.02},
                              {"J", 6 / (1.001 * to)}});
    from = to;
  }
  const Reply fine = sent("/v1/convert", soil.dump());
  expect_problem(fine, 422, "invalid-file");
  EXPECT_THAT(fine.body, HasSubstr("cannot be interpolated by depth within the accuracy"));
  // A first row of a million columns.
  expect_problem(sent("/v1/convert", form({{"nodes", std::string(1'000'000, ',')}, {"members", ""}}), kForm),
                 422, "invalid-file", "nodes:1", "missing_field");
  // Wrong numbers without end: the first thousand are named.
  std::string nodes = "id,x,y\n";
  for (int i = 0; i < 2'000; ++i) {
    nodes += std::to_string(i) + ",a,b\n";
  }
  const json problem = json::parse(
      sent("/v1/convert", form({{"nodes", nodes}, {"members", "id,start,end,section\n"}}), kForm).body);
  ASSERT_EQ(problem["errors"].size(), 1001U);
  EXPECT_EQ(problem["errors"][1000]["code"], "too_many_findings");
  EXPECT_THAT(problem["detail"].get<std::string>(), StartsWith("The file has 4000 errors"));
}

TEST_F(Tools, PartsThatNoRequestCanHoldAreRefused) {
  ServiceConfig small = config();
  small.listener.limits.body_bytes = 4'000;
  start_with(small);
  std::string lines;
  for (int i = 0; i < 40; ++i) {
    lines += "0\nLINE\n10\n" + std::to_string(i) + "\n20\n0\n11\n" + std::to_string(i + 1) + "\n21\n0\n";
  }
  expect_problem(sent("/v1/convert", drawing(lines), kDrawing), 422, "invalid-file", "", "too_many");
}

// The bound on time holds for converting and drawing, too: each ends soon after it has used its millisecond.
TEST_F(Tools, LongWorkIsGivenUp) {
  ServiceConfig hurried = config();
  hurried.listener.limits.body_bytes = 8 * 1024 * 1024;
  hurried.listener.times.reading = 1ms;
  start_with(hurried);
  std::string lines;
  for (int i = 0; i < 15'000; ++i) {
    lines += "0\nLINE\n10\n" + std::to_string(i) + "\n20\n0\n11\n" + std::to_string(i + 1) + "\n21\n0\n";
  }
  std::string nodes = "id,x,y\n";
  json table = small_table();
  for (int i = 0; i < 15'000; ++i) {
    nodes += std::to_string(i) + ",0,0\n";
    table["rows"].push_back({i, i, nullptr});
  }
  expect_problem(sent("/v1/convert", drawing(lines), kDrawing), 422, "too-costly-to-read");
  expect_problem(sent("/v1/convert", form({{"nodes", nodes}, {"members", ""}}), kForm), 422,
                 "too-costly-to-read");
  expect_problem(sent("/v1/plot", table.dump()), 422, "too-costly-to-read");
}

// Sound bodies with bytes changed at random are answered or refused, never with a fault of the service.
TEST_F(Tools, AnyBodyIsAnsweredOrRefused) {
  const std::string request = column_request();
  struct Sound {
    std::string target, type, body;
  };
  const std::string nodes = text_of(kExamples + "convert/nodes.csv");
  const std::string members = text_of(kExamples + "convert/members.csv");
  const std::vector<Sound> sound{
      {"/v1/convert", kJson, text_of(kExamples + "convert/pile_soil.json")},
      {"/v1/convert", kDrawing, drawing(kLine)},
      {"/v1/convert", kForm, form({{"nodes", nodes}, {"members", members}})},
      {"/v1/plot", kJson, small_table().dump()},
      {"/v1/plot?kind=model", kJson, request},
      {"/v1/plot?kind=path", kJson,
       R"({"result": )" + printed({"solve", "-"}, request) + R"(, "request": )" + request + "}"}};
  std::mt19937 random(11);
  for (int i = 0; i < 600; ++i) {
    Sound one = sound[random() % sound.size()];
    for (auto edits = 1 + random() % 3; edits > 0; --edits) {
      one.body[random() % one.body.size()] = "0123456789-.e\n,\"[]{}:\xff"[random() % 23];
    }
    const Reply reply = sent(one.target, one.body, one.type);
    EXPECT_TRUE(reply.status == 200 || reply.status == 400 || reply.status == 422)
        << reply.status << " " << one.target << "\n"
        << one.body;
  }
}

TEST_F(Tools, AServiceWithKeysAsksForOne) {
  ServiceConfig keyed = config();
  keyed.keys = ann_and_bob();
  start_with(keyed);
  const std::string table = small_table().dump();
  for (const char* target : {"/v1/convert", "/v1/plot"}) {
    EXPECT_EQ(sent(target, table).status, 401);
  }
  EXPECT_EQ(
      post(port(), "/v1/plot", table, {"Content-Type: application/json", "Authorization: Bearer bob"}).status,
      200);
}

}  // namespace
}  // namespace snapthrough::server::test
