#pragma once
/// @file
/// Soils whose curves have closed forms, and limits of all soils.

#include <cstddef>

namespace snapthrough::api::soil {

/// Largest number of soils of a model.
inline constexpr std::size_t kMaxSoils = 1'000;
/// Largest number of layers of a soil.
inline constexpr std::size_t kMaxLayers = 1'000;
/// Largest number of depths of a layer between which its curves are linear.
inline constexpr std::size_t kMaxBreakPoints = 1'000;
/// Largest number of numbers of all laws of a document together, which bounds its text to some megabytes: a
/// number by depth takes about 90 bytes.
inline constexpr std::size_t kMaxNumbersByDepth = 50'000;
/// Least and largest value of a soil's `accuracy`.
inline constexpr double kLeastAccuracy = 1e-4;
inline constexpr double kLargestAccuracy = 0.1;

enum class Loading { static_, cyclic };

/// Depths at which the lateral curves of a layer are taken.
enum class Layering {
  none,       ///< each layer has its own depths
  georgiadis  ///< equivalent depths, at which the soil alone has the resistance of the layers above
};

/// Sand of API RP 2GEO.
struct Sand {
  double C1 = 0.0, C2 = 0.0, C3 = 0.0;  ///< dimensionless coefficients of the ultimate resistance
  double k = 0.0;                       ///< initial modulus of subgrade reaction, force/length^3
};

/// Soft clay of Matlock (1970) and API RP 2GEO.
struct SoftClay {
  double Su_top = 0.0, Su_bottom = 0.0;  ///< undrained shear strength at both faces, linear between
  double eps50 = 0.0;                    ///< strain at half the strength in an undrained compression test
  double J = 0.0;                        ///< dimensionless constant of the shallow resistance
};

}  // namespace snapthrough::api::soil
