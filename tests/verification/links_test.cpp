/// Springs between nodes and one-sided members against closed forms.
#include <functional>

#include "tests/findings.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Member with hinges at both ends.
Member bar(const std::string& id, const std::string& start, const std::string& end,
           const std::string& section) {
  return {id, start, end, section, LineCurve{}, true, true};
}

Member rod(const std::string& id, const std::string& start, const std::string& end,
           const std::string& section, Reaction reaction) {
  Member out{id, start, end, section, LineCurve{}};
  out.reaction = reaction;
  return out;
}

Spring between(const std::string& id, const std::string& at, const std::string& to,
               std::optional<std::array<double, 2>> direction, double stiffness) {
  Spring out;
  out.id = id;
  out.at = at_node(at);
  out.to = at_node(to);
  out.direction = direction;
  out.stiffness = stiffness;
  return out;
}

const SpringState& spring_of(const State& state, const std::string& id) {
  return *std::find_if(state.springs.begin(), state.springs.end(),
                       [&id](const SpringState& spring) { return spring.id == id; });
}

double axial_force(const State& state, const std::string& id) {
  const MemberState& member = member_of(state, id);
  for (const double force : member.axial_force) EXPECT_EQ(force, member.axial_force.front());
  for (const double force : member.shear_force) EXPECT_EQ(force, 0.0);
  for (const double moment : member.bending_moment) EXPECT_EQ(moment, 0.0);
  return member.axial_force.front();
}

/// Two columns that lean as rigid bars of height h under the load P each. A spring k joins their tops, and a
/// spring c holds the first one. With the deflections u, v of the tops the energy
/// c u^2 / 2 + k (u - v)^2 / 2 - P (u^2 + v^2) / (2 h) has the determinant (c + k - P/h)(k - P/h) - k^2.
TEST(SpringsBetweenNodes, LeaningColumnsShareTheirBracing) {
  constexpr double h = 2.0;
  for (const auto& [c, k] : {std::pair{3.0, 0.5}, std::pair{0.7, 2.0}, std::pair{1.0, 1e3}}) {
    Model model;
    model.nodes = {{"a", 0.0, 0.0}, {"A", 0.0, h}, {"b", 3.0, 0.0}, {"B", 3.0, h}};
    model.sections = {{"s", 1e6, 1e3, {}}};
    model.members = {{"one", "a", "A", "s", LineCurve{}}, {"other", "b", "B", "s", LineCurve{}}};
    model.supports = {support("a", "xy"), support("b", "xy")};
    Spring brace = between("brace", "A", "B", std::array{1.0, 0.0}, k);
    Spring held = brace;
    held.id = "held";
    held.to.reset();
    held.stiffness = c;
    model.springs = {brace, held};
    model.loads = {force_at(at_node("A"), 0.0, -1.0), force_at(at_node("B"), 0.0, -1.0)};
    const double sum = c + 2.0 * k;
    const double expected = 0.5 * h * (sum - std::sqrt(sum * sum - 4.0 * c * k));
    const Result result = solve_soundly(model, buckling_on(fixed_mesh(4, 4)));
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, expected, 1e-9, "linearised");
    Analysis path = analysis_of(AnalysisType::critical, fixed_mesh(4, 4));
    const Result followed = solve_soundly(model, path);
    ASSERT_TRUE(followed.summary.critical_load_factor);
    expect_relative(*followed.summary.critical_load_factor, expected, 1e-5, "shortened by P / EA");
  }
}

