#pragma once
/// @file
/// L D L^T factorisation of a small symmetric matrix with six border columns; fixed size, no heap memory.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "solver/numeric/lanes.h"

namespace snapthrough {

/// Doubles per block; rows are padded to whole blocks, and loops run over whole blocks.
inline constexpr int kBlock = kLanes;
[[nodiscard]] constexpr int padded(int n) { return (n + kBlock - 1) / kBlock * kBlock; }

using Block = Eigen::Map<Lanes, Eigen::Aligned32>;
using ConstBlock = Eigen::Map<const Lanes, Eigen::Aligned32>;

inline void store(const Lanes& lanes, double* to) { Block{to} = lanes; }

/// @brief Upper triangle of a symmetric matrix with N rows and six border rows, stored in whole blocks.
///
/// Entries left of the diagonal within its block are arbitrary; entries beyond the last column are zero.
template <int N>
struct AugmentedMatrix {
  static constexpr int kSides = 6;
  static constexpr int kRows = N + kSides;
  static constexpr int kWidth = padded(kRows);

  alignas(32) std::array<std::array<double, kWidth>, kRows> rows;

  double& operator()(int i, int j) { return rows[i][j]; }
  double operator()(int i, int j) const { return rows[i][j]; }
  void set_zero() {
    for (auto& row : rows) row.fill(0.0);
  }
  /// Vector x of row length with the weight of x x^T.
  struct Weighted {
    alignas(32) std::array<double, kWidth> x;
    double weight;
  };
  /// @brief Adds sum_k weight_k x_k x_k^T to the rows from `First` on.
  template <int First>
  void add_squares(const Weighted* x, std::size_t count) {
    add_squares_from<First>(x, count, std::make_integer_sequence<int, kWidth / kBlock>());
  }

 private:
  template <int First, int... R>
  void add_squares_from(const Weighted* x, std::size_t count, std::integer_sequence<int, R...>) {
    (add_squares_to_block<First, R>(x, count), ...);
  }
  /// Adds to block row R; the sums of one row stay in registers.
  template <int First, int R>
  void add_squares_to_block(const Weighted* x, std::size_t count) {
    constexpr int blocks = kWidth / kBlock - R;
    constexpr int begin = std::max(First, kBlock * R);
    for (int i = begin; i < std::min(kBlock * (R + 1), kRows); ++i) {
      std::array<Lanes, blocks> sum;
      for (int b = 0; b < blocks; ++b) sum[b] = Block(&rows[i][kBlock * (R + b)]);
      for (std::size_t k = 0; k < count; ++k) {
        const double f = x[k].weight * x[k].x[i];
        for (int b = 0; b < blocks; ++b) sum[b] += f * ConstBlock(&x[k].x[kBlock * (R + b)]);
      }
      for (int b = 0; b < blocks; ++b) store(sum[b], &rows[i][kBlock * (R + b)]);
    }
  }
};

/// @brief Factors [D L^T  L^-1 B] of [S B] for S = L D L^T with N rows and B with six columns.
///
/// Stored rows are zero up to and including the diagonal, so that every inner loop runs over whole blocks.
template <int N>
class AugmentedFactor {
 public:
  using Matrix = AugmentedMatrix<N>;
  static constexpr int kWidth = Matrix::kWidth;

  /// @brief Eliminates the first N rows of `a` = [S B; B^T C]; pivots that are exactly zero become 1e-300.
  ///
  /// Elimination goes row by row, so that a row stays in registers. On return the last six rows of `a` hold
  /// the upper triangle of C - B^T S^-1 B.
  /// @param pivots the diagonal of D
  void factorise(Matrix& a, std::array<double, N>& pivots) {
    factorise_blocks(a, pivots, std::make_integer_sequence<int, kWidth / kBlock>());
  }

  /// Four vectors of length N with their six sides, one in each lane.
  using Vectors = std::array<Lanes, Matrix::kRows>;

  /// @brief x := L^-1 x in its first N entries; the six that follow become -B^T S^-1 x. @pre these are zero
  void forward(Vectors& x) const { forward_rows(x, std::make_integer_sequence<int, N>()); }
  /// @brief y := S^-1 (r - B sides) from x = L^-1 r; on entry y holds `sides` in its last six entries.
  void backward(const std::array<Lanes, N>& x, Vectors& y) const {
    backward_rows(x, y, std::make_integer_sequence<int, N>());
  }

 private:
  // every loop is written out, so that the vectors stay in registers
  template <int... K>
  void forward_rows(Vectors& x, std::integer_sequence<int, K...>) const {
    (forward_row<K>(x, std::make_integer_sequence<int, Matrix::kRows - 1 - K>()), ...);
  }
  template <int K, int... J>
  void forward_row(Vectors& x, std::integer_sequence<int, J...>) const {
    const Lanes f = inverses_[K] * x[K];
    ((x[K + 1 + J] -= rows_[K][K + 1 + J] * f), ...);
  }
  template <int... K>
  void backward_rows(const std::array<Lanes, N>& x, Vectors& y, std::integer_sequence<int, K...>) const {
    (backward_row<N - 1 - K>(x, y, std::make_integer_sequence<int, K + Matrix::kSides>()), ...);
  }
  /// The entry of y that was found last is used last, so that the other products need not wait for it.
  template <int K, int... J>
  void backward_row(const std::array<Lanes, N>& x, Vectors& y, std::integer_sequence<int, J...>) const {
    Lanes sum = x[K];
    ((sum -= rows_[K][Matrix::kRows - 1 - J] * y[Matrix::kRows - 1 - J]), ...);
    y[K] = sum * inverses_[K];
  }
  template <int... R>
  void factorise_blocks(Matrix& a, std::array<double, N>& pivots, std::integer_sequence<int, R...>) {
    (factorise_block<R>(a, pivots), ...);
  }
  template <int R>
  void factorise_block(Matrix& a, std::array<double, N>& pivots) {
    constexpr int blocks = kWidth / kBlock - R;
    for (int i = kBlock * R; i < std::min(kBlock * (R + 1), Matrix::kRows); ++i) {
      std::array<Lanes, blocks> row;
      for (int b = 0; b < blocks; ++b) row[b] = ConstBlock(&a.rows[i][kBlock * (R + b)]);
      for (int k = 0; k < std::min(i, N); ++k) {
        const double f = inverses_[k] * rows_[k][i];
        for (int b = 0; b < blocks; ++b) row[b] -= f * ConstBlock(&rows_[k][kBlock * (R + b)]);
      }
      double* out = i < N ? rows_[i].data() : a.rows[i].data();
      for (int b = 0; b < blocks; ++b) store(row[b], out + kBlock * (R + b));
      if (i >= N) continue;
      pivots[i] = out[i] == 0.0 ? 1e-300 : out[i];
      inverses_[i] = 1.0 / pivots[i];
      for (int j = kBlock * R; j <= i; ++j) out[j] = 0.0;
    }
  }

  alignas(32) std::array<std::array<double, kWidth>, N> rows_{};
  std::array<double, N> inverses_{};
};

}  // namespace snapthrough
