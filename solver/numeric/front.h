#pragma once
/// @file
/// Dense step of a symmetric indefinite factorisation.

#include <Eigen/Core>
#include <vector>

namespace snapthrough {

/// Signs of the eigenvalues of a symmetric matrix.
struct Inertia {
  int negative = 0;
  int zero = 0;  ///< eigenvalues that are zero within the tolerance, of either computed sign
};

/// Summary of the pivots of a factorisation.
struct PivotSummary {
  double floor = 0.0;  ///< size up to which a pivot counts as zero
  Inertia inertia;
  double log_abs_det = 0.0;  ///< log |det|; zero pivots enter with their tiny replacement

  void note(double eigenvalue);
};

/// @brief Dense symmetric matrix whose first unknowns can be eliminated: P A P^T = L D L^T with 1 x 1 and 2 x
/// 2 pivots (Bunch and Kaufman, Math. Comp. 31, 1977).
///
/// If some rows cannot be pivots, a pivot must not be small relative to any row (Duff and Reid, ACM Trans.
/// Math. Softw. 9, 1983); unknowns without such a pivot remain. Backward stable for any inertia.
class Front {
 public:
  std::vector<int> unknowns;  ///< one per row; eliminate() moves those that it eliminates to the front
  Eigen::MatrixXd matrix;     ///< lower triangle; after elimination the factor and the Schur complement

  /// @brief Eliminates as many as possible of the first `summed` rows; all, if there are no other rows.
  /// @pre the entries are finite (otherwise solutions are not)
  void eliminate(Eigen::Index summed, PivotSummary& pivots);
  /// Number of eliminated rows.
  [[nodiscard]] Eigen::Index eliminated() const { return done_; }
  /// @brief Applies L^-1, D^-1 or L^-T of the eliminated rows to x, in the order of `unknowns`.
  void forward(Eigen::VectorXd& x) const;
  void scale(Eigen::VectorXd& x) const;
  void backward(Eigen::VectorXd& x) const;

 private:
  void swap_rows(Eigen::Index a, Eigen::Index b);
  bool try_pivot(PivotSummary& pivots);
  [[nodiscard]] Eigen::Index choose_beside(Eigen::Index row, double largest) const;
  [[nodiscard]] double largest_in_row(Eigen::Index row, Eigen::Index except) const;
  void eliminate_one(PivotSummary& pivots);
  void eliminate_two(PivotSummary& pivots);
  void update_rest();

  Eigen::Index summed_ = 0;
  Eigen::Index done_ = 0;
  std::vector<char> two_;   ///< true: a 2 x 2 pivot starts at this row
  Eigen::MatrixXd scaled_;  ///< scratch of update_rest()
};

}  // namespace snapthrough
