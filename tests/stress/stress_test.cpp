/// A slice of the stress test: random valid models are solved, and every returned state is checked by
/// mechanics written a second time. The long run is scripts/stress.sh; docs/stress.md says what is checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "api/api.h"
#include "solver/solve.h"
#include "tests/stress/broad_model.h"
#include "tests/stress/frame_model.h"
#include "tests/stress/inertia.h"
#include "tests/stress/laws_model.h"
#include "tests/stress/media_model.h"
#include "tests/stress/members_model.h"
#include "tests/stress/random_model.h"
#include "tests/stress/request_text.h"
#include "tests/stress/rod_law.h"
#include "tests/stress/soil_model.h"
#include "tests/stress/stress_run.h"

namespace snapthrough::testing {
namespace {

TEST(StressChecker, CountsNegativeEigenvaluesOfAMatrixWithoutDiagonal) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 4);
  a(1, 0) = a(0, 1) = 2.0;  // +2, -2
  a(2, 2) = -1.0;
  a(3, 3) = 5.0;
  a(3, 1) = a(1, 3) = 1e-3;
  EXPECT_EQ(negative_eigenvalues(a), 2);
  EXPECT_EQ(negative_eigenvalues(-a), 2);
}

/// The checker must see a point that is a little off: a residual that never fails would prove nothing.
TEST(StressChecker, SeesAFalsePoint) {
  const auto request = random_request(14);
  Analysis analysis = request.analysis;
  analysis.output.states = StateOutput::all;
  analysis.output.points_per_member = points_needed(request.model, analysis);
  Result result = solve(request.model, analysis);
  ASSERT_TRUE(check_result(request.model, analysis, result).failures.empty());
  result.states.back().load_factor *= 1.0 + 1e-6;
  EXPECT_FALSE(check_result(request.model, analysis, result).failures.empty());
}

ReactionLaw law_of(ReactionLaw::Type type) {
  ReactionLaw law;
  law.type = type;
  law.stiffness = AlongMember({{0.0, 200.0}, {0.4, 500.0}, {1.0, 300.0}});
  law.capacity = AlongMember({{0.0, 2.0}, {0.4, 4.0}, {1.0, 3.0}});
  law.reference = 0.02;
  law.points = {{0.004, 1.5}, {0.01, 2.5}, {0.03, 3.0}};
  law.factor = AlongMember({{0.0, 0.5}, {0.4, 1.5}, {1.0, 1.0}});
  return law;
}

/// A hinged beam of length 2 on a foundation, loaded across its middle.
RandomRequest beam_on(const Foundation& foundation) {
  RandomRequest out;
  out.model.nodes = {{"a", 0.0, 0.0}, {"b", 2.0, 0.0}};
  out.model.sections = {{"s", 1e4, 1.0, {}}};
  out.model.members = {{.id = "beam", .start = "a", .end = "b", .section = "s", .curve = {}}};
  out.model.supports = {{"a", true, true, false, 0.0, {}}, {"b", false, true, false, 0.0, {}}};
  out.model.foundations = {foundation};
  out.model.loads = {PointLoad{{"", "beam", 0.6}, {0.0, 4.0}, 0.0, Pattern::proportional}};
  out.analysis.type = AnalysisType::path;
  out.analysis.stop.load_factor = {{-1.0, 2.0}};
  out.analysis.output.states = StateOutput::all;
  out.analysis.output.points_per_member = points_needed(out.model, out.analysis);
  return out;
}

/// A law whose force is off by 1e-5 is another law.
TEST(StressChecker, SeesAFalseLaw) {
  using Type = ReactionLaw::Type;
  for (const Type type : {Type::linear, Type::tanh, Type::hyperbolic, Type::power, Type::table}) {
    SCOPED_TRACE(static_cast<int>(type));
    Foundation soil;
    soil.id = "soil";
    soil.member = "beam";
    soil.law = law_of(type);
    RandomRequest request = beam_on(soil);
    const Result result = solve(request.model, request.analysis);
    ASSERT_EQ(result.summary.termination, "load_factor") << result.summary.message;
    for (const std::string& what : check_result(request.model, request.analysis, result).failures)
      EXPECT_TRUE(what.starts_with("reactions:")) << what;
    ReactionLaw& law = *request.model.foundations.front().law;
    for (AlongMember* number : {&law.stiffness, &law.capacity, &law.factor})
      for (auto& point : number->points) point.second *= 1.0 + 1e-5;
    const ResultCheck check = check_result(request.model, request.analysis, result);
    EXPECT_GT(check.residual, 1.0);
  }
}

