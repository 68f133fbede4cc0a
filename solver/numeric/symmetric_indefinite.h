#pragma once
/// @file
/// Sparse symmetric indefinite factorisation with inertia.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/numeric/elimination_plan.h"
#include "solver/numeric/front.h"

namespace snapthrough {

/// @brief A symmetric matrix that is the sum of small dense blocks, factorised front by front (Duff and Reid,
/// ACM Trans. Math. Softw. 9, 1983).
///
/// Unknowns that find no good pivot in their front wait for the next one, so that the factorisation is
/// backward stable whatever the inertia. A small matrix is one dense front. Not thread safe while
/// factorising.
class SymmetricIndefinite {
 public:
  /// @brief Plans the elimination.
  /// @param blocks unknowns of each block; negative ones are left out
  void analyse(int size, std::vector<std::vector<int>> blocks);
  /// @brief Factorises the sum of the blocks, of which the lower triangles are read. A pivot below
  /// `tolerance` times the largest entry of a block counts as zero. When an entry is not finite, neither are
  /// the solutions.
  /// @pre one matrix a block of analyse(), of its size
  void factorise(std::span<const Eigen::MatrixXd> values, double tolerance = 1e-15);
  /// @brief Solves in place, `x` of the size of the matrix.
  void solve(Eigen::Ref<Eigen::VectorXd> x);
  [[nodiscard]] int size() const { return size_; }
  /// Unknowns of each block, as analyse() was given them.
  [[nodiscard]] const std::vector<std::vector<int>>& blocks() const { return blocks_; }
  [[nodiscard]] Inertia inertia() const { return pivots_.inertia; }
  /// log |det|; a zero pivot counts with its tiny replacement.
  [[nodiscard]] double log_abs_det() const { return pivots_.log_abs_det; }
  /// Entries of the factor.
  [[nodiscard]] Eigen::Index entries() const;

 private:
  Eigen::Index start_front(std::size_t number);
  void assemble(std::size_t number, std::span<const Eigen::MatrixXd> values);

  int size_ = 0;
  std::vector<std::vector<int>> blocks_;
  std::vector<FrontPlan> plan_;
  std::vector<Front> fronts_;
  std::vector<int> row_;   ///< of each unknown in the front that is being built
  Eigen::VectorXd local_;  ///< scratch of solve()
  PivotSummary pivots_;
  bool finite_ = true;
};

}  // namespace snapthrough
