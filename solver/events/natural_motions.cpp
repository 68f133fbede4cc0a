#include "solver/events/natural_motions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "solver/numeric/dense.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Limits of the search; ratios unless said otherwise.
struct SearchLimits {
  static constexpr Index block = kLanes;      ///< columns of a block: as many as solve() takes at once
  static constexpr Index spare = 36;          ///< vectors beyond three per wanted eigenvalue, at most
  static constexpr double dependent = 1e-10;  ///< part of a column outside the basis that is rounding
  static constexpr double again = 0.5;        ///< part of a column that a second pass leaves; less: rounding
  static constexpr double orthogonal = 1e-4;  ///< error of products of vectors, over that of eigenvalues
  static constexpr double massless = 1e-13;   ///< eigenvalue of the inverse, over the largest: no mass moves
  static constexpr double far = 30.0;         ///< shift over the lowest eigenvalues at which it is moved
  static constexpr double below = 0.3;        ///< moved shift over the lowest eigenvalues
  /// Eigenvalues over the shift, or over that of a member alone, that count as zero.
  static constexpr double zero = 1e-6;
  static constexpr double first_shift = 0.1;  ///< first shift over the scale
  static constexpr std::size_t lowest = 3;  ///< number of eigenvalues that tell the scale of the next search
  static constexpr int shifts = 60;         ///< shifts that are tried
  static constexpr int tries = 3;           ///< starts from other vectors when an eigenvalue was missed
  static constexpr double conjugate = 1e-12;  ///< difference of the real parts of a pair, over its magnitude
  static constexpr double rounding = 1e-12;   ///< rest of a motion that is rounding, over the largest theta
  /// Distance of eigenvalues that a count need not tell apart: the rounding of J moves them by 5e-9 where
  /// EA l^2 / EI is 1e14.
  static constexpr double apart = 1e-7;
};

/// The operator T = (J + sigma M)^-1 M, with inner product x^T M y.
class ShiftedInverse {
 public:
  ShiftedInverse(const Structure& structure, StructuralProblem& problem, const MassMatrix& masses,
                 const VectorXd& y, double lambda)
      : structure_(structure), problem_(problem), masses_(masses), y_(y), lambda_(lambda) {}

  /// Factorises J - shift M. @return number of eigenvalues below the shift
  int factorise(double shift) {
    Regime regime;
    regime.masses = &masses_.elements;
    regime.shift = shift;
    ++factorizations_;
    return problem_.linearise(y_, lambda_, residual_, regime).negative;
  }
  [[nodiscard]] MatrixXd weighted(const MatrixXd& x) const { return mass_products(structure_, masses_, x); }
  /// T x from M x.
  [[nodiscard]] MatrixXd apply(MatrixXd weighted) {
    problem_.to_rows(weighted);
    problem_.solve(weighted);
    return weighted;
  }
  [[nodiscard]] Index size() const { return problem_.size(); }
  [[nodiscard]] bool is_symmetric() const { return !structure_.unsymmetric(); }
  [[nodiscard]] int factorizations() const { return factorizations_; }

 private:
  const Structure& structure_;
  StructuralProblem& problem_;
  const MassMatrix& masses_;
  const VectorXd& y_;
  double lambda_;
  VectorXd residual_;
  int factorizations_ = 0;
};

/// Eigenvalue theta of T with its motion in the basis.
struct Ritz {
  std::complex<double> theta;
  /// Combination of the images T V that is the motion; of a conjugate pair the real part for the first and
  /// the imaginary part for the second.
  VectorXd combination;
  double rest = 0.0;  ///< norm of T x - theta x
};

