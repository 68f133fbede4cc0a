/// Sections whose curvature is a curve of the bending moment, against closed forms and quadrature of this
/// file.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/element/bending_curve.h"
#include "solver/numeric/gauss_rule.h"
#include "tests/verification/cases.h"
#include "tests/verification/root.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kRigid = std::numeric_limits<double>::infinity();

/// k = (M + a M0 (M / M0)^n) / EI with its integral by M.
struct Power {
  double EI = 1.0;
  double M0 = 1.0;
  double n = 3.0;
  double a = 1.0;
  [[nodiscard]] double curvature(double M) const { return (M + a * M0 * std::pow(M / M0, n)) / EI; }
  [[nodiscard]] double energy(double M) const {
    return (0.5 * M * M + a * M0 * M0 * std::pow(M / M0, n + 1.0) / (n + 1.0)) / EI;
  }
};

BendingLaw law_of(const Power& power) {
  BendingLaw law;
  law.type = BendingLaw::Type::ramberg_osgood;
  law.moment = power.M0;
  law.exponent = power.n;
  law.coefficient = power.a;
  return law;
}

/// Moment EI k up to Mp, and a line of slope `slope` EI beyond.
BendingLaw bilinear(double EI, double Mp, double slope) {
  BendingLaw law;
  law.interpolation = Interpolation::linear;
  law.points = {{Mp / EI, Mp}, {2.0 * Mp / EI, (1.0 + slope) * Mp}};
  return law;
}

/// Integral by Gauss points on 40 equal parts.
double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr int kParts = 40;
  const Quadrature rule = gauss_legendre(10);
  const double width = (to - from) / kParts;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i)
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      sum += width * rule.weights[q] * f(from + width * (i + rule.points[q]));
  return sum;
}

/// Inextensible cantilever (EI = 1, length 1) along x with the moment `M` on its end.
TEST(BendingLaw, EndMomentBendsACircle) {
  const Power power{1.0, 0.5, 5.0, 0.4};
  Model model = straight(1.0, 1.0, kRigid, "xyr", "");
  model.sections[0].bending = law_of(power);
  model.loads = {force_at(at_node("b"), 0.0, 0.0, 1.0)};
  const Result result =
      solve_soundly(model, static_on(fixed_mesh(2, 5), Geometry::nonlinear, {0.1, -0.5, 0.8}));
  ASSERT_EQ(result.states.size(), 3u);
  for (const State& state : result.states) {
    const double M = state.load_factor;
    const double k = std::copysign(power.curvature(std::abs(M)), M);
    const MemberState& m = state.members.at(0);
    EXPECT_NEAR(m.rotation.back(), k, 1e-11) << M;
    EXPECT_NEAR(m.v.back(), (1.0 - std::cos(k)) / k, 1e-7) << M;  // order 5 on two elements
  }
}

/// Inextensible cantilever (length 1) along x with the dead force P along y on its end: with E(M) the
/// integral of k by M, E(M) + P sin t is constant along it, and ds = -dM / (P cos t).
struct Cantilever {
  double moment = 0.0;  ///< at the clamp
  double turn = 0.0;    ///< at the end
  double x = 0.0;       ///< position of the end
  double y = 0.0;
};

Cantilever cantilever(const Power& power, double P) {
  const auto sine = [&](double moment, double M) { return (power.energy(moment) - power.energy(M)) / P; };
  const auto along = [&](double moment, const std::function<double(double)>& f) {
    return integral(
        [&](double M) {
          const double s = sine(moment, M);
          return f(s) / (P * std::sqrt(1.0 - s * s));
        },
        0.0, moment);
  };
  // the largest moment for which the end does not turn beyond a right angle, less a little
  const double most = root([&](double M) { return power.energy(M) / P - 0.999; }, 0.0, 100.0 * P);
  Cantilever out;
  out.moment = root([&](double M) { return along(M, [](double) { return 1.0; }) - 1.0; }, 1e-9, most);
  out.turn = std::asin(power.energy(out.moment) / P);
  out.x = out.moment / P;
  out.y = along(out.moment, [](double s) { return s; });
  return out;
}

