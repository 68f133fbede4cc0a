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
/// otherwise the larger one counts. One difference alone may be small by chance, where both meshes err alike.
class Differences {
 public:
  /// @return estimated error of `coarse`
  double add(double coarse, double fine) {
    constexpr double kSafety = 2.0;
    const double size = std::abs(fine);
    const double difference = size > 0.0 ? std::abs(coarse - fine) / size : 1.0;
    const bool falls = last_ < 0.0 || difference <= last_ / kFall;
    first_ = last_ < 0.0;
    error_ = kSafety * (falls ? difference : std::max(difference, last_));
    last_ = difference;
    return error_;
  }
  /// @brief Whether the last estimate is enough: of a first difference, if one four times as large were.
  [[nodiscard]] bool confirm(double accuracy) const { return (first_ ? kFall : 1.0) * error_ <= accuracy; }

 private:
  static constexpr double kFall = 4.0;
  double last_ = -1.0;
  double error_ = 1.0;
  bool first_ = true;
};

}  // namespace snapthrough
