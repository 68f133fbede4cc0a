/// The inertia of two joined runs against the eigenvalues of the matrix it stands for.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "solver/member/chain.h"

namespace snapthrough {
namespace {

using Eigen::Matrix3d;

int negative_by_eigenvalues(const Matrix3d& F, const Matrix3d& K) {
  Eigen::Matrix<double, 6, 6> A;
  A << -F, Matrix3d::Identity(), Matrix3d::Identity(), K;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(A, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array() < 0.0).count()) - 3;
}

/// Symmetric with eigenvalues of either sign.
Matrix3d random_symmetric(std::mt19937& generator, double shift) {
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  Matrix3d A;
  for (int i = 0; i < 9; ++i) A(i % 3, i / 3) = entry(generator);
  const Matrix3d Q = Eigen::HouseholderQR<Matrix3d>(A).householderQ();
  const Eigen::Vector3d values(entry(generator) + shift, 3.0 * (entry(generator) + shift),
                               10.0 * (entry(generator) + shift));
  return Q * values.asDiagonal() * Q.transpose();
}

TEST(ChainInertia, IsThatOfTheEigenvalues) {
  std::mt19937 generator(7);
  int found[7] = {};
  for (int i = 0; i < 3000; ++i) {
    const Matrix3d F = random_symmetric(generator, i % 3 == 0 ? 0.0 : 1.0);
    const Matrix3d K = random_symmetric(generator, 0.0);
    const int expected = negative_by_eigenvalues(F, K);
    ASSERT_EQ(extra_negative(F, K), expected) << "F\n" << F << "\nK\n" << K;
    ++found[expected + 3];
  }
  for (const int count : {found[2], found[3], found[4], found[5]}) EXPECT_GT(count, 20);
}

/// Rows of forces and moments, or of stiff and soft directions, differ by orders of magnitude: a
/// congruence that scales them does not change the inertia.
TEST(ChainInertia, DoesNotDependOnTheScaleOfItsRows) {
  std::mt19937 generator(8);
  const Eigen::Vector3d scale(1e2, 1.0, 1e-2);
  for (int i = 0; i < 500; ++i) {
    const Matrix3d F = random_symmetric(generator, i % 2 == 0 ? 0.0 : 1.0);
    const Matrix3d K = random_symmetric(generator, 0.0);
    const Matrix3d scaled_F = scale.asDiagonal() * F * scale.asDiagonal();
    const Matrix3d scaled_K = scale.cwiseInverse().asDiagonal() * K * scale.cwiseInverse().asDiagonal();
    ASSERT_EQ(extra_negative(scaled_F, scaled_K), negative_by_eigenvalues(F, K));
  }
}

/// Zero diagonals need block pivots.
TEST(ChainInertia, OfPureCouplings) {
  const Matrix3d one = Matrix3d::Identity();
  EXPECT_EQ(extra_negative(Matrix3d::Zero(), Matrix3d::Zero()), 0);
  EXPECT_EQ(extra_negative(Matrix3d::Zero(), -5.0 * one), 0);
  EXPECT_EQ(extra_negative(one, -5.0 * one), 3);
  EXPECT_EQ(extra_negative(-one, -5.0 * one), 0);
  EXPECT_EQ(extra_negative(-one, 5.0 * one), -3);
}

}  // namespace
}  // namespace snapthrough
