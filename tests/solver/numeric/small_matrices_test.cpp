/// Null spaces of sparse matrices, and factors of three rows.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solver/numeric/null_space.h"
#include "solver/numeric/small_factor.h"

namespace snapthrough {
namespace {

Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& dense) {
  Eigen::SparseMatrix<double> out = dense.sparseView();
  out.makeCompressed();
  return out;
}

/// A random matrix with a null space of two dimensions, and one that is nearly a third.
TEST(NullSpace, HasAsManyVectorsAsItHas) {
  std::srand(3);
  for (const double almost : {1.0, 1e-4}) {
    Eigen::MatrixXd v = Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd::Random(6, 6)).householderQ();
    Eigen::VectorXd values(6);
    values << 1.0, 0.7, 0.5, almost, 0.0, 0.0;
    const Eigen::MatrixXd b = v * values.asDiagonal() * v.transpose();
    NullSpace space(sparse(b), sparse(Eigen::MatrixXd::Identity(6, 6)), 1e-9);
    EXPECT_FALSE(space.too_dense());
    std::vector<Eigen::VectorXd> found;
    while (const auto x = space.next()) {
      ASSERT_LT(found.size(), 3U);
      EXPECT_NEAR(x->norm(), 1.0, 1e-12);
      EXPECT_LT((b * *x).norm(), 1e-12);
      for (const Eigen::VectorXd& other : found) EXPECT_NEAR(x->dot(other), 0.0, 1e-9);
      found.push_back(*x);
    }
    EXPECT_EQ(found.size(), 2U) << almost;
  }
}

TEST(NullSpace, IsEmptyOfARegularMatrix) {
  NullSpace space(sparse(Eigen::MatrixXd::Identity(4, 4)), sparse(Eigen::MatrixXd::Identity(4, 4)), 1e-9);
  EXPECT_FALSE(space.next());
}

TEST(SmallFactor, SolvesWithItsMatrixAndTheTransposedOne) {
  std::srand(5);
  for (int i = 0; i < 100; ++i) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Random();
    if (i % 3 == 0) a(0, 0) = 0.0;  // needs another pivot
    const SmallFactor factor(a);
    const Eigen::Vector3d x = Eigen::Vector3d::Random();
    const double size = 1e-13 * a.norm() * a.inverse().norm() * x.norm();
    EXPECT_NEAR((factor.solve(Eigen::Vector3d(a * x)) - x).norm(), 0.0, size);
    EXPECT_NEAR((factor.solve_transposed(a.transpose() * x) - x).norm(), 0.0, size);
    EXPECT_NEAR(factor.determinant(), a.determinant(), 1e-14);
    EXPECT_NEAR((factor.inverse() * a - Eigen::Matrix3d::Identity()).norm(), 0.0,
                1e-13 * a.norm() * a.inverse().norm());
  }
}

/// A singular one solves to something huge, not to no number.
TEST(SmallFactor, OfASingularMatrixIsFinite) {
  const SmallFactor factor(Eigen::Matrix3d::Zero());
  EXPECT_NE(factor.determinant(), 0.0);
  const SmallFactor rank_one(Eigen::Vector3d(1.0, 2.0, 3.0) * Eigen::RowVector3d(1.0, 1.0, 1.0));
  EXPECT_GT(rank_one.solve(Eigen::Vector3d(1.0, 0.0, 0.0)).norm(), 1e100);
}

}  // namespace
}  // namespace snapthrough
