#include "solver/support/catenary.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace snapthrough {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

/// Limits of the search for a cable's force. Chosen.
struct CableLimits {
  static constexpr int iterations = 200;    ///< Newton corrections
  static constexpr int halvings = 60;       ///< halvings of one correction
  static constexpr double overshoot = 0.5;  ///< slope beyond the least energy, over the first slope
  static constexpr double near = 1e-6;      ///< correction over the force from which each is smaller
  /// Force across the weight, over the weight, below which it counts as this: a cable that hangs beside
  /// itself has a tangent of infinite compliance.
  static constexpr double least_across = 1e-140;
  static constexpr double least_span = 1e-6;  ///< across the weight, over the length, of the first guess
  /// Sag, as (length over chord) - 1, from which the elastic part of the first guess is left out.
  static constexpr double deep = 0.2;
};

/// The integral A of |F - q t| over a part of a cable, with h and v the components of F across and along q
/// and w = |q|. Differences of its end values are written as quotients without cancellation.
class Integral {
 public:
  Integral(double h, double v, double l, double w)
      : h_(h), v_(v), l_(l), w_(w), v1_(v + 0.5 * w * l), v2_(v - 0.5 * w * l) {
    t1_ = std::hypot(h, v1_);
    t2_ = std::hypot(h, v2_);
    const double rise = v1_ > 0.0 ? h * h / (t1_ + v1_) : t1_ - v1_;
    const double fall = v2_ < 0.0 ? h * h / (t2_ - v2_) : t2_ + v2_;
    less_ = rise + fall;
  }
  /// First derivatives of A: by h, by v.
  [[nodiscard]] std::array<double, 2> gradient() const {
    return {h_ * parameter(), 2.0 * v_ * l_ / (t1_ + t2_)};
  }
  /// Second derivatives of A: by h twice, by h and v, by v twice.
  [[nodiscard]] std::array<double, 3> curvature() const {
    const double sum = t1_ + t2_;
    const double vv = 2.0 * l_ * sum / (t1_ / h_ * (t2_ / h_) * less_ * (less_ + 2.0 * w_ * l_));
    return {parameter() - vv, -2.0 * (h_ / t1_) * (v_ / t2_) * l_ / sum, vv};
  }
  /// Third derivatives of A: by h, three times, twice, once, and never; by v as often as is left.
  [[nodiscard]] std::array<double, 4> third() const {
    const double sine1 = v1_ / t1_;
    const double sine2 = v2_ / t2_;
    const double cosine1 = h_ / t1_;
    const double cosine2 = h_ / t2_;
    return {-(std::pow(sine1, 3) - std::pow(sine2, 3)) / (h_ * w_),
            (sine1 * sine1 / t1_ - sine2 * sine2 / t2_) / w_,
            (cosine2 * sine2 / t2_ - cosine1 * sine1 / t1_) / w_,
            (cosine1 * cosine1 / t1_ - cosine2 * cosine2 / t2_) / w_};
  }

 private:
  /// (asinh(v1 / h) - asinh(v2 / h)) / w; half the difference has the hyperbolic tangent (v1 - v2) / (T1 +
  /// T2).
  [[nodiscard]] double parameter() const { return std::log1p(2.0 * w_ * l_ / less_) / w_; }

  double h_;
  double v_;
  double l_;
  double w_;
  double v1_;  ///< component along q at the start
  double v2_;  ///< component along q at the end
  double t1_;
  double t2_;
  double less_;  ///< T1 + T2 - w l
};

/// Root x > 0 of sinh(x) / x = ratio. @pre ratio > 1
double catenary_parameter(double ratio) {
  double x = ratio < 3.0 ? std::sqrt(6.0 * (ratio - 1.0)) : std::log(2.0 * ratio * std::log(2.0 * ratio));
  for (int i = 0; i < 50; ++i) {
    const double step = (std::sinh(x) - ratio * x) / (std::cosh(x) - ratio);
    x -= step;
    if (!(std::abs(step) > 1e-6 * x)) break;  // the guess needs no more
  }
  return x;
}

/// Root T > 0 of T^2 (6 slack + 6 T / EA) = (w a / 2)^2: force of a cable of little sag, whose length exceeds
/// its chord by the share `slack`, with w a its weight across the chord.
double force_of_flat_cable(double slack, double EA, double half_weight) {
  // from above, where the function is convex and rises, Newton's method falls to the root
  double force = std::cbrt(EA * half_weight * half_weight / 6.0) + std::max(-slack, 0.0) * EA;
  for (int i = 0; i < 60; ++i) {
    const double value = force * force * 6.0 * (slack + force / EA) - half_weight * half_weight;
    const double slope = 12.0 * force * slack + 18.0 * force * force / EA;
    if (!(slope > 0.0)) break;
    const double next = force - value / slope;
    if (!(next > 0.0)) break;
    if (std::abs(next - force) <= 1e-6 * force) return next;
    force = next;
  }
  return force;
}

}  // namespace

Catenary::Catenary(double axial_stiffness, double length, const Vector2d& weight)
    : axial_stiffness_(axial_stiffness),
      length_(length),
      weight_(weight),
      size_(weight.norm()),
      along_(weight / size_),
      across_(-along_[1], along_[0]) {}

