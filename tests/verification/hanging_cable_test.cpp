/// Cables that hang in elastic catenaries, against reference values of nine digits, and against the equations
/// of end forces (H. M. Irvine, Cable Structures, 1981, section 1.3) in structures.
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "tests/findings.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// End forces of a cable whose weight acts down: H to the right and V upwards on its start.
struct EndForces {
  double H = 0.0;
  double V = 0.0;
};

/// By the forces T at both ends of a cable of the weight W:  T0^2 - T1^2 = 2 V W - W^2.
EndForces end_forces(const MemberState& cable, double W) {
  const double first = cable.axial_force.front();
  const double last = cable.axial_force.back();
  EndForces out;
  out.V = 0.5 * ((first * first - last * last) / W + W);
  out.H = std::sqrt(first * first - out.V * out.V) * (cable.x.back() >= cable.x.front() ? 1.0 : -1.0);
  return out;
}

/// Vector from the start to the end of a cable, by Irvine's closed forms; y upwards.
std::array<double, 2> irvine(const EndForces& at, double EA, double L, double w) {
  const double H = std::abs(at.H);
  const double top = at.V / H;
  const double foot = (at.V - w * L) / H;
  const double x = H * L / EA + H / w * (std::asinh(top) - std::asinh(foot));
  const double down = L / EA * (at.V - 0.5 * w * L) + H / w * (std::hypot(1.0, top) - std::hypot(1.0, foot));
  return {std::copysign(x, at.H), -down};
}

Member cable(const std::string& id, const std::string& start, const std::string& end, double length,
             const std::string& section = "rope") {
  Member out{id, start, end, section, LineCurve{}};
  out.reaction = Reaction::tension_only;
  out.cable = true;
  out.pretension.emplace();
  out.pretension->unstressed_length = length;
  return out;
}

Section rope(double EA, double mass) {
  Section out{"rope", EA, 1.0, {}};
  out.mass = mass;
  return out;
}

SelfWeight weight() { return {{0.0, -1.0}, Pattern::constant}; }

/// A rope between two places.
Model one_rope(std::array<double, 2> to, double EA, double length, double w) {
  Model out;
  out.nodes = {{"a", 0.0, 0.0}, {"b", to[0], to[1]}};
  out.sections = {rope(EA, w)};
  out.members = {cable("rope", "a", "b", length)};
  out.supports = {support("a", "xy"), support("b", "xy")};
  out.loads = {weight()};
  return out;
}

State state_of(const Model& model, double accuracy = 1e-8) {
  const Result result = solve_soundly(model, static_on(accurate(accuracy), Geometry::nonlinear));
  EXPECT_EQ(result.states.size(), 1U);
  return result.states.at(0);
}

/// A rope as long as its span, of EA = 5000; reference values by the elastic catenary, which another program
/// solved.
TEST(HangingCable, RopeAsLongAsItsSpan) {
  const State state = state_of(one_rope({20.0, 0.0}, 5000.0, 20.0, 1.2));
  const MemberState& rope = member_of(state, "rope");
  EXPECT_NEAR(rope.extremes.axial_force.min.value, 48.8900559, 5e-8);
  EXPECT_NEAR(rope.extremes.axial_force.min.s, 10.0, 1e-9);
  const std::size_t middle = rope.s.size() / 2;
  ASSERT_DOUBLE_EQ(rope.s[middle], 10.0);
  EXPECT_NEAR(rope.y[middle], -1.22129626, 5e-9);
  EXPECT_NEAR(rope.y0[middle], -1.22129626, 5e-9);
  EXPECT_NEAR(rope.extremes.displacement.value, 0.0, 1e-14);
}

/// A mooring line of 1000 m between places 800 m and 100 m apart.
TEST(HangingCable, MooringLine) {
  const State state = state_of(one_rope({800.0, 100.0}, 64e9, 1000.0, 1962.0));
  const EndForces forces = end_forces(member_of(state, "rope"), 1962e3);
  EXPECT_NEAR(forces.H, 671447.44, 5e-3);
  EXPECT_NEAR(std::abs(forces.V - 1962e3), 1100067.36, 5e-3);
  EXPECT_NEAR(forces.V, 861932.64, 5e-3);
}