/// Two cantilevers, one above the other, that a one-sided spring of stiffness k joins when the gap between
/// their tips has closed. Stiffness of a tip: s = 3 EI / L^3.
TEST(SpringsBetweenNodes, AGapBetweenCantileversCloses) {
  constexpr double k = 8.0;
  constexpr double gap = 0.02;
  for (const bool swapped : {false, true}) {
    Model model;
    model.nodes = {{"a", 0.0, 0.0}, {"A", 1.0, 0.0}, {"b", 0.0, -0.5}, {"B", 1.0, -0.5}};
    model.sections = {{"s", 1e6, 1.0, {}}};
    model.members = {{"upper", "a", "A", "s", LineCurve{}}, {"lower", "b", "B", "s", LineCurve{}}};
    model.supports = {support("a", "xyr"), support("b", "xyr")};
    Spring pad = swapped ? between("pad", "B", "A", std::array{0.0, 2.0}, k)
                         : between("pad", "A", "B", std::array{0.0, -2.0}, k);
    pad.reaction = Reaction::compression_only;
    pad.gap = gap;
    model.springs = {pad};
    model.loads = {force_at(at_node("A"), 0.0, -1.0)};
    constexpr double s = 3.0;
    const Result result =
        solve_soundly(model, static_on(fixed_mesh(2, 4), Geometry::linear, {0.5 * s * gap, 4.0 * s * gap}));
    ASSERT_EQ(result.states.size(), 2U);
    EXPECT_EQ(spring_of(result.states[0], "pad").force, 0.0);
    EXPECT_NEAR(spring_of(result.states[0], "pad").displacement, 0.5 * gap, 1e-12);
    EXPECT_FALSE(spring_of(result.states[0], "pad").closed);
    const double force = 3.0 * gap / (2.0 / s + 1.0 / k);
    EXPECT_NEAR(spring_of(result.states[1], "pad").force, force, 1e-10);
    EXPECT_NEAR(spring_of(result.states[1], "pad").displacement, gap + force / k, 1e-10);
    EXPECT_TRUE(spring_of(result.states[1], "pad").closed);
    EXPECT_NEAR(member_of(result.states[1], "lower").v.back(), -force / s, 1e-10);
  }
}

/// A moment M at the end of a hinged beam, whose end a spring c joins to that of an equal one: with the
/// stiffness s = 3 EI / L of an end, (s + c) t - c r = M and (s + c) r - c t = 0.
TEST(SpringsBetweenNodes, RotationalOnesJoinRotations) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"A", 1.0, 0.0}, {"b", 2.0, 0.0}, {"B", 3.0, 0.0}};
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.members = {{"one", "a", "A", "s", LineCurve{}}, {"other", "b", "B", "s", LineCurve{}}};
  model.supports = {support("a", "xy"), support("A", "xy"), support("b", "xy"), support("B", "xy")};
  constexpr double s = 3.0;
  constexpr double c = 2.0;
  model.springs = {between("joint", "A", "b", {}, c)};
  model.loads = {force_at(at_node("A"), 0.0, 0.0, 0.1)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(1, 4), Geometry::linear));
  const double r = 0.1 * c / (s * (s + 2.0 * c));
  const double t = 0.1 * (s + c) / (s * (s + 2.0 * c));
  EXPECT_NEAR(member_of(result.states[0], "one").rotation.back(), t, 1e-12);
  EXPECT_NEAR(member_of(result.states[0], "other").rotation.front(), r, 1e-12);
  EXPECT_NEAR(spring_of(result.states[0], "joint").displacement, t - r, 1e-12);
  EXPECT_NEAR(spring_of(result.states[0], "joint").force, c * (t - r), 1e-12);
}

/// Opposite springs at one place are joined where they go to ground, not between nodes.
TEST(SpringsBetweenNodes, OppositeOnesAreNotTakenForSpringsToGround) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"A", 0.0, 1.0}, {"b", 1.0, 0.0}, {"B", 1.0, 1.0}};
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.members = {{"one", "a", "A", "s", LineCurve{}}, {"other", "b", "B", "s", LineCurve{}}};
  model.supports = {support("a", "xyr"), support("b", "xyr")};
  Spring push = between("push", "A", "B", std::array{1.0, 0.0}, 5.0);
  push.reaction = Reaction::compression_only;
  Spring back = push;
  back.id = "back";
  back.direction = {-1.0, 0.0};
  back.to.reset();
  model.springs = {push, back};
  model.loads = {force_at(at_node("A"), 1.0, 0.0)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(1, 4), Geometry::linear));
  // tip stiffness 3 beside 5 in series with 3
  EXPECT_NEAR(member_of(result.states[0], "one").u.back(), 1.0 / (3.0 + 1.0 / (1.0 / 5.0 + 1.0 / 3.0)),
              1e-10);
  EXPECT_EQ(spring_of(result.states[0], "back").force, 0.0);
}

