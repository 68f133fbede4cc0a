/// Documents that nobody checked: a figure that is well-formed, or an error that names the place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "api/plot/plot.h"
#include "api/plot/plot_error.h"
#include "api/plot/plot_request.h"
#include "tests/api/plot/documents.h"
#include "tests/api/plot/svg_reader.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::SvgReader;

/// A small result with everything that figures read: contact, supports, critical points, modes, states.
json small_result() {
  json request = testing::example_request("tunnel_arch");
  request["analysis"]["output"] = {{"points_per_member", 3}};
  return testing::solved(request);
}

PlotError error_of(const json& document, const PlotRequest& request = {}) {
  try {
    (void)svg_of(document, request);
  } catch (const PlotError& error) {
    return error;
  }
  return {"", "no error"};
}

PlotError error_with(const std::string& pointer, const json& value, PlotKind kind) {
  static const json sound = small_result();
  json document = sound;
  document[json::json_pointer(pointer)] = value;
  PlotRequest request;
  request.kind = kind;
  return error_of(document, request);
}

TEST(HostileDocument, MistakesAreNamedByTheirPlaces) {
  struct Case {
    const char* pointer;
    json value;
    PlotKind kind;
    const char* named;
    const char* rule;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {"/branches/0/load_factor/1", "x", PlotKind::path, "/branches/0/load_factor/1", "must be a number"},
      {"/branches/0/load_factor/1", nullptr, PlotKind::path, "/branches/0/load_factor/1", "must be a number"},
      {"/branches/0/load_factor/1", nan, PlotKind::path, "/branches/0/load_factor/1", "finite"},
      {"/branches/0/load_factor/1", 1e300, PlotKind::path, "/branches/0/load_factor/1", "1e100"},
      {"/branches/0/load_factor", json::object(), PlotKind::path, "/branches/0/load_factor",
       "must be a list"},
      {"/branches/0/arc_length/1", 1e9, PlotKind::path, "/branches/0/arc_length/2", "must not be less"},
      {"/branches/0/monitors/crown", {1, 2}, PlotKind::path, "/branches/0/monitors/crown", "numbers"},
      {"/branches", json::array(), PlotKind::path, "/branches", "no path"},
      {"/critical_points/0/type", "fold", PlotKind::path, "/critical_points/0/type", "no figure knows"},
      {"/critical_points/0/branch", 9, PlotKind::path, "/critical_points/0/branch", "index"},
      {"/critical_points/0/state", 99, PlotKind::shape, "/states/99", "states 0 to"},
      {"/states", json::array(), PlotKind::sections, "/states/", "has no states"},
      {"/states/0/members/arch/s",
       {0, 1},
       PlotKind::shape,
       "/states/0/members/arch/x0",
       "must have 2 numbers"},
      {"/model/title", 5, PlotKind::path, "/model/title", "must be a text"},
  };
  for (const Case& one : cases) {
    const PlotError error = error_with(one.pointer, one.value, one.kind);
    EXPECT_THAT(error.pointer(), ::testing::StartsWith(one.named)) << one.pointer << " " << error.what();
    EXPECT_THAT(error.rule(), HasSubstr(one.rule)) << one.pointer;
  }
}

TEST(HostileDocument, OtherDocumentsAreToldWhatTheyAre) {
  EXPECT_THAT(error_of(testing::example_request("tunnel_arch")).what(), HasSubstr("solve it first"));
  EXPECT_THAT(error_of(testing::example_request("sweeps/lining_thickness")).what(),
              HasSubstr("snapthrough sweep"));
  EXPECT_THAT(error_of(json::array()).rule(), HasSubstr("must be a result"));
  EXPECT_THAT(error_of(json::object()).rule(), HasSubstr("neither a result"));
  PlotRequest request;
  request.kind = PlotKind::heatmap;
  EXPECT_THAT(error_of(small_result(), request).rule(), HasSubstr("no figure of kind heatmap"));
  request.kind = PlotKind::path;
  EXPECT_THAT(error_of(testing::table_of_two(), request).rule(), HasSubstr("no figure of kind path"));
}

