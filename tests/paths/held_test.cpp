/// Loads that one-sided supports cannot hold are refused in every kind of analysis, before anything is
/// computed. tests/paths/held/ has requests that were answered as if the structures stood.
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "api/api.h"
#include "solver/sweep/critical_curve.h"
#include "tests/paths/reference_problems.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kWidth = 1.0;   // half of the footing's
constexpr double kHeight = 6.0;  // of the wall
constexpr double kWeight = 200.0;

api::Request request_of(const std::string& name) {
  std::ifstream in(SNAPTHROUGH_SOURCE_DIR "/tests/paths/held/" + name + ".json");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const api::ReadOutcome read = api::read_request(text);
  EXPECT_TRUE(read.request) << name;
  return *read.request;
}

void expect_refused(const Result& result, const std::vector<std::string>& words) {
  ASSERT_TRUE(result.failure) << result.summary.message;
  EXPECT_EQ(result.failure->code, "not_held") << result.failure->detail;
  EXPECT_EQ(result.summary.termination, "not_held");
  EXPECT_FALSE(result.summary.critical_load_factor);
  EXPECT_TRUE(result.states.empty());
  EXPECT_TRUE(result.branches.empty());
  for (const std::string& word : words)
    EXPECT_NE(result.failure->detail.find(word), std::string::npos) << result.failure->detail;
}

/// W and H at the top of a wall on a footing that only its soil holds against turning.
Model footing(double W, double H, Pattern weight = Pattern::proportional) {
  Model model = request_of("footing_combo_overturn").model;
  model.loads = {PointLoad{at_node("top"), {0.0, -W}, 0.0, weight}, force_at(at_node("top"), H, 0.0)};
  return model;
}

TEST(Held, FootingThatOverturnsIsRefusedInEveryAnalysis) {
  const api::Request request = request_of("footing_combo_overturn");
  const std::vector<std::string> words{"all members", "turn clockwise about node \"r\"",
                                       "the point load at node \"top\""};
  for (const AnalysisType type :
       {AnalysisType::static_, AnalysisType::critical, AnalysisType::path, AnalysisType::buckling}) {
    Analysis analysis = request.analysis;
    analysis.type = type;
    expect_refused(solve(request.model, analysis), words);
  }
  Analysis linear = request.analysis;
  linear.geometry = Geometry::linear;
  const Result result = solve(request.model, linear);
  expect_refused(result, words);
  EXPECT_EQ(result.not_reached, std::vector<double>{1.0});
}

TEST(Held, PortalOnPadsThatOverturnsIsRefused) {
  const api::Request request = request_of("portal_pads_overturn");
  expect_refused(solve(request.model, request.analysis),
                 {"all members", "turn clockwise about node \"D\"", "the point load at node \"B\""});
}

TEST(Held, WindWithoutWeightIsRefusedBeforeBuckling) {
  const api::Request request = request_of("footing_wind_buckling");
  expect_refused(solve(request.model, request.analysis), {"clockwise about node \"r\""});
}

/// Beyond the rigid limit H = W b / h there is no state at all.
TEST(Held, GrowingLoadOnAConstantWeight) {
  const Model model = footing(kWeight, 1.0, Pattern::constant);
  constexpr double kLimit = kWeight * kWidth / kHeight;
  const Result linearised = solve(model, analysis_of(AnalysisType::buckling, {}));
  ASSERT_TRUE(linearised.failure);
  EXPECT_EQ(linearised.failure->code, "not_held");
  EXPECT_FALSE(linearised.summary.critical_load_factor);
  EXPECT_NE(linearised.failure->detail.find("33.3333"), std::string::npos) << linearised.failure->detail;
  // rigid: W (b - c / 3) - W h t with the contact width c = sqrt(2 W / (K t)) is largest at the tilt t
  Model rigid = model;
  rigid.sections[0].EI = 1e9;
  rigid.sections[0].EA = 1e11;
  const double slack = std::sqrt(2.0 * kWeight / rigid.foundations[0].stiffness);
  const double tilt = std::pow(slack / (6.0 * kHeight), 2.0 / 3.0);
  const double by_hand = kWeight * (kWidth - slack / (3.0 * std::sqrt(tilt)) - kHeight * tilt) / kHeight;
  const Result path = solve_soundly(rigid, analysis_of(AnalysisType::critical, {}));
  ASSERT_TRUE(path.summary.critical_load_factor);
  expect_relative(*path.summary.critical_load_factor, by_hand, 1e-3, "of the soft soil, by the path");
  EXPECT_LT(*path.summary.critical_load_factor, kLimit);
  Model strong = model;
  std::get<PointLoad>(strong.loads[1]).force[0] = 1.1 * kLimit;
  expect_refused(solve(strong, analysis_of(AnalysisType::buckling, {})),
                 {"the reference load", "node \"r\""});
}

/// Rows of the load factors that are held stay, the others are listed as they were asked for.
TEST(Held, StaticRowsAsFarAsTheyAreHeld) {
  const Model model = footing(kWeight, 1.0, Pattern::constant);
  const std::vector<double> asked{40.0, 1.0, -50.0, 0.0, -5.0, 34.0};
  for (const Geometry geometry : {Geometry::linear, Geometry::nonlinear}) {
    const Result result = solve(model, static_on({}, geometry, asked));
    ASSERT_TRUE(result.failure);
    EXPECT_EQ(result.failure->code, "not_held");
    EXPECT_NE(result.failure->detail.find("load factor 40"), std::string::npos) << result.failure->detail;
    EXPECT_NE(result.failure->detail.find("3 load factors"), std::string::npos) << result.failure->detail;
    EXPECT_EQ(result.not_reached, (std::vector<double>{40.0, -50.0, 34.0}));
    ASSERT_TRUE(result.static_table);
    EXPECT_EQ(result.static_table->load_factor, (std::vector<double>{1.0, 0.0, -5.0}));
    EXPECT_EQ(result.states.size(), 3u);
  }
}

