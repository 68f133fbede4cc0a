#pragma once
/// @file
/// Lowest eigenpairs of a pencil of a structure, none missed by an inertia count.

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace snapthrough {

/// @brief A pencil A - mu B as the search for its eigenpairs sees it, with factors at one shift.
///
/// T = (A - shift B)^-1 B has the eigenvectors of the pencil and the eigenvalues theta = 1 / (mu - shift).
class Pencil {
 public:
  Pencil() = default;
  Pencil(const Pencil&) = delete;
  Pencil& operator=(const Pencil&) = delete;
  virtual ~Pencil() = default;

  /// Factorises A - shift B. @return number of its negative eigenvalues; without meaning if not symmetric
  virtual int factorise(double shift) = 0;
  /// W x of each column x. T is symmetric in the inner product of W where is_symmetric().
  [[nodiscard]] virtual Eigen::MatrixXd weighted(const Eigen::MatrixXd& x) = 0;
  /// T x of each column x. @param weighted W x @pre factorise()
  [[nodiscard]] virtual Eigen::MatrixXd apply(const Eigen::MatrixXd& x, const Eigen::MatrixXd& weighted) = 0;
  /// (A - shift B)^-1 times forces on the unknowns, in global axes. @pre factorise()
  [[nodiscard]] virtual Eigen::MatrixXd response(Eigen::MatrixXd forces) = 0;
  /// x^T A x for the columns of x, by products with A and not with factors.
  [[nodiscard]] virtual Eigen::MatrixXd works(const Eigen::MatrixXd& x) = 0;
  [[nodiscard]] virtual Eigen::Index size() const = 0;
  /// Largest number of vectors that are independent in W.
  [[nodiscard]] virtual Eigen::Index rank() const { return size(); }
  [[nodiscard]] virtual bool is_symmetric() const = 0;
  /// Whether eigenvalues below the shift are left out; else those of an unsymmetric pencil are found too.
  [[nodiscard]] virtual bool is_searched_above() const { return is_symmetric(); }
};

/// Lowest eigenvalues of a pencil above a shift.
struct Eigenpairs {
  std::vector<std::complex<double>> values;  ///< by ascending real part; conjugate pairs adjoin
  /// A column for each entry of `values`; real and imaginary part of the vector for a conjugate pair.
  Eigen::MatrixXd vectors;
  bool complete = true;    ///< no lower eigenvalue was missed, by an inertia count where one was asked for
  bool converged = false;  ///< every eigenvalue has the asked digits
};

/// What is searched for.
struct EigenSearch {
  int count = 1;  ///< number of eigenvalues; the pencil may have fewer
  /// Relative error of eigenvalues that the iteration may leave: the part of a vector that it leaves is as
  /// large, or the square root of that where the pencil is symmetric.
  double tolerance = 1e-12;
  bool counted = true;        ///< inertia counts confirm that no eigenvalue was missed (symmetric pencils)
  Eigen::MatrixXd near = {};  ///< vectors nearby, to begin with; may be empty
  /// Forces on the unknowns, in global axes. Where there are some, the subspace begins with their responses
  /// and `near` alone: eigenvectors that it can't reach from there are not searched.
  Eigen::MatrixXd forces = {};
};

/// Columns of a Krylov basis, kept from one search to the next: to return and to get as much memory costs as
/// much as a search. Contents between searches mean nothing.
struct KrylovColumns {
  Eigen::MatrixXd basis, weighted, images;
};

/// Place of a pencil's factors.
struct Shift {
  double at = 0.0;
  int below = 0;  ///< inertia there; the eigenvalues below the shift are not searched for
};

/// @brief Factorises a pencil at a negative shift, multiplied by four until its inertia is `shift.below`. An
/// unsymmetric pencil is factorised at the shift as it is.
void factorise_below(Pencil& pencil, Shift& shift);

/// @brief Finds the lowest eigenpairs above a shift.
///
/// Block Krylov subspaces of T, orthonormal in W (Parlett, The Symmetric Eigenvalue Problem, ch. 13;
/// Arnoldi's method where T is not symmetric). A block finds as many equal eigenvalues as it has columns.
/// Where an inertia count just below the last eigenvalue exceeds what was found, the search is repeated with
/// what was found and as many other columns as were missed. A search that has not converged is continued from
/// a shift nearer to the lowest eigenvalue.
/// @param pencil factorised at the shift; its factors are overwritten
/// @param shift moved by later searches
/// @param columns overwritten
[[nodiscard]] Eigenpairs lowest_eigenpairs(Pencil& pencil, Shift& shift, const EigenSearch& search,
                                           KrylovColumns& columns);

}  // namespace snapthrough
