#pragma once
/// @file
/// What the searches for buckling loads by inertia counts share.

namespace snapthrough {

/// An interval of load factors with the number of eigenvalues, or of buckling loads, below each end.
struct LoadBracket {
  double lo = 0.0;
  double hi = 0.0;
  int below_lo = 0;
  int below_hi = 0;
};

/// What Euler's load is multiplied by where a search begins: the root of 5, halved. Most columns, and
/// elements held at one end, buckle at simple multiples of it, where elimination loses all digits; neither
/// doubling nor halving from here meets one.
inline constexpr double kOffMultiples = 1.1180339887498949;

}  // namespace snapthrough
