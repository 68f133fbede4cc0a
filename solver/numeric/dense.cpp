#include "solver/numeric/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd symmetric_part(const MatrixXd& A) { return 0.5 * (A + A.transpose()); }

SymmetricEigen symmetric_eigen(const MatrixXd& A) {
  if (A.size() == 1) return {A.col(0), MatrixXd::Ones(1, 1)};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd symmetric_eigenvalues(const MatrixXd& A) {
  if (A.size() == 1) return A.col(0);
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A).eigenvalues();
}

SymmetricEigen generalised_symmetric_eigen(const MatrixXd& A, const MatrixXd& B) {
  if (A.size() == 1) return {A.col(0) / B(0, 0), MatrixXd::Constant(1, 1, 1.0 / std::sqrt(B(0, 0)))};
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(A, B);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

RealEigen real_eigen(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues().real(), solver.eigenvectors().real()};
}

MatrixXd inverse(const MatrixXd& A) {
  if (A.size() == 1) return A.cwiseInverse();
  return A.inverse();
}

double determinant(const MatrixXd& A) { return A.determinant(); }

MatrixXd solve_row_pivoting(const MatrixXd& A, const MatrixXd& B) { return A.partialPivLu().solve(B); }

VectorXd solve_full_pivoting(const MatrixXd& A, const VectorXd& b) { return A.fullPivLu().solve(b); }

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
