#pragma once
/// @file
/// Units of the solver's scaled quantities, and the conversion of model quantities to them.

namespace snapthrough {

/// @brief Units that make all quantities of order one: lengths over `length`, forces over
/// `force` = EI / length^2, load factors times `load`. The functions scale each kind of quantity; results are
/// scaled back when written.
struct Scales {
  double length = 1.0;
  double force = 1.0;
  double load = 1.0;

  [[nodiscard]] double moment() const { return force * length; }
  [[nodiscard]] double line_load() const { return force / length; }
  [[nodiscard]] double scaled_length(double l) const { return l / length; }
  [[nodiscard]] double scaled_force(double f) const { return f / force; }
  [[nodiscard]] double scaled_moment(double m) const { return m / (force * length); }
  /// Scaled force per length: loads along members, pressures.
  [[nodiscard]] double scaled_line_load(double q) const { return q * length / force; }
  /// Scaled force per displacement: springs.
  [[nodiscard]] double scaled_stiffness(double k) const { return k * length / force; }
  /// Scaled moment per radian: rotational springs.
  [[nodiscard]] double scaled_rotational(double k) const { return k / (force * length); }
  /// Scaled force per length squared: foundation moduli.
  [[nodiscard]] double scaled_modulus(double k) const { return k * length * length / force; }
  [[nodiscard]] double scaled_curvature(double kappa) const { return kappa * length; }
};

}  // namespace snapthrough