TEST(BendingLaw, ElasticaOfACantilever) {
  for (const Power& power :
       {Power{1.0, 0.6, 3.0, 1.0}, Power{1.0, 0.8, 7.0, 0.5}, Power{2.0, 1.0, 2.0, 0.7}}) {
    Model model = straight(1.0, power.EI, kRigid, "xyr", "");
    model.sections[0].bending = law_of(power);
    model.loads = {force_at(at_node("b"), 0.0, 1.0)};
    for (const bool chosen : {false, true}) {
      const Discretization mesh = chosen ? accurate(1e-10) : fixed_mesh(16, 7);
      const Result result = solve_soundly(model, static_on(mesh, Geometry::nonlinear, {0.3, 0.8, 1.1}));
      ASSERT_EQ(result.states.size(), 3u);
      for (const State& state : result.states) {
        const Cantilever expected = cantilever(power, state.load_factor);
        const std::string what = std::to_string(power.n) + " at " + std::to_string(state.load_factor);
        const MemberState& m = state.members.at(0);
        EXPECT_NEAR(m.rotation.back(), expected.turn, 1e-9) << what;
        EXPECT_NEAR(1.0 + m.u.back(), expected.x, 1e-9) << what;
        EXPECT_NEAR(m.v.back(), expected.y, 1e-9) << what;
        EXPECT_NEAR(std::abs(m.bending_moment.front()), expected.moment, 1e-9) << what;
      }
    }
  }
}

/// A table of straight lines on a cantilever with the force P along y on its end, small displacements: the
/// moment P (1 - s) is known, and v(1) is the integral of k (1 - s).
TEST(BendingLaw, TableOfStraightLines) {
  const std::vector<std::array<double, 2>> points{{0.5, 1.0}, {1.5, 1.6}, {4.0, 1.9}};
  const auto curvature = [&](double M) {
    std::array<double, 2> from{0.0, 0.0};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& to = points[i];
      if (M < to[1] || i + 1 == points.size())
        return from[0] + (to[0] - from[0]) * (M - from[1]) / (to[1] - from[1]);
      from = to;
    }
    return 0.0;
  };
  Model model = straight(1.0, 2.0, 1e6, "xyr", "");
  BendingLaw law;
  law.interpolation = Interpolation::linear;
  law.points = points;
  model.sections[0].bending = law;
  model.loads = {force_at(at_node("b"), 0.0, 1.0)};
  const Result result = solve_soundly(model, static_on(accurate(1e-7), Geometry::linear, {0.9, 1.5, 2.5}));
  ASSERT_EQ(result.states.size(), 3u);
  for (const State& state : result.states) {
    const double P = state.load_factor;
    // integrals between the places of the kinks are exact
    std::vector<double> at{0.0};
    for (auto point = points.rbegin(); point != points.rend(); ++point)
      if (const double s = 1.0 - (*point)[1] / P; s > 0.0) at.push_back(s);
    at.push_back(1.0);
    double expected = 0.0;
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      expected += integral([&](double s) { return curvature(P * (1.0 - s)) * (1.0 - s); }, at[i], at[i + 1]);
    expect_relative(state.members.at(0).v.back(), expected, 1e-6, std::to_string(P));
  }
}

/// The cubic of a table passes its points, with the end moment as the only action.
TEST(BendingLaw, TablesPassTheirPoints) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::monotone_cubic}) {
    BendingLaw law;
    law.interpolation = interpolation;
    law.points = {{0.1, 1.0}, {0.25, 1.8}, {0.9, 2.2}};
    Model model = straight(1.0, 1.0, 1e6, "xyr", "");
    model.sections[0].bending = law;
    model.sections[0].EI = initial_slope(law);
    model.loads = {force_at(at_node("b"), 0.0, 0.0, 1.0)};
    // forces are rounding here, so that their sum is no measure
    const Result result =
        solve(model, static_on(fixed_mesh(1, 3), Geometry::linear, {1.0, 1.8, 2.2, -1.8, -2.6}));
    ASSERT_EQ(result.states.size(), 5u);
    const auto turn = [&](std::size_t i) { return result.states[i].members.at(0).rotation.back(); };
    EXPECT_NEAR(turn(0), 0.1, 1e-12);
    EXPECT_NEAR(turn(1), 0.25, 1e-12);
    EXPECT_NEAR(turn(2), 0.9, 1e-12);
    EXPECT_NEAR(turn(3), -0.25, 1e-12);
    EXPECT_LT(turn(4), -0.9);
  }
}