/// A braced bay 6 wide and 4 high with rods as diagonals: F at the corner pulls the one and leaves the other
/// slack. T = F sqrt(52) / 6. Sway of the pulled corner: T^2 L / (F EA) of the diagonal, and F 4^3 / (36 EA)
/// of the post.
Model braced_bay() {
  Model model;
  model.nodes = {{"A", 0.0, 0.0}, {"B", 6.0, 0.0}, {"C", 6.0, 4.0}, {"D", 0.0, 4.0}};
  model.sections = {{"frame", 2e6, 1e5, {}}, {"brace", 4e4, 1.0, {}}};
  model.members = {bar("left", "A", "D", "frame"), rod("rising", "A", "C", "brace", Reaction::tension_only),
                   bar("beam", "D", "C", "frame"), rod("falling", "B", "D", "brace", Reaction::tension_only),
                   bar("right", "B", "C", "frame")};
  model.supports = {support("A", "xy"), support("B", "xy")};
  model.loads = {force_at(at_node("D"), 50.0, 0.0)};
  model.monitors = {{"sway", at_node("D"), Component::x}};
  return model;
}

TEST(Rods, ABracedBayHasOneDiagonalInTension) {
  Model model = braced_bay();
  const double length = std::sqrt(52.0);
  const double T = 50.0 * length / 6.0;
  Result result = solve_soundly(model, static_on({}, Geometry::linear, {1.0, -1.0}));
  ASSERT_EQ(result.states.size(), 2U);
  EXPECT_NEAR(T, 60.0925, 5e-5);
  EXPECT_NEAR(axial_force(result.states[0], "rising"), T, 1e-9);
  EXPECT_EQ(axial_force(result.states[0], "falling"), 0.0);
  const double sway = T * T * length / (50.0 * 4e4) + 50.0 * 64.0 / (36.0 * 2e6) + 50.0 * 6.0 / 2e6;
  EXPECT_NEAR(sway, 0.0132145, 5e-8);
  EXPECT_NEAR(member_of(result.states[0], "left").u.back(), sway, 1e-12);
  EXPECT_EQ(axial_force(result.states[1], "rising"), 0.0);
  EXPECT_NEAR(axial_force(result.states[1], "falling"), T, 1e-9);
  EXPECT_EQ(result.states[0].members[1].id, "rising") << "in the order of the request";
  EXPECT_EQ(result.states[0].members[3].id, "falling");
  EXPECT_NEAR(result.states[0].members[1].s.back(), length, 1e-14);
  // the same with props in place of ties
  for (Member& member : model.members)
    if (is_rod(member)) member.reaction = Reaction::compression_only;
  result = solve_soundly(model, static_on({}, Geometry::linear));
  EXPECT_NEAR(axial_force(result.states[0], "falling"), -T, 1e-9);
  EXPECT_EQ(axial_force(result.states[0], "rising"), 0.0);
}

/// Large displacements: horizontal equilibrium of the deformed bay, whose bars turn.
TEST(Rods, ABracedBayIsInEquilibriumInItsDeformedShape) {
  const Model model = braced_bay();
  const Result result = solve_soundly(model, static_on({}, Geometry::nonlinear, {1.0, 40.0}));
  ASSERT_EQ(result.states.size(), 2U);
  EXPECT_NEAR(axial_force(result.states[0], "rising"), 60.0925, 0.2) << "small displacements";
  for (const State& state : result.states) {
    const MemberState& rising = member_of(state, "rising");
    const double l = std::hypot(rising.x.back() - rising.x.front(), rising.y.back() - rising.y.front());
    EXPECT_NEAR(axial_force(state, "rising"), 4e4 * (l / std::sqrt(52.0) - 1.0), 1e-7 * 4e4);
    EXPECT_EQ(axial_force(state, "falling"), 0.0);
    EXPECT_EQ(member_of(state, "right").x.back(), rising.x.back());
  }
}

