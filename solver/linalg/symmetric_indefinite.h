#pragma once
/// @file
/// Dense symmetric indefinite factorisation with inertia.

#include <Eigen/Core>
#include <vector>

namespace snapthrough {

/// Signs of the eigenvalues of a symmetric matrix.
struct Inertia {
  int negative = 0;
  int zero = 0;  ///< how many are zero to the tolerance, whatever their computed sign
};

/// @brief P A P^T = L D L^T with 1 x 1 and 2 x 2 pivots (Bunch and Kaufman, Math. Comp. 31, 1977).
///
/// Reads the lower triangle only. Backward stable whatever the inertia. Not thread safe while factorising.
class SymmetricIndefinite {
 public:
  /// @brief Factorises a (n x n). A pivot below `tolerance` times the largest entry counts as zero. When an
  /// entry is not finite, so are the solutions, and the pivot ratio is 0.
  void factorise(const Eigen::MatrixXd& a, double tolerance = 1e-15);
  /// @brief Solves in place, `x` of size n.
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;
  [[nodiscard]] Inertia inertia() const { return inertia_; }
  /// log |det|; a zero pivot counts with its tiny replacement.
  [[nodiscard]] double log_abs_det() const { return log_abs_det_; }
  /// Smallest pivot (eigenvalue of a pivot block) over the largest, in absolute value.
  [[nodiscard]] double pivot_ratio() const { return pivot_ratio_; }

 private:
  void swap_rows(Eigen::Index a, Eigen::Index b, Eigen::Index done);
  void refuse();
  void note_pivot(double eigenvalue);
  Eigen::Index eliminate_one(Eigen::Index k);
  Eigen::Index eliminate_two(Eigen::Index k);

  Eigen::MatrixXd l_;
  std::vector<Eigen::Index> swap_;  ///< row exchanged with row k when k was eliminated
  std::vector<char> two_;           ///< k starts a 2 x 2 pivot
  Inertia inertia_;
  double log_abs_det_ = 0.0;
  double smallest_ = 0.0;
  double largest_ = 0.0;
  double floor_ = 0.0;
  double pivot_ratio_ = 0.0;
};

}  // namespace snapthrough