/// The straight column buckles at pi^2 EI / L^2 with EI the slope without moment. Beyond it, with the mode
/// t = q cos(pi s / L) and k = M / EI + c M^3, P / P1 = 1 + q^2 / 8 - 3/4 c EI^3 (pi / L)^2 q^2.
TEST(BendingLaw, ColumnBeyondItsEulerLoad) {
  for (const double M0 : {100.0, 12.0, 4.0}) {
    Model model = straight(1.0, 1.0, kRigid, "xy", "y");
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    const auto critical_of = [&](bool by_law) {
      Model own = model;
      if (by_law) own.sections[0].bending = law_of({1.0, M0, 3.0, 1.0});
      Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-9));
      analysis.koiter = true;
      return solve_soundly(own, analysis).critical_points.at(0);
    };
    const CriticalPoint with = critical_of(true);
    const CriticalPoint without = critical_of(false);
    expect_relative(with.load_factor, kPi * kPi, 1e-9, "load");
    ASSERT_TRUE(with.koiter && with.koiter->b && without.koiter && without.koiter->b);
    const double c = 1.0 / (M0 * M0);
    const double expected = 1.0 - 6.0 * c * kPi * kPi;
    EXPECT_NEAR(*with.koiter->b / *without.koiter->b, expected, 1e-6 * std::abs(expected)) << M0;
    EXPECT_EQ(with.koiter->kind,
              expected > 0.0 ? BifurcationKind::stable_symmetric : BifurcationKind::unstable_symmetric);
  }
}

/// Inextensible column of length 1 between hinges under P with the eccentricity e at both ends: with t the
/// angle from the line of action, E(M) - P cos t is constant, dM/ds = P sin t, and t = 0 in the middle.
double load_at(const Power& power, double e, double middle) {
  const auto half = [&](double P) {
    const auto rate = [&](double u) {  // ds/du with M = middle - u^2
      if (u == 0.0) return 0.0;
      const double D = (power.energy(middle) - power.energy(middle - u * u)) / P;
      return 2.0 * u / (P * std::sqrt(D * (2.0 - D)));
    };
    return integral(rate, 0.0, std::sqrt(middle - P * e));
  };
  const double least = power.energy(middle) / 1.9;  // the ends have nearly turned round
  return root([&](double P) { return half(P) - 0.5; }, least, (1.0 - 1e-6) * middle / e);
}

/// Largest P over the moments in the middle.
double largest_load(const Power& power, double e) {
  double from = 0.1 * power.M0;
  double to = 1.2 * power.M0;
  while (to - from > 1e-5 * power.M0) {  // the load is stationary there
    const double a = from + (to - from) / 3.0;
    const double b = to - (to - from) / 3.0;
    if (load_at(power, e, a) < load_at(power, e, b))
      from = a;
    else
      to = b;
  }
  return load_at(power, e, 0.5 * (from + to));
}

/// A column that softens has a limit point, and its load a derivative by the moment of the law.
TEST(BendingLaw, LimitPointOfAColumnWithEccentricLoad) {
  constexpr double e = 0.02;
  const Power power{1.0, 1.0, 5.0, 0.6};
  const auto model_at = [&](double M0) {
    Model model = straight(1.0, 1.0, kRigid, "xy", "y");
    model.sections[0].bending = law_of({power.EI, M0, power.n, power.a});
    model.loads = {force_at(at_node("a"), 0.0, 0.0, e), force_at(at_node("b"), -1.0, 0.0, -e)};
    return model;
  };
  Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-9));
  Variation variation;
  variation.pointer = "moment";
  variation.value = variation.size = power.M0;
  variation.model_at = [&](double M0) { return std::optional(model_at(M0)); };
  analysis.sensitivities = {variation};
  const Result result = solve_soundly(model_at(power.M0), analysis);
  ASSERT_EQ(result.critical_points.size(), 1u);
  const CriticalPoint& point = result.critical_points[0];
  EXPECT_EQ(point.type, CriticalType::limit_max);
  expect_relative(point.load_factor, largest_load(power, e), 1e-8, "limit load");
  const auto limit = [&](double M0) { return largest_load({power.EI, M0, power.n, power.a}, e); };
  ASSERT_EQ(point.sensitivities.size(), 1u);
  expect_relative(*point.sensitivities[0].derivative, (limit(1.0 + 1e-3) - limit(1.0 - 1e-3)) / 2e-3, 1e-5,
                  "d limit load / d M0");
}

/// EI = 100 below a moment so small that the states of these tests are beyond it, and dM / dk = 1 there.
BendingLaw soft_at_once() {
  BendingLaw law;
  law.interpolation = Interpolation::linear;
  law.points = {{1e-8, 1e-6}, {10.00000001, 10.000001}};
  return law;
}

