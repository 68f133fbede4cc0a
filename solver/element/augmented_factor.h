#pragma once
/// @file
/// L D L^T of a small symmetric matrix together with six columns beside it, of fixed size and without heap.

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace snapthrough {

/// Doubles in one block: rows are worked on, and padded to, whole blocks.
inline constexpr int kBlock = 4;
[[nodiscard]] constexpr int padded(int n) { return (n + kBlock - 1) / kBlock * kBlock; }

using Block = Eigen::Map<Eigen::Array<double, kBlock, 1>, Eigen::Aligned32>;
using ConstBlock = Eigen::Map<const Eigen::Array<double, kBlock, 1>, Eigen::Aligned32>;

/// y -= f x over the blocks from the one that holds `first` on.
/// @pre y and x aligned to 32 bytes, `Width` whole blocks
template <int Width>
inline void subtract_scaled(double* y, const double* x, double f, int first) {
  for (int b = first / kBlock * kBlock; b < Width; b += kBlock) Block(y + b) -= f * ConstBlock(x + b);
}

/// x.y over the blocks from the one that holds `first` on.
template <int Width>
[[nodiscard]] inline double dot_from(const double* x, const double* y, int first) {
  Eigen::Array<double, kBlock, 1> sum = Eigen::Array<double, kBlock, 1>::Zero();
  for (int b = first / kBlock * kBlock; b < Width; b += kBlock) sum += ConstBlock(x + b) * ConstBlock(y + b);
  return sum.sum();
}

/// @brief [S B] reduced to [D L^T  L^-1 B] for S = L D L^T of up to Max rows, and B of six columns.
///
/// Row i of the input holds S_ij for j > i, then B, the diagonal is kept apart, and factors have zeros left
/// of it. So every inner loop runs over whole blocks. The sums are those of outer products, which have no
/// chain of dependent additions.
template <int Max>
class AugmentedFactor {
 public:
  static constexpr int kSides = 6;
  static constexpr int kStride = padded(Max + kSides);

  /// Starts a row: all zero.
  double* row(int i) { return rows_[i].data(); }
  void clear_row(int i) { rows_[i].fill(0.0); }
  double& diagonal(int i) { return pivots_[i]; }

  /// @brief Factorises the first N rows; pivots of exactly zero become tiny.
  /// @param schur B^T S^-1 B, 6 x 6
  template <int N>
  void factorise(Eigen::Matrix<double, kSides, kSides>& schur) {
    constexpr int width = padded(N + kSides);
    schur.setZero();
    for (int k = 0; k < N; ++k) {
      double* top = rows_[k].data();
      for (int j = k / kBlock * kBlock; j <= k; ++j) top[j] = 0.0;  // whole blocks reached it from above
      if (pivots_[k] == 0.0) pivots_[k] = 1e-300;
      const double inverse = 1.0 / pivots_[k];
      inverses_[k] = inverse;
      for (int i = k + 1; i < N; ++i) {
        const double f = top[i] * inverse;
        pivots_[i] -= f * top[i];
        subtract_scaled<width>(rows_[i].data(), top, f, i);
      }
      const double* side = top + N;
      for (int c = 0; c < kSides; ++c)
        for (int r = 0; r < kSides; ++r) schur(r, c) += inverse * side[c] * side[r];
    }
  }
  [[nodiscard]] double pivot(int i) const { return pivots_[i]; }

  /// @brief x := L^-1 x in its first N entries; the six that follow become -B^T S^-1 x.
  /// @pre x aligned, kStride long, zero from entry N on
  template <int N>
  void forward(double* x) const {
    for (int k = 0; k < N; ++k)
      subtract_scaled<padded(N + kSides)>(x, rows_[k].data(), inverses_[k] * x[k], k + 1);
  }
  /// @brief y := S^-1 (r - B sides) from x = L^-1 r; y holds `sides` in the six entries after its first N.
  /// @pre y aligned, kStride long, zero but for the sides
  template <int N>
  void backward(const double* x, double* y) const {
    for (int k = N - 1; k >= 0; --k)
      y[k] = (x[k] - dot_from<padded(N + kSides)>(rows_[k].data(), y, k + 1)) * inverses_[k];
  }

 private:
  alignas(32) std::array<std::array<double, kStride>, Max> rows_{};
  std::array<double, Max> pivots_{};
  std::array<double, Max> inverses_{};
};

}  // namespace snapthrough
