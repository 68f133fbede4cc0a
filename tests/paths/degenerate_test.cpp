/// Models at the edge of having an answer: each is answered, with what was found and why it ended.
#include "tests/paths/reference_problems.h"

namespace snapthrough {
namespace {

using namespace testing;

TEST(Degenerate, MechanismIsAFindingBeforeAnySolving) {
  Model model = straight(1.0, 1.0, 1e6, "xy", "");
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  const auto findings = check(model, default_path(1));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "mechanism");
  EXPECT_EQ(findings[0].pointer, "/model/supports");
}

/// A load on a support does no work: nothing moves, the load grows to its bound.
TEST(Degenerate, LoadThatDoesNoWorkEndsAtTheLoadBound) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "xyr");
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  const Result result = solve_soundly(model, default_path(1));
  EXPECT_EQ(result.summary.termination, "load_bound");
  EXPECT_FALSE(result.summary.critical_load_factor);
  const Result critical = solve_soundly(model, analysis_of(AnalysisType::critical, {}));
  EXPECT_EQ(critical.summary.termination, "load_bound");
}

/// A cantilever that a force pushes onto a spring, which touches its tip.
Model cantilever_on_a_touching_spring() {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "");
  Spring tip;
  tip.id = "tip";
  tip.at = at_node("b");
  tip.stiffness = 1e3;
  tip.direction = std::array{0.0, -1.0};
  tip.reaction = Reaction::compression_only;
  model.springs = {tip};
  model.loads = {force_at(at_node("b"), -0.8, -1.0)};
  return model;
}

/// Constant actions on what holds them leave the structure at rest, where a spring touches without pressure:
/// the path is the one without them, and starts as that does.
TEST(Degenerate, ConstantActionOnASupportChangesNothing) {
  Model model = cantilever_on_a_touching_spring();
  const Result without = solve_soundly(model, analysis_of(AnalysisType::critical, {}));
  model.loads.emplace_back(PointLoad{at_node("a"), {3.0, -2.0}, 5.0, Pattern::constant});
  const Result with = solve_soundly(model, analysis_of(AnalysisType::critical, {}));
  EXPECT_EQ(with.summary.termination, without.summary.termination);
  ASSERT_TRUE(without.summary.critical_load_factor && with.summary.critical_load_factor);
  expect_relative(*with.summary.critical_load_factor, *without.summary.critical_load_factor, 1e-9, "limit");
}

/// So does one on a part of its own: the other part starts as from rest.
TEST(Degenerate, ConstantActionElsewhereChangesNothing) {
  Model model = cantilever_on_a_touching_spring();
  const Result without = solve_soundly(model, analysis_of(AnalysisType::critical, {}));
  Member other = model.members[0];
  other.id = "other";
  other.end = "c";
  model.nodes.push_back({"c", -1.0, 0.0});
  model.members.push_back(other);
  model.loads.emplace_back(PointLoad{at_node("c"), {0.0, -1.0}, 0.0, Pattern::constant});
  const Result with = solve_soundly(model, analysis_of(AnalysisType::critical, {}));
  EXPECT_EQ(with.summary.termination, without.summary.termination);
  ASSERT_TRUE(without.summary.critical_load_factor && with.summary.critical_load_factor);
  expect_relative(*with.summary.critical_load_factor, *without.summary.critical_load_factor, 1e-3, "limit");
}

/// A base that the structure moves away from changes nothing.
TEST(Degenerate, BaseThatNeverTouchesChangesNothing) {
  const ReferenceProblem free = shallow_arch(0.0, Side::left, 76.149346);
  ReferenceProblem far = shallow_arch(1e7, Side::left, 76.149346);
  far.model.foundations[0].gap = 1e3;
  const auto a = limits_of(solve_soundly(free.model, free.analysis));
  const Result result = solve_soundly(far.model, far.analysis);
  const auto b = limits_of(result);
  ASSERT_EQ(b.size(), 1u);
  expect_relative(b[0].load_factor, 76.149346, 1e-3, "limit");
  EXPECT_EQ(a[0].negative_after, b[0].negative_after);
  EXPECT_TRUE(result.contact_events.empty());
  for (const double fraction : result.branches[0].contact_fraction[0].values) EXPECT_EQ(fraction, 0.0);
}

/// A constant axial force above Euler's: the structure is unstable before the proportional load grows.
TEST(Degenerate, StructureUnstableAtZeroLoadSaysSo) {
  Model model = straight(1.0, 1.0, 1e6, "xy", "y");
  model.loads = {PointLoad{at_node("b"), {-1.5 * kPi * kPi, 0.0}, 0.0, Pattern::constant},
                 force_at(at_member("m", 0.5), 0.0, -1.0)};
  const Result critical = solve_soundly(model, analysis_of(AnalysisType::critical, {}));
  EXPECT_EQ(critical.summary.termination, "unstable_at_start");
  EXPECT_FALSE(critical.summary.critical_load_factor);
}

