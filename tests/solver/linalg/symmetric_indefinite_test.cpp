#include "solver/linalg/symmetric_indefinite.h"

#include <gtest/gtest.h>

#include <limits>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdlib>

namespace snapthrough {
namespace {

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
    SymmetricIndefinite factor;
    factor.factorise(a);
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

TEST(SymmetricIndefinite, ReportsAZeroPivot) {
  Eigen::MatrixXd a(3, 3);
  a << 2.0, 1.0, 3.0, 1.0, 0.5, 1.5, 3.0, 1.5,
      -1.0;  // row 2 is half of row 1 in the first two columns and the third
  SymmetricIndefinite factor;
  factor.factorise(a);
  EXPECT_EQ(factor.inertia().zero, 1);
  EXPECT_LT(factor.pivot_ratio(), 1e-15);
}

TEST(SymmetricIndefinite, AcceptsAnEmptyMatrix) {
  SymmetricIndefinite factor;
  factor.factorise(Eigen::MatrixXd(0, 0));
  Eigen::VectorXd x(0);
  factor.solve(x);
  EXPECT_EQ(factor.inertia().negative, 0);
}

/// What diverges brings numbers that are none: they go on into the solution, nothing is read out of bounds.
TEST(SymmetricIndefinite, PassesOnWhatIsNotANumber) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(4, 4);
  a.diagonal().setConstant(std::numeric_limits<double>::quiet_NaN());
  SymmetricIndefinite factor;
  factor.factorise(a);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(4);
  factor.solve(x);
  EXPECT_TRUE(x.array().isNaN().all());
}

}  // namespace
}  // namespace snapthrough
