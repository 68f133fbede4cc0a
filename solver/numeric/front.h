#pragma once
/// @file
/// One dense step of a symmetric indefinite factorisation: rows that are eliminated, and what is left.

#include <Eigen/Core>
#include <vector>

namespace snapthrough {

/// Signs of the eigenvalues of a symmetric matrix.
struct Inertia {
  int negative = 0;
  int zero = 0;  ///< how many are zero to the tolerance, whatever their computed sign
};

/// What the pivots of a factorisation say.
struct PivotSummary {
  double floor = 0.0;  ///< a pivot of at most this size counts as zero
  Inertia inertia;
  double log_abs_det = 0.0;  ///< a zero pivot counts with its tiny replacement

  void note(double eigenvalue);
};

/// @brief A dense symmetric matrix over some unknowns, of which the first can be eliminated: P A P^T = L D
/// L^T with 1 x 1 and 2 x 2 pivots (Bunch and Kaufman, Math. Comp. 31, 1977).
///
/// Where not all rows can be pivots, a pivot must not be small beside any row (Duff and Reid, ACM Trans.
/// Math. Softw. 9, 1983); unknowns without such a pivot stay. Backward stable whatever the inertia.
class Front {
 public:
  std::vector<int> unknowns;  ///< of the rows; eliminate() puts those first that it eliminates
  Eigen::MatrixXd matrix;     ///< lower triangle; afterwards the factor, and what is left of the others

  /// @brief Eliminates what it can of the first `summed` rows; all when there are no others.
  /// @pre the entries are finite, or the solutions need not be
  void eliminate(Eigen::Index summed, PivotSummary& pivots);
  /// How many rows were eliminated.
  [[nodiscard]] Eigen::Index eliminated() const { return done_; }
  /// @brief L^-1, then D^-1 of the eliminated rows, then L^-T; each on x in the order of `unknowns`.
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
  std::vector<char> two_;   ///< a 2 x 2 pivot starts here
  Eigen::MatrixXd scaled_;  ///< scratch of update_rest()
};

}  // namespace snapthrough
