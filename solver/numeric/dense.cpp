#include "solver/numeric/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <type_traits>

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd symmetric_part(const MatrixXd& A) { return 0.5 * (A + A.transpose()); }

namespace {

/// Calls take(matrix) with a copy of A whose size is known at compile time if A has 1 to 4 rows, for which
/// Eigen's decompositions need no memory from the heap; else with A.
template <class Take>
auto with_fixed_size(const MatrixXd& A, const Take& take) {
  switch (A.rows() == A.cols() ? A.rows() : Index{0}) {
    case 1:
      return take(Eigen::Matrix<double, 1, 1>(A));
    case 2:
      return take(Eigen::Matrix2d(A));
    case 3:
      return take(Eigen::Matrix3d(A));
    case 4:
      return take(Eigen::Matrix4d(A));
    default:
      return take(A);
  }
}

}  // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& A) {
  return with_fixed_size(A, [](const auto& a) {
    const Eigen::SelfAdjointEigenSolver<std::remove_cvref_t<decltype(a)>> solver(a);
    return SymmetricEigen{solver.eigenvalues(), solver.eigenvectors()};
  });
}

VectorXd symmetric_eigenvalues(const MatrixXd& A) {
  return with_fixed_size(A, [](const auto& a) {
    return VectorXd(Eigen::SelfAdjointEigenSolver<std::remove_cvref_t<decltype(a)>>(a, Eigen::EigenvaluesOnly)
                        .eigenvalues());
  });
}

SymmetricEigen generalised_symmetric_eigen(const MatrixXd& A, const MatrixXd& B) {
  if (A.size() == 1) return {A.col(0) / B(0, 0), MatrixXd::Constant(1, 1, 1.0 / std::sqrt(B(0, 0)))};
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(A, B);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

ComplexEigen complex_eigen(const MatrixXd& A) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Eigen::EigenSolver<MatrixXd> solver(A);
  if (solver.info() != Eigen::Success)
    return {Eigen::VectorXcd::Constant(A.rows(), kNone),
            Eigen::MatrixXcd::Constant(A.rows(), A.cols(), kNone)};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

RealEigen real_eigen(const MatrixXd& A) {
  const ComplexEigen found = complex_eigen(A);
  return {found.values.real(), found.vectors.real()};
}

MatrixXd inverse(const MatrixXd& A) {
  return with_fixed_size(A, [](const auto& a) { return MatrixXd(a.inverse()); });
}

double determinant(const MatrixXd& A) { return A.determinant(); }

MatrixXd solve_row_pivoting(const MatrixXd& A, const MatrixXd& B) { return A.partialPivLu().solve(B); }

VectorXd solve_full_pivoting(const MatrixXd& A, const VectorXd& b) {
  return with_fixed_size(A, [&b](const auto& a) { return VectorXd(a.fullPivLu().solve(b)); });
}

MatrixXd orthonormal_by_gram(const MatrixXd& V, const MatrixXd& gram) {
  if (gram.size() == 1) return V / std::sqrt(gram(0, 0));
  const MatrixXd root = gram.llt().matrixU();
  return root.transpose().triangularView<Eigen::Lower>().solve(V.transpose()).transpose();
}

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) { return A.colPivHouseholderQr().solve(b); }

MatrixXd independent_columns(const MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> factors(A);
  factors.setThreshold(threshold);
  MatrixXd out(A.rows(), factors.rank());
  for (Index i = 0; i < out.cols(); ++i) out.col(i) = A.col(factors.colsPermutation().indices()[i]);
  return out;
}

MatrixXd orthonormal_span(const MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> factors(A);
  factors.setThreshold(threshold);
  return factors.householderQ() * MatrixXd::Identity(A.rows(), factors.rank());
}

MatrixXd orthonormal_columns(const MatrixXd& A) {
  const Eigen::HouseholderQR<MatrixXd> factors(A);
  return factors.householderQ() * MatrixXd::Identity(A.rows(), A.cols());
}

}  // namespace snapthrough
