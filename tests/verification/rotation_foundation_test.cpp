/// Foundations that resist the rotation of a member's sections, against closed forms.
#include <functional>
#include <limits>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

Foundation against_rotation(const std::string& member, double stiffness) {
  Foundation out = winkler(member, stiffness);
  out.id = "turning";
  out.component = FoundationComponent::rotation;
  return out;
}

/// With w = sin(q x), q = n pi / L, and the rotation w', the energy
/// EI w''^2 / 2 + k w'^2 / 2 + K w^2 / 2 - P w'^2 / 2 gives P = EI q^2 + K / q^2 + k.
TEST(RotationFoundation, BucklingLoadOfABeamOnBothFoundations) {
  constexpr double EI = 7.0;
  constexpr double K = 112.0;
  constexpr double k = 5.0;
  const double best = std::pow(K / EI, 0.25);
  for (const double waves : {1.0, 3.0, 5.4}) {
    const double L = waves * kPi / best;
    Model model = straight(L, EI, kRigid, "xy", "y");
    model.foundations = {winkler("m", K), against_rotation("m", k)};
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    double expected = kRigid;
    for (int n = 1; n < 12; ++n) {
      const double q = n * kPi / L;
      expected = std::min(expected, EI * q * q + K / (q * q) + k);
    }
    if (waves == 3.0) expect_relative(expected, 2.0 * std::sqrt(K * EI) + k, 1e-14, "long beam");
    const Result linear = solve_soundly(model, buckling_on(accurate(1e-10)));
    ASSERT_TRUE(linear.summary.critical_load_factor) << waves;
    expect_relative(*linear.summary.critical_load_factor, expected, 1e-9, "linearised");
    const Result path = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-10)));
    ASSERT_TRUE(path.summary.critical_load_factor) << waves;
    EXPECT_EQ(path.summary.critical_type, CriticalType::bifurcation);
    expect_relative(*path.summary.critical_load_factor, expected, 1e-9, "path");
  }
}

/// A clamped bar of length L under the force P at its tip, which is directed against its axis but for the
/// angle beta. With the moment per length m(t) = c tanh(k t / c) of the foundation at the rotation t, and its
/// integral W, EI t'' = m(t) - P sin(t + beta); the tip turns by a where
/// EI t'^2 / 2 = W(t) - W(a) + P (cos(t + beta) - cos(a + beta)).
struct TurningBar {
  double EI, k, c, beta, tip;

