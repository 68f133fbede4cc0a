/// Post-buckling that gathers at one place: a strut on a soft base, and a column that lies down on a wall.
///
/// Sources. The strut: G. Hunt, M. Wadee, N. Shiacolas, Localized elasticae for the strut on the linear
/// foundation, J. Appl. Mech. 60 (1993) 1033. With EI = K = 1 the energy is int (th'^2 + w^2) / 2 - P (1 -
/// cos th), w' = sin th; its average over the waves w = A(x) cos x, with d = 2 - P, is int d A^2 / 4 + A'^2 -
/// A^4 / 32 to leading order. Its two solutions are the periodic one, A^2 = 4 d, and the localised one, A =
/// sqrt(8 d) sech(sqrt(d) x / 2). Half of the strut is shortened by d X / 2 in the first and by 4 sqrt(d) in
/// the second. The column: G. Domokos, P. Holmes, B. Royce, Constrained Euler buckling, J. Nonlinear Sci. 7
/// (1997) 281.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

StartState start_of(const State& state) {
  StartState start;
  start.load_factor = state.load_factor;
  for (const MemberState& m : state.members)
    start.members.push_back(
        {m.id, m.s, m.u, m.v, m.rotation, m.axial_force, m.shear_force, m.bending_moment});
  return start;
}

/// Half of a strut that is 300 long, which a force of 1e-5 pushes aside in its middle, at x = 0.
TEST(LocalisedStrut, HasTheShapeAndTheShorteningOfItsAmplitudeEquation) {
  constexpr double X = 150.0;
  constexpr double EA = 1e6;
  Model model = straight(X, 1.0, EA, "xr", "y");
  model.foundations = {winkler("m", 1.0)};
  PointLoad push = force_at(at_node("a"), 0.0, 1e-5);
  push.pattern = Pattern::constant;
  model.loads = {force_at(at_node("b"), -1.0, 0.0), push};
  model.monitors = {{"middle", at_node("a"), Component::y}};
  Analysis analysis = path_on(accurate(1e-6), 1);
  analysis.stop = {};
  analysis.stop.monitor = MonitorRange{"middle", {-1.0, 1.2}};
  analysis.stop.steps = 500;
  analysis.output.states = StateOutput::at_load_factors;
  analysis.output.at_load_factors = {1.8, 1.95, 1.975};
  const Result result = solve_soundly(model, analysis);
  ASSERT_FALSE(limits_of(result).empty());
  // twice the square root of EI K
  expect_relative(limits_of(result)[0].load_factor, 2.0, 1e-4, "largest load");
  std::vector<double> amplitude;
  std::vector<double> shortening;
  for (const State& state : result.states) {
    const MemberState& m = state.members[0];
    if (m.v.front() < 0.1) continue;  // before the largest load
    const double d = 2.0 - state.load_factor;
    const double bent = -m.u.back() - state.load_factor * X / EA;
    amplitude.push_back(m.v.front() / std::sqrt(8.0 * d));
    shortening.push_back(bent / (4.0 * std::sqrt(d)));
    EXPECT_LT(state.load_factor, 2.0 - 2.0 * bent / X) << "the periodic path carries more";
  }
  ASSERT_EQ(amplitude.size(), 3U);
  // in the order of the path: d = 0.025, 0.05 and 0.2; what remains goes with d
  EXPECT_NEAR(2.0 * amplitude[0] - amplitude[1], 1.0, 1e-3);
  EXPECT_NEAR(2.0 * shortening[0] - shortening[1], 1.0, 3e-3);
  EXPECT_NEAR(amplitude[0], 1.0, 0.02);
  EXPECT_NEAR(shortening[0], 1.0, 0.02);
}

