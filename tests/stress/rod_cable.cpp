#include "tests/stress/rod_cable.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/stress/rod_rule.h"

namespace snapthrough::testing {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

struct Reach {
  Vector2d chord = Vector2d::Zero();
  Matrix2d by_force = Matrix2d::Zero();
};

/// Integrates x' = T/|T| (1 + lengthening/length) + T/EA with T = force - weight t, t from the middle, on
/// pieces that halve towards the place of least tension.
Reach reach_of(const HangingBar& cable, const Vector2d& force, double lengthening) {
  constexpr int kPieces = 48;
  const double half = 0.5 * cable.length;
  const double stretch = 1.0 + lengthening / cable.length;
  const double least = std::clamp(force.dot(cable.weight) / cable.weight.squaredNorm(), -half, half);
  static const Rule rule = gauss(12);
  Reach out;
  for (const double end : {-half, half}) {
    double far = end;
    for (int k = 0; k < kPieces; ++k) {
      const double near = k + 1 == kPieces ? least : 0.5 * (far + least);
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const double share = std::abs(near - far) * rule.weights[q];
        const Vector2d tension = force - cable.weight * (far + (near - far) * rule.points[q]);
        const double size = tension.norm();
        if (!(size > 0.0)) continue;
        const Vector2d along = tension / size;
        out.chord += share * (stretch * along + tension / cable.EA);
        out.by_force += share * (stretch / size * (Matrix2d::Identity() - along * along.transpose()) +
                                 Matrix2d::Identity() / cable.EA);
      }
      far = near;
    }
  }
  return out;
}

}  // namespace

/// Newton's method from a force along the chord. A step is halved while its end is as far beyond the least
/// energy along it, by nine tenths of the slope, as its beginning is before it.
BarPull pull_of(const HangingBar& cable, const Vector2d& chord, double lengthening) {
  const double weight = cable.length * cable.weight.norm();
  const double taut = cable.EA * (chord.norm() / (cable.length + lengthening) - 1.0);
  Vector2d force = std::max(taut, weight) * chord.normalized();
  Reach reach = reach_of(cable, force, lengthening);
  for (int i = 0; i < 300; ++i) {
    const Vector2d apart = reach.chord - chord;
    Vector2d step = reach.by_force.inverse() * apart;
    if (step.norm() <= 1e-15 * force.norm()) break;
    Reach next = reach_of(cable, force - step, lengthening);
    for (int k = 0; k < 50 && (next.chord - chord).dot(step) < -0.9 * apart.dot(step); ++k) {
      step *= 0.5;
      next = reach_of(cable, force - step, lengthening);
    }
    force -= step;
    reach = next;
  }
  BarPull out;
  out.force = force;
  out.tangent = reach.by_force.inverse();
  out.at_start = (force + 0.5 * cable.length * cable.weight).norm();
  return out;
}

}  // namespace snapthrough::testing
