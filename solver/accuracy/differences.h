#pragma once
/// @file
/// From the values of one load on ever finer meshes to its error.

#include <algorithm>
#include <cmath>

namespace snapthrough {

/// Finer meshes tried after the first.
inline constexpr int kMostLevels = 6;

/// @brief Estimates the relative error of a load on each mesh by its difference to the next one.
///
/// Twice the difference, because the finer mesh's error may be half of the coarser one's where both are so
/// coarse that errors change their sign from mesh to mesh. Successive differences must fall by four;
/// otherwise the larger one counts.
class Differences {
 public:
  /// @return estimated error of `coarse`
  double add(double coarse, double fine) {
    constexpr double kSafety = 2.0;
    constexpr double kFall = 4.0;
    const double size = std::abs(fine);
    const double difference = size > 0.0 ? std::abs(coarse - fine) / size : 1.0;
    const bool falls = last_ < 0.0 || difference <= last_ / kFall;
    const double error = kSafety * (falls ? difference : std::max(difference, last_));
    last_ = difference;
    return error;
  }

 private:
  double last_ = -1.0;
};

}  // namespace snapthrough
