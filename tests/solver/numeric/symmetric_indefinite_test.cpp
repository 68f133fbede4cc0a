#include "solver/numeric/symmetric_indefinite.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

namespace snapthrough {
namespace {

/// A matrix that is one block.
SymmetricIndefinite factorised(const Eigen::MatrixXd& a) {
  std::vector<int> unknowns(static_cast<std::size_t>(a.rows()));
  std::iota(unknowns.begin(), unknowns.end(), 0);
  SymmetricIndefinite factor;
  factor.analyse(static_cast<int>(a.rows()), {unknowns});
  factor.factorise(std::vector<Eigen::MatrixXd>{a});
  return factor;
}

/// Random symmetric matrices, some with a zero diagonal: the inertia and determinant of Eigen's eigenvalues.
TEST(SymmetricIndefinite, SolvesAndCountsLikeTheEigenvalues) {
  std::srand(7);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 17;
    Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
    a = (a + a.transpose()).eval();
    if (trial % 3 == 0) a.diagonal().setZero();
    if (n == 1 && trial % 3 == 0) a(0, 0) = -2.0;
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues();
    SymmetricIndefinite factor = factorised(a);
    EXPECT_EQ(factor.inertia().negative, (eigenvalues.array() < 0.0).count())
        << "n = " << n << ", trial " << trial;
    EXPECT_EQ(factor.inertia().zero, 0);
    EXPECT_NEAR(factor.log_abs_det(), eigenvalues.array().abs().log().sum(), 1e-9);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(n);
    Eigen::VectorXd solved = a * x;
    factor.solve(solved);
    const double condition = eigenvalues.array().abs().maxCoeff() / eigenvalues.array().abs().minCoeff();
    EXPECT_LT((solved - x).norm(), 1e-14 * condition * n) << "trial " << trial;
  }
}

/// Members of a random frame: two nodes of three unknowns and three forces with a zero or small diagonal, so
/// that many unknowns find no pivot in their first front.
struct RandomFrame {
  std::vector<std::vector<int>> blocks;
  std::vector<Eigen::MatrixXd> values;
  Eigen::MatrixXd sum;

