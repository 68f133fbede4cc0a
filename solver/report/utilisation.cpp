#include "solver/report/utilisation.h"

#include <cmath>

#include "solver/numeric/rounding.h"

namespace snapthrough {

std::array<double, 2> fibre_utilisations(const Strength& strength, double fraction, double axial_force,
                                         double bending_moment) {
  const double axial = axial_force / strength.axial_force.at(fraction);
  const double bent = bending_moment / strength.bending_moment.at(fraction);
  std::array<double, 2> out{axial - bent, axial + bent};
  for (double& value : out)
    if (value < 0.0) value /= strength.compression;
  return out;
}

bool exceeds(const Utilisation& value, const Utilisation& other) {
  return std::abs(value.value) > Rounding::first_of_equal * std::abs(other.value);
}

}  // namespace snapthrough
