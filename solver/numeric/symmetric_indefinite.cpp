#include "solver/numeric/symmetric_indefinite.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void SymmetricIndefinite::analyse(int size, std::vector<std::vector<int>> blocks) {
  size_ = size;
  blocks_ = std::move(blocks);
  plan_ = plan_elimination(size, blocks_);
  fronts_.assign(plan_.size(), {});
  row_.assign(static_cast<std::size_t>(size), -1);
}

/// Collects the unknowns of a front with those delayed by its children. @return number that can be eliminated
Index SymmetricIndefinite::start_front(std::size_t number) {
  const FrontPlan& plan = plan_[number];
  Front& front = fronts_[number];
  front.unknowns = plan.pivots;
  for (const int c : plan.children) {
    const Front& child = fronts_[c];
    const std::size_t summed = child.unknowns.size() - plan_[c].rest.size();
    front.unknowns.insert(front.unknowns.end(), child.unknowns.begin() + child.eliminated(),
                          child.unknowns.begin() + static_cast<std::ptrdiff_t>(summed));
  }
  const auto summed = static_cast<Index>(front.unknowns.size());
  front.unknowns.insert(front.unknowns.end(), plan.rest.begin(), plan.rest.end());
  return summed;
}

/// Adds the front's blocks and the Schur complements of its children.
void SymmetricIndefinite::assemble(std::size_t number, std::span<const MatrixXd> values) {
  const FrontPlan& plan = plan_[number];
  Front& front = fronts_[number];
  const auto n = static_cast<Index>(front.unknowns.size());
  front.matrix.setZero(n, n);
  for (Index i = 0; i < n; ++i) row_[front.unknowns[i]] = static_cast<int>(i);
  const auto add = [&](std::span<const int> unknowns, const auto& block) {
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      if (unknowns[j] < 0) continue;
      for (std::size_t i = j; i < unknowns.size(); ++i) {
        if (unknowns[i] < 0) continue;
        const auto [low, high] = std::minmax(row_[unknowns[i]], row_[unknowns[j]]);
        front.matrix(high, low) += block(static_cast<Index>(i), static_cast<Index>(j));
      }
    }
  };
  for (const int b : plan.blocks) add(blocks_[b], values[b]);
  for (const int c : plan.children) {
    const Front& child = fronts_[c];
    const Index left = child.matrix.rows() - child.eliminated();
    add(std::span(child.unknowns).subspan(static_cast<std::size_t>(child.eliminated())),
        child.matrix.bottomRightCorner(left, left));
  }
}

void SymmetricIndefinite::factorise(std::span<const MatrixXd> values, double tolerance) {
  double scale = 0.0;
  double sum = 0.0;
  for (const MatrixXd& block : values)
    for (Index j = 0; j < block.cols(); ++j)
      for (Index i = j; i < block.rows(); ++i) {
        scale = std::max(scale, std::abs(block(i, j)));
        sum += std::abs(block(i, j));
      }
  pivots_ = {};
  pivots_.floor = tolerance * scale;
  finite_ = std::isfinite(sum);
  if (!finite_) return;
  for (std::size_t k = 0; k < fronts_.size(); ++k) {
    const Index summed = start_front(k);
    assemble(k, values);
    fronts_[k].eliminate(summed, pivots_);
  }
}

void SymmetricIndefinite::solve(Eigen::Ref<VectorXd> x) {
  if (!finite_) {
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const auto gather = [&](const Front& front) {
    local_.resize(static_cast<Index>(front.unknowns.size()));
    for (Index i = 0; i < local_.size(); ++i) local_[i] = x[front.unknowns[i]];
  };
  const auto scatter = [&](const Front& front) {
    for (Index i = 0; i < local_.size(); ++i) x[front.unknowns[i]] = local_[i];
  };
  for (const Front& front : fronts_) {
    gather(front);
    front.forward(local_);
    front.scale(local_);
    scatter(front);
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    gather(*front);
    front->backward(local_);
    scatter(*front);
  }
}

Index SymmetricIndefinite::entries() const {
  Index count = 0;
  for (const Front& front : fronts_) count += front.eliminated() * static_cast<Index>(front.unknowns.size());
  return count;
}

}  // namespace snapthrough
