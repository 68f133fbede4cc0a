/// Curve of weak rock.

#include <algorithm>
#include <cmath>

#include "api/soil/curve_sampling.h"

namespace snapthrough::api::soil {

Curve curve_of(const WeakRock& rock, const Place& place, double accuracy) {
  const double D = place.diameter;
  const double depth =
      std::min((place.depth - place.layer_top) / D, 3.0);  // relative, below the rock's surface
  const double reduction = 1.0 - 2.0 / 3.0 * rock.RQD / 100.0;
  const double ultimate = reduction * rock.q_u * D * (1.0 + 1.4 * depth);
  const double stiffness = rock.E_ir * (100.0 + 400.0 * depth / 3.0);
  const double end = 16.0 * rock.k_rm * D;  // where the power reaches the ultimate resistance
  const auto power = [=](double y) { return ultimate * std::pow(y / end, 0.25); };
  return sampled(below_line({{end, power}}, stiffness), accuracy);
}

}  // namespace snapthrough::api::soil
