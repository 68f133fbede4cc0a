#include "solver/resolve/action.h"

#include <cmath>

namespace snapthrough {

using Vec2 = std::array<double, 2>;

Vec2 LinePiece::at(double fraction) const {
  return from == to ? from : between(from, to, (fraction - range[0]) / (range[1] - range[0]), power);
}

double measure_of(LoadMeasure per, double angle) {
  if (per == LoadMeasure::horizontal) return std::abs(std::cos(angle));
  return per == LoadMeasure::vertical ? std::abs(std::sin(angle)) : 1.0;
}

Vec2 global_force(LoadAxes axes, const Vec2& force, double angle) {
  if (axes == LoadAxes::global) return force;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * force[0] - s * force[1], s * force[0] + c * force[1]};
}

}  // namespace snapthrough
