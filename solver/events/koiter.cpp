#include "solver/events/koiter.h"

#include <cmath>

#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// Differences of second derivatives. Source: errors of truncation, of rounding and of the mesh.
struct KoiterLimits {
  static constexpr double longest = 2e-2;    ///< largest step, displacement gradient
  static constexpr double shorter = 0.25;    ///< ratio of successive steps
  static constexpr int most_steps = 4;       ///< steps at most
  static constexpr double settled = 1e-3;    ///< relative change between steps; the error is about its square
  static constexpr double symmetric = 1e-5;  ///< slope per load factor that counts as zero
};

/// n.F'''[n, n, n] from differences of n.F''[n, n], extrapolated; empty when not converged.
std::optional<double> third_derivative(const BorderedPoint& point) {
  const CriticalSolution& at = point.at();
  const VectorXd n = at.null.col(0);
  const auto second = [&](double e) {
    return point.works(point.problem().tangent_change(at.y + e * n, at.lambda, {n, 0.0}, n))[0];
  };
  const auto third = [&](double e) { return (second(e) - second(-e)) / (2.0 * e); };
  double e = KoiterLimits::longest;
  for (int step = 0; step < KoiterLimits::most_steps; ++step, e *= KoiterLimits::shorter) {
    const double coarse = third(e);
    const double fine = third(0.5 * e);
    const double rounding = Rounding::cancelled_sum * std::abs(at.lambda * at.B(0, 0)) / e;
    if (std::abs(fine - coarse) <= KoiterLimits::settled * std::abs(fine) + rounding)
      return (4.0 * fine - coarse) / 3.0;
  }
  return std::nullopt;
}

}  // namespace

std::optional<KoiterExpansion> koiter_expansion(const BorderedPoint& point, double along_path) {
  const CriticalSolution& at = point.at();
  const double A = at.A[0](0, 0);
  const double B = at.B(0, 0);
  const double C = at.C[0];
  const double root = B * B - A * C;
  if (!(root > 0.0)) return std::nullopt;
  // tangents (1, a) of both paths solve A a^2 + 2 B a + C = 0
  const double big = B + std::copysign(std::sqrt(root), B);
  double along = -C / big;
  if (A != 0.0 && std::abs(-big / A - along_path) < std::abs(along - along_path)) along = -big / A;
  const double rate = B + A * along;
  KoiterExpansion out{-A / (2.0 * rate), std::nullopt, 0.0};
  if (std::abs(out.slope) > KoiterLimits::symmetric * std::abs(at.lambda)) return out;
  out.slope = 0.0;
  const auto third = third_derivative(point);
  if (!third) return out;
  const VectorXd n = at.null.col(0);
  const VectorXd bent = point.response(point.held(-0.5 * point.tangent_change_along(n, n)));
  out.stiffening = point.works(point.tangent_change_along(bent, n))[0] + *third / 6.0;
  out.curvature = -out.stiffening / rate;
  return out;
}

}  // namespace snapthrough