/// Cantilever with a constant force aside, that bends it, and a force that follows its end: damping takes the
/// stiffness at the origin, so that the law has a hundred times the damping of the section EI = 1.
TEST(BendingLaw, DampingHasTheStiffnessAtTheOrigin) {
  const auto flutter_load = [](bool by_law, double damper) {
    Model model = straight(1.0, 1.0, 1e6, "xyr", "");
    model.sections[0].mass = 1.0;
    if (by_law) {
      model.sections[0].bending = soft_at_once();
      model.sections[0].EI = initial_slope(soft_at_once());
    }
    PointLoad follower = force_at(at_node("b"), -1.0, 0.0);
    follower.follows = true;
    PointLoad aside = force_at(at_node("b"), 0.0, 0.05);
    aside.pattern = Pattern::constant;
    model.loads = {follower, aside};
    model.damping = {0.05, damper};
    const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, fixed_mesh(12, 4)));
    EXPECT_EQ(result.summary.critical_type, CriticalType::flutter);
    return result.summary.critical_load_factor.value_or(0.0);
  };
  const double expected = flutter_load(false, 1.0);
  // the moment is below 1e-6, where the law is stiff, on 2e-5 of the length
  expect_relative(flutter_load(true, 0.01), expected, 1e-3, "flutter load");
  EXPECT_GT(std::abs(flutter_load(false, 0.01) / expected - 1.0), 0.1);
}

/// An arch between two clamped columns buckles by itself, whether its EI or the slope of its law is 1.
TEST(BendingLaw, NamesTheMemberThatBuckles) {
  const auto member = [](bool by_law) {
    Model model;
    model.nodes = {{"d", -1.0, 0.0}, {"a", 0.0, 0.0}, {"c", 2.0, 0.0}, {"e", 3.0, 0.0}};
    model.sections = {{"A", 1e5, 1.0, {}}, {"B", 1e5, 40.0, {}}};
    if (by_law) {
      model.sections[0].bending = soft_at_once();
      model.sections[0].EI = initial_slope(soft_at_once());
    }
    model.members = {{"arch", "c", "a", "A", ArcCurve{120.0}, false, false},
                     {"left", "d", "a", "B", LineCurve{}, false, false},
                     {"right", "c", "e", "B", LineCurve{}, false, false}};
    model.supports = {support("a", "xy"), support("c", "xy"), support("d", "xyr"), support("e", "xyr")};
    model.loads = {force_at(at_member("arch", 0.5), 0.0, -1.0)};
    const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, fixed_mesh(24, 4)));
    return result.critical_points.at(0).member.value_or("none");
  };
  EXPECT_EQ(member(false), "arch");
  EXPECT_EQ(member(true), "arch");
}

/// Portal with clamped feet, height and half span l = 1, and the load P on its corner and on its middle:
/// rigid-plastic theory has the loads 4 Mp / l of the beam, 4 Mp / l of the sway and 3 Mp / l of both
/// together. The axial stiffness is rigid and the displacements are small, so that the frame becomes that
/// mechanism as the slope beyond Mp goes to zero.
Model portal(double Mp, double slope) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 0.0, 1.0}, {"m", 1.0, 1.0}, {"c", 2.0, 1.0}, {"d", 2.0, 0.0}};
  Section section{"s", kRigid, 1.0, {}};
  section.bending = bilinear(1.0, Mp, slope);
  model.sections = {section};
  model.members = {{"ab", "a", "b", "s", LineCurve{}, false, false},
                   {"bm", "b", "m", "s", LineCurve{}, false, false},
                   {"mc", "m", "c", "s", LineCurve{}, false, false},
                   {"cd", "c", "d", "s", LineCurve{}, false, false}};
  model.supports = {support("a", "xyr"), support("d", "xyr")};
  model.loads = {force_at(at_node("b"), Mp, 0.0), force_at(at_node("m"), 0.0, -Mp)};
  model.monitors = {{"sway", at_node("b"), Component::x}};
  return model;
}

/// The same frame by its three redundants X, the moment and the forces on the foot d: M is linear along each
/// member, and the integrals of k m_i along the frame vanish for the moments m_i of each redundant.
class PortalByRedundants {
 public:
  PortalByRedundants(double Mp, double slope) : Mp_(Mp), slope_(slope) {}

  /// Load at which the corner has moved by `sway`.
  double load_at(double sway) {
    return root([&](double P) { return sway_at(P) - sway; }, 0.0, 8.0);
  }

 private:
  using Moments = std::array<double, 5>;  ///< at a, b, m, c, d
  static constexpr std::array<Moments, 3> kOwn{
      {{1.0, 1.0, 1.0, 1.0, 1.0}, {0.0, 1.0, 1.0, 1.0, 0.0}, {2.0, 2.0, 1.0, 0.0, 0.0}}};
  static constexpr Moments kSway{-1.0, 0.0, 0.0, 0.0, 0.0};  ///< of a unit force on the corner

