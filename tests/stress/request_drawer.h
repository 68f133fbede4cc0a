#pragma once
/// @file
/// Base of the classes that draw random requests.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tests/stress/random_model.h"
#include "tests/stress/random_numbers.h"

namespace snapthrough::testing {

/// @brief Draws one request; lengths come in a unit `length_`, forces in `force_` = EI / length^2.
class RequestDrawer {
 protected:
  /// @param lengths, forces range of the decimal logarithms of the units
  RequestDrawer(std::uint64_t seed, std::array<double, 2> lengths, std::array<double, 2> forces)
      : random_(Random(seed).bits()),  // seeds next to each other share nothing
        length_(random_.decades(lengths[0], lengths[1])),
        force_(random_.decades(forces[0], forces[1])) {}

  [[nodiscard]] Model& model() { return out_.model; }
  [[nodiscard]] const Member& any_member() {
    return model().members[static_cast<std::size_t>(random_.below(static_cast<int>(model().members.size())))];
  }
  /// Component of a force.
  [[nodiscard]] double component() { return force_ * random_.between(-1.0, 1.0); }
  /// Fractions on a grid of twentieths, so that no element is much shorter than the others.
  [[nodiscard]] double fraction(int lo, int hi) { return 0.05 * (lo + random_.below(hi - lo + 1)); }

  Random random_;
  double length_, force_;
  RandomRequest out_;
};

}  // namespace snapthrough::testing
