/// Slender structures in stiff one-sided surroundings, followed through the onset of contact.
///
/// Sources. The clamped column between elastic walls: small deflections, with contact over a patch of unknown
/// width in the middle, where w'''' + P w'' + K (w - g) = 0; the states of the half are written in closed
/// form (ElasticPatch, below), and stability is lost in the antisymmetric motion for which those equations
/// without g have a solution. For K -> infinity the load tends to 16 pi^2, where the column lies down on its
/// wall. The encased ring: Glock's limit load of a thin ring in a rigid host, p = E / (1 - nu^2) (t / D)^2.2
/// (Der Stahlbau 46, 1977), which is a fit with an exponent of two digits.
#include <Eigen/LU>
#include <complex>
#include <optional>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Half of a clamped column of length 1 with EI = 1 that is pressed to a wall of stiffness K at unit
/// distance, over a patch of half width x about the middle.
class ElasticPatch {
 public:
  explicit ElasticPatch(double K) : K_(K) {}

  /// Vanishes where the antisymmetric motion has no stiffness.
  [[nodiscard]] double antisymmetric(double P) const {
    const double x = half_width(P);
    return motions(P, x, false).determinant();
  }

 private:
  using Derivatives = Eigen::Vector4d;  // of order 0 to 3

  /// cos(k s) - 1 and sin(k s) - k s: deflections of the free part, clamped at s = 0.
  static std::array<Derivatives, 2> free_part(double k, double s) {
    const double c = std::cos(k * s);
    const double d = std::sin(k * s);
    return {Derivatives(c - 1.0, -k * d, -k * k * c, k * k * k * d),
            Derivatives(d - k * s, k * c - k, -k * k * d, -k * k * k * c)};
  }
  /// Real and imaginary part of cosh(z t) or sinh(z t), z^4 + P z^2 + K = 0, t from the middle.
  [[nodiscard]] std::array<Derivatives, 2> patch(double P, double t, bool even) const {
    const auto z = std::sqrt(std::complex<double>(-0.5 * P, std::sqrt(K_ - 0.25 * P * P)));
    std::array<Derivatives, 2> out;
    std::complex<double> factor = 1.0;
    for (int n = 0; n < 4; ++n, factor *= z) {
      const auto value = factor * ((n % 2 == 0) == even ? std::cosh(z * t) : std::sinh(z * t));
      out[0][n] = value.real();
      out[1][n] = value.imag();
    }
    return out;
  }
  /// Columns: free part, then the patch with the opposite sign; rows scaled to be of one size.
  [[nodiscard]] Eigen::Matrix4d motions(double P, double x, bool even) const {
    const auto left = free_part(std::sqrt(P), 0.5 - x);
    const auto right = patch(P, -x, even);
    Eigen::Matrix4d m;
    m << left[0], left[1], -right[0], -right[1];
    const Eigen::Vector4d sizes = m.cwiseAbs().rowwise().maxCoeff();
    return sizes.cwiseInverse().asDiagonal() * m;
  }
  /// Jump of the shear where deflection (that of the wall), slope and curvature are continuous.
  [[nodiscard]] double shear_jump(double P, double x) const {
    const auto left = free_part(std::sqrt(P), 0.5 - x);
    const auto right = patch(P, -x, true);
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    m.row(0) << left[0][0], left[1][0], 0.0, 0.0;
    m.row(1) << 0.0, 0.0, right[0][0], right[1][0];
    for (int n = 1; n < 3; ++n) m.row(1 + n) << left[0][n], left[1][n], -right[0][n], -right[1][n];
    const Eigen::Vector4d v = m.fullPivLu().solve(Eigen::Vector4d(1.0, 0.0, 0.0, 0.0));
    return v[0] * left[0][3] + v[1] * left[1][3] - v[2] * right[0][3] - v[3] * right[1][3];
  }
  [[nodiscard]] double half_width(double P) const {
    const double unit = std::pow(K_, -0.25);
    double low = 0.01 * unit;
    const double first = shear_jump(P, low);
    double high = low;
    while ((shear_jump(P, high) > 0.0) == (first > 0.0)) high += 0.01 * unit;
    low = high - 0.01 * unit;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((shear_jump(P, middle) > 0.0) == (first > 0.0) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  double K_;
};

double patch_load(double K) {
  const ElasticPatch column(K);
  double low = 120.0;
  double high = 157.85;
  const double first = column.antisymmetric(low);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((column.antisymmetric(middle) > 0.0) == (first > 0.0) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The offset, 1e-6 of the gap, chooses the wall.
Model confined_column(double K, double gap) {
  Model model = straight(1.0, 1.0, 1e9, "xyr", "yr");
  for (const double sign : {1.0, -1.0}) {
    Foundation wall = one_sided("m", K, sign > 0.0 ? Side::left : Side::right);
    wall.id = sign > 0.0 ? "upper" : "lower";
    wall.direction = std::array{0.0, sign};
    wall.gap = gap;
    model.foundations.push_back(wall);
  }
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  model.imperfections = {SineImperfection{"m", 1, 1e-6 * gap}};
  return model;
}

/// Slopes of 3e-3 change loads by 1e-5, an offset that is 1e-6 of the gap by 6e-5 (in proportion: ten times
/// the offset, ten times that).
TEST(ConfinedColumn, LosesStabilityAsOnAnElasticPatch) {
  for (const double K : {1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}) {
    Discretization mesh;
    mesh.accuracy = 1e-6;
    Analysis analysis = path_on(mesh, 1);
    analysis.stop = {};
    analysis.stop.load_factor = std::array{0.0, 165.0};
    analysis.stop.steps = 3000;
    const Result result = solve_soundly(confined_column(K, 1e-3), analysis);
    ASSERT_TRUE(result.summary.critical_load_factor) << K;
    expect_relative(*result.summary.critical_load_factor, patch_load(K), 1e-4, "K " + std::to_string(K));
    EXPECT_EQ(result.summary.critical_type, CriticalType::bifurcation) << K;
  }
}

/// Half of a ring, R = EI = 1, in a host of great stiffness, which a small force lifts off at the crown.
/// @param host its stiffness
Model encased_ring(double diameter_by_thickness, std::optional<double> host = {}) {
  const double EA = 3.0 * diameter_by_thickness * diameter_by_thickness;
  Model model;
  model.nodes = {{"bottom", 0.0, -1.0}, {"crown", 0.0, 1.0}};
  model.sections = {{"s", EA, 1.0, {}}};
  model.members = {{"ring", "bottom", "crown", "s", ArcCurve{180.0}, false, false}};
  model.supports = {support("bottom", "xr"), support("crown", "xr")};
  model.foundations = {one_sided("ring", host.value_or(1e4 * std::pow(EA, 0.8)), Side::right)};
  PointLoad lift = force_at(at_node("crown"), 0.0, -1e-3 * std::pow(EA, 0.4) / 30.0);
  lift.pattern = Pattern::constant;
  model.loads = {PressureLoad{"ring", 1.0, Side::right, Pattern::proportional}, lift};
  return model;
}

/// Beyond the load at which the ring, detached, would buckle (3), on to where it snaps away from its host.
TEST(EncasedRing, ReachesGlocksLoad) {
  for (const double ratio : {50.0, 100.0, 200.0}) {
    Discretization mesh;
    mesh.accuracy = 1e-4;
    Analysis analysis = path_on(mesh, 1);
    analysis.stop.steps = 3000;
    const Result result = solve_soundly(encased_ring(ratio), analysis);
    const auto limits = limits_of(result);
    ASSERT_EQ(limits.size(), 1u) << ratio;
    const double glock = 12.0 * std::pow(ratio, -2.2) * std::pow(0.5 * ratio, 3);
    expect_relative(limits[0].load_factor, glock, 0.03, "D/t " + std::to_string(ratio));
  }
}

/// A detached ring touches its host along a patch as wide as the host's own length (EI / K)^(1/4), which the
/// stiffest host of this test makes 1/300 of the radius; the limit load tends to that in a rigid host.
TEST(EncasedRing, ReachesALimitAsItsHostStiffens) {
  std::vector<double> loads;
  for (const double host : {1e7, 1e8, 1e9, 1e10}) {
    Discretization mesh;
    mesh.accuracy = 1e-6;
    Analysis analysis = path_on(mesh, 1);
    analysis.stop.steps = 3000;
    const Result result = solve_soundly(encased_ring(50.0, host), analysis);
    const auto limits = limits_of(result);
    ASSERT_EQ(limits.size(), 1u) << host;
    loads.push_back(limits[0].load_factor);
  }
  const double least = std::sqrt(10.0);  // fall of what remains, even if that goes as the length's square
  for (std::size_t i = 2; i < loads.size(); ++i) {
    EXPECT_GT(loads[i], loads[i - 1]);
    EXPECT_LT(least * (loads[i] - loads[i - 1]), loads[i - 1] - loads[i - 2]);
  }
  expect_relative(loads.back(), 12.0 * std::pow(50.0, -2.2) * std::pow(25.0, 3), 0.03, "Glock");
}

/// On a host of 1e12 the converged limit load (741 elements, which resolve the patch) is 35.0768836, and
/// hosts that are stiffer still are within 1e-6 of it.
TEST(EncasedRing, CostsNoMoreInAStifferHost) {
  constexpr double kRigid = 35.0768836;
  int in_soft_host = 0;
  for (const double host : {1e6, 1e8, 1e10, 1e12, 1e14, 1e16}) {
    Discretization mesh;
    mesh.accuracy = 1e-3;
    Analysis analysis = path_on(mesh, 1);
    const Result result = solve_soundly(encased_ring(50.0, host), analysis);
    const auto limits = limits_of(result);
    ASSERT_EQ(limits.size(), 1u) << host;
    if (in_soft_host == 0) in_soft_host = result.diagnostics.factorizations;
    EXPECT_LE(result.diagnostics.factorizations, 3 * in_soft_host) << host;
    if (host < 1e12) continue;
    ASSERT_TRUE(limits[0].error_estimate.has_value()) << host;
    EXPECT_LE(std::abs(limits[0].load_factor / kRigid - 1.0), *limits[0].error_estimate + 1e-6) << host;
    EXPECT_LE(*limits[0].error_estimate, 1e-3) << host;
    const auto& skipped = result.diagnostics.skipped;
    EXPECT_TRUE(std::any_of(skipped.begin(), skipped.end(), [](const std::string& what) {
      return what.find("stiffness beyond") != std::string::npos;
    })) << host;
  }
}

}  // namespace
}  // namespace snapthrough