TEST(StressChecker, SeesAMissingContact) {
  Foundation wall;
  wall.id = "wall";
  wall.member = "beam";
  wall.stiffness = 100.0;
  wall.reaction = Reaction::compression_only;
  const RandomRequest request = beam_on(wall);
  Result result = solve(request.model, request.analysis);
  ASSERT_TRUE(check_result(request.model, request.analysis, result).failures.empty());
  result.states.back().foundations.front().contact.clear();
  const ResultCheck check = check_result(request.model, request.analysis, result);
  ASSERT_FALSE(check.failures.empty());
  EXPECT_TRUE(check.failures.front().starts_with("contact:")) << check.failures.front();
}

/// The checker agrees with the solver on a request, and not on another one.
/// @param change by which the model that is checked differs from the one that is solved
void expect_seen(RandomRequest request, const std::function<void(Model&)>& change) {
  request.analysis.output.points_per_member = points_needed(request.model, request.analysis);
  const Result result = solve(request.model, request.analysis);
  ASSERT_EQ(result.summary.termination, "load_factor") << result.summary.message;
  for (const std::string& what : check_result(request.model, request.analysis, result).failures)
    ADD_FAILURE() << what;
  change(request.model);
  EXPECT_GT(check_result(request.model, request.analysis, result).residual, 1.0);
}

ReactionLaw yielding(double stiffness, double capacity) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::tanh;
  law.stiffness = stiffness;
  law.capacity = capacity;
  return law;
}

/// The hinged beam with a moment law of its sections' rotation.
TEST(StressChecker, SeesAFalseFoundationAgainstRotation) {
  Foundation bed;
  bed.id = "bed";
  bed.member = "beam";
  bed.component = FoundationComponent::rotation;
  bed.law = yielding(5.0, 0.3);
  const auto change = [](Model& m) { m.foundations.front().law->capacity = 0.3 * (1.0 + 1e-5); };
  expect_seen(beam_on(bed), change);
  bed.law.reset();
  bed.stiffness = 5.0;
  expect_seen(beam_on(bed), [](Model& m) { m.foundations.front().stiffness *= 1.0 + 1e-5; });
}

/// The beam, clamped at its start by a joint that yields.
TEST(StressChecker, SeesAFalseJoint) {
  RandomRequest request = beam_on({.id = "soft", .member = "beam", .stiffness = 0.1, .direction = {}});
  request.model.supports.front().rotation = true;
  request.model.members.front().release_start_rotation = true;
  request.model.members.front().release_start_law = yielding(20.0, 0.5);
  expect_seen(request, [](Model& m) { m.members.front().release_start_law->capacity = 0.5 * (1.0 + 1e-5); });
}

/// The beam with a guy, a tie and a spring to the ground beside it, all of them pretensioned.
TEST(StressChecker, SeesAFalsePretension) {
  RandomRequest request = beam_on({.id = "soft", .member = "beam", .stiffness = 0.1, .direction = {}});
  Model& model = request.model;
  constexpr double EA = 100.0;  // so that the changes below strain by more than a state's digits
  model.sections.push_back({"tie", EA, 1.0, {}});
  model.nodes.push_back({"c", 3.0, -1.0});
  model.nodes.push_back({"d", 3.0, 1.0});
  model.supports.push_back({"c", true, true, false, 0.0, {}});
  model.supports.push_back({"d", true, true, false, 0.0, {}});
  model.members.push_back({.id = "guy", .start = "b", .end = "c", .section = "tie", .curve = {}});
  model.members.back().reaction = Reaction::tension_only;
  model.members.push_back({.id = "tie", .start = "b", .end = "d", .section = "tie", .curve = {}});
  model.members.back().release_start_rotation = model.members.back().release_end_rotation = true;
  Spring link;
  link.id = "link";
  link.at = {"b", "", 0.0};
  link.to = Location{"d", "", 0.0};
  link.direction = {-2.0, -2.0};
  link.stiffness = 3.0;
  model.springs = {link};
  const double length = std::numbers::sqrt2;
  for (const bool by_force : {true, false}) {
    const auto given = [&](double force, double stiffness) {
      return by_force ? Pretension{force, {}} : Pretension{{}, length - force / stiffness};
    };
    model.members[1].pretension = given(2.0, EA / length);
    model.members[2].pretension = given(1.0, EA / length);
    model.springs.front().pretension = given(0.5, 3.0);
    const auto off = [](Pretension& p) { (p.force ? *p.force : *p.unstressed_length) *= 1.0 + 1e-5; };
    expect_seen(request, [&off](Model& m) { off(*m.members[1].pretension); });
    expect_seen(request, [&off](Model& m) { off(*m.members[2].pretension); });
    expect_seen(request, [&off](Model& m) { off(*m.springs.front().pretension); });
  }
}

