#pragma once
/// @file
/// LU factorisation of a 3 x 3 matrix.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace snapthrough {

/// @brief P A = L U with row pivoting. Solutions are backward stable, unlike those by an explicit inverse.
class SmallFactor {
 public:
  SmallFactor() = default;
  /// @brief Factorises `a`; pivots that are exactly zero become `tiny`.
  explicit SmallFactor(const Eigen::Matrix3d& a) : lu_(a) {
    for (int k = 0; k < 2; ++k) {
      int best = k;
      for (int i = k + 1; i < 3; ++i)
        if (std::abs(lu_(i, k)) > std::abs(lu_(best, k))) best = i;
      if (best != k) {
        for (int j = 0; j < 3; ++j) std::swap(lu_(k, j), lu_(best, j));
        std::swap(row_[k], row_[best]);
        odd_ = !odd_;
      }
      if (lu_(k, k) == 0.0) lu_(k, k) = tiny;
      for (int i = k + 1; i < 3; ++i) {
        lu_(i, k) /= lu_(k, k);
        for (int j = k + 1; j < 3; ++j) lu_(i, j) -= lu_(i, k) * lu_(k, j);
      }
    }
    if (lu_(2, 2) == 0.0) lu_(2, 2) = tiny;
  }

  /// det A, replaced by a tiny number if zero.
  [[nodiscard]] double determinant() const {
    const double product = lu_(0, 0) * lu_(1, 1) * lu_(2, 2);
    if (product == 0.0) return std::numeric_limits<double>::min();
    return odd_ ? -product : product;
  }
  /// @brief Solution A^-1 b.
  /// @tparam Vector three numbers, or three Lanes for four right-hand sides
  template <class Vector>
  [[nodiscard]] Vector solve(const Vector& b) const {
    using Number = std::remove_cvref_t<decltype(b[0])>;
    const Number y1 = b[row_[1]] - lu_(1, 0) * b[row_[0]];
    const Number y2 = b[row_[2]] - lu_(2, 0) * b[row_[0]] - lu_(2, 1) * y1;
    Vector x;
    x[2] = y2 / lu_(2, 2);
    x[1] = (y1 - lu_(1, 2) * x[2]) / lu_(1, 1);
    x[0] = (b[row_[0]] - lu_(0, 1) * x[1] - lu_(0, 2) * x[2]) / lu_(0, 0);
    return x;
  }
  /// Solution A^-T b.
  [[nodiscard]] Eigen::Vector3d solve_transposed(const Eigen::Vector3d& b) const {
    const double y0 = b[0] / lu_(0, 0);
    const double y1 = (b[1] - lu_(0, 1) * y0) / lu_(1, 1);
    const double y2 = (b[2] - lu_(0, 2) * y0 - lu_(1, 2) * y1) / lu_(2, 2);
    Eigen::Vector3d x;
    x[row_[2]] = y2;
    const double x1 = y1 - lu_(2, 1) * y2;
    x[row_[1]] = x1;
    x[row_[0]] = y0 - lu_(1, 0) * x1 - lu_(2, 0) * y2;
    return x;
  }
  /// Solution A^-1 B.
  [[nodiscard]] Eigen::Matrix3d solve_columns(const Eigen::Matrix3d& b) const {
    Eigen::Matrix3d x;
    for (int j = 0; j < 3; ++j) x.col(j) = solve(Eigen::Vector3d(b.col(j)));
    return x;
  }
  [[nodiscard]] Eigen::Matrix3d solve_columns_transposed(const Eigen::Matrix3d& b) const {
    Eigen::Matrix3d x;
    for (int j = 0; j < 3; ++j) x.col(j) = solve_transposed(Eigen::Vector3d(b.col(j)));
    return x;
  }
  [[nodiscard]] Eigen::Matrix3d inverse() const { return solve_columns(Eigen::Matrix3d::Identity()); }

 private:
  static constexpr double tiny = 1e-300;  ///< far below every pivot; its square is zero

  Eigen::Matrix3d lu_ = Eigen::Matrix3d::Identity();  ///< U, and L below the unit diagonal
  std::array<std::uint8_t, 3> row_{0, 1, 2};          ///< row of A for each row of L U
  bool odd_ = false;                                  ///< the permutation is odd
};

}  // namespace snapthrough
