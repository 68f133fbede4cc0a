#pragma once
/// @file
/// The units that the solver computes in.

namespace snapthrough {

/// @brief Lengths over `length`, forces over `force` = EI / length^2, and the load factor times `load`, so
/// that every quantity is of order one whatever the units of the model. Here is how each kind of quantity of
/// a model is scaled; what is scaled is multiplied again where a result is written.
struct Scales {
  double length = 1.0;
  double force = 1.0;
  double load = 1.0;

  [[nodiscard]] double moment() const { return force * length; }
  [[nodiscard]] double line_load() const { return force / length; }
  [[nodiscard]] double scaled_length(double l) const { return l / length; }
  [[nodiscard]] double scaled_force(double f) const { return f / force; }
  [[nodiscard]] double scaled_moment(double m) const { return m / (force * length); }
  /// Force per length: loads along members, pressures.
  [[nodiscard]] double scaled_line_load(double q) const { return q * length / force; }
  /// Force per length of displacement: a spring.
  [[nodiscard]] double scaled_stiffness(double k) const { return k * length / force; }
  /// Moment per radian: a rotational spring.
  [[nodiscard]] double scaled_rotational(double k) const { return k / (force * length); }
  /// Force per length squared: a foundation's modulus.
  [[nodiscard]] double scaled_modulus(double k) const { return k * length * length / force; }
  [[nodiscard]] double scaled_curvature(double kappa) const { return kappa * length; }
};

}  // namespace snapthrough
