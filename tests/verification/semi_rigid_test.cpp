/// Semi-rigid joints, effective lengths and pieces of parabolas against closed forms.
#include "tests/verification/cases.h"
#include "tests/verification/root.h"

namespace snapthrough {
namespace {

using namespace testing;

void join(Member& member, double start, double end) {
  member.release_start_rotation = member.release_end_rotation = true;
  member.release_start_stiffness = start;
  member.release_end_stiffness = end;
}

/// Clamped beam with joints of stiffness k: M = q L^2 / 12 / (1 + 2 EI / (k L)) at the ends.
TEST(SemiRigidJoints, OfAClampedBeamCarryTheirShareOfTheEndMoment) {
  Model model = straight(4.0, 100.0, 1e6, "xyr", "xyr");
  DistributedLoad load;
  load.member = "m";
  load.force = {0.0, -3.0};
  model.loads = {load};
  for (const double k : {0.0, 1.0, 40.0, 1e9}) {
    join(model.members[0], k, k);
    const Result result = solve_soundly(model, static_on(fixed_mesh(2, 5), Geometry::linear));
    const State& state = result.states.at(0);
    const double expected = k == 0.0 ? 0.0 : 4.0 / (1.0 + 200.0 / (4.0 * k));
    EXPECT_NEAR(state.members[0].bending_moment.front(), -expected, 1e-8) << k;
    EXPECT_NEAR(state.members[0].bending_moment.back(), -expected, 1e-8) << k;
    EXPECT_NEAR(state.supports[0].moment, expected, 1e-8) << k;
    EXPECT_NEAR(state.supports[1].moment, -expected, 1e-8) << k;
  }
}

/// Portal on pinned feet with joints at both ends of its beam, a load on each column head.
Model portal(double joint) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 0.0, 4.0}, {"c", 6.0, 4.0}, {"d", 6.0, 0.0}};
  model.sections = {{"s", 1e14, 8000.0, {}}};
  model.members = {{"left", "a", "b", "s", LineCurve{}, false, false},
                   {"beam", "b", "c", "s", LineCurve{}, false, false},
                   {"right", "d", "c", "s", LineCurve{}, false, false}};
  join(model.members[1], joint, joint);
  model.supports = {support("a", "xy"), support("d", "xy")};
  model.loads = {force_at(at_node("b"), 0.0, -1.0), force_at(at_node("c"), 0.0, -1.0)};
  return model;
}

/// A swaying column of height h is hinged below, and a rotational spring c resists its head: the
/// antisymmetric beam with a joint at each end, 1 / c = 1 / k_j + L / (6 EI). Its moment P v at the head
/// gives k h tan(k h) = c h / EI, k^2 = P / EI.
double sway_load(double joint) {
  const double c = 1.0 / (1.0 / joint + 6.0 / (6.0 * 8000.0));
  const double kh =
      root([c](double x) { return x * std::tan(x) - c * 4.0 / 8000.0; }, 1e-6, 0.5 * kPi - 1e-12);
  return kh * kh * 8000.0 / 16.0;
}

TEST(SemiRigidJoints, OfAPortalGiveItsSwayLoad) {
  EXPECT_NEAR(sway_load(5000.0), 496.18, 0.005);
  for (const double joint : {50.0, 5000.0, 1e6}) {
    const Model model = portal(joint);
    const Result buckling = solve_soundly(model, buckling_on(fixed_mesh(4, 6)));
    expect_relative(*buckling.summary.critical_load_factor, sway_load(joint), 1e-9, "buckling");
    const Result path = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-6)));
    expect_relative(*path.summary.critical_load_factor, sway_load(joint), 2e-6, "critical");
  }
}

/// dP / dk_j by the closed form's difference.
TEST(SemiRigidJoints, TheirStiffnessHasASensitivity) {
  const double step = 1.0;
  const double expected = (sway_load(5000.0 + step) - sway_load(5000.0 - step)) / (2.0 * step);
  Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-7));
  Variation variation;
  variation.pointer = "joints";
  variation.value = variation.size = 5000.0;
  variation.model_at = [](double k) { return std::optional(portal(k)); };
  analysis.sensitivities = {variation};
  const Result result = solve_soundly(portal(5000.0), analysis);
  ASSERT_EQ(result.critical_points.size(), 1u);
  ASSERT_EQ(result.critical_points[0].sensitivities.size(), 1u);
  expect_relative(*result.critical_points[0].sensitivities[0].derivative, expected, 1e-4, "dP / dk");
}

/// All members of a node may have semi-rigid joints there: the node then turns with their springs alone.
TEST(SemiRigidJoints, MayBeAllThatANodeHas) {
  Model model = straight(2.0, 10.0, 1e6, "xyr", "");
  model.nodes.push_back({"c", 4.0, 0.0});
  model.members.push_back({"n", "b", "c", "s", LineCurve{}, false, false});
  model.members[0].release_end_rotation = true;
  model.members[0].release_end_stiffness = 7.0;
  model.members[1].release_start_rotation = true;
  model.members[1].release_start_stiffness = 5.0;
  model.loads = {force_at(at_node("c"), 0.0, -1e-3)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear));
  const MemberState& tip = result.states.at(0).members[1];
  const double expected = 1e-3 * (64.0 / 30.0 + 4.0 * (1.0 / 7.0 + 1.0 / 5.0));
  EXPECT_NEAR(tip.v.back(), -expected, 1e-12);
}

