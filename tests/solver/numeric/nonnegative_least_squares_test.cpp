/// Non-negative least squares, against closed forms and its optimality conditions.
#include "solver/numeric/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>

namespace snapthrough {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Two rays at right angles: each unknown is the projection, cut off at zero.
TEST(NonnegativeLeastSquares, ProjectsOnOrthogonalRays) {
  const MatrixXd A = MatrixXd::Identity(2, 2);
  for (const auto& [x, y] : {std::pair{1.0, 2.0}, {-1.0, 2.0}, {3.0, -4.0}, {-1.0, -1.0}, {0.0, 0.0}}) {
    const NonnegativeSolution found = nonnegative_least_squares(A, Vector2d(x, y));
    EXPECT_NEAR(found.x[0], std::max(x, 0.0), 1e-15);
    EXPECT_NEAR(found.x[1], std::max(y, 0.0), 1e-15);
    EXPECT_NEAR(found.residual[0], std::min(x, 0.0), 1e-15);
    EXPECT_NEAR(found.residual[1], std::min(y, 0.0), 1e-15);
  }
}

TEST(NonnegativeLeastSquares, WithoutColumnsLeavesEverything) {
  const NonnegativeSolution found = nonnegative_least_squares(MatrixXd(2, 0), Vector2d(1.0, -1.0));
  EXPECT_EQ(found.x.size(), 0);
  EXPECT_EQ(found.residual, VectorXd(Vector2d(1.0, -1.0)));
}

/// Columns that positively span the plane leave nothing, whatever is asked.
TEST(NonnegativeLeastSquares, PositiveSpanBalancesAll) {
  MatrixXd A(2, 3);
  A << 1.0, -0.5, -0.5, 0.0, 0.8, -0.8;
  for (int i = 0; i < 16; ++i) {
    const Vector2d b(std::cos(0.4 * i), std::sin(0.4 * i));
    const NonnegativeSolution found = nonnegative_least_squares(A, b);
    EXPECT_LT(found.residual.norm(), 1e-15);
    EXPECT_GE(found.x.minCoeff(), 0.0);
  }
}

/// Optimality (Karush, Kuhn, Tucker) on random matrices of all shapes, with repeated, opposite, zero and
/// nearly dependent columns.
TEST(NonnegativeLeastSquares, MeetsItsOptimalityConditions) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  int inside = 0;
  int outside = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int rows = 1 + trial % 9;
    const int columns = 1 + static_cast<int>(random() % 30U);
    MatrixXd A(rows, columns);
    for (int j = 0; j < columns; ++j) {
      for (int i = 0; i < rows; ++i) A(i, j) = normal(random);
      if (j == 0) continue;
      const int before = static_cast<int>(random() % static_cast<unsigned>(j));
      const unsigned kind = random() % 8U;
      if (kind == 0) A.col(j) = A.col(before);
      if (kind == 1) A.col(j) = -2.0 * A.col(before);
      // a residual along their difference has a slope that is rounding's: not where b is in the cone
      if (kind == 2 && trial % 3 != 0) A.col(j) = A.col(before) + 1e-9 * A.col(j);
      if (kind == 3) A.col(j).setZero();
    }
    VectorXd b(rows);
    for (int i = 0; i < rows; ++i) b[i] = normal(random);
    if (trial % 3 == 0) b = A * VectorXd::Constant(columns, 0.3);
    const NonnegativeSolution found = nonnegative_least_squares(A, b);
    ASSERT_GE(found.x.minCoeff(), 0.0) << trial;
    EXPECT_LT((b - A * found.x - found.residual).norm(), 1e-10) << trial;
    const double rounding = 1e-13 * (b.norm() + A.colwise().norm().dot(found.x));
    for (int j = 0; j < columns; ++j) {
      const double slope = A.col(j).dot(found.residual);
      EXPECT_LE(slope, rounding * A.col(j).norm()) << trial;
      if (found.x[j] > 0.0) {
        EXPECT_GE(slope, -rounding * A.col(j).norm()) << trial;
      }
    }
    if (trial % 3 == 0) {
      EXPECT_LT(found.residual.norm(), rounding) << trial << ": in the cone";
    }
    (found.residual.norm() < rounding ? inside : outside) += 1;
  }
  EXPECT_GT(inside, 600);
  EXPECT_GT(outside, 300);
}

}  // namespace
}  // namespace snapthrough