/// Half of the weight of a rod acts at each of its nodes.
TEST(Rods, HaveWeight) {
  Model model = braced_bay();
  for (Section& section : model.sections) section.mass = 0.0;
  model.sections[1].mass = 3.0;
  model.loads.emplace_back(SelfWeight{{0.0, -10.0}, Pattern::constant});
  const Result result = solve_soundly(model, static_on({}, Geometry::linear));
  EXPECT_NEAR(result.states[0].loads.fy, -2.0 * 3.0 * 10.0 * std::sqrt(52.0), 1e-9);
  EXPECT_NEAR(axial_force(result.states[0], "rising"), 50.0 * std::sqrt(52.0) / 6.0, 1e-9);
  const double post = -15.0 * std::sqrt(52.0);
  EXPECT_NEAR(member_of(result.states[0], "left").axial_force[0], post, 1e-6);
}

/// Von Mises's truss of half span b and height h: F = 2 EA z (1 / l - 1 / l0) at the apex, z its height and l
/// the length of a bar; limit points at l^3 = b^2 l0.
void expect_snap_through(Model model, const std::string& what) {
  constexpr double b = 1.0;
  constexpr double h = 0.3;
  constexpr double EA = 50.0;
  model.nodes.insert(model.nodes.begin(), {{"a", -b, 0.0}, {"b", b, 0.0}, {"apex", 0.0, h}});
  model.sections = {{"s", EA, 20.0, {}}};
  model.supports.insert(model.supports.end(), {support("a", "xy"), support("b", "xy")});
  model.loads = {force_at(at_node("apex"), 0.0, -1.0)};
  model.monitors = {{"apex", at_node("apex"), Component::y}};
  const double l0 = std::hypot(b, h);
  const double l = std::cbrt(b * b * l0);
  const double z = std::sqrt(l * l - b * b);
  const double expected = 2.0 * EA * z * (1.0 / l - 1.0 / l0);
  Analysis analysis = path_on(fixed_mesh(2, 4), 2);
  analysis.output.states = StateOutput::critical;
  const Result result = solve_soundly(model, analysis);
  const std::vector<CriticalPoint> limits = limits_of(result);
  ASSERT_EQ(limits.size(), 2U) << what;
  expect_relative(limits[0].load_factor, expected, 1e-8, what);
  expect_relative(limits[1].load_factor, -expected, 1e-8, what);
  ASSERT_FALSE(result.states.empty()) << what;
  EXPECT_NEAR(member_of(result.states[0], "left").y.back(), z, 1e-5) << what;
  EXPECT_NEAR(axial_force(result.states[0], "left"), EA * (l / l0 - 1.0), 1e-5) << what;
}

TEST(Rods, AShallowTrussOfARodAndABarSnapsThrough) {
  Model model;
  model.members = {rod("left", "a", "apex", "s", Reaction::compression_only), bar("right", "apex", "b", "s")};
  expect_snap_through(model, "a rod and a bar");
}

/// Only rods reach the apex.
TEST(Rods, AShallowTrussOfTwoRodsSnapsThrough) {
  Model model;
  model.members = {rod("left", "a", "apex", "s", Reaction::compression_only), bar("between", "a", "b", "s"),
                   rod("right", "b", "apex", "s", Reaction::compression_only)};
  expect_snap_through(model, "two rods");
}

/// A mast of height h on a hinge under the load P and e P across it, held by a stay from its top to a
/// distance a behind its foot. With the angle t from the vertical the stay has the length l^2 = L^2 + 2 a h
/// sin t, and P = EA a cos t (1 / L - 1 / l) / (sin t + e cos t).
Model mast(double EA, double e) {
  Model model;
  model.nodes = {{"foot", 0.0, 0.0}, {"top", 0.0, 2.0}, {"anchor", -1.5, 0.0}};
  model.sections = {{"mast", 1e9, 1e5, {}}, {"stay", EA, 1.0, {}}};
  model.members = {rod("stay", "anchor", "top", "stay", Reaction::tension_only),
                   {"mast", "foot", "top", "mast", LineCurve{}}};
  model.supports = {support("foot", "xy"), support("anchor", "xy")};
  model.loads = {force_at(at_node("top"), e, -1.0)};
  model.monitors = {{"top", at_node("top"), Component::x}};
  return model;
}

/// Largest value of a function with one maximum (golden section search).
double largest(double lo, double hi, const std::function<double(double)>& f) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 100; ++i) {
    const double left = hi - golden * (hi - lo);
    const double right = lo + golden * (hi - lo);
    (f(left) > f(right) ? hi : lo) = f(left) > f(right) ? right : left;
  }
  return f(0.5 * (lo + hi));
}

