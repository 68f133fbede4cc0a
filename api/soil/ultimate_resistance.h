#pragma once
/// @file
/// Ultimate resistance of soil to a pile, per length, as polynomials of the depth.
///
/// X is the depth below ground, D the pile's diameter, s the vertical effective stress at X, which is the sum
/// of unit weight times thickness of the soil above. In homogeneous soil s = gamma X. Sources: API RP 2GEO,
/// Geotechnical and Foundation Design Considerations (sand, and soft clay after H. Matlock, Correlations for
/// design of laterally loaded piles in soft clay, OTC 1204, 1970).

#include <array>
#include <vector>

#include "api/soil/layers.h"

namespace snapthrough::api::soil {

/// Accepted friction angles in degrees. The figure of API RP 2GEO covers 20 to 40.
inline constexpr double kLeastPhi = 20.0;
inline constexpr double kLargestPhi = 45.0;

/// Dimensionless coefficients of the ultimate resistance of sand.
struct SandCoefficients {
  double C1 = 0.0, C2 = 0.0, C3 = 0.0;
};

/// @brief Returns the coefficients of a friction angle in degrees.
///
/// With a = phi/2, b = 45 degrees + phi/2, K0 = 0.4 and Ka = tan^2(45 degrees - phi/2):
///   C1 = K0 tan(phi) sin(b) / (tan(b - phi) cos(a)) + tan^2(b) tan(a) / tan(b - phi)
///        + K0 tan(b) (tan(phi) sin(b) - tan(a))
///   C2 = tan(b) / tan(b - phi) - Ka
///   C3 = Ka (tan^8(b) - 1) + K0 tan(phi) tan^4(b)
[[nodiscard]] SandCoefficients sand_coefficients(double phi_degrees);

/// Polynomial of third degree.
class Cubic {
 public:
  Cubic() = default;
  /// @param coefficients coefficients of 1, X, X^2, X^3
  explicit Cubic(const std::array<double, 4>& coefficients) : c_(coefficients) {}

  [[nodiscard]] double operator()(double X) const { return c_[0] + X * (c_[1] + X * (c_[2] + X * c_[3])); }
  /// Returns the largest absolute value of the second derivative between a and b.
  [[nodiscard]] double largest_curvature(double a, double b) const;
  /// Returns the coefficient of X^i.
  [[nodiscard]] double coefficient(std::size_t i) const { return c_[i]; }

  friend Cubic operator+(const Cubic& p, const Cubic& q);
  /// Returns the product. @pre its degree is at most 3
  friend Cubic operator*(const Cubic& p, const Cubic& q);
  friend Cubic operator*(double factor, const Cubic& p);

 private:
  std::array<double, 4> c_{};
};

/// Range of depth in which a resistance is one polynomial.
struct Piece {
  double from = 0.0, to = 0.0;
  Cubic value;
};

/// Part of a layer that touches the pile, with the vertical effective stress as polynomial of the depth.
struct Contact {
  double from = 0.0, to = 0.0;
  Cubic stress;
};

/// @brief Returns A Pmax of sand in consecutive pieces from contact.from to contact.to.
///
/// Pmax = min((C1 X + C2 D) s, C3 D s); A = max(0.9, 3 - 0.8 X/D), under cyclic loads A = 0.9.
/// @param shortest pieces are longer
[[nodiscard]] std::vector<Piece> sand_resistance(const Sand& sand, double D, Loading loading,
                                                 const Contact& contact, double shortest);

/// Returns A Pmax of sand at one place.
[[nodiscard]] double ultimate_of(const Sand& sand, const Place& place);

/// @brief Returns Pmax of soft clay in consecutive pieces from contact.from to contact.to.
///
/// Pmax = min((3 Su + s) D + J Su X, 9 Su D).
/// @param shortest pieces are longer
[[nodiscard]] std::vector<Piece> clay_resistance(const SoftClay& clay, const Layer& layer, double D,
                                                 const Contact& contact, double shortest);

/// @brief Returns the depth X_R of transition of soft clay: the least depth in the layer, continued
/// downwards, at which (3 Su + s) D + J Su X reaches 9 Su D. In homogeneous soil X_R = 6 D / (gamma D / Su +
/// J).
[[nodiscard]] double transition_depth(const SoftClay& clay, const Layer& layer, double D,
                                      const Cubic& stress);

}  // namespace snapthrough::api::soil
