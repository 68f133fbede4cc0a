#pragma once
/// @file
/// Sparse symmetric indefinite factorisation with inertia.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/numeric/elimination_plan.h"
#include "solver/numeric/front.h"

namespace snapthrough {

/// @brief Multifrontal factorisation of a symmetric matrix that is a sum of small dense blocks (Duff and
/// Reid, ACM Trans. Math. Softw. 9, 1983).
///
/// Unknowns without a good pivot are delayed to the next front, so that the factorisation is backward stable
/// for any inertia. A small matrix is one dense front. Not thread safe during factorisation.
class SymmetricIndefinite {
 public:
  /// @brief Plans the elimination.
  /// @param blocks unknowns of each block; negative entries are ignored
  void analyse(int size, std::vector<std::vector<int>> blocks);
  /// @brief Factorises the sum of the blocks, reading lower triangles. Pivots below `tolerance` times the
  /// largest entry of a block count as zero. Non-finite entries give non-finite solutions.
  /// @pre one matrix per block of analyse(), of matching size
  void factorise(std::span<const Eigen::MatrixXd> values, double tolerance = 1e-15);
  /// @brief Solves in place. @pre x.size() == size()
  void solve(Eigen::Ref<Eigen::VectorXd> x);
  [[nodiscard]] int size() const { return size_; }
  /// Unknowns of each block, as passed to analyse().
  [[nodiscard]] const std::vector<std::vector<int>>& blocks() const { return blocks_; }
  [[nodiscard]] Inertia inertia() const { return pivots_.inertia; }
  /// log |det|; zero pivots enter with their tiny replacement.
  [[nodiscard]] double log_abs_det() const { return pivots_.log_abs_det; }
  /// Number of entries of the factor.
  [[nodiscard]] Eigen::Index entries() const;

 private:
  Eigen::Index start_front(std::size_t number);
  void assemble(std::size_t number, std::span<const Eigen::MatrixXd> values);

  int size_ = 0;
  std::vector<std::vector<int>> blocks_;
  std::vector<FrontPlan> plan_;
  std::vector<Front> fronts_;
  std::vector<int> row_;   ///< row of each unknown in the current front
  Eigen::VectorXd local_;  ///< scratch of solve()
  PivotSummary pivots_;
  bool finite_ = true;
};

}  // namespace snapthrough