/// A carrier rope with a carriage, against two catenaries (tests/verification/data/ropeway.py).
TEST(HangingCable, RopewayWithACarriage) {
  struct Case {
    double share;
    double load;
    double H;
    double depth;
  };
  for (const Case& one :
       {Case{0.5, 0.0, 13.037021424, 12.475970874}, Case{0.5, 10.0, 44.941750325, 14.756830575},
        Case{0.25, 10.0, 39.284410776, 12.487087850}}) {
    Model model = one_rope({200.0, 0.0}, 44000.0, 202.0, 0.0033 * 9.81);
    model.nodes.push_back({"carriage", 200.0 * one.share, -1.0});
    model.members = {cable("left", "a", "carriage", 202.0 * one.share),
                     cable("right", "carriage", "b", 202.0 * (1.0 - one.share))};
    model.loads.emplace_back(force_at(at_node("carriage"), 0.0, -one.load));
    const State state = state_of(model);
    const MemberState& left = member_of(state, "left");
    EXPECT_NEAR(end_forces(left, 0.0033 * 9.81 * 202.0 * one.share).H, one.H, 1e-8) << one.load;
    EXPECT_NEAR(left.y.back(), -one.depth, 1e-8) << one.load;
  }
}

/// Heat makes a rope that is longer, lighter and stiffer by the same share; heat that grows does so by its
/// load factor.
TEST(HangingCable, Temperature) {
  constexpr double strain = 1.2e-5 * 60.0;
  const Model longer =
      one_rope({20.0, 1.0}, 5000.0 * (1.0 + strain), 20.5 * (1.0 + strain), 1.2 / (1.0 + strain));
  const MemberState expected = member_of(state_of(longer), "rope");
  for (const Pattern pattern : {Pattern::constant, Pattern::proportional}) {
    Model model = one_rope({20.0, 1.0}, 5000.0, 20.5, 1.2);
    model.sections[0].expansion = 1.2e-5;
    TemperatureLoad heat{"rope", 60.0};
    heat.pattern = pattern;
    model.loads.emplace_back(heat);
    const MemberState rope = member_of(state_of(model), "rope");
    for (std::size_t i = 0; i < rope.s.size(); ++i) {
      EXPECT_NEAR(rope.y[i], expected.y[i], 1e-12);
      EXPECT_NEAR(rope.axial_force[i], expected.axial_force[i], 1e-11);
    }
  }
}

/// A rod lengthens by its mean change of temperature; both kinds of heat and a pretension add.
TEST(HangingCable, HeatedRod) {
  Model model = one_rope({10.0, 0.0}, 2000.0, 10.0, 1.0);
  model.loads.clear();
  model.members[0].cable = false;
  model.members[0].pretension->unstressed_length = 9.99;
  model.sections[0].expansion = 1e-5;
  TemperatureLoad cold{"rope", 0.0};
  cold.change_along = {{0.0, -10.0}, {1.0, -30.0}};
  TemperatureLoad heat{"rope", 15.0};
  heat.pattern = Pattern::constant;
  model.loads = {cold, heat};
  const Result result = solve_soundly(model, static_on(accurate(1e-8), Geometry::nonlinear, {0.0, 1.0, 2.0}));
  ASSERT_EQ(result.states.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double strain = 1e-5 * (15.0 - 20.0 * static_cast<double>(i));
    EXPECT_NEAR(member_of(result.states[i], "rope").axial_force[0], 2000.0 * (10.0 / 9.99 - 1.0 - strain),
                1e-9);
  }
}

/// Each cable has the end forces that Irvine's equations ask for, and the forces at free nodes are in
/// balance.
void expect_balance(const Model& model, const std::string& what) {
  const State state = state_of(model);
  const double EA = model.sections[0].EA.constant;
  const double w = model.sections[0].mass->constant;
  std::map<std::string, std::array<double, 2>> sums;
  double largest = 0.0;
  for (const Member& member : model.members) {
    const MemberState& rope = member_of(state, member.id);
    const double L = *member.pretension->unstressed_length;
    const EndForces at = end_forces(rope, w * L);
    const auto chord = irvine(at, EA, L, w);
    // H by the end forces has half of the digits of a steep cable's
    EXPECT_NEAR(chord[0], rope.x.back() - rope.x.front(), 1e-6 * L) << what << ", " << member.id;
    EXPECT_NEAR(chord[1], rope.y.back() - rope.y.front(), 1e-6 * L) << what << ", " << member.id;
    sums[member.start][0] += at.H;
    sums[member.start][1] -= at.V;
    sums[member.end][0] -= at.H;
    sums[member.end][1] += at.V - w * L;
    largest = std::max(largest, rope.extremes.axial_force.max.value);
  }
  for (const Load& load : model.loads)
    if (const auto* point = std::get_if<PointLoad>(&load))
      for (std::size_t c = 0; c < 2; ++c) sums[point->at.node][c] += point->force[c];
  for (const Support& held : model.supports) sums.erase(held.node);
  for (const auto& [node, sum] : sums) {
    EXPECT_NEAR(sum[0], 0.0, 1e-6 * largest) << what << ", node " << node;
    EXPECT_NEAR(sum[1], 0.0, 1e-6 * largest) << what << ", node " << node;
  }
}