TEST(HostileDocument, WrongRequestsAreRefused) {
  const json result = small_result();
  PlotRequest request;
  request.kind = PlotKind::path;
  request.monitor = "crwn";
  EXPECT_EQ(error_of(result, request).pointer(), "/branches/0/monitors/crwn");
  EXPECT_THAT(error_of(result, request).rule(), HasSubstr("there are: crown"));
  request = {};
  for (const double width : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    request.width = width;
    EXPECT_THAT(error_of(result, request).rule(), HasSubstr("200 to 8000"));
  }
  request = {};
  request.kind = PlotKind::sweep;
  request.output = "/summary/nothing";
  EXPECT_THAT(error_of(testing::table_of_two(), request).rule(),
              HasSubstr("there are: /summary/critical_load_factor"));
  request = {};
  request.x = "q";
  EXPECT_THAT(error_of(testing::table_of_two(), request).rule(), HasSubstr("there are: k, t"));
}

TEST(HostileDocument, ATablesRowsMustHaveItsColumns) {
  json table = testing::table_of_two();
  table["rows"][3].erase(0);
  EXPECT_EQ(error_of(table).pointer(), "/rows/3");
  table = testing::table_of_two();
  table["rows"][3] = 5;
  EXPECT_EQ(error_of(table).pointer(), "/rows/3");
  table = testing::table_of_two();
  table["rows"].push_back(table["rows"][0]);
  PlotRequest map;
  map.kind = PlotKind::heatmap;
  EXPECT_EQ(error_of(table, map).pointer(), "/rows/12");
  table["rows"] = json::array();
  EXPECT_EQ(error_of(table).pointer(), "/rows");
}

TEST(HostileDocument, TextsAreEscaped) {
  json result = small_result();
  const std::string title =
      "<script>alert(\"1\")</script> & ']]> \x01\x1f \xff\xc0\x80 \xed\xa0\x80 \xef\xbf\xbf \u00e9";
  result["model"]["title"] = title;
  result["branches"][0]["monitors"]["<a & b>"] = result["branches"][0]["monitors"]["crown"];
  PlotRequest request;
  request.monitor = "<a & b>";
  const std::string text = svg_of(result, request);
  const SvgReader svg(text);
  EXPECT_EQ(text.find("<script"), std::string::npos);
  EXPECT_THAT(svg.texts()[0], HasSubstr("<script>alert(\"1\")</script> & ']]>"));
  EXPECT_THAT(svg.texts(), ::testing::Contains(HasSubstr("<a & b>")));
}

TEST(HostileDocument, OnePointAndFlatPathsHaveTheirAxes) {
  json result = {{"summary", json::object()},
                 {"branches",
                  {{{"load_factor", {0.0}},
                    {"arc_length", {0.0}},
                    {"negative_eigenvalues", {0}},
                    {"monitors", json::object()}}}}};
  EXPECT_NO_THROW(SvgReader(svg_of(result)));
  json& branch = result["branches"][0];
  branch["load_factor"] = {1e-99, 1e-99, 1e-99};
  branch["arc_length"] = {5, 5, 5};
  branch["negative_eigenvalues"] = {0, 1, 0};
  EXPECT_NO_THROW(SvgReader(svg_of(result)));
  branch["load_factor"] = {-1e100, 0, 1e100};
  branch["arc_length"] = {0, 1e-100, 1e100};
  EXPECT_NO_THROW(SvgReader(svg_of(result)));
  branch["load_factor"] = {1, 1 + 1e-15, 1 - 1e-15};
  EXPECT_NO_THROW(SvgReader(svg_of(result)));
}