/// A cantilever under a growing transverse load has no critical point: the load goes to its bound.
TEST(Degenerate, PathWithoutCriticalPointEnds) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "");
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  const Result result = solve_soundly(model, default_path(1));
  EXPECT_TRUE(result.critical_points.empty());
  EXPECT_TRUE(result.summary.termination == "load_bound" ||
              result.summary.termination == "displacement_bound")
      << result.summary.termination;
  EXPECT_EQ(result.branches[0].termination, result.summary.termination);
}

/// A ring of radius 1 and EI = 1 under pressure.
Model pressed_ring(double EA) {
  Model model;
  model.nodes = {{"bottom", 0.0, -1.0}, {"top", 0.0, 1.0}};
  model.sections = {{"s", EA, 1.0, {}}};
  model.members = {{"right", "bottom", "top", "s", ArcCurve{180.0}, false, false},
                   {"left", "top", "bottom", "s", ArcCurve{180.0}, false, false}};
  for (const Member& member : model.members)
    model.loads.push_back(PressureLoad{member.id, 1.0, Side::right, Pattern::proportional});
  return model;
}

/// The two modes of each pair of a ring under pressure: critical
/// points closer than any tolerance are one of multiplicity two, or two at one load.
TEST(Degenerate, CriticalPointsTogetherAreAllCounted) {
  Model model = pressed_ring(1.2e5);
  model.supports = {support("bottom", "xy"), support("top", "x")};
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 5.0};
  int multiplicity = 0;
  for (const CriticalPoint& point : solve_soundly(model, analysis).critical_points) {
    expect_relative(point.load_factor, 3.000125006, 1e-3, "ring");  // reference README: q R^3 / EI
    multiplicity += point.multiplicity;
  }
  EXPECT_EQ(multiplicity, 2);
}

/// All pairs of a ring that is held at one point, whatever accuracy is asked for: where the guess has one
/// motion of a pair, the other is found at the solution. Loads n^2 - 1, raised by the ring's own shortening.
TEST(Degenerate, PairsOfARingAreDoubleAtEveryAccuracy) {
  constexpr double kEA = 1e6;
  Model model = pressed_ring(kEA);
  model.supports = {support("bottom", "xyr")};
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 26.0};
  analysis.output.states = StateOutput::none;
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    SCOPED_TRACE(accuracy);
    analysis.discretization.accuracy = accuracy;
    const Result result = solve_soundly(model, analysis);
    EXPECT_EQ(result.summary.termination, "load_factor");
    ASSERT_EQ(result.critical_points.size(), 4u);
    for (int n = 2; n <= 5; ++n) {
      const CriticalPoint& point = result.critical_points[static_cast<std::size_t>(n - 2)];
      EXPECT_EQ(point.multiplicity, 2);
      EXPECT_TRUE(point.confirmed);
      const double inextensible = n * n - 1.0;
      expect_relative(point.load_factor, inextensible, 2.0 * inextensible / kEA + accuracy, "pair");
    }
  }
}

/// A beam that nothing but a spring behind a gap holds in place starts where it comes to rest against it.
TEST(Degenerate, StructureThatMovesUntilAGapClosesStartsThere) {
  Model model = straight(1.0, 1.0, 1e6, "xy", "");
  Spring stop;
  stop.id = "stop";
  stop.at = at_node("b");
  stop.direction = std::array{0.0, -1.0};
  stop.stiffness = 1e4;
  stop.reaction = Reaction::compression_only;
  stop.gap = 0.05;
  model.springs = {stop};
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  model.monitors = {{"tip", at_node("b"), Component::y}};
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 10.0};
  const Result result = solve_soundly(model, analysis);
  EXPECT_EQ(result.summary.termination, "load_factor");
  const std::vector<double>& tip = result.branches[0].monitors[0].values;
  EXPECT_NEAR(tip.front(), -0.05, 1e-6);
  // the load on the spring: 10 = k (tip - gap), the bar turned by 0.05 rad takes a share of it along itself
  EXPECT_NEAR(-tip.back() - 0.05, 10.0 / 1e4, 1e-5);
}

/// Half a ring, clamped at one end and free at the other, under follower pressure: the tangent is not
/// symmetric, and its symmetric part loses its sign twice at once (at 20.4) where no eigenvalue passes zero.
/// That is no bifurcation.
TEST(Degenerate, FreeEndUnderFollowerPressureHasNoFalseBifurcation) {
  Model model;
  model.nodes = {{"a", -1.0, 0.0}, {"b", 1.0, 0.0}};
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.members = {{"m", "a", "b", "s", ArcCurve{180.0}, false, false}};
  model.supports = {support("a", "xyr")};
  model.loads = {PressureLoad{"m", 1.0, Side::left, Pattern::proportional}};
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 60.0};
  const Result result = solve_soundly(model, analysis);
  EXPECT_EQ(result.summary.termination, "load_factor");
  EXPECT_TRUE(result.critical_points.empty()) << result.critical_points.front().load_factor;
  for (const int count : result.branches[0].negative_eigenvalues) EXPECT_EQ(count, 0);
}

