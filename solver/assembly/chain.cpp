#include "solver/assembly/chain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace snapthrough {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Lower Cholesky factor of a positive semidefinite F; empty when F is clearly not semidefinite.
std::optional<Matrix3d> semidefinite_root(const Matrix3d& F) {
  Matrix3d L = Matrix3d::Zero();
  const double floor = 1e-13 * F.diagonal().cwiseAbs().maxCoeff();
  for (int j = 0; j < 3; ++j) {
    double d = F(j, j);
    for (int k = 0; k < j; ++k) d -= L(j, k) * L(j, k);
    if (d < -floor) return std::nullopt;
    if (d <= 1e-3 * floor) continue;  // a rigid direction
    L(j, j) = std::sqrt(d);
    for (int i = j + 1; i < 3; ++i) {
      double sum = F(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum / L(j, j);
    }
  }
  return L;
}

int count_negative(const Eigen::VectorXd& eigenvalues) {
  return static_cast<int>((eigenvalues.array() < 0.0).count());
}

/// Whether all pivots of C = L D L^T are well above zero.
bool clearly_positive(const Matrix3d& C) {
  const double d0 = C(0, 0);
  if (d0 < 1e-2) return false;
  const double l10 = C(1, 0) / d0;
  const double l20 = C(2, 0) / d0;
  const double d1 = C(1, 1) - l10 * C(1, 0);
  if (d1 < 1e-2) return false;
  const double l21 = (C(2, 1) - l20 * C(1, 0)) / d1;
  return C(2, 2) - l20 * C(2, 0) - l21 * l21 * d1 > 1e-2;
}

}  // namespace

int extra_negative(const Matrix3d& F, const Matrix3d& K) {
  if (const auto L = semidefinite_root(F)) {
    const Matrix3d C = Matrix3d::Identity() + L->transpose() * K * *L;
    if (clearly_positive(C)) return 0;
    return count_negative(Eigen::SelfAdjointEigenSolver<Matrix3d>(C, Eigen::EigenvaluesOnly).eigenvalues());
  }
  Eigen::Matrix<double, 6, 6> A;
  A << -F, Matrix3d::Identity(), Matrix3d::Identity(), K;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(A, Eigen::EigenvaluesOnly);
  return count_negative(solver.eigenvalues()) - 3;
}

void Chain::factorise(std::span<const CondensedElement> elements) {
  ends_ = elements.front();
  nodes_.resize(elements.size() - 1);
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const CondensedElement& next = elements[i];
    Node& node = nodes_[i - 1];
    node.X = ends_.X;
    node.F = ends_.F;
    const Matrix3d pivot = Matrix3d::Identity() + next.K * node.F;
    double det = pivot.determinant();
    if (det == 0.0) det = std::numeric_limits<double>::min();
    node.M = pivot.inverse();
    const Matrix3d MK = node.M * next.K;
    const Matrix3d FM = node.F * node.M;
    ends_.K += node.X.transpose() * MK * node.X;
    ends_.X = -next.X * (node.X - node.F * MK * node.X);
    ends_.F = next.F + next.X * FM * next.X.transpose();
    // rounding only: both are symmetric
    ends_.K = 0.5 * (ends_.K + ends_.K.transpose()).eval();
    ends_.F = 0.5 * (ends_.F + ends_.F.transpose()).eval();
    ends_.negative += next.negative + extra_negative(node.F, next.K);
    ends_.log_det += next.log_det + std::log(std::abs(det));
  }
}

void Chain::reduce(std::span<const CondensedElement> elements, std::span<const ElementDofs> dofs,
                   const Eigen::VectorXd& rhs) {
  ends_.ra = elements.front().ra;
  ends_.rm = elements.front().rm;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const CondensedElement& next = elements[i];
    Node& node = nodes_[i - 1];
    node.c1 = ends_.rm;
    node.c2 = next.ra;
    for (int c = 0; c < 3; ++c) node.c2[c] += rhs[dofs[i].a[c]];
    const Vector3d m = node.M * (node.c2 - next.K * node.c1);
    ends_.ra -= node.X.transpose() * m;
    ends_.rm = next.rm - next.X * (node.c1 + node.F * m);
  }
}

void Chain::recover(std::span<const CondensedElement> elements, std::span<const ElementDofs> dofs,
                    Eigen::VectorXd& x) const {
  const auto& start = dofs.front().a;
  const Vector3d us(x[start[0]], x[start[1]], x[start[2]]);
  Vector3d m = x.segment<3>(dofs.back().m);
  for (std::size_t i = nodes_.size(); i > 0; --i) {
    const CondensedElement& next = elements[i];
    const Node& node = nodes_[i - 1];
    const Vector3d free = node.c1 - node.X * us;
    const Vector3d inner = node.M * (node.c2 - next.X.transpose() * m - next.K * free);
    const Vector3d u = free + node.F * inner;
    for (int c = 0; c < 3; ++c) x[dofs[i].a[c]] = u[c];
    x.segment<3>(dofs[i - 1].m) = inner;
    m = inner;
  }
}

}  // namespace snapthrough