TEST(HostileDocument, LongPathsAreDrawnByWhatCanBeSeen) {
  constexpr int kRows = 300'000;
  std::vector<double> load(kRows);
  std::vector<double> arc(kRows);
  for (int i = 0; i < kRows; ++i) {
    load[static_cast<std::size_t>(i)] = std::sin(1e-5 * i);
    arc[static_cast<std::size_t>(i)] = i;
  }
  const json result = {
      {"summary", json::object()},
      {"branches",
       {{{"load_factor", load}, {"arc_length", arc}, {"negative_eigenvalues", std::vector<int>(kRows)}}}}};
  const std::string text = svg_of(result);
  EXPECT_NO_THROW((void)SvgReader(text));
  EXPECT_LT(text.size(), 100'000U);
}

/// Pointers of all values of a document; of lists the first and the last.
void collect(const json& value, const json::json_pointer& place, std::vector<json::json_pointer>& all) {
  if (!place.empty()) {
    all.push_back(place);
  }
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      collect(member, place / key, all);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i == 0 || i + 1 == value.size()) {
        collect(value[i], place / i, all);
      }
    }
  }
}

/// Every value of a document in turn replaced by values of other types, or taken away: each figure is
/// well-formed, or refused.
void expect_figures_or_errors(const json& sound, const std::vector<PlotRequest>& requests) {
  const json others[] = {nullptr,       "x",           -1, 1e99, std::numeric_limits<double>::infinity(),
                         json::array(), json::object()};
  std::vector<json::json_pointer> places;
  collect(sound, json::json_pointer(), places);
  std::size_t figures = 0;
  std::size_t refused = 0;
  const auto check = [&](const json& document, const std::string& what) {
    for (const PlotRequest& request : requests) {
      try {
        const std::string text = svg_of(document, request);
        ++figures;
        EXPECT_NO_THROW((void)SvgReader(text)) << what;
      } catch (const PlotError& error) {
        ++refused;
        EXPECT_FALSE(error.rule().empty()) << what;
      } catch (const std::exception& error) {
        ADD_FAILURE() << what << ": " << error.what();
      }
    }
  };
  for (const json::json_pointer& place : places) {
    for (const json& other : others) {
      json document = sound;
      document[place] = other;
      check(document, place.to_string());
    }
    json document = sound;
    json& parent = document[place.parent_pointer()];
    if (parent.is_object()) {
      parent.erase(place.back());
      check(document, place.to_string() + " taken away");
    }
  }
  EXPECT_GT(figures, places.size());
  EXPECT_GT(refused, places.size() / 4);
}

std::vector<PlotRequest> kinds(std::vector<PlotKind> all, const json* solved = nullptr) {
  std::vector<PlotRequest> requests;
  for (const PlotKind kind : all) {
    requests.emplace_back();
    requests.back().kind = kind;
    requests.back().solved_request = solved;
  }
  return requests;
}

TEST(HostileDocument, AnyValueOfAResultMayBeAnother) {
  json result = small_result();
  // only what figures read: one branch of few rows, one critical point, one state
  result["states"] =
      json::array({result["states"][result["critical_points"][0]["state"].get<std::size_t>()]});
  result["critical_points"] = json::array({result["critical_points"][0]});
  result["critical_points"][0]["state"] = 0;
  result.erase("diagnostics");
  result.erase("discretization");
  expect_figures_or_errors(result, kinds({PlotKind::path, PlotKind::shape, PlotKind::sections, PlotKind::mode,
                                          PlotKind::stiffness}));
}

TEST(HostileDocument, AnyValueOfALawMayBeAnother) {
  const json number = {{"along", {{0, 1}, {1, 2}}}};
  for (const json& law :
       {json{{"type", "tanh"}, {"stiffness", number}, {"capacity", 2}},
        json{{"type", "hyperbolic"}, {"stiffness", 1}, {"capacity", number}},
        json{{"type", "power"}, {"stiffness", number}, {"capacity", 2}, {"reference", 4}, {"exponent", 0.5}},
        json{{"type", "table"}, {"points", {{0, 0}, {1, 2}, {2, 3}}}, {"factor", number}}}) {
    expect_figures_or_errors({{"model",
                               {{"nodes", json::array()},
                                {"units", {{"length", "m"}, {"force", "kN"}}},
                                {"foundations",
                                 {{{"id", "ground"},
                                   {"reaction", "compression_only"},
                                   {"gap", 1},
                                   {"range", {0, 1}},
                                   {"law", law}}}}}}},
                             kinds({PlotKind::law}));
  }
}