/// Half of a clamped column of length 1 whose middle lies on a wall at the distance 1e-3. Its free parts have
/// the length l = 2 pi / sqrt(P) and the shape w = g (k x - sin k x) / (2 pi).
class ColumnOnAWall {
 public:
  explicit ColumnOnAWall(double K) : model_(straight(0.5, 1.0, 1e9, "xyr", "r")) {
    Foundation wall = one_sided("m", K, Side::left);
    wall.direction = std::array{0.0, 1.0};
    wall.gap = kGap;
    model_.foundations = {wall};
    model_.loads = {force_at(at_node("b"), -1.0, 0.0)};
  }

  static StartState on_a_rigid_wall(double P) {
    const double k = std::sqrt(P);
    const double g = kGap / (2.0 * kPi);
    MemberShape m;
    m.id = "m";
    for (int i = 0; i <= 400; ++i) {
      const double x = 0.5 * i / 400;
      const double a = std::min(k * x, 2.0 * kPi);
      const bool is_free = k * x < 2.0 * kPi;
      m.s.push_back(x);
      m.u.push_back(0.0);
      m.v.push_back(g * (a - std::sin(a)));
      m.rotation.push_back(g * k * (1.0 - std::cos(a)));
      m.axial.push_back(-P);
      m.shear.push_back(is_free ? -g * k * k * k : 0.0);
      m.bend.push_back(g * k * k * std::sin(a));
    }
    return {P, {m}};
  }

  /// Limit point in a sense from a state, in units of pi^2 EI / L^2; leaves a state at the load 300 in
  /// `start`.
  double limit(double direction, StartState& start) const {
    Analysis analysis = path_on(accurate(1e-6), 1);
    analysis.start = start;
    analysis.step.direction = direction;
    analysis.output.states = StateOutput::at_load_factors;
    analysis.output.at_load_factors = {300.0};
    const Result result = solve_soundly(model_, analysis);
    if (direction > 0.0 && !result.states.empty()) start = start_of(result.states[0]);
    const std::vector<CriticalPoint> limits = limits_of(result);
    return limits.empty() ? 0.0 : limits[0].load_factor / (kPi * kPi);
  }

 private:
  static constexpr double kGap = 1e-3;
  Model model_;
};

/// Limit for K -> infinity of three values with 10 K, 100 K: the errors go as K^(-1/4) and K^(-1/2).
double in_rigid_limit(const std::array<double, 3>& values) {
  const double q = std::pow(10.0, -0.25);
  const double first = (values[1] - q * values[0]) / (1.0 - q);
  const double second = (values[2] - q * values[1]) / (1.0 - q);
  return (second - q * q * first) / (1.0 - q * q);
}

/// The column touches at 4 pi^2 and lies flat from 16 pi^2 on; the flat part is a clamped column of the
/// length 1 - 4 pi / k, which buckles away from the wall at 36 pi^2.
TEST(ColumnOnAWall, LiesFlatFrom16To36) {
  Model free = straight(0.5, 1.0, 1e9, "xyr", "r");
  free.loads = {force_at(at_node("b"), -1.0, 0.0)};
  const Result first = solve_soundly(free, buckling_on(accurate(1e-8)));
  expect_relative(first.summary.critical_load_factor.value_or(0.0), 4.0 * kPi * kPi, 1e-7, "first contact");
  std::array<double, 3> most{};
  std::array<double, 3> least{};
  StartState start = ColumnOnAWall::on_a_rigid_wall(250.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const ColumnOnAWall column(std::pow(10.0, 7.0 + static_cast<double>(i)));
    most[i] = column.limit(1.0, start);
    least[i] = column.limit(-1.0, start);
    EXPECT_GT(most[i], i == 0 ? 33.0 : most[i - 1]);
    EXPECT_LT(least[i], i == 0 ? 18.5 : least[i - 1]);
  }
  expect_relative(in_rigid_limit(most), 36.0, 3e-4, "the flat part buckles");
  expect_relative(in_rigid_limit(least), 16.0, 1e-3, "line contact begins");
}

}  // namespace
}  // namespace snapthrough