/// Random structures of cables between supports and free nodes.
TEST(HangingCable, RandomNetsAreInBalance) {
  std::mt19937 random(5);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int seed = 0; seed < 120; ++seed) {
    Model model;
    const int columns = 2 + static_cast<int>(between(0.0, 4.0));
    const double w = std::pow(10.0, between(-2.0, 1.0));
    const double EA = w * std::pow(10.0, between(2.0, 5.0));
    model.sections = {rope(EA, w)};
    model.loads = {weight()};
    for (int i = 0; i <= columns; ++i) {
      const std::string id = std::to_string(i);
      model.nodes.push_back({id, 4.0 * i + between(-1.0, 1.0), between(-2.0, 2.0)});
      if (i == 0 || i == columns) model.supports.push_back(support(id, "xy"));
      if (i > 0) model.members.push_back(cable("span " + id, std::to_string(i - 1), id, between(3.5, 8.0)));
      if (i > 0 && i < columns && between(0.0, 1.0) < 0.7)
        model.loads.emplace_back(force_at(at_node(id), between(-3.0, 3.0) * w, between(-20.0, 0.0) * w));
      if (i > 0 && i < columns && between(0.0, 1.0) < 0.3) {
        model.nodes.push_back({"tie " + id, model.nodes.back().x + between(-1.0, 1.0), -9.0});
        model.supports.push_back(support("tie " + id, "xy"));
        model.members.push_back(cable("tie " + id, "tie " + id, id, between(6.0, 12.0)));
      }
    }
    expect_balance(model, "seed " + std::to_string(seed));
  }
}

/// Pairs of cables, slack and taut, drawn near and far from where they hang: each has a state.
TEST(HangingCable, RandomPairsHaveAState) {
  std::mt19937 random(9);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int seed = 0; seed < 250; ++seed) {
    const double span = std::pow(10.0, between(0.0, 2.0));
    const double w = std::pow(10.0, between(-1.0, 2.0));
    Model model;
    model.nodes = {
        {"a", 0.0, 0.0}, {"b", span * between(0.1, 2.0), span * between(-1.0, 0.5)}, {"c", 3.0 * span, 0.0}};
    model.sections = {rope(w * span * std::pow(10.0, between(1.0, 5.0)), w)};
    model.members = {cable("left", "a", "b", span * between(1.4, 3.0)),
                     cable("right", "b", "c", span * between(1.5, 3.0))};
    model.supports = {support("a", "xy"), support("c", "xy")};
    model.loads = {weight(),
                   force_at(at_node("b"), w * span * between(-1.0, 1.0), -w * span * between(0.0, 10.0))};
    expect_balance(model, "pair " + std::to_string(seed));
  }
}

/// Horizontal force of a guy on the head of a mast at (u, v) from its drawn place, and the downward one, with
/// the weight, by bisection for H and V in Irvine's equations.
EndForces guy_at(double dx, double dy, double EA, double L, double w) {
  double H = EA * 1e-3;
  double V = 0.5 * w * L;
  for (int i = 0; i < 200; ++i) {  // Newton's method with differences
    const auto at = irvine({H, V}, EA, L, w);
    const double h = 1e-6 * H;
    const auto by_H = irvine({H + h, V}, EA, L, w);
    const auto by_V = irvine({H, V + h}, EA, L, w);
    const double a = (by_H[0] - at[0]) / h;
    const double b = (by_V[0] - at[0]) / h;
    const double c = (by_H[1] - at[1]) / h;
    const double d = (by_V[1] - at[1]) / h;
    const double rx = dx - at[0];
    const double ry = dy - at[1];
    const double det = a * d - b * c;
    double step_H = (d * rx - b * ry) / det;
    const double step_V = (a * ry - c * rx) / det;
    const double share = step_H < -0.5 * H ? -0.5 * H / step_H : 1.0;
    H += share * step_H;
    V += share * step_V;
    if (std::abs(step_H) + std::abs(step_V) < 1e-14 * (H + std::abs(V))) break;
  }
  return {H, V};
}

