#pragma once
/// @file
/// Bracketing methods: locating a root, or eigenvalues by counts, inside an interval.

#include <algorithm>
#include <cmath>
#include <vector>

namespace snapthrough {

/// @brief Bracket of a sign change, closed by inverse quadratic interpolation where safe, else by bisection
/// (Chandrupatla, Advances in Engineering Software 28, 1997).
class SignBracket {
 public:
  /// @param fa, fb values at a and b, of opposite signs or one of them zero
  SignBracket(double a, double fa, double b, double fb) : a_(a), fa_(fa), b_(b), fb_(fb), c_(a), fc_(fa) {}

  /// @brief Next position to evaluate, at least a share of the bracket's width from both ends.
  /// @param least share, in (0, 1/2)
  [[nodiscard]] double next(double least) const {
    return a_ + std::clamp(share_, least, 1.0 - least) * (b_ - a_);
  }
  /// @brief Updates the bracket with the value fx at x = next().
  void take(double x, double fx) {
    c_ = a_;
    fc_ = fa_;
    if ((fx > 0.0) != (fa_ > 0.0)) {
      c_ = b_;
      fc_ = fb_;
      b_ = a_;
      fb_ = fa_;
    }
    a_ = x;
    fa_ = fx;
    const double xi = (a_ - b_) / (c_ - b_);
    const double phi = (fa_ - fb_) / (fc_ - fb_);
    share_ = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
      share_ = fa_ / (fb_ - fa_) * fc_ / (fb_ - fc_) +
               (c_ - a_) / (b_ - a_) * fa_ / (fc_ - fa_) * fb_ / (fc_ - fb_);
  }
  [[nodiscard]] double largest() const { return std::max(a_, b_); }
  [[nodiscard]] double width() const { return std::abs(b_ - a_); }
  /// End with the smaller absolute value.
  [[nodiscard]] double best() const { return std::abs(fa_) < std::abs(fb_) ? a_ : b_; }
  [[nodiscard]] bool is_exact() const { return fa_ == 0.0 || fb_ == 0.0; }
  [[nodiscard]] double middle() const { return 0.5 * (a_ + b_); }

 private:
  double a_, fa_;  ///< latest position with its value
  double b_, fb_;  ///< other end of the bracket with its value
  double c_, fc_;  ///< previous position with its value
  double share_ = 0.5;
};

/// @brief Bisects (lo, hi) to the given width or to adjacent doubles.
/// @param is_beyond whether a position is above the wanted one
/// @return middle of the final interval
template <class IsBeyond>
[[nodiscard]] double bisect(double lo, double hi, double width, const IsBeyond& is_beyond) {
  while (hi - lo > width) {
    const double middle = 0.5 * (lo + hi);
    if (middle <= lo || middle >= hi) break;
    (is_beyond(middle) ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

/// Interval of load factors with the number of eigenvalues (or buckling loads) below each end.
struct LoadBracket {
  double lo = 0.0;
  double hi = 0.0;
  int below_lo = 0;
  int below_hi = 0;

  [[nodiscard]] bool is_empty() const { return below_hi <= below_lo; }
  [[nodiscard]] bool is_single() const { return below_hi - below_lo == 1; }
};

/// Factor sqrt(5) / 2 on Euler's load at the start of a search. Many columns and elements buckle at simple
/// multiples of Euler's load, at which elimination loses all digits; neither doubling nor halving reaches
/// one.
inline constexpr double kOffMultiples = 1.1180339887498949;

/// @brief Bisects a bracket of loads until `take` accepts each part; parts are taken in ascending order.
/// @param count number of loads below a load factor; clamped to the counts at the bracket's ends
/// @param wanted parts whose lower end has at least this count are omitted
/// @param take accepts a part (true), or asks to divide it (false)
template <class Count, class Take>
void isolate_loads(const LoadBracket& bracket, int wanted, const Count& count, const Take& take) {
  if (bracket.is_empty() || bracket.below_lo >= wanted || take(bracket)) return;
  const double middle = 0.5 * (bracket.lo + bracket.hi);
  const int below = std::clamp(count(middle), bracket.below_lo, bracket.below_hi);
  isolate_loads({bracket.lo, middle, bracket.below_lo, below}, wanted, count, take);
  isolate_loads({middle, bracket.hi, below, bracket.below_hi}, wanted, count, take);
}

}  // namespace snapthrough