/// The beam with a rigid piece that continues it, and a force on its end.
TEST(StressChecker, SeesThatARigidMemberStrains) {
  constexpr double kRigid = std::numeric_limits<double>::infinity();
  RandomRequest request = beam_on({.id = "soft", .member = "beam", .stiffness = 0.1, .direction = {}});
  Model& model = request.model;
  model.nodes.push_back({"c", 2.5, 0.0});
  model.sections.push_back({"rigid", kRigid, kRigid, {}});
  model.members.push_back({.id = "arm", .start = "b", .end = "c", .section = "rigid", .curve = {}});
  model.loads.emplace_back(PointLoad{{"c", "", 0.0}, {0.1, 0.2}, 0.0, Pattern::proportional});
  expect_seen(request, [](Model& m) { m.sections.back().EI = 1e5; });
  expect_seen(request, [](Model& m) { m.sections.back().EA = 1e5; });
}

BendingLaw bending_law(BendingLaw::Type type, Interpolation interpolation) {
  BendingLaw law;
  law.type = type;
  law.interpolation = interpolation;
  law.moment = 0.4;
  law.exponent = 5.0;
  law.points = {{0.3, 0.3}, {1.0, 0.5}, {3.0, 0.6}};
  return law;
}

/// The beam with sections that soften; a moment, an exponent or a curvature of a law is off by 1e-5.
TEST(StressChecker, SeesAFalseBendingLaw) {
  using Type = BendingLaw::Type;
  RandomRequest request = beam_on({.id = "soft", .member = "beam", .stiffness = 0.1, .direction = {}});
  request.model.loads = {PointLoad{{"", "beam", 0.6}, {0.0, 1.0}, 0.0, Pattern::proportional}};
  request.analysis.stop.load_factor = {{-1.0, 1.2}};
  Section& section = request.model.sections.front();
  section.bending = bending_law(Type::ramberg_osgood, {});
  expect_seen(request, [](Model& m) { m.sections.front().bending->moment *= 1.0 + 1e-5; });
  expect_seen(request, [](Model& m) { m.sections.front().bending->exponent *= 1.0 + 1e-5; });
  expect_seen(request, [](Model& m) { m.sections.front().bending->coefficient *= 1.0 + 1e-5; });
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::monotone_cubic}) {
    SCOPED_TRACE(static_cast<int>(interpolation));
    section.bending = bending_law(Type::table, interpolation);
    section.EI = bending_stiffness_of(*section.bending);
    expect_seen(request, [](Model& m) { m.sections.front().bending->points[1][1] *= 1.0 + 1e-5; });
    expect_seen(request, [](Model& m) { m.sections.front().bending->points[2][0] *= 1.0 + 1e-5; });
  }
}

