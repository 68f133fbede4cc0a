#pragma once
/// @file
/// Sine and cosine of many angles at once.

#include <Eigen/Core>
#include <vector>

#include "solver/numeric/lanes.h"

namespace snapthrough {

/// Angles with their sines and cosines, four to an entry.
struct Angles {
  std::vector<Lanes> angle, sine, cosine;
};

/// @brief Number of entries of Angles that hold `count` angles.
[[nodiscard]] constexpr std::size_t lanes_for(std::size_t count) { return (count + kLanes - 1) / kLanes; }

/// @brief Sets sine and cosine of every angle, rad. Errors are below 3e-16 for angles up to 1e5.
///
/// An angle is a number n of quarter turns and a rest r within pi/4; polynomials in r by the coefficients of
/// FreeBSD's k_sin.c and k_cos.c.
void find_sines(Angles& of);

}  // namespace snapthrough
