#pragma once
/// @file
/// Four numbers that one instruction handles: blocks of a row, or one entry of four vectors.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

namespace snapthrough {

inline constexpr int kLanes = 4;
using Lanes = Eigen::Array<double, kLanes, 1>;
using Lanes3 = std::array<Lanes, 3>;

/// @brief Four columns of a matrix from a given one on, one in each lane. Lanes past the last column repeat
/// it, so that they hold and write the same numbers.
class ColumnLanes {
 public:
  ColumnLanes(Eigen::Ref<Eigen::MatrixXd> x, Eigen::Index first) {
    for (int l = 0; l < kLanes; ++l) at_[l] = x.col(std::min(first + l, x.cols() - 1)).data();
  }
  [[nodiscard]] Lanes operator[](Eigen::Index row) const {
    return {at_[0][row], at_[1][row], at_[2][row], at_[3][row]};
  }
  void store(Eigen::Index row, const Lanes& values) const {
    for (int l = 0; l < kLanes; ++l) at_[l][row] = values[l];
  }
  /// The column in a lane.
  [[nodiscard]] double* column(int lane) const { return at_[lane]; }

 private:
  std::array<double*, kLanes> at_{};
};

/// Matrix times four vectors.
[[nodiscard]] inline Lanes3 times(const Eigen::Matrix3d& A, const Lanes3& x) {
  Lanes3 out;
  for (int i = 0; i < 3; ++i) out[i] = A(i, 0) * x[0] + A(i, 1) * x[1] + A(i, 2) * x[2];
  return out;
}
/// Transposed matrix times four vectors.
[[nodiscard]] inline Lanes3 transposed_times(const Eigen::Matrix3d& A, const Lanes3& x) {
  Lanes3 out;
  for (int i = 0; i < 3; ++i) out[i] = A(0, i) * x[0] + A(1, i) * x[1] + A(2, i) * x[2];
  return out;
}
[[nodiscard]] inline Lanes3 sum(const Lanes3& x, const Lanes3& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
[[nodiscard]] inline Lanes3 difference(const Lanes3& x, const Lanes3& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

}  // namespace snapthrough