/// Pinned 1, cantilever 2, clamped and pinned 0.69916, by the differential equation and by elements.
TEST(EffectiveLengths, AreThoseOfTheTextbook) {
  const double clamped_pinned = kPi / root([](double x) { return std::tan(x) - x; }, 4.4, 4.6);
  for (const auto& [start, end, expected] :
       {std::tuple{"xy", "y", 1.0}, std::tuple{"xyr", "", 2.0}, std::tuple{"xyr", "y", clamped_pinned}}) {
    Model model = straight(3.0, 100.0, 1e13, start, end);
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    for (const Discretization& mesh : {accurate(1e-9), fixed_mesh(6, 6)}) {
      const Result result = solve_soundly(model, buckling_on(mesh));
      const auto& lengths = result.buckling->modes.at(0).effective_lengths;
      ASSERT_EQ(lengths.size(), 1u);
      EXPECT_EQ(lengths[0].id, "m");
      expect_relative(*lengths[0].ratio, expected, 1e-9, end);
      expect_relative(*lengths[0].length, 3.0 * expected, 1e-9, end);
    }
  }
}

/// Columns of the portal: pi / (k h); the beam has no axial force before it sways, and no effective length.
TEST(EffectiveLengths, OfAPortalAreThoseOfItsColumns) {
  const Result result = solve_soundly(portal(5000.0), buckling_on(fixed_mesh(4, 6)));
  const auto& lengths = result.buckling->modes.at(0).effective_lengths;
  ASSERT_EQ(lengths.size(), 3u);
  const double expected = kPi * std::sqrt(8000.0 / sway_load(5000.0));
  expect_relative(lengths[0].length.value(), expected, 1e-9, "left");
  expect_relative(lengths[0].ratio.value(), expected / 4.0, 1e-9, "left");
  expect_relative(lengths[2].length.value(), expected, 1e-9, "right");
  EXPECT_FALSE(lengths[1].length || lengths[1].ratio);
}

/// Span 20, rise 5, hinges at the feet and the crown; each half is a piece of one parabola whose axis is
/// vertical. Its offset from the chord is largest in the middle: 5 / 4.
Model three_hinged_arch() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"crown", 10.0, 5.0}, {"b", 20.0, 0.0}};
  model.sections = {{"s", 1e7, 1e4, {}}};
  const ParabolaCurve half{1.25, std::array{0.0, 2.0}};
  model.members = {{"left", "a", "crown", "s", half, false, true},
                   {"right", "crown", "b", "s", half, false, false}};
  model.supports = {support("a", "xy"), support("b", "xy")};
  return model;
}

/// A load q per horizontal length on the whole span is carried by thrust alone: H = q l^2 / (8 f), M = 0.
TEST(PieceOfAParabola, CarriesAnEvenLoadByThrust) {
  Model model = three_hinged_arch();
  for (const std::string member : {"left", "right"}) {
    DistributedLoad load;
    load.member = member;
    load.force = {0.0, -10.0};
    load.per = LoadMeasure::horizontal;
    model.loads.emplace_back(load);
  }
  const Result result = solve_soundly(model, static_on(fixed_mesh(8, 7), Geometry::linear));
  const State& state = result.states.at(0);
  EXPECT_NEAR(state.supports[0].fx, 100.0, 1e-8);
  for (const MemberState& member : state.members)
    for (std::size_t i = 0; i < member.s.size(); ++i) EXPECT_NEAR(member.bending_moment[i], 0.0, 1e-7) << i;
}

/// q = 250 per horizontal length on the left half: H = q l^2 / (16 f), M = q l^2 / 64 = 1562.5 at the loaded
/// quarter, 0 at the crown.
TEST(PieceOfAParabola, HasTheMomentsOfHalfALoad) {
  Model model = three_hinged_arch();
  DistributedLoad load;
  load.member = "left";
  load.force = {0.0, -250.0};
  load.per = LoadMeasure::horizontal;
  model.loads = {load};
  Analysis analysis = static_on(fixed_mesh(8, 7), Geometry::linear);
  analysis.output.points_per_member = 2001;
  const State state = solve_soundly(model, analysis).states.at(0);
  EXPECT_NEAR(state.supports[0].fx, 250.0 * 400.0 / 80.0, 1e-7);
  const auto moment = [](double x) {  // of the loaded half: A x - q x^2 / 2 - H y
    return 1875.0 * x - 125.0 * x * x - 1250.0 * (x - x * x / 20.0);
  };
  EXPECT_DOUBLE_EQ(moment(5.0), 1562.5);
  const MemberState& left = state.members[0];
  for (std::size_t i = 0; i < left.s.size(); ++i) {
    EXPECT_NEAR(left.y0[i], left.x0[i] - left.x0[i] * left.x0[i] / 20.0, 1e-12);
    EXPECT_NEAR(left.bending_moment[i], moment(left.x0[i]), 1e-6) << left.x0[i];
  }
  EXPECT_NEAR(left.bending_moment.back(), 0.0, 1e-8);
}

}  // namespace
}  // namespace snapthrough