/// A bar on a hinge that nothing presses onto the spring beside it: it can leave it, and is named.
TEST(Degenerate, PartThatNothingHoldsIsNamed) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "");
  model.nodes.push_back({"c", 0.0, 1.0});
  model.members.push_back({"loose", "a", "c", model.sections[0].id, LineCurve{}, true, false});
  Spring stop;
  stop.id = "stop";
  stop.at = at_node("c");
  stop.direction = std::array{1.0, 0.0};
  stop.stiffness = 50.0;
  stop.reaction = Reaction::compression_only;
  model.springs = {stop};
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  const Result result = solve(model, default_path(1));
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "not_held");
  for (const char* words :
       {"member \"loose\" can turn counter-clockwise about node \"a\"", "nothing presses"})
    EXPECT_NE(result.failure->detail.find(words), std::string::npos) << result.failure->detail;
  // pressed onto it, however lightly, it is held
  model.loads.push_back(force_at(at_node("c"), 1e-6, 0.0));
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 1.0};
  EXPECT_EQ(solve_soundly(model, analysis).summary.termination, "load_factor");
}

/// The stop of a bar's sideways movement by a spring: contact begins at the gap, and stability returns there.
TEST(Degenerate, ContactThatBeginsIsAnEvent) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "");
  Spring stop;
  stop.id = "stop";
  stop.at = at_node("b");
  stop.direction = std::array{0.0, -1.0};
  stop.stiffness = 50.0;
  stop.reaction = Reaction::compression_only;
  stop.gap = 0.01;
  model.springs = {stop};
  model.loads = {force_at(at_node("b"), 0.0, -1.0)};
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.load_factor = std::array{-1.0, 1.0};
  const Result result = solve_soundly(model, analysis);
  ASSERT_EQ(result.contact_events.size(), 1u);
  EXPECT_EQ(result.contact_events[0].id, "stop");
  EXPECT_FALSE(result.contact_events[0].opened);
  // tip of a cantilever: P L^3 / (3 EI) = gap at P = 0.03, its large displacements change it by (gap / L)^2
  expect_relative(result.contact_events[0].load_factor, 0.03, 2e-4, "closing load");
}

/// Three bars in a chain between two pins, held by a base of one side on the last alone: pressed onto it, it
/// is the same structure on every mesh; beside it, it has several states of rest, all far away, and is
/// refused.
TEST(Degenerate, LinkageOnAOneSidedBaseIsAlikeOnEveryMesh) {
  Model model;
  model.nodes = {{"n0", 0.0, 0.0}, {"n1", 0.456, 0.441}, {"n2", 1.003, 1.06}, {"n3", 0.79, 1.945}};
  model.sections = {{"s", 2e4, 1.0, {}}};
  model.members = {{"m0", "n0", "n1", "s", LineCurve{}, false, true},
                   {"m1", "n1", "n2", "s", ArcCurve{125.0}, false, true},
                   {"m2", "n2", "n3", "s", ArcCurve{27.0}, false, false}};
  model.supports = {support("n0", "xy"), support("n3", "xy")};
  PointLoad load = force_at(at_member("m1", 0.19), -0.12, -0.64);
  load.moment = -0.0116;
  model.loads = {load};
  model.foundations = {one_sided("m2", 2.7, Side::left)};
  const Result coarse = solve_soundly(model, analysis_of(AnalysisType::critical, fixed_mesh(4, 5)));
  ASSERT_TRUE(coarse.summary.critical_load_factor);
  for (const int elements : {6, 8, 16, 48}) {
    const Result fine = solve_soundly(model, analysis_of(AnalysisType::critical, fixed_mesh(elements, 5)));
    ASSERT_TRUE(fine.summary.critical_load_factor) << elements;
    expect_relative(*fine.summary.critical_load_factor, *coarse.summary.critical_load_factor, 1e-6,
                    std::to_string(elements));
  }
  model.foundations[0].side = Side::right;
  for (const int elements : {4, 6, 8, 16, 48}) {
    const Result refused = solve(model, analysis_of(AnalysisType::critical, fixed_mesh(elements, 5)));
    ASSERT_TRUE(refused.failure) << elements;
    EXPECT_EQ(refused.failure->code, "not_held") << elements;
  }
}

}  // namespace
}  // namespace snapthrough