  [[nodiscard]] double moment(double t) const { return c * std::tanh(k * t / c); }
  [[nodiscard]] double work(double t) const { return c * c / k * std::log(std::cosh(k * t / c)); }
  [[nodiscard]] double half_square(double P, double t) const {
    return work(t) - work(tip) + P * (std::cos(t + beta) - std::cos(tip + beta));
  }
  /// Length at which the force P turns the tip by `tip`: the integral of dt / t', t = tip (1 - u^2), by the
  /// midpoint rule with Richardson's extrapolation.
  [[nodiscard]] double length(double P) const {
    const auto rule = [&](int n) {
      double sum = 0.0;
      for (int i = 0; i < n; ++i) {
        const double u = (i + 0.5) / n;
        sum += 2.0 * tip * u / std::sqrt(2.0 / EI * half_square(P, tip * (1.0 - u * u))) / n;
      }
      return sum;
    };
    const double a = rule(1000);
    const double b = rule(2000);
    const double d = rule(4000);
    const double once = b + (b - a) / 3.0;
    const double twice = d + (d - b) / 3.0;
    return twice + (twice - once) / 15.0;
  }
  /// Force at which a bar of length L turns its tip by `tip`.
  [[nodiscard]] double force(double L) const {
    double lo = (work(tip)) / (std::cos(beta) - std::cos(tip + beta)) * (1.0 + 1e-9);
    double hi = 1e4;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (lo + hi);
      (length(middle) > L ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
  }
};

TEST(RotationFoundation, ElasticaOnALaw) {
  constexpr double L = 1.0;
  for (const TurningBar& bar : {TurningBar{2.0, 3.0, 0.8, 0.3, 0.4}, TurningBar{2.0, 3.0, 0.8, 0.3, 1.4},
                                TurningBar{1.0, 20.0, 4.0, 1.0, 0.7}}) {
    const double P = bar.force(L);
    Model model = straight(L, bar.EI, kRigid, "xyr", "");
    Foundation base = against_rotation("m", 0.0);
    base.law.emplace();
    base.law->type = ReactionLaw::Type::tanh;
    base.law->stiffness = bar.k;
    base.law->capacity = bar.c;
    model.foundations = {base};
    model.loads = {force_at(at_node("b"), -P * std::cos(bar.beta), P * std::sin(bar.beta))};
    const Result result = solve_soundly(model, static_on(accurate(1e-10), Geometry::nonlinear));
    ASSERT_EQ(result.states.size(), 1U);
    const State& state = result.states[0];
    EXPECT_NEAR(state.members[0].rotation.back(), bar.tip, 1e-8 * bar.tip);
    const double clamped = std::sqrt(2.0 * bar.EI * bar.half_square(P, 0.0));
    EXPECT_NEAR(std::abs(state.members[0].bending_moment.front()), clamped, 1e-8 * clamped);
    EXPECT_NEAR(state.members[0].bending_moment.back(), 0.0, 1e-8 * clamped);
    const FoundationState& reaction = state.foundations.at(0);
    EXPECT_NEAR(reaction.displacement.back(), bar.tip, 1e-8 * bar.tip);
    EXPECT_NEAR(reaction.reaction.back(), bar.moment(bar.tip), 1e-8 * bar.moment(bar.tip));
  }
}

/// On linear springs, the section moment between the ends follows from the force and the reactions:
/// M(s) = integral from s to L of (P sin(t + beta) - m(t)), here of a cantilever under a transverse force in
/// linear geometry: EI t'' = k t - P, t(0) = 0, t'(L) = 0.
TEST(RotationFoundation, SectionMomentsBetweenTheEnds) {
  constexpr double EI = 2.0;
  constexpr double k = 50.0;
  constexpr double P = 3.0;
  constexpr double L = 1.5;
  Model model = straight(L, EI, 1e3, "xyr", "");
  model.foundations = {against_rotation("m", k)};
  model.loads = {force_at(at_node("b"), 0.0, P)};
  for (const Discretization& mesh : {accurate(1e-9), fixed_mesh(20, 6)}) {
    const Result result = solve_soundly(model, static_on(mesh, Geometry::linear));
    const MemberState& member = result.states.at(0).members.at(0);
    const double a = std::sqrt(k / EI);
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      const double s = member.s[i];
      const double turned = P / k * (1.0 - std::cosh(a * (L - s)) / std::cosh(a * L));
      const double moment = EI * P / k * a * std::sinh(a * (L - s)) / std::cosh(a * L);
      EXPECT_NEAR(member.rotation[i], turned, 1e-9) << s;
      EXPECT_NEAR(std::abs(member.bending_moment[i]), moment, 1e-8) << s;
    }
  }
}

/// A bar on a hinge turns when the moment at its end is as large as what the foundation can resist, c per
/// length on its whole length L, however long another member of the model is.
TEST(RotationFoundation, LimitMomentOfABar) {
  constexpr double L = 1.5;
  constexpr double c = 0.4;
  Model model = straight(L, 50.0, 1e4, "xy", "");
  model.nodes.push_back({"c", 0.0, -4.0});
  model.nodes.push_back({"d", 6.0, -4.0});
  model.members.push_back({"other", "c", "d", "s", LineCurve{}});
  model.supports.push_back(support("c", "xyr"));
  Foundation base = against_rotation("m", 0.0);
  base.law.emplace();
  base.law->type = ReactionLaw::Type::tanh;
  base.law->stiffness = 3.0;
  base.law->capacity = c;
  model.foundations = {base};
  model.loads = {force_at(at_node("b"), 0.0, 0.0, 1.0)};
  const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, accurate(1e-6)));
  EXPECT_EQ(result.summary.critical_type, CriticalType::capacity);
  ASSERT_TRUE(result.summary.critical_load_factor);
  expect_relative(*result.summary.critical_load_factor, c * L, 1e-9, "limit moment");
}

/// A rotational foundation holds no displacement: a bar on one alone floats away.
TEST(RotationFoundation, HoldsNoDisplacement) {
  Model model = straight(1.0, 1.0, 1e3, "", "");
  model.foundations = {against_rotation("m", 1.0)};
  model.loads = {force_at(at_node("b"), 0.0, 1.0)};
  const std::vector<Finding> findings = check(model, static_on(fixed_mesh(2, 4), Geometry::linear));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].code, "mechanism");
  model.supports = {support("a", "xy")};
  const Result result = solve_soundly(model, static_on(fixed_mesh(4, 5), Geometry::linear));
  EXPECT_FALSE(result.states.empty()) << "the foundation holds the bar against turning about its hinge";
}

}  // namespace
}  // namespace snapthrough