/// The load falls, and the wall is held: the direction of the path decides.
TEST(Held, DirectionOfThePath) {
  Model model = footing(1.0, 0.0);
  std::get<PointLoad>(model.loads[0]).force[1] = 1.0;
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 1.0};
  expect_refused(solve(model, analysis), {"shift in direction (0, 1)"});
  const Result table = solve(model, static_on({}, Geometry::nonlinear, {-1.0, 1.0}));
  EXPECT_EQ(table.not_reached, std::vector<double>{1.0});
  EXPECT_EQ(table.static_table->load_factor, std::vector<double>{-1.0});
}

/// Wind that is constant before the weight grows: a state at load factor 1 exists, and small displacements
/// give it; a path would begin with the wind alone.
TEST(Held, PathCannotBeginWithConstantActionsThatAreNotHeld) {
  Model model = footing(kWeight, 0.0);
  model.loads.push_back(PointLoad{at_node("top"), {10.0, 0.0}, 0.0, Pattern::constant});
  const Result linear = solve_soundly(model, static_on({}, Geometry::linear, {1.0}));
  EXPECT_EQ(linear.states.size(), 1u);
  const Result nonlinear = solve(model, static_on({}, Geometry::nonlinear, {1.0}));
  expect_refused(nonlinear, {"the constant actions", "load factor 1", "node \"r\""});
  expect_refused(solve(model, analysis_of(AnalysisType::critical, {})), {"the constant actions"});
}

/// A sweep says the same, at the values that are not held.
TEST(Held, FollowedCurveRefusesWhatIsNotHeld) {
  CriticalCurveRequest request;
  request.model = [](double H) { return footing(kWeight, H, Pattern::proportional); };
  request.analysis = analysis_of(AnalysisType::critical, {});
  request.analysis.discretization.fixed_mesh = true;
  request.analysis.discretization.elements = 4;
  request.analysis.discretization.order = 5;
  request.values = {5.0, 10.0, 33.0, 34.0, 50.0};
  const CriticalCurve curve = follow_critical_point(request);
  ASSERT_EQ(curve.points.size(), request.values.size());
  for (const CriticalCurvePoint& point : curve.points)
    EXPECT_EQ(point.failure, point.value > kWeight * kWidth / kHeight ? "not_held" : "") << point.value;
}

/// Contact of a constant weight opens before the linearised load, which keeps it: the answer says so. Without
/// constant actions and gaps it is the same under every load.
TEST(Held, LinearisedContactThatChangesIsAWarning) {
  Model model = straight(4.0, 1.0, 1e6, "xy", "y");
  model.foundations = {one_sided("m", 2.0, Side::right)};
  model.loads = {force_at(at_node("b"), -1.0, 0.0),
                 DistributedLoad{"m", {0.0, 1e-3}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const Result alike = solve_soundly(model, analysis_of(AnalysisType::buckling, {}));
  EXPECT_TRUE(alike.warnings.empty());
  std::get<DistributedLoad>(model.loads[1]).force[1] = 1.0;
  model.loads.push_back(
      DistributedLoad{"m", {0.0, -1.5}, {0.0, 1.0}, LoadMeasure::length, Pattern::constant});
  const Result changes = solve_soundly(model, analysis_of(AnalysisType::buckling, {}));
  ASSERT_TRUE(changes.summary.critical_load_factor);
  ASSERT_GT(*changes.summary.critical_load_factor, 1.5);
  ASSERT_EQ(changes.warnings.size(), 1u);
  EXPECT_EQ(changes.warnings[0].code, "contact_changes");
  EXPECT_NE(changes.warnings[0].detail.find("foundation soil touches on 100 % of its range under the "
                                            "reference load and on 0 %"),
            std::string::npos)
      << changes.warnings[0].detail;
}

/// A gap that closes between the reference load and the critical one.
TEST(Held, LinearisedGapThatClosesIsAWarning) {
  Model model = straight(1.0, 1.0, 1e6, "xy", "y");
  Spring stop;
  stop.id = "stop";
  stop.at = at_member("m", 0.5);
  stop.direction = std::array{0.0, -1.0};
  stop.stiffness = 1e4;
  stop.reaction = Reaction::compression_only;
  stop.gap = 0.05;
  model.springs = {stop};
  // sag of the middle P / 48: the gap closes at P = 2.4
  model.loads = {force_at(at_node("b"), -1.0, 0.0), force_at(at_member("m", 0.5), 0.0, -1.0)};
  const Result result = solve_soundly(model, analysis_of(AnalysisType::buckling, {}));
  ASSERT_TRUE(result.summary.critical_load_factor);
  expect_relative(*result.summary.critical_load_factor, kPi * kPi, 1e-3, "without the stop");
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].code, "contact_changes");
  EXPECT_NE(result.warnings[0].detail.find("spring stop"), std::string::npos) << result.warnings[0].detail;
}

}  // namespace
}  // namespace snapthrough
