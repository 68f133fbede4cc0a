#pragma once
/// @file
/// Elastic cable that hangs between two places under its weight.

#include <Eigen/Core>
#include <algorithm>

namespace snapthrough {

/// @brief Elastic catenary: a cable without bending stiffness whose weight per length without force is
/// constant.
///
/// With F the force in its middle, by length without force, T(t) = F - q t is the force at the length t from
/// there, t in [-L/2, L/2], and q the weight per length. The complementary energy
///
///   Psi(F) = integral of (1 + z/L) |T| + |T|^2 / (2 EA)
///
/// with z the lengthening without force is strictly convex, and its gradient is the chord from start to end
/// (H. M. Irvine, Cable Structures, 1981, section 1.3, has the same chord by end forces). The cable acts on
/// its start with F and half of its weight, on its end with -F and the other half.
///
/// All arguments are in consistent units.
class Catenary {
 public:
  /// @param axial_stiffness EA > 0
  /// @param length L > 0, without force
  /// @param weight q, not zero
  Catenary(double axial_stiffness, double length, const Eigen::Vector2d& weight);

  /// Force in the middle at a chord, with its derivatives.
  struct Pull {
    Eigen::Vector2d force;
    Eigen::Matrix2d stiffness;       ///< by the chord; positive definite
    Eigen::Vector2d by_lengthening;  ///< by z
  };
  /// Chord and lengthening z, or their changes.
  struct Ends {
    Eigen::Vector2d chord;
    double lengthening = 0.0;
  };
  [[nodiscard]] Pull pull(const Ends& ends) const;
  /// Second derivative of the force along two changes of the ends.
  [[nodiscard]] Eigen::Vector2d second(const Ends& ends, const Ends& one, const Ends& other) const;

  /// @param force force in the middle
  /// @param s length from the start, without force
  [[nodiscard]] Eigen::Vector2d force_at(const Eigen::Vector2d& force, double s) const {
    return force + (0.5 * length_ - s) * weight_;
  }
  /// Length from the start to the end with the larger tension. @param force as for force_at()
  [[nodiscard]] double tightest(const Eigen::Vector2d& force) const {
    return force_at(force, 0.0).norm() >= force_at(force, length_).norm() ? 0.0 : length_;
  }
  /// Length from the start to the place of least tension: where the force is across the weight, or the end
  /// next to it. @param force as for force_at()
  [[nodiscard]] double slackest(const Eigen::Vector2d& force) const {
    return std::clamp(0.5 * length_ + force.dot(along_) / size_, 0.0, length_);
  }
  /// Vector from the start to the place at the length s from it. @param force, s as for force_at()
  [[nodiscard]] Eigen::Vector2d place_at(const Eigen::Vector2d& force, double lengthening, double s) const;
  /// Derivative of place_at() by the force.
  [[nodiscard]] Eigen::Matrix2d place_by_force(const Eigen::Vector2d& force, double lengthening,
                                               double s) const;

  [[nodiscard]] double axial_stiffness() const { return axial_stiffness_; }
  [[nodiscard]] double length() const { return length_; }

 private:
  /// Part of the cable of a given length, by the force in its middle across the weight and along it.
  struct Part {
    double across;
    double along;
    double length;
  };
  [[nodiscard]] Part part(const Eigen::Vector2d& force, double s) const;
  [[nodiscard]] Eigen::Vector2d force_for(const Ends& ends) const;
  [[nodiscard]] Eigen::Vector2d first_force(const Ends& ends) const;
  [[nodiscard]] Eigen::Vector2d in_plane(double across, double along) const {
    return across * across_ + along * along_;
  }

  double axial_stiffness_;
  double length_;
  Eigen::Vector2d weight_;
  double size_;             ///< |q|
  Eigen::Vector2d along_;   ///< unit vector of the weight
  Eigen::Vector2d across_;  ///< unit vector across it
};

}  // namespace snapthrough