/// Values at the moments that scale the laws, and of the cubic's slopes by hand.
TEST(StressChecker, BendingLawsAreThoseOfTheDocument) {
  using Type = BendingLaw::Type;
  BendingLaw given = bending_law(Type::ramberg_osgood, {});
  given.coefficient = 0.25;
  const BendingCurvature power(given, 2.0);
  EXPECT_DOUBLE_EQ(power.at(-0.4), -0.25);  // 1.25 * 0.4 / 2
  EXPECT_DOUBLE_EQ(power.at(0.8), 0.5 * (0.8 + 0.25 * 0.4 * 32.0));
  EXPECT_DOUBLE_EQ(power.scaled(0.1, 0.5).at(-4.0), -0.5);
  EXPECT_NEAR(power.moment_of(-0.25), -0.4, 1e-15);

  given = bending_law(Type::table, Interpolation::linear);
  EXPECT_DOUBLE_EQ(bending_stiffness_of(given), 1.0);
  const BendingCurvature lines(given, 1.0);
  EXPECT_DOUBLE_EQ(lines.at(-0.4), -0.65);
  EXPECT_DOUBLE_EQ(lines.at(0.7), 5.0);
  EXPECT_DOUBLE_EQ(lines.slope(0.7), 20.0);
  EXPECT_NEAR(lines.change(0.5, 0.01), 0.2, 1e-15);
  EXPECT_NEAR(lines.slopes_near(-0.5, 0.01)[0], 3.5, 1e-15);
  EXPECT_NEAR(lines.slopes_near(-0.5, 0.01)[1], 20.0, 1e-13);

  // chords 1 and 3 of equal length have the slope 1.5 between them, with which the outer ones have no bend
  given.interpolation = Interpolation::monotone_cubic;
  given.points = {{1.0, 1.0}, {4.0, 2.0}};
  EXPECT_DOUBLE_EQ(bending_stiffness_of(given), 1.0 / 0.75);
  const BendingCurvature cubic(given, 1.0 / 0.75);
  EXPECT_DOUBLE_EQ(cubic.slope(0.0), 0.75);
  EXPECT_DOUBLE_EQ(cubic.slope(1.0), 1.5);
  EXPECT_DOUBLE_EQ(cubic.slope(2.0), 3.75);
  EXPECT_DOUBLE_EQ(cubic.at(0.5), 0.5 + (0.75 - 1.5) / 8.0);
  EXPECT_DOUBLE_EQ(cubic.at(3.0), 7.75);
  for (const BendingCurvature& law : {power, lines, cubic})
    for (const double moment : {-0.17, 0.35, 0.45, 1.3, 2.6}) {
      constexpr double kStep = 1e-6;
      const double difference = (law.at(moment + kStep) - law.at(moment - kStep)) / (2.0 * kStep);
      EXPECT_NEAR(law.slope(moment), difference, 1e-7 * difference);
    }
}

/// Values that the formulas of docs/requests.md have at the penetrations that scale them, and slopes.
TEST(StressChecker, LawsAreThoseOfTheDocument) {
  using Type = ReactionLaw::Type;
  ReactionLaw given;
  given.stiffness.constant = 10.0;
  given.capacity.constant = 2.0;
  given.reference = 1.0;
  given.points = {{1.0, 2.0}, {3.0, 6.0}};
  const auto law = [&given](Type type) {
    given.type = type;
    return LawAlong(given).at(0.0);
  };
  EXPECT_DOUBLE_EQ(law(Type::tanh).force(0.2), 2.0 * std::tanh(1.0));
  EXPECT_DOUBLE_EQ(law(Type::hyperbolic).force(-0.2), -1.0);
  EXPECT_DOUBLE_EQ(law(Type::power).force(0.25), 1.0);
  EXPECT_DOUBLE_EQ(law(Type::power).force(0.01), 0.1);
  EXPECT_DOUBLE_EQ(law(Type::power).force(4.0), 2.0);
  EXPECT_DOUBLE_EQ(law(Type::table).force(2.2), 4.4);  // points on a line
  EXPECT_DOUBLE_EQ(law(Type::table).force(5.0), 6.0);
  given.points = {{1.0, 3.0}, {3.0, 5.0}, {4.0, 5.0}, {6.0, 9.0}};
  for (const Type type : {Type::tanh, Type::hyperbolic, Type::power, Type::table})
    for (const double w : {-0.15, 0.17, 1.3, 3.4, 5.0}) {
      constexpr double kStep = 1e-6;
      const double difference = law(type).force(w + kStep) - law(type).force(w - kStep);
      EXPECT_NEAR(law(type).slope(w), difference / (2.0 * kStep), 1e-7);
    }
}

void expect_checked(const StressOutcome& out, const std::string& end) {
  EXPECT_EQ(out.termination, end) << out.detail;
  EXPECT_TRUE(out.reached);
  EXPECT_TRUE(out.said_where);
  EXPECT_GT(out.check.points, 0) << "no state was checked";
  for (const std::string& what : out.check.failures) ADD_FAILURE() << what << "\n" << out.features;
}

