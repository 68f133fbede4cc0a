/// Solutions of a chain against a dense factorisation, where part of it is at a buckling load of its own.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "solver/member/chain.h"

namespace snapthrough {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kElements = 30;
constexpr double kLength = 1.0 / kElements;

/// Elements with their right-hand sides.
struct Bars {
  std::vector<CondensedElement> elements = std::vector<CondensedElement>(kElements);
  std::vector<Eigen::Vector3d> forces = std::vector<Eigen::Vector3d>(kElements);
};

/// Rigid bars with a hinge of some flexibility at each end under a dead thrust, the last third on stiff
/// springs: an unpropped cantilever of some of the bars buckles before the whole does.
Bars bars(double thrust) {
  Bars out;
  for (int i = 0; i < kElements; ++i) {
    CondensedElement& bar = out.elements[i];
    Matrix3d transfer = Matrix3d::Identity();
    transfer(1, 2) = kLength;
    bar.X = -transfer;
    bar.F = Eigen::Vector3d(1e-6 * kLength, 1e-3 * kLength, kLength).asDiagonal();
    bar.K = Matrix3d::Zero();
    bar.K(2, 2) = -thrust * kLength;
    if (3 * i >= 2 * kElements) bar.K(1, 1) = 1e7 * kLength;
    out.forces[i] = Eigen::Vector3d(0.1, 1.0 + std::sin(3.0 * i), 0.0);
  }
  return out;
}

/// Unknowns: the displacement at each bar's start but the first, and the force through each bar's end.
VectorXd dense_solution(const Bars& given) {
  const auto& elements = given.elements;
  const int n = kElements;
  MatrixXd A = MatrixXd::Zero(6 * n - 3, 6 * n - 3);
  VectorXd b = VectorXd::Zero(6 * n - 3);
  const auto u = [](int i) { return 3 * (i - 1); };
  const auto m = [n](int i) { return 3 * (n - 1) + 3 * i; };
  for (int i = 0; i < n; ++i) {
    if (i > 0) {
      A.block<3, 3>(u(i), u(i)) += elements[i].K;
      A.block<3, 3>(u(i), m(i)) += elements[i].X.transpose();
      A.block<3, 3>(m(i), u(i)) += elements[i].X;
      b.segment<3>(u(i)) += given.forces[i];
    }
    A.block<3, 3>(m(i), m(i)) -= elements[i].F;
    if (i + 1 < n) A.block<3, 3>(m(i), u(i + 1)) += Matrix3d::Identity();
    if (i + 1 < n) A.block<3, 3>(u(i + 1), m(i)) += Matrix3d::Identity();
  }
  using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  return Wide(A.cast<long double>()).partialPivLu().solve(b.cast<long double>()).cast<double>();
}

/// The same by the chain: both ends are held, so the end's force follows from F m = -r. Each of the four
/// right-hand sides is solved, the last three being multiples of the first.
VectorXd chain_solution(const Bars& given) {
  std::vector<ElementDofs> dofs(kElements);
  for (int i = 0; i < kElements; ++i) {
    const int at = 6 * i;
    dofs[i].a = {at, at + 1, at + 2};
    dofs[i].m = at + 3;
    dofs[i].b = {at + 6, at + 7, at + 8};
  }
  Chain chain;
  chain.factorise(given.elements);
  std::vector<CondensedForces> forces(kElements);
  const Lanes multiples(1.0, -2.0, 0.5, 4.0);
  for (int i = 0; i < kElements; ++i)
    for (int c = 0; c < 3; ++c) {
      forces[i].ra[c] = given.forces[i][c] * multiples;
      forces[i].rm[c] = Lanes::Zero();
    }
  MatrixXd block = MatrixXd::Zero(6 * kElements + 3, kLanes);
  const ColumnLanes lanes(block, 0);
  const CondensedForces ends = chain.reduce(forces, dofs, lanes);
  const Matrix3d F = chain.ends().F;
  for (int l = 0; l < kLanes; ++l)
    block.col(l).segment<3>(dofs.back().m) =
        -F.fullPivLu().solve(Eigen::Vector3d(ends.rm[0][l], ends.rm[1][l], ends.rm[2][l]));
  chain.recover(forces, dofs, lanes);
  const VectorXd x = block.col(0);
  for (int l = 1; l < kLanes; ++l) EXPECT_EQ(block.col(l), multiples[l] * x) << "powers of two do not round";
  VectorXd out(6 * kElements - 3);
  for (int i = 0; i < kElements; ++i) {
    if (i > 0) out.segment<3>(3 * (i - 1)) = x.segment<3>(6 * i);
    out.segment<3>(3 * (kElements - 1) + 3 * i) = x.segment<3>(6 * i + 3);
  }
  return out;
}

/// Thrust at which the first `count` bars, held at their start and free at their end, buckle.
double cantilever_load(int count) {
  const double pi = std::acos(-1.0);
  return (2.0 - 2.0 * std::cos(pi / (2.0 * count - 1.0))) / (kLength * kLength);
}

TEST(ChainSolve, KeepsItsDigitsWhereAPartBucklesOnItsOwn) {
  for (int count = 12; count < kElements; ++count)
    for (const double off : {0.0, 1e-12, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3}) {
      const Bars given = bars(cantilever_load(count) * (1.0 + off));
      const VectorXd exact = dense_solution(given);
      // a thousand roundings times the ratio of stiff to soft; a run that is taken at its own buckling load
      // loses all digits
      EXPECT_LT((chain_solution(given) - exact).norm(), 1e-8 * exact.norm()) << count << " bars, " << off;
    }
}

/// Two springs side by side, as a patch of a stiff base: an error of 1e-15 in what each moves is one of 1e-15
/// times its stiffness in the forces. Formed as an inverse, the pivot loses the ratio of stiff to soft twice.
TEST(ChainSolve, KeepsItsDigitsBesideAPatchOfAStiffBase) {
  constexpr double kRounding = 1e-15;
  for (const double k : {1e6, 1e8, 1e10, 1e12})
    for (int at = 1; at < kElements; ++at) {
      Bars given = bars(0.5);
      for (const double arm : {0.0, 0.1 * kLength}) {
        const Eigen::Vector3d spring(0.6, 0.8, arm);
        given.elements[at].K += k * spring * spring.transpose();
      }
      const VectorXd exact = dense_solution(given);
      const VectorXd found = chain_solution(given);
      EXPECT_LT((found - exact).norm(), kRounding * k * exact.norm()) << "springs " << k << " at " << at;
    }
}

}  // namespace
}  // namespace snapthrough
