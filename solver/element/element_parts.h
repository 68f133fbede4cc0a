#pragma once
/// @file
/// Unknowns of an element, and springs on it.

#include <array>
#include <vector>

#include "solver/support/ground_motion.h"
#include "solver/support/law.h"

namespace snapthrough {

/// Indices of an element's unknowns in the vector of all unknowns.
struct ElementDofs {
  std::array<int, 3> a{};  ///< displacement (x, y, rotation) at the start
  std::array<int, 3> b{};  ///< displacement (x, y, rotation) at the end
  int v = 0;               ///< first of 3 P unknowns: u'_x of all Gauss points, then u'_y, then b'
  int s = 0;               ///< first of 3 P unknowns: N of all Gauss points, then Q, then M
  int m = 0;               ///< first of 3 multipliers
};

/// State of a one-sided support that touches without pressure, used within Rounding::touching of touching:
/// taken from the critical motion, because rounding hides it. `none`: not such a support.
enum class Touch : char { none, absent, acts };

/// Spring on a linear functional of one element's displacements, w = a.u_a + sum_q v_q.(u'_q, b'_q); where
/// the ground moves, less a.u_g with its displacement u_g.
struct SupportSpring {
  int element = 0;
  GroundPlace ground;
  Law law;
  Touch touch = Touch::none;
  int spring = -1;  ///< index of the spring; -1: part of a foundation
  std::array<double, 3> a{};
  std::vector<std::array<double, 3>> v;
};

}  // namespace snapthrough
