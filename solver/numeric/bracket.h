#pragma once
/// @file
/// The one way in which a place between two others is located: by a bracket that is never left.

#include <algorithm>
#include <cmath>
#include <vector>

namespace snapthrough {

/// @brief A change of sign of a function between two places, closed by inverse quadratic interpolation where
/// that can be trusted and by halving where not (Chandrupatla, Advances in Engineering Software 28, 1997).
class SignBracket {
 public:
  /// @param fa, fb of opposite signs, or one of them zero
  SignBracket(double a, double fa, double b, double fb) : a_(a), fa_(fa), b_(b), fb_(fb), c_(a), fc_(fa) {}

  /// @brief The next place to look at, inside the bracket, at least a share of its width from both ends.
  /// @param least share, in (0, 1/2)
  [[nodiscard]] double next(double least) const {
    return a_ + std::clamp(share_, least, 1.0 - least) * (b_ - a_);
  }
  /// @brief Takes the value at next() into the bracket.
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
  /// Its end with the smaller value.
  [[nodiscard]] double best() const { return std::abs(fa_) < std::abs(fb_) ? a_ : b_; }
  [[nodiscard]] bool is_exact() const { return fa_ == 0.0 || fb_ == 0.0; }
  [[nodiscard]] double middle() const { return 0.5 * (a_ + b_); }

 private:
  double a_, fa_;  ///< the last place
  double b_, fb_;  ///< the other end
  double c_, fc_;  ///< the place before
  double share_ = 0.5;
};

/// @brief Halves (lo, hi) until it is no wider than `width` or has no middle.
/// @param is_beyond whether the place that is looked for is below a middle
/// @return the middle of what is left
template <class IsBeyond>
[[nodiscard]] double bisect(double lo, double hi, double width, const IsBeyond& is_beyond) {
  while (hi - lo > width) {
    const double middle = 0.5 * (lo + hi);
    if (middle <= lo || middle >= hi) break;
    (is_beyond(middle) ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

/// An interval of load factors with the number of eigenvalues, or of buckling loads, below each end.
struct LoadBracket {
  double lo = 0.0;
  double hi = 0.0;
  int below_lo = 0;
  int below_hi = 0;

  [[nodiscard]] bool is_empty() const { return below_hi <= below_lo; }
  [[nodiscard]] bool is_single() const { return below_hi - below_lo == 1; }
};

/// What Euler's load is multiplied by where a search begins: the root of 5, halved. Most columns, and
/// elements held at one end, buckle at simple multiples of it, where elimination loses all digits; neither
/// doubling nor halving from here meets one.
inline constexpr double kOffMultiples = 1.1180339887498949;

/// @brief Splits a bracket of loads until each part is a leaf, and takes the leaves in ascending order.
/// @param count loads below a load factor; one that lost its digits says no more than its neighbours
/// @param wanted parts whose lower end has as many below it are left out
/// @param take whether a part is a leaf; it has taken it then
template <class Count, class Take>
void isolate_loads(const LoadBracket& bracket, int wanted, const Count& count, const Take& take) {
  if (bracket.is_empty() || bracket.below_lo >= wanted || take(bracket)) return;
  const double middle = 0.5 * (bracket.lo + bracket.hi);
  const int below = std::clamp(count(middle), bracket.below_lo, bracket.below_hi);
  isolate_loads({bracket.lo, middle, bracket.below_lo, below}, wanted, count, take);
  isolate_loads({middle, bracket.hi, below, bracket.below_hi}, wanted, count, take);
}

}  // namespace snapthrough
