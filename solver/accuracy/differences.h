#pragma once
/// @file
/// Error estimate of a load from its values on finer and finer meshes.

#include <algorithm>
#include <cmath>

namespace snapthrough {

/// @brief Estimates the relative error of a load on each mesh from the difference to the next mesh.
///
/// The estimate is twice the difference: on coarse meshes with errors of alternating sign, the finer mesh's
/// error may be half of the coarser one's. Successive differences must fall by a factor of four; otherwise
/// the larger one is used. A single difference may be small by chance if both meshes have similar errors.
class Differences {
 public:
  static constexpr int most_levels = 6;  ///< largest number of meshes beyond the first

  /// @return estimated relative error of `coarse`
  double add(double coarse, double fine) {
    const double size = std::abs(fine);
    const double difference = size > 0.0 ? std::abs(coarse - fine) / size : 1.0;
    const bool falls = last_ < 0.0 || difference <= last_ / fall;
    first_ = last_ < 0.0;
    error_ = safety * (falls ? difference : std::max(difference, last_));
    last_ = difference;
    return error_;
  }
  /// @brief Whether the last estimate is within the accuracy; a first estimate must be four times smaller.
  [[nodiscard]] bool confirm(double accuracy) const { return (first_ ? fall : 1.0) * error_ <= accuracy; }

 private:
  static constexpr double safety = 2.0;  ///< error over the difference, see the class comment
  static constexpr double fall = 4.0;    ///< least ratio of successive differences
  double last_ = -1.0;
  double error_ = 1.0;
  bool first_ = true;
};

}  // namespace snapthrough