/// Krylov basis V, orthonormal in M, with M V, the images T V and the projection H = V^T M T V.
class Basis {
 public:
  /// @param tolerance relative error of eigenvalues
  /// @param most number of columns from which on no block is expanded
  /// @param columns kept by reference
  Basis(ShiftedInverse& inverse, const MatrixXd& start, double tolerance, Index most, KrylovColumns& columns)
      : inverse_(inverse),
        least_(std::numeric_limits<double>::epsilon() / (SearchLimits::orthogonal * tolerance)),
        V_(columns.basis),
        MV_(columns.weighted),
        image_(columns.images) {
    const Index all = most + start.cols() + SearchLimits::block;
    for (MatrixXd* one : {&V_, &MV_, &image_})
      if (one->rows() != inverse.size() || one->cols() < all) one->resize(inverse.size(), all);
    H_ = MatrixXd::Zero(all, all);
    add(inverse_.apply(inverse_.weighted(start)));
  }
  [[nodiscard]] Index size() const { return columns_; }
  [[nodiscard]] Index expanded() const { return expanded_; }
  [[nodiscard]] Index fresh() const { return columns_ - expanded_; }
  /// Adds T times the newest vectors.
  void expand() {
    const Index first = expanded_;
    const Index count = std::min(SearchLimits::block, fresh());
    const MatrixXd image = inverse_.apply(MV_.middleCols(first, count));
    image_.middleCols(first, count) = image;
    expanded_ += count;
    add(image);
    // these images lie in the span of the vectors so far: rows of later vectors stay zero
    H_.block(0, first, columns_, count) = along_basis(image);
  }
  /// Eigenvalues of T on the expanded vectors, largest first, as those of the lowest mu.
  [[nodiscard]] std::vector<Ritz> ritz() const;
  /// Motions of the first pairs, one column each.
  [[nodiscard]] MatrixXd motions(std::span<const Ritz> pairs) const {
    MatrixXd combinations(expanded_, static_cast<Index>(pairs.size()));
    for (std::size_t i = 0; i < pairs.size(); ++i)
      combinations.col(static_cast<Index>(i)) = pairs[i].combination;
    return image_.leftCols(expanded_) * combinations;
  }

 private:
  void add(MatrixXd columns);
  /// V^T M x of each column x. Products by column: with four columns, Eigen's matrix products spend more time
  /// on copies than on products.
  [[nodiscard]] MatrixXd along_basis(const MatrixXd& columns) const {
    MatrixXd out(columns_, columns.cols());
    for (Index j = 0; j < columns.cols(); ++j)
      out.col(j).noalias() = MV_.leftCols(columns_).transpose() * columns.col(j);
    return out;
  }

  ShiftedInverse& inverse_;
  const double least_;  ///< part of a column that is orthogonal enough after one pass
  Index columns_ = 0;
  Index expanded_ = 0;
  MatrixXd &V_, &MV_, &image_;  ///< the first columns are in use
  MatrixXd H_;
};

/// Makes columns orthonormal in M, and removes those that depend on the ones before but for rounding.
/// @param weighted M times the columns
/// @param removed squared norms of the parts that were taken from the columns before
/// @param dependent part of a column's norm that is rounding
/// @return least norm that was left of a column, over its norm before, among the columns that are kept
double orthonormalise(MatrixXd& columns, MatrixXd& weighted, const VectorXd& removed, double dependent) {
  Index kept = 0;
  double least = 1.0;
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd v = columns.col(j);
    VectorXd mv = weighted.col(j);
    const double size = v.dot(mv) + removed[j];
    const VectorXd along = weighted.leftCols(kept).transpose() * v;
    v.noalias() -= columns.leftCols(kept) * along;
    mv.noalias() -= weighted.leftCols(kept) * along;
    const double rest = v.dot(mv);
    if (!(rest > dependent * dependent * size)) continue;
    least = std::min(least, std::sqrt(rest / size));
    columns.col(kept) = v / std::sqrt(rest);
    weighted.col(kept) = mv / std::sqrt(rest);
    ++kept;
  }
  columns.conservativeResize(Eigen::NoChange, kept);
  weighted.conservativeResize(Eigen::NoChange, kept);
  return least;
}

/// Appends the part of the columns that is orthogonal to the basis, but for rounding.
void Basis::add(MatrixXd columns) {
  MatrixXd weighted;
  double left = 0.0;
  // a second pass removes what the rounding of the first has left, and columns that were nothing else
  for (int pass = 0; pass < 2 && left < least_; ++pass) {
    const MatrixXd along = along_basis(columns);
    for (Index j = 0; j < columns.cols(); ++j)
      columns.col(j).noalias() -= V_.leftCols(columns_) * along.col(j);
    weighted = inverse_.weighted(columns);
    left = orthonormalise(columns, weighted, along.colwise().squaredNorm(),
                          pass == 0 ? SearchLimits::dependent : SearchLimits::again);
  }
  V_.middleCols(columns_, columns.cols()) = columns;
  MV_.middleCols(columns_, columns.cols()) = weighted;
  columns_ += columns.cols();
}