double mast_limit(double EA, double e) {
  constexpr double a = 1.5;
  constexpr double h = 2.0;
  constexpr double L = 2.5;
  return largest(1e-3, 1.4, [&](double t) {
    const double l = std::sqrt(L * L + 2.0 * a * h * std::sin(t));
    return EA * a * std::cos(t) * (1.0 / L - 1.0 / l) / (std::sin(t) + e * std::cos(t));
  });
}

TEST(Rods, AStayedMastFallsAtItsLimitLoad) {
  for (const double e : {0.01, 0.1}) {
    const Model model = mast(10.0, e);
    Analysis analysis = path_on(fixed_mesh(2, 4), 1);
    analysis.sensitivities = {
        {"/model/sections/1/EA", 10.0, 10.0, [&](double EA) -> std::optional<Model> { return mast(EA, e); }}};
    const Result result = solve_soundly(model, analysis);
    ASSERT_EQ(result.critical_points.size(), 1U);
    const double expected = mast_limit(10.0, e);
    expect_relative(result.critical_points[0].load_factor, expected, 1e-6, "limit");
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_NE(result.warnings[0].detail.find("in member \"stay\""), std::string::npos)
        << "strain of the stay";
    ASSERT_EQ(result.critical_points[0].sensitivities.size(), 1U);
    ASSERT_TRUE(result.critical_points[0].sensitivities[0].derivative);
    expect_relative(*result.critical_points[0].sensitivities[0].derivative, expected / 10.0, 1e-5, "by EA");
  }
}

/// A constant force H across the top tightens the stay to N = H L / a. Stiffness of the top:
/// EA a^2 / L^3 + N h^2 / L^3 - (P + N h / L) / h, zero at P = a^2 h (EA - N) / L^3.
TEST(Rods, LinearisedBucklingHasTheForceOfAStay) {
  Model model = mast(10.0, 0.0);
  constexpr double N = 0.8;
  model.loads.emplace_back(PointLoad{at_node("top"), {N * 1.5 / 2.5, 0.0}, 0.0, Pattern::constant});
  const double expected = 1.5 * 1.5 * 2.0 * (10.0 - N) / (2.5 * 2.5 * 2.5);
  const Result result = solve_soundly(model, buckling_on(fixed_mesh(2, 4)));
  ASSERT_TRUE(result.summary.critical_load_factor);
  expect_relative(*result.summary.critical_load_factor, expected, 1e-7, "a stay with a force");
  ASSERT_EQ(result.buckling->modes.size(), 1U);
  ASSERT_EQ(result.buckling->modes[0].members.size(), 2U);
  EXPECT_EQ(result.buckling->modes[0].members[0].id, "stay");
  EXPECT_NEAR(std::abs(result.buckling->modes[0].members[0].u.back()), 1.0, 1e-9);
}

/// A constant force slackens a cable, which the growing load pulls tight at the load factor 1: the path has a
/// kink there and no critical point. A spring c holds the end of the bar.
TEST(Rods, ASlackCableTightensWithoutACriticalPoint) {
  constexpr double c = 3.0;
  constexpr double EA = 40.0;
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 2.0, 0.0}, {"far", 10.0, 0.0}};
  model.sections = {{"s", 1e6, 10.0, {}}, {"cable", EA, 1.0, {}}};
  model.members = {{"bar", "b", "far", "s", LineCurve{}},
                   rod("cable", "a", "b", "cable", Reaction::tension_only)};
  model.supports = {support("a", "xy"), support("b", "y"), support("far", "y")};
  Spring held;
  held.id = "held";
  held.at = at_node("b");
  held.direction = {1.0, 0.0};
  held.stiffness = c;
  model.springs = {held};
  model.loads = {force_at(at_node("b"), 0.2, 0.0),
                 PointLoad{at_node("b"), {-0.2, 0.0}, 0.0, Pattern::constant}};
  model.monitors = {{"b", at_node("b"), Component::x}};
  Analysis analysis = analysis_of(AnalysisType::path, fixed_mesh(1, 3));
  analysis.stop.load_factor = {-1.0, 4.0};
  analysis.output.states = StateOutput::at_load_factors;
  analysis.output.at_load_factors = {0.5, 2.0, 3.0};
  const Result result = solve_soundly(model, analysis);
  EXPECT_TRUE(result.critical_points.empty());
  ASSERT_EQ(result.states.size(), 3U);
  const auto moved = [&](std::size_t i) { return member_of(result.states[i], "bar").u.front(); };
  EXPECT_NEAR(moved(0), -0.1 / c, 1e-9);
  EXPECT_NEAR(moved(1), 0.2 / (c + EA / 2.0), 1e-9);
  EXPECT_NEAR(moved(2), 0.4 / (c + EA / 2.0), 1e-9);
  EXPECT_EQ(axial_force(result.states[0], "cable"), 0.0);
  EXPECT_NEAR(axial_force(result.states[2], "cable"), 0.4 * (EA / 2.0) / (c + EA / 2.0), 1e-9);
}