  RandomFrame(int nodes, int members, double flexibility) {
    const int size = 3 * (nodes - 1) + 3 * members;  // the first node is fixed
    sum = Eigen::MatrixXd::Zero(size, size);
    for (int m = 0; m < members; ++m) {
      // a chain holds all nodes together; the rest is anywhere
      const int a = m < nodes - 1 ? m : std::rand() % nodes;
      const int b = m < nodes - 1 ? m + 1 : std::rand() % nodes;
      std::vector<int> rows;
      for (const int first : {3 * a, 3 * b, 3 * nodes + 3 * m})
        for (int c = 0; c < 3; ++c) rows.push_back(first - 3 + c);
      Eigen::MatrixXd block = Eigen::MatrixXd::Zero(9, 9);
      block.topLeftCorner<3, 3>() = Eigen::Matrix3d::Random();
      block.block<3, 3>(6, 0) = Eigen::Matrix3d::Random();
      block.block<3, 3>(6, 3).setIdentity();
      block.bottomRightCorner<3, 3>() = flexibility * Eigen::Matrix3d::Random();
      block = block.selfadjointView<Eigen::Lower>();
      if (a == b) block.leftCols(3).setZero(), block.topRows(3).setZero();
      for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
          if (rows[i] >= 0 && rows[j] >= 0) sum(rows[i], rows[j]) += block(i, j);
      blocks.push_back(rows);
      values.push_back(block);
    }
  }
};

/// Matrices of many fronts: the inertia and determinant of Eigen's eigenvalues, and solutions as accurate as
/// a backward stable elimination gives them.
TEST(SymmetricIndefinite, ManyFrontsCountAndSolveLikeTheEigenvalues) {
  std::srand(11);
  for (const double flexibility : {0.0, 1e-9, 1e-3, 1.0}) {
    for (int trial = 0; trial < 12; ++trial) {
      const int nodes = 12 + 3 * trial;
      // rigid members that close a ring are singular
      const RandomFrame frame(nodes, flexibility == 0.0 ? nodes - 1 : nodes + 2 + trial, flexibility);
      const auto n = static_cast<int>(frame.sum.rows());
      const Eigen::VectorXd eigenvalues =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(frame.sum).eigenvalues();
      SymmetricIndefinite factor;
      factor.analyse(n, frame.blocks);
      factor.factorise(frame.values);
      SCOPED_TRACE(testing::Message() << n << " unknowns, flexibility " << flexibility);
      EXPECT_EQ(factor.inertia().negative, (eigenvalues.array() < 0.0).count());
      EXPECT_EQ(factor.inertia().zero, 0);
      const double condition = eigenvalues.array().abs().maxCoeff() / eigenvalues.array().abs().minCoeff();
      const double rounding = 1e-15 * condition * n;  // of the smallest eigenvalue, both ways
      EXPECT_NEAR(factor.log_abs_det(), eigenvalues.array().abs().log().sum(), rounding);
      const Eigen::VectorXd x = Eigen::VectorXd::Random(n);
      Eigen::VectorXd solved = frame.sum * x;
      factor.solve(solved);
      EXPECT_LT((solved - x).norm(), rounding);
    }
  }
}

/// Square frames of rigid joints: the factor grows as n log n where the order is a good one, and as n^2 where
/// there is none.
TEST(SymmetricIndefinite, TheFactorOfAFrameStaysSparse) {
  const auto entries = [](int bays) {
    std::vector<std::vector<int>> blocks;
    int next = 3 * (bays + 1) * (bays + 1);
    const auto add = [&](int a, int b) {
      blocks.push_back({3 * a, 3 * a + 1, 3 * a + 2, 3 * b, 3 * b + 1, 3 * b + 2, next, next + 1, next + 2});
      next += 3;
    };
    for (int i = 0; i <= bays; ++i)
      for (int j = 0; j < bays; ++j) {
        add(i * (bays + 1) + j, i * (bays + 1) + j + 1);
        add(j * (bays + 1) + i, (j + 1) * (bays + 1) + i);
      }
    const std::vector<FrontPlan> plan = plan_elimination(next, blocks);
    double count = 0.0;
    for (const FrontPlan& front : plan)
      count += static_cast<double>(front.pivots.size() * (front.pivots.size() + front.rest.size()));
    return count;
  };
  // twenty-five times as many unknowns: with the logarithm about thirty-eight times
  EXPECT_LT(entries(50), 45.0 * entries(10));
}

TEST(SymmetricIndefinite, ReportsAZeroPivot) {
  Eigen::MatrixXd a(3, 3);
  a << 2.0, 1.0, 3.0, 1.0, 0.5, 1.5, 3.0, 1.5,
      -1.0;  // row 2 is half of row 1 in the first two columns and the third
  SymmetricIndefinite factor = factorised(a);
  EXPECT_EQ(factor.inertia().zero, 1);
}

TEST(SymmetricIndefinite, AcceptsAnEmptyMatrix) {
  SymmetricIndefinite factor = factorised(Eigen::MatrixXd(0, 0));
  Eigen::VectorXd x(0);
  factor.solve(x);
  EXPECT_EQ(factor.inertia().negative, 0);
}

/// What diverges brings numbers that are none: they go on into the solution, nothing is read out of bounds.
TEST(SymmetricIndefinite, PassesOnWhatIsNotANumber) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(4, 4);
  a.diagonal().setConstant(std::numeric_limits<double>::quiet_NaN());
  SymmetricIndefinite factor = factorised(a);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(4);
  factor.solve(x);
  EXPECT_TRUE(x.array().isNaN().all());
}

}  // namespace
}  // namespace snapthrough