/// Part of an eigenvector that stands for it among real vectors: of a conjugate pair the real part first.
VectorXd real_part_of_pair(const ComplexEigen& found, Index i) {
  const bool second =
      i > 0 && found.values[i].imag() != 0.0 && found.values[i] == std::conj(found.values[i - 1]);
  if (second) return found.vectors.col(i).imag();
  return found.vectors.col(i).real();
}

std::vector<Ritz> Basis::ritz() const {
  const auto H = H_.topLeftCorner(expanded_, expanded_);
  // what a motion leaves is in the vectors that are not expanded
  const auto beyond = H_.block(expanded_, 0, columns_ - expanded_, expanded_);
  std::vector<Ritz> out;
  if (inverse_.is_symmetric()) {
    const SymmetricEigen found = symmetric_eigen(symmetric_part(H));
    for (Index i = 0; i < found.values.size(); ++i)
      out.push_back({found.values[i], found.vectors.col(i), (beyond * found.vectors.col(i)).norm()});
  } else {
    const ComplexEigen found = complex_eigen(H);
    for (Index i = 0; i < found.values.size(); ++i)
      out.push_back({found.values[i], real_part_of_pair(found, i), (beyond * found.vectors.col(i)).norm()});
  }
  double largest = 0.0;
  for (const Ritz& pair : out) largest = std::max(largest, std::abs(pair.theta));
  std::erase_if(
      out, [largest](const Ritz& pair) { return std::abs(pair.theta) <= SearchLimits::massless * largest; });
  const auto square = [](const Ritz& pair) { return 1.0 / pair.theta; };
  const bool symmetric = inverse_.is_symmetric();
  std::sort(out.begin(), out.end(), [&](const Ritz& a, const Ritz& b) {
    // no eigenvalue lies below the shift: theta < 0 is rounding
    if (symmetric) return a.theta.real() > b.theta.real();
    const auto x = square(a);
    const auto y = square(b);
    // conjugates differ by rounding in their real parts
    const bool pair =
        a.theta.imag() != 0.0 && std::abs(x.real() - y.real()) <= SearchLimits::conjugate * std::abs(x);
    return pair ? x.imag() < y.imag() : x.real() < y.real();
  });
  return out;
}

/// Whether the lowest `count` pairs have converged.
bool has_converged(const std::vector<Ritz>& pairs, int count, double tolerance) {
  if (static_cast<int>(pairs.size()) < count) return false;
  double largest = 0.0;
  for (const Ritz& pair : pairs) largest = std::max(largest, std::abs(pair.theta));
  return std::all_of(pairs.begin(), pairs.begin() + count, [&](const Ritz& pair) {
    return pair.rest <= std::max(tolerance * std::abs(pair.theta), SearchLimits::rounding * largest);
  });
}

/// Writes the lowest eigenvalues with their motions.
void take(const Basis& basis, const std::vector<Ritz>& pairs, int count, double shift, NaturalMotions& out) {
  out.squares.clear();
  auto n = std::min(static_cast<std::size_t>(count), pairs.size());
  // a conjugate pair is not divided
  if (n > 0 && n < pairs.size() && pairs[n - 1].theta.imag() != 0.0 &&
      pairs[n].theta == std::conj(pairs[n - 1].theta))
    ++n;
  out.motions = basis.motions(std::span(pairs).first(n));
  for (std::size_t i = 0; i < n; ++i) out.squares.push_back(shift + 1.0 / pairs[i].theta);
}

/// Motions to begin with: those nearby, filled up to a whole number of blocks.
MatrixXd start_of(const MotionSearch& search, Index size, unsigned seed) {
  const Index given = seed == 0 ? search.near.cols() : 0;
  const Index blocks = given / SearchLimits::block + 1;
  MatrixXd out(size, blocks * SearchLimits::block);
  if (given > 0) out.leftCols(given) = search.near;
  for (Index i = given; i < out.cols(); ++i)
    out.col(i) = pseudo_random(size, seed * 1000U + static_cast<unsigned>(i) + 1U);
  return out;
}