/// How each of the twelve ends: as it does drawn mirrored, from the other end and in another order, and,
/// where an accuracy is asked for, at a tenth of it.
TEST(Stress, SliceOfRandomModels) {
  const std::map<std::uint64_t, std::string> ends{
      {28, "load_factor"},  {29, "monitor"},     {30, "load_factor"},    {31, "load_factor"},
      {32, "load_factor"},  {33, "monitor"},     {34, "load_bound"},     {35, "critical_point"},
      {36, "limit_points"}, {37, "load_factor"}, {38, "critical_point"}, {39, "load_factor"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_checked(run_seed(Draw::broad, seed, 20.0), end);
  }
}

/// Structures on laws of supports.
TEST(Stress, SliceOfRandomLaws) {
  const std::map<std::uint64_t, std::string> ends{
      {700001, "critical_point"},     {700002, "displacement_bound"}, {700010, "critical_point"},
      {700014, "load_factor"},        {700018, "displacement_bound"}, {700024, "monitor"},
      {700027, "critical_point"},     {700030, "displacement_bound"}, {700032, "displacement_bound"},
      {700035, "displacement_bound"}, {700036, "critical_point"},     {700039, "load_factor"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_checked(run_seed(Draw::laws, seed, 20.0), end);
  }
}

/// Structures with rods, tapers, rigid supports, outlines and gaps along members.
TEST(Stress, SliceOfRandomMedia) {
  const std::map<std::uint64_t, std::string> ends{{810082, "load_factor"},
                                                  {810085, "load_factor"},
                                                  {810086, "load_factor"},
                                                  {810099, "critical_point"},
                                                  {810102, "limit_points"},
                                                  {810115, "critical_point"},
                                                  {810122, "displacement_bound"},
                                                  {810123, "displacement_bound"},
                                                  {810124, "limit_points"},
                                                  {810128, "critical_point"},
                                                  {810133, "monitor"},
                                                  {810135, "monitor"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_checked(run_seed(Draw::media, seed, 20.0), end);
  }
}

/// Structures with rigid members, joints that yield, beds against rotation, guys, ties and links.
TEST(Stress, SliceOfRandomMembers) {
  const std::map<std::uint64_t, std::string> ends{
      {900044, "monitor_turned"}, {900222, "critical_point"}, {900243, "load_bound"},
      {900272, "load_bound"},     {900294, "steps"},          {900350, "load_factor"},
      {900463, "critical_point"}, {900606, "limit_points"},   {900551, "monitor"},
      {900577, "critical_point"}, {900594, "load_factor"},    {900769, "displacement_bound"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_checked(run_seed(Draw::members, seed, 20.0), end);
  }
}

/// Those of these structures that have cables: each kind of end.
TEST(Stress, SliceOfRandomCables) {
  const std::map<std::uint64_t, std::string> ends{
      {900019, "load_factor"}, {900025, "critical_point"},     {900031, "load_factor"},
      {900090, "load_bound"},  {900109, "displacement_bound"}, {900111, "load_factor"},
      {900113, "steps"},       {900145, "critical_point"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_checked(run_seed(Draw::members, seed, 20.0), end);
  }
}

/// Those of these structures whose sections have bending laws: each kind of law and of end.
TEST(Stress, SliceOfRandomBendingLaws) {
  const std::map<std::uint64_t, std::string> ends{{900180, "monitor_turned"}, {900190, "steps"},
                                                  {900256, "load_bound"},     {900340, "displacement_bound"},
                                                  {900372, "load_factor"},    {900612, "load_factor"},
                                                  {901327, "steps"},          {900777, "limit_points"},
                                                  {900971, "critical_point"}, {900976, "critical_point"},
                                                  {901218, "critical_point"}, {901220, "monitor"}};
  for (const auto& [seed, end] : ends) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomRequest request = draw_request(Draw::members, seed);
    const auto has_law = [](const Section& s) { return s.bending.has_value(); };
    EXPECT_TRUE(std::ranges::any_of(request.model.sections, has_law));
    expect_checked(run_request(request, 20.0), end);
  }
}

/// What `stress_request` writes is the request that was drawn: read as a user's document it is written the
/// same.
TEST(Stress, RequestsOfSeedsAreWrittenWhole) {
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    for (const RandomRequest& drawn :
         {random_request(seed), broad_request(seed), laws_request(seed), media_request(seed),
          soil_request(seed), members_request(seed), frame_request(seed, 1e-3)}) {
      const std::string text = request_text(drawn);
      const api::ReadOutcome read = api::read_request(text);
      ASSERT_TRUE(read.request) << seed << ": " << text;
      EXPECT_EQ(request_text({read.request->model, read.request->analysis}), text) << seed;
    }
}

}  // namespace
}  // namespace snapthrough::testing