Catenary::Part Catenary::part(const Vector2d& force, double s) const {
  const Vector2d middle = force + 0.5 * (length_ - s) * weight_;
  double across = middle.dot(across_);
  const double least = CableLimits::least_across * size_ * length_;
  if (std::abs(across) < least) across = std::copysign(least, across);
  return {across, middle.dot(along_), s};
}

Vector2d Catenary::place_at(const Vector2d& force, double lengthening, double s) const {
  if (!(s > 0.0)) return Vector2d::Zero();
  const Part p = part(force, s);
  const auto [across, along] = Integral(p.across, p.along, s, size_).gradient();
  const double stretch = 1.0 + lengthening / length_;
  const double give = s / axial_stiffness_;
  return in_plane(stretch * across + give * p.across, stretch * along + give * p.along);
}

Matrix2d Catenary::place_by_force(const Vector2d& force, double lengthening, double s) const {
  if (!(s > 0.0)) return Matrix2d::Zero();
  const Part p = part(force, s);
  const auto [hh, hv, vv] = Integral(p.across, p.along, s, size_).curvature();
  Matrix2d turn;
  turn << across_, along_;
  Matrix2d own;
  own << hh, hv, hv, vv;
  own *= 1.0 + lengthening / length_;
  own.diagonal().array() += s / axial_stiffness_;
  return turn * own * turn.transpose();
}

/// Force by the inextensible catenary of a deep cable, and by the parabola of a flat one.
Vector2d Catenary::first_force(const Ends& ends) const {
  const double length = length_ + ends.lengthening;
  const double b = ends.chord.dot(along_);
  const double side = ends.chord.dot(across_);
  const double a = std::max(std::abs(side), CableLimits::least_span * length);
  const double ratio = std::sqrt(std::max(length * length - b * b, 0.0)) / a;
  if (ratio > 1.0 + CableLimits::deep) {
    const double x = catenary_parameter(ratio);
    return in_plane(std::copysign(0.5 * size_ * a / x, side), 0.5 * size_ * b / std::tanh(x));
  }
  const double chord = ends.chord.norm();
  return force_of_flat_cable(length / chord - 1.0, axial_stiffness_, 0.5 * size_ * a) / chord * ends.chord;
}

/// Newton's method for the force at which the gradient of the complementary energy is the chord. A correction
/// is halved where the energy would rise along it nearly as steeply as it falls at its beginning; corrections
/// end where rounding lets them do nothing.
Vector2d Catenary::force_for(const Ends& ends) const {
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  const auto apart_at = [&](const Vector2d& force) -> Vector2d {
    return place_at(force, ends.lengthening, length_) - ends.chord;
  };
  Vector2d force = first_force(ends);
  Vector2d apart = apart_at(force);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < CableLimits::iterations; ++i) {
    Vector2d step = place_by_force(force, ends.lengthening, length_).inverse() * apart;
    const double size = step.norm();
    // near the solution corrections fall until they are rounding
    if (size <= rounding * force.norm() || (size < CableLimits::near * force.norm() && size >= least)) break;
    least = size;
    Vector2d left = apart_at(force - step);
    for (int k = 0; k < CableLimits::halvings; ++k) {
      if (!(left.dot(step) < -CableLimits::overshoot * apart.dot(step))) break;
      step *= 0.5;
      left = apart_at(force - step);
    }
    force -= step;
    apart = left;
  }
  return force;
}

Catenary::Pull Catenary::pull(const Ends& ends) const {
  Pull out;
  out.force = force_for(ends);
  out.stiffness = place_by_force(out.force, ends.lengthening, length_).inverse();
  const Part p = part(out.force, length_);
  const auto [across, along] = Integral(p.across, p.along, length_, size_).gradient();
  out.by_lengthening = -out.stiffness * in_plane(across, along) / length_;
  return out;
}

/// With G the chord by force and lengthening, G_F F'' = - (G_FF F' F' + G_Fz F' z' twice).
Vector2d Catenary::second(const Ends& ends, const Ends& one, const Ends& other) const {
  const Pull at = pull(ends);
  const Vector2d a = at.stiffness * one.chord + at.by_lengthening * one.lengthening;
  const Vector2d b = at.stiffness * other.chord + at.by_lengthening * other.lengthening;
  const Part p = part(at.force, length_);
  const Integral integral(p.across, p.along, length_, size_);
  const auto [hhh, hhv, hvv, vvv] = integral.third();
  const double ah = a.dot(across_);
  const double av = a.dot(along_);
  const double bh = b.dot(across_);
  const double bv = b.dot(along_);
  const double stretch = 1.0 + ends.lengthening / length_;
  const auto [hh, hv, vv] = integral.curvature();
  const double across =
      stretch * (hhh * ah * bh + hhv * (ah * bv + av * bh) + hvv * av * bv) +
      ((hh * ah + hv * av) * other.lengthening + (hh * bh + hv * bv) * one.lengthening) / length_;
  const double along =
      stretch * (hhv * ah * bh + hvv * (ah * bv + av * bh) + vvv * av * bv) +
      ((hv * ah + vv * av) * other.lengthening + (hv * bh + vv * bv) * one.lengthening) / length_;
  return -at.stiffness * in_plane(across, along);
}

}  // namespace snapthrough