/// One Krylov search with the present factors.
void search_at(ShiftedInverse& inverse, double shift, const MotionSearch& search, unsigned seed,
               KrylovColumns& columns, NaturalMotions& out) {
  const Index most = 3 * search.count + SearchLimits::spare;
  const double rest = inverse.is_symmetric() ? std::sqrt(search.tolerance) : search.tolerance;
  Basis basis(inverse, start_of(search, inverse.size(), seed), search.tolerance, most, columns);
  // the first image of a vector does not tell whether the vector is a motion
  const Index least = 2 * basis.size();
  std::vector<Ritz> pairs;
  out.converged = false;
  while (basis.fresh() > 0) {
    basis.expand();
    if (basis.expanded() < least && basis.fresh() > 0 && basis.size() < most) continue;
    pairs = basis.ritz();
    out.converged = basis.fresh() == 0 || has_converged(pairs, search.count, rest);
    if (out.converged || basis.size() >= most) break;
  }
  if (pairs.empty()) return;
  take(basis, pairs, search.count, shift, out);
}

/// Factorises at a negative shift, multiplied by four until all eigenvalues of a symmetric problem lie above
/// it.
/// @return the shift of the factors
double factorise_below(ShiftedInverse& inverse, double shift) {
  for (int i = 0; i < SearchLimits::shifts; ++i) {
    if (inverse.factorise(shift) == 0 || !inverse.is_symmetric()) break;
    shift *= 4.0;
  }
  return shift;
}

/// Whether an inertia count finds no other eigenvalue below the last one. The count is taken just below the
/// last of the found eigenvalues that differ, because one of several equal eigenvalues may be the last that
/// is asked for.
/// @param shift of the search, by whose size eigenvalues are told apart
bool is_complete(ShiftedInverse& inverse, double shift, const NaturalMotions& found) {
  const auto at = [&](std::size_t i) { return found.squares[i].real(); };
  std::size_t below = found.squares.size() - 1;
  // the search finds 1 / (mu - shift), whose rounding is that of the largest of these numbers
  const double rounding = SearchLimits::rounding * (at(below) - shift) / (at(0) - shift);
  const double apart = std::max(SearchLimits::apart, rounding) * (std::abs(at(below)) + std::abs(shift));
  while (below > 0 && at(below) - at(below - 1) <= 2.0 * apart) --below;
  return inverse.factorise(at(below) - apart) == static_cast<int>(below);
}

}  // namespace

void MotionSearch::begin_with(const NaturalMotions& found) {
  if (!found.motions.allFinite()) {
    near.resize(0, 0);
    return;
  }
  near = found.motions;
  scale = 0.0;
  for (std::size_t i = 0; i < std::min(found.squares.size(), SearchLimits::lowest); ++i)
    scale = std::max(scale, std::abs(found.squares[i]));
}

NaturalMotions natural_motions(const Structure& structure, StructuralProblem& problem,
                               const MassMatrix& masses, const VectorXd& y, double lambda,
                               const MotionSearch& search, KrylovColumns& columns) {
  NaturalMotions out;
  ShiftedInverse inverse(structure, problem, masses, y, lambda);
  // squares of rigid motions are rounding and tell no scale
  const double scale = search.scale > SearchLimits::zero * masses.scale ? search.scale : masses.scale;
  double shift = factorise_below(inverse, -SearchLimits::first_shift * scale);
  for (unsigned seed = 0; seed < SearchLimits::tries; ++seed) {
    search_at(inverse, shift, search, seed, columns, out);
    if (out.squares.empty()) break;
    // an eigenvalue that is far smaller than the shift, and not zero, loses digits: the shift is moved near
    // it
    double size = -shift;
    for (const auto& mu : out.squares)
      if (std::abs(mu) > SearchLimits::zero * -shift) size = std::min(size, std::abs(mu));
    if (-shift > SearchLimits::far * size) {
      shift = factorise_below(inverse, -SearchLimits::below * size);
      search_at(inverse, shift, search, seed, columns, out);
    }
    if (!search.counted || !inverse.is_symmetric()) break;
    out.complete = is_complete(inverse, shift, out);
    if (out.complete && out.converged) break;
    shift = factorise_below(inverse, shift);
  }
  out.factorizations = inverse.factorizations();
  return out;
}

}  // namespace snapthrough