/// What cannot be is refused, with the field and what to do.
TEST(Links, AreRefusedWhereTheyCannotBe) {
  const auto refused = [](const Model& model, const std::string& pointer, const std::string& code) {
    const auto findings = check(model, static_on({}, Geometry::linear));
    const bool found = std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
      return finding.pointer == pointer && finding.code == code;
    });
    EXPECT_TRUE(found) << pointer << " " << code << (findings.empty() ? "" : ", got " + findings[0].pointer);
  };
  Model model = braced_bay();
  model.members[1].curve = SineCurve{0.1, 1};
  refused(model, "/model/members/1/curve", "not_supported");
  model = braced_bay();
  model.members[1].release_start_rotation = true;
  EXPECT_TRUE(check(model, static_on({}, Geometry::linear)).empty()) << "a hinge is there anyway";
  model.members[1].release_start_stiffness = 3.0;
  refused(model, "/model/members/1/release/start/rotation", "not_supported");
  model = braced_bay();
  model.loads.emplace_back(DistributedLoad{"rising", {0.0, -1.0}});
  refused(model, "/model/loads/1/member", "not_supported");
  model.loads[1] = force_at(at_member("rising", 0.5), 1.0, 0.0);
  refused(model, "/model/loads/1/at/member", "not_supported");
  model.loads[1] = InitialStrain{"rising", 0.01, 0.0};
  refused(model, "/model/loads/1/member", "not_supported");
  model = braced_bay();
  model.foundations = {winkler("falling", 1.0)};
  refused(model, "/model/foundations/0/member", "not_supported");
  model = braced_bay();
  model.imperfections = {SineImperfection{"falling", 1, 0.01}};
  refused(model, "/model/imperfections/0/member", "not_supported");
  model = braced_bay();
  model.monitors = {{"m", at_member("rising", 0.0), Component::x}};
  refused(model, "/model/monitors/0/at/member", "not_supported");
  model = braced_bay();
  model.springs = {between("k", "A", "D", std::array{1.0, 0.0}, 1.0)};
  model.springs[0].to = at_member("left", 1.0);
  refused(model, "/model/springs/0/to", "not_supported");
  model.springs[0].to = at_node("A");
  refused(model, "/model/springs/0/to", "ambiguous");
  model.springs[0] = between("k", "A", "D", {}, 1.0);
  refused(model, "/model/springs/0/to", "needs_member");
}

/// Without its braces the bay is a mechanism, which the loads drive; rods alone may hold it.
TEST(Rods, HoldWhatWouldMove) {
  Model model = braced_bay();
  EXPECT_TRUE(check(model, static_on({}, Geometry::linear)).empty());
  std::erase_if(model.members, is_rod);
  const auto findings = check(model, static_on({}, Geometry::linear));
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].code, "mechanism");
  // one tie holds one sense of the load only
  model = braced_bay();
  model.members.erase(model.members.begin() + 3);
  const Result result = solve(model, static_on({}, Geometry::linear, {1.0, -1.0}));
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "not_held");
  ASSERT_EQ(result.states.size(), 1U);
  EXPECT_NEAR(axial_force(result.states[0], "rising"), 60.0925, 1e-4);
}

}  // namespace
}  // namespace snapthrough