/// A hinged rigid mast with a sagging guy to each side buckles sideways where the work of the load and of the
/// guys' downward forces, h (P + Q), meets the stiffness of the guys against the head, h^2 K.
TEST(HangingCable, BucklingOfAGuyedMast) {
  constexpr double h = 12.0;
  constexpr double a = 9.0;
  constexpr double EA = 5000.0;
  constexpr double w = 0.4;
  constexpr double L = 15.02;
  Model model;
  model.nodes = {
      {"foot", 0.0, 0.0}, {"head", 0.0, h}, {"left", -a, 0.0}, {"right", a, 0.0}, {"stub", 0.0, h + 1.0}};
  Section mast{"mast", std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), {}};
  mast.mass = 0.0;
  Section stub{"stub", std::numeric_limits<double>::infinity(), 1000.0, {}};
  stub.mass = 0.0;
  model.sections = {mast, rope(EA, w), stub};
  model.members = {{"mast", "foot", "head", "mast", LineCurve{}},
                   {"stub", "head", "stub", "stub", LineCurve{}},
                   cable("left", "left", "head", L),
                   cable("right", "right", "head", L)};
  model.supports = {support("foot", "xy"), support("left", "xy"), support("right", "xy")};
  model.loads = {weight(), force_at(at_node("head"), 0.0, -1.0)};
  Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-8));
  const Result result = solve_soundly(model, analysis);
  ASSERT_FALSE(result.critical_points.empty());
  // force of both guys to the right on a head displaced by u, as it turns about the foot
  const auto pull = [&](double u) {
    const double v = std::sqrt(h * h - u * u);
    return guy_at(a - u, -v, EA, L, w).H - guy_at(a + u, -v, EA, L, w).H;
  };
  constexpr double step = 1e-3;
  const double K =
      -(8.0 * (pull(step) - pull(-step)) - (pull(2.0 * step) - pull(-2.0 * step))) / (12.0 * step);
  const double Q = 2.0 * guy_at(a, -h, EA, L, w).V;
  EXPECT_NEAR(result.critical_points[0].load_factor / (h * K - Q), 1.0, 1e-7);
}

std::vector<Finding> findings_of(const Model& model, const Analysis& analysis) {
  return check(model, analysis);
}

TEST(HangingCable, FieldsThatDoNotFit) {
  const Analysis statics = static_on(accurate(1e-4), Geometry::nonlinear);
  Model model = one_rope({20.0, 0.0}, 5000.0, 20.0, 1.2);
  EXPECT_TRUE(findings_of(model, statics).empty());
  const auto expect = [&](const Model& changed, const Analysis& analysis, const std::string& pointer,
                          const std::string& code) {
    const auto found = findings_of(changed, analysis);
    ASSERT_FALSE(found.empty()) << pointer;
    EXPECT_EQ(found[0].pointer, pointer);
    EXPECT_EQ(found[0].code, code);
  };
  Model changed = model;
  changed.loads.clear();
  expect(changed, statics, "/model/members/0/cable", "no_weight");
  changed = model;
  std::get<SelfWeight>(changed.loads[0]).pattern = Pattern::proportional;
  expect(changed, statics, "/model/members/0/cable", "not_supported");
  changed = model;
  changed.members[0].reaction = Reaction::compression_only;
  expect(changed, statics, "/model/members/0/reaction", "not_supported");
  changed = model;
  changed.members[0].pretension = Pretension{5.0, {}};
  expect(changed, statics, "/model/members/0/pretension/force", "not_supported");
  changed = model;
  changed.sections[0].mass = 0.0;
  expect(changed, statics, "/model/members/0/section", "no_weight");
  changed = model;
  changed.sections[0].expansion = 1e-5;
  TemperatureLoad heat{"rope", 0.0, 3.0};
  changed.loads.emplace_back(heat);
  expect(changed, statics, "/model/loads/1/gradient", "not_supported");
  expect(model, static_on(accurate(1e-4), Geometry::linear), "/analysis/geometry", "unsupported");
}

}  // namespace
}  // namespace snapthrough