  [[nodiscard]] double curvature(double M) const {
    const double a = std::abs(M);
    return std::copysign(a <= Mp_ ? a : Mp_ + (a - Mp_) / slope_, M);
  }
  [[nodiscard]] double softness(double M) const { return std::abs(M) <= Mp_ ? 1.0 : 1.0 / slope_; }
  [[nodiscard]] Moments moments(double P) const {
    Moments out{-2.0 * P * Mp_, -P * Mp_, 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t n = 0; n < 5; ++n) out[n] += X_[i] * kOwn[i][n];
    return out;
  }
  /// Integral along the frame of f(M) u v, exact for f linear between -Mp, Mp and beyond.
  template <class F>
  [[nodiscard]] double along(const Moments& M, const F& f, const Moments& u, const Moments& v) const {
    static const Quadrature rule = gauss_legendre(3);
    double sum = 0.0;
    for (std::size_t n = 0; n < 4; ++n) {
      const double rise = M[n + 1] - M[n];
      std::vector<double> at{0.0, 1.0};
      for (const double kink : {-Mp_, Mp_})
        if (const double t = (kink - M[n]) / rise; t > 0.0 && t < 1.0) at.push_back(t);
      std::sort(at.begin(), at.end());
      for (std::size_t i = 0; i + 1 < at.size(); ++i)
        for (std::size_t q = 0; q < rule.points.size(); ++q) {
          const double t = at[i] + (at[i + 1] - at[i]) * rule.points[q];
          const auto value = [&](const Moments& m) { return m[n] + t * (m[n + 1] - m[n]); };
          sum += (at[i + 1] - at[i]) * rule.weights[q] * f(M[n] + t * rise) * value(u) * value(v);
        }
    }
    return sum;
  }
  /// Finds the redundants at a load by Newton's method from those of the last one, in small steps of the
  /// load.
  double sway_at(double P) {
    constexpr Moments kOne{1.0, 1.0, 1.0, 1.0, 1.0};
    X_ = {0.0, 0.0, 0.0};
    constexpr int kSteps = 100;
    for (int step = 1; step <= kSteps; ++step)
      for (int i = 0; i < 50 && correct(P * step / kSteps) > 1e-14 * Mp_; ++i) {
      }
    return along(
        moments(P), [this](double m) { return curvature(m); }, kOne, kSway);
  }
  double correct(double P);

  double Mp_, slope_;
  std::array<double, 3> X_{};
};

/// Corrects the redundants at a load once. Returns the size of the correction.
double PortalByRedundants::correct(double P) {
  constexpr Moments kOne{1.0, 1.0, 1.0, 1.0, 1.0};
  const Moments M = moments(P);
  Eigen::Vector3d r;
  Eigen::Matrix3d F;
  for (std::size_t i = 0; i < 3; ++i) {
    r[static_cast<int>(i)] = along(
        M, [this](double m) { return curvature(m); }, kOne, kOwn[i]);
    for (std::size_t j = 0; j < 3; ++j)
      F(static_cast<int>(i), static_cast<int>(j)) = along(
          M, [this](double m) { return softness(m); }, kOwn[i], kOwn[j]);
  }
  const Eigen::Vector3d change = F.fullPivLu().solve(r);
  for (int i = 0; i < 3; ++i) X_[static_cast<std::size_t>(i)] -= change[i];
  return change.norm();
}

/// The excess over the load of the mechanism falls with the square root of the slope, because hinges of a
/// length l turn by about (M - Mp) l / (slope EI) with M - Mp proportional to l.
TEST(BendingLaw, FrameToItsMechanism) {
  constexpr double Mp = 1e-8;
  constexpr double kSway = 20.0 * Mp;
  std::vector<double> loads;
  for (const double slope : {1e-4, 1e-6, 1e-8}) {
    Analysis analysis = path_on(accurate(1e-5), 1);
    analysis.stop.monitor = MonitorRange{"sway", {-1.0, kSway}};
    const Result result = solve_soundly(portal(Mp, slope), analysis);
    ASSERT_FALSE(result.branches.empty());
    EXPECT_NEAR(result.branches[0].monitors.at(0).values.back(), kSway, 1e-9 * kSway);
    loads.push_back(result.branches[0].load_factor.back());
    expect_relative(loads.back(), PortalByRedundants(Mp, slope).load_at(kSway), 1e-5, std::to_string(slope));
  }
  expect_relative((10.0 * loads[2] - loads[1]) / 9.0, 3.0, 1e-4, "rigid-plastic theory");
}

}  // namespace
}  // namespace snapthrough
