#include "solver/numeric/nonnegative_least_squares.h"

#include <algorithm>
#include <vector>

#include "solver/numeric/dense.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// State of the active set method: x is positive on `passive` and zero elsewhere.
class ActiveSet {
 public:
  /// Most steps over rows plus columns; about twice the number of rows is usual.
  static constexpr Index most_steps = 10;

  ActiveSet(const MatrixXd& A, const VectorXd& b)
      : A_(A), b_(b), sizes_(A.colwise().norm()), x_(VectorXd::Zero(A.cols())), residual_(b) {}

  /// Adds the column with the largest reduction of the residual. @return false: none is left
  [[nodiscard]] bool advance();
  [[nodiscard]] NonnegativeSolution solution() const { return {x_, residual_}; }

 private:
  [[nodiscard]] Index steepest(const std::vector<Index>& rejected) const;
  [[nodiscard]] VectorXd passive_solution() const { return least_squares(A_(Eigen::all, passive_), b_); }
  void move_to(VectorXd wanted);

  const MatrixXd& A_;
  const VectorXd& b_;
  VectorXd sizes_;
  VectorXd x_;
  VectorXd residual_;
  std::vector<Index> passive_;
};

/// Column with the largest component of the residual, above rounding; -1: none.
Index ActiveSet::steepest(const std::vector<Index>& rejected) const {
  const double rounding = Rounding::inner_product * (b_.norm() + sizes_.dot(x_));
  Index best = -1;
  double largest = rounding;
  for (Index j = 0; j < A_.cols(); ++j) {
    if (!(sizes_[j] > 0.0) || x_[j] > 0.0) continue;
    const double slope = A_.col(j).dot(residual_) / sizes_[j];
    if (slope <= largest || std::find(rejected.begin(), rejected.end(), j) != rejected.end()) continue;
    best = j;
    largest = slope;
  }
  return best;
}

/// Moves x towards the least squares solution on the passive columns; removes columns whose unknown reaches
/// zero, until that solution is positive.
void ActiveSet::move_to(VectorXd wanted) {
  while (!(wanted.array() > 0.0).all()) {
    double share = 1.0;
    Index first = -1;
    for (Index i = 0; i < wanted.size(); ++i) {
      const double now = x_[passive_[static_cast<std::size_t>(i)]];
      if (wanted[i] > 0.0 || (first >= 0 && now >= share * (now - wanted[i]))) continue;
      share = now > 0.0 ? now / (now - wanted[i]) : 0.0;
      first = i;
    }
    for (Index i = 0; i < wanted.size(); ++i) {
      double& x = x_[passive_[static_cast<std::size_t>(i)]];
      x = i == first ? 0.0 : std::max(0.0, x + share * (wanted[i] - x));
    }
    passive_.erase(passive_.begin() + first);
    if (passive_.empty()) return;
    wanted = passive_solution();
  }
  for (Index i = 0; i < wanted.size(); ++i) x_[passive_[static_cast<std::size_t>(i)]] = wanted[i];
}

bool ActiveSet::advance() {
  std::vector<Index> rejected;
  for (Index next = steepest(rejected); next >= 0; next = steepest(rejected)) {
    passive_.push_back(next);
    const VectorXd wanted = passive_solution();
    if (wanted[wanted.size() - 1] > 0.0) {
      move_to(wanted);
      residual_ = b_ - A_ * x_;
      return true;
    }
    passive_.pop_back();  // the column's gradient component was rounding
    rejected.push_back(next);
  }
  return false;
}

}  // namespace

NonnegativeSolution nonnegative_least_squares(const MatrixXd& A, const VectorXd& b) {
  ActiveSet set(A, b);
  for (Index step = 0; step < ActiveSet::most_steps * (A.cols() + A.rows()); ++step)
    if (!set.advance()) break;
  return set.solution();
}

}  // namespace snapthrough