TEST(HostileDocument, AnyValueOfAModelWithLawsMayBeAnother) {
  const json number = {{"along", {{0, 1}, {0.5, 2}}}};
  const json table = {{"type", "table"}, {"points", {{1, 2}, {2, 1}}}, {"factor", number}};
  const json power = {
      {"type", "power"}, {"stiffness", number}, {"capacity", 2}, {"reference", 4}, {"exponent", 0.5}};
  const json model = {
      {"nodes", {{{"id", "a"}, {"x", 0}, {"y", 0}}, {{"id", "b"}, {"x", 1}, {"y", -9}}}},
      {"members",
       {{{"id", "m"},
         {"start", "a"},
         {"end", "b"},
         {"release", {{"end", {{"rotation", {{"law", table}}}}}}}}}},
      {"foundations",
       {{{"id", "f"}, {"member", "m"}, {"range", {0, 0.5}}, {"law", table}},
        {{"id", "g"},
         {"member", "m"},
         {"reaction", "tension_only"},
         {"side", "right"},
         {"gap", number},
         {"law", power}}}},
      {"springs",
       {{{"id", "s"}, {"at", {{"node", "b"}}}, {"direction", {0, 1}}, {"gap", 1}, {"law", table}}}}};
  expect_figures_or_errors({{"model", model}}, kinds({PlotKind::law, PlotKind::laws}));
}

TEST(HostileDocument, AnyValueOfFrequenciesMayBeAnother) {
  const json motions = {{"omega_squared", {4, 4}}, {"imaginary", {-1, 1}}};
  const json still = {{"omega_squared", {1, 9}}};
  const json rows = {{"load_factor", {0, 1}},
                     {"arc_length", {0, 1}},
                     {"negative_eigenvalues", {0, 0}},
                     {"frequencies", {still, motions}}};
  const json point = {{"type", "flutter"}, {"branch", 0},       {"load_factor", 1},
                      {"arc_length", 1},   {"confirmed", true}, {"monitors", json::object()}};
  const json vibration = {{"load_factor", 1}, {"frequencies", motions}};
  for (const json& result :
       {json{{"summary", json::object()}, {"branches", {rows}}, {"critical_points", {point}}},
        json{{"summary", json::object()}, {"static", rows}},
        json{{"summary", json::object()}, {"vibrations", {vibration}}}}) {
    expect_figures_or_errors(result, kinds({PlotKind::frequencies}));
  }
}

TEST(HostileDocument, AnyValueOfATableMayBeAnother) {
  expect_figures_or_errors(testing::table_of_two(), kinds({PlotKind::sweep, PlotKind::heatmap}));
}

TEST(HostileDocument, AnyValueOfTheSolvedRequestMayBeAnother) {
  const json request = testing::example_request("tunnel_arch");
  const json result = small_result();
  std::vector<json::json_pointer> places;
  collect(request, json::json_pointer(), places);
  for (const json::json_pointer& place : places) {
    for (const json& other :
         {json(), json("x"), json(-1), json(1e99), json(true), json::array(), json::object()}) {
      json changed = request;
      changed[place] = other;
      for (const PlotRequest& plot : kinds({PlotKind::path, PlotKind::shape, PlotKind::mode}, &changed)) {
        try {
          const std::string text = svg_of(result, plot);
          EXPECT_NO_THROW((void)SvgReader(text)) << place;
        } catch (const PlotError& error) {
          EXPECT_FALSE(error.rule().empty());
        }
      }
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
