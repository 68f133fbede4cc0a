#include "solver/events/eigenpairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "solver/discrete/structure.h"
#include "solver/numeric/dense.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Limits of the search; ratios unless said otherwise.
struct SearchLimits {
  static constexpr Index block = kLanes;      ///< least columns of a block: as many as solve() takes at once
  static constexpr Index blocks = 9;          ///< blocks beyond three vectors per wanted eigenvalue, at most
  static constexpr double dependent = 1e-10;  ///< part of a column outside the basis that is rounding
  static constexpr double again = 0.5;        ///< part of a column that a second pass leaves; less: rounding
  static constexpr double orthogonal = 1e-4;  ///< error of products of vectors, over that of eigenvalues
  static constexpr double infinite =
      1e-13;  ///< eigenvalue of T, over the largest: that of the pencil is infinite
  /// Distance of a moved shift from the lowest eigenvalue, over that of the shift before.
  static constexpr double closest = 2e-3;
  static constexpr int tries = 6;      ///< searches at most
  static constexpr double far = 30.0;  ///< shift over the least eigenvalue at which it is moved there
  static constexpr double near = 0.3;  ///< moved shift over that eigenvalue
  static constexpr int shifts = 60;    ///< shifts that are tried until no eigenvalue lies below
  /// Eigenvalue over the largest of the shift and those found that is rounding: that of a motion without
  /// stiffness. Where all are, the shift is out of scale and falls by `scales`.
  static constexpr double zero = 1e-12;
  static constexpr double scales = 1e-9;
  /// Eigenvalue over the shift that is rounding where 1 / theta alone gives it, in unsymmetric pencils.
  static constexpr double unrefined = 1e-9;
  static constexpr double conjugate = 1e-12;  ///< difference of the real parts of a pair, over its magnitude
  static constexpr double rounding = 1e-12;   ///< rest of a vector that is rounding, over the largest theta
  /// Eigenvalue over the shift below which 1 / theta has lost digits, and works() give its value.
  static constexpr double small = 1e-3;
  /// Distance of eigenvalues that a count need not tell apart: the rounding of J moves them by 5e-9 where
  /// EA l^2 / EI is 1e14.
  static constexpr double apart = 1e-7;
};

/// Eigenvalue theta of T with its vector in the basis.
struct Ritz {
  std::complex<double> theta;
  /// Combination of the images T V that is the vector; of a conjugate pair the real part for the first and
  /// the imaginary part for the second.
  VectorXd combination;
  double rest = 0.0;  ///< norm of T x - theta x
};

/// Krylov basis V, orthonormal in W, with W V, the images T V and the projection H = V^T W T V.
class Basis {
 public:
  /// @param start columns in the range of T
  /// @param tolerance relative error of eigenvalues
  /// @param most number of columns from which on no block is expanded
  /// @param columns kept by reference
  Basis(Pencil& pencil, const MatrixXd& start, double tolerance, Index most, KrylovColumns& columns)
      : pencil_(pencil),
        least_(std::numeric_limits<double>::epsilon() / (SearchLimits::orthogonal * tolerance)),
        V_(columns.basis),
        WV_(columns.weighted),
        image_(columns.images) {
    const Index all = most + start.cols() + SearchLimits::block;
    for (MatrixXd* one : {&V_, &WV_, &image_})
      if (one->rows() != pencil.size() || one->cols() < all) one->resize(pencil.size(), all);
    H_ = MatrixXd::Zero(all, all);
    add(start);
  }
  [[nodiscard]] Index size() const { return columns_; }
  [[nodiscard]] Index expanded() const { return expanded_; }
  [[nodiscard]] Index fresh() const { return columns_ - expanded_; }
  /// Adds T times the newest vectors.
  void expand() {
    const Index first = expanded_;
    const Index count = std::min(SearchLimits::block, fresh());
    const MatrixXd image = pencil_.apply(V_.middleCols(first, count), WV_.middleCols(first, count));
    image_.middleCols(first, count) = image;
    expanded_ += count;
    add(image);
    // these images lie in the span of the vectors so far: rows of later vectors stay zero
    H_.block(0, first, columns_, count) = along_basis(image);
  }
  /// Eigenvalues of T on the expanded vectors that are not zero; those of the lowest eigenvalues of the
  /// pencil first.
  [[nodiscard]] std::vector<Ritz> ritz() const;
  /// Vectors of the first pairs, one column each.
  [[nodiscard]] MatrixXd vectors(std::span<const Ritz> pairs) const {
    MatrixXd combinations(expanded_, static_cast<Index>(pairs.size()));
    for (std::size_t i = 0; i < pairs.size(); ++i)
      combinations.col(static_cast<Index>(i)) = pairs[i].combination;
    return image_.leftCols(expanded_) * combinations;
  }

 private:
  void add(MatrixXd columns);
  /// V^T W x of each column x. Products by column: with four columns, Eigen's matrix products spend more time
  /// on copies than on products.
  [[nodiscard]] MatrixXd along_basis(const MatrixXd& columns) const {
    MatrixXd out(columns_, columns.cols());
    for (Index j = 0; j < columns.cols(); ++j)
      out.col(j).noalias() = WV_.leftCols(columns_).transpose() * columns.col(j);
    return out;
  }

  Pencil& pencil_;
  const double least_;  ///< part of a column that is orthogonal enough after one pass
  Index columns_ = 0;
  Index expanded_ = 0;
  MatrixXd &V_, &WV_, &image_;  ///< the first columns are in use
  MatrixXd H_;
};

/// Makes columns orthonormal in W, and removes those that depend on the ones before but for rounding.
/// @param weighted W times the columns
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
    weighted = pencil_.weighted(columns);
    left = orthonormalise(columns, weighted, along.colwise().squaredNorm(),
                          pass == 0 ? SearchLimits::dependent : SearchLimits::again);
  }
  // what is left beyond the rank of W is rounding
  const Index count = std::min(columns.cols(), pencil_.rank() - columns_);
  V_.middleCols(columns_, count) = columns.leftCols(count);
  WV_.middleCols(columns_, count) = weighted.leftCols(count);
  columns_ += count;
}

/// Part of an eigenvector that stands for it among real vectors: of a conjugate pair the real part first.
VectorXd real_part_of_pair(const ComplexEigen& found, Index i) {
  const bool second =
      i > 0 && found.values[i].imag() != 0.0 && found.values[i] == std::conj(found.values[i - 1]);
  if (second) return found.vectors.col(i).imag();
  return found.vectors.col(i).real();
}

/// Whether an eigenvalue of the pencil comes before another one, by eigenvalues of an unsymmetric T.
bool comes_before(const Ritz& a, const Ritz& b) {
  const auto x = 1.0 / a.theta;
  const auto y = 1.0 / b.theta;
  // conjugates differ by rounding in their real parts
  const bool pair =
      a.theta.imag() != 0.0 && std::abs(x.real() - y.real()) <= SearchLimits::conjugate * std::abs(x);
  return pair ? x.imag() < y.imag() : x.real() < y.real();
}

std::vector<Ritz> Basis::ritz() const {
  const auto H = H_.topLeftCorner(expanded_, expanded_);
  // what a vector leaves is in the vectors that are not expanded
  const auto beyond = H_.block(expanded_, 0, columns_ - expanded_, expanded_);
  const bool symmetric = pencil_.is_symmetric();
  const bool above = pencil_.is_searched_above();
  std::vector<Ritz> out;
  if (symmetric) {
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
  std::erase_if(out, [=](const Ritz& pair) {
    const double size = above ? pair.theta.real() : std::abs(pair.theta);
    return size <= SearchLimits::infinite * largest;
  });
  std::sort(out.begin(), out.end(), [above](const Ritz& a, const Ritz& b) {
    return above ? a.theta.real() > b.theta.real() : comes_before(a, b);
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

/// Writes the lowest eigenvalues with their vectors.
void take(const Basis& basis, const std::vector<Ritz>& pairs, int count, double shift, Eigenpairs& out) {
  out.values.clear();
  auto n = std::min(static_cast<std::size_t>(count), pairs.size());
  // a conjugate pair is not divided
  if (n > 0 && n < pairs.size() && pairs[n - 1].theta.imag() != 0.0 &&
      pairs[n].theta == std::conj(pairs[n - 1].theta))
    ++n;
  out.vectors = basis.vectors(std::span(pairs).first(n));
  for (std::size_t i = 0; i < n; ++i) out.values.push_back(shift + 1.0 / pairs[i].theta);
}

/// Columns to begin with: those nearby, and others.
/// @param others number of pseudo-random columns
/// @param seed of those columns
MatrixXd start_of(const MatrixXd& near, Index size, Index others, unsigned seed) {
  MatrixXd out(size, near.cols() + others);
  if (near.cols() > 0) out.leftCols(near.cols()) = near;
  for (Index i = near.cols(); i < out.cols(); ++i)
    out.col(i) = pseudo_random(size, seed * 1000U + static_cast<unsigned>(i) + 1U);
  return out;
}

/// Images of the columns to begin with: the responses to forces, and T of the columns.
MatrixXd images_of(Pencil& pencil, const MatrixXd& forces, const MatrixXd& start) {
  MatrixXd out(pencil.size(), start.cols() + forces.cols());
  if (start.cols() > 0) out.leftCols(start.cols()) = pencil.apply(start, pencil.weighted(start));
  if (forces.cols() > 0) out.rightCols(forces.cols()) = pencil.response(forces);
  return out;
}

/// One Krylov search with the present factors.
/// @param start columns to begin with
/// @param width number of columns beside those nearby
void search_at(Pencil& pencil, double shift, const EigenSearch& search, const MatrixXd& start, Index width,
               KrylovColumns& columns, Eigenpairs& out) {
  const Index most =
      3 * search.count + SearchLimits::blocks * std::max(width, SearchLimits::block) + (start.cols() - width);
  const double rest = pencil.is_symmetric() ? std::sqrt(search.tolerance) : search.tolerance;
  Basis basis(pencil, images_of(pencil, search.forces, start), search.tolerance, most, columns);
  // the first image of a vector does not tell whether the vector is an eigenvector
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

/// Number of eigenvalues that an inertia count finds below the last one, and the search did not. The count is
/// taken just below the last of the found eigenvalues that differ, because one of several equal eigenvalues
/// may be the last that is asked for.
int missed(Pencil& pencil, const Shift& shift, const Eigenpairs& found) {
  const auto at = [&](std::size_t i) { return found.values[i].real(); };
  std::size_t below = found.values.size() - 1;
  // the search finds 1 / (mu - shift), whose rounding is that of the largest of these numbers
  const double rounding = SearchLimits::rounding * (at(below) - shift.at) / (at(0) - shift.at);
  const double apart = std::max(SearchLimits::apart, rounding) * (std::abs(at(below)) + std::abs(shift.at));
  while (below > 0 && at(below) - at(below - 1) <= 2.0 * apart) --below;
  return pencil.factorise(at(below) - apart) - shift.below - static_cast<int>(below);
}

/// Factorises nearer to the lowest eigenvalue, but below all of them: at a distance from it as large as the
/// range of those found.
void move_nearer(Pencil& pencil, const Eigenpairs& found, Shift& shift) {
  double first = found.values.front().real();
  const double range = found.values.back().real() - first;
  for (int i = 0; i < SearchLimits::tries; ++i) {
    const double distance = std::max(range, SearchLimits::closest * (first - shift.at));
    if (distance >= 0.5 * (first - shift.at)) break;
    if (pencil.factorise(first - distance) == shift.below) {
      shift.at = first - distance;
      return;
    }
    // an eigenvalue below was not found yet
    first -= 0.5 * (first - shift.at);
  }
  pencil.factorise(shift.at);
}

/// Eigenvalues that are small beside the shift from the works of their vectors, to the rounding of A.
void refine_small(Pencil& pencil, double shift, Eigenpairs& found) {
  Index small = 0;
  const auto count = static_cast<Index>(found.values.size());
  while (small < count &&
         std::abs(found.values[static_cast<std::size_t>(small)]) < SearchLimits::small * std::abs(shift))
    ++small;
  if (small == 0) return;
  const MatrixXd vectors = found.vectors.leftCols(small);
  const MatrixXd weights = vectors.transpose() * pencil.weighted(vectors);
  const SymmetricEigen refined =
      generalised_symmetric_eigen(symmetric_part(pencil.works(vectors)), symmetric_part(weights));
  if (!refined.vectors.allFinite()) return;
  found.vectors.leftCols(small) = vectors * refined.vectors;
  for (Index i = 0; i < small; ++i) found.values[static_cast<std::size_t>(i)] = refined.values[i];
}

/// Moves a negative shift that is far larger than an eigenvalue near to it. @return whether it was moved
bool move_to_scale(Pencil& pencil, const Eigenpairs& found, Shift& shift) {
  const double size = -shift.at;
  double largest = size;
  for (const auto& value : found.values) largest = std::max(largest, std::abs(value));
  const double zero = pencil.is_symmetric() ? SearchLimits::zero * largest : SearchLimits::unrefined * size;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& value : found.values)
    if (std::abs(value) > zero) least = std::min(least, std::abs(value));
  const bool is_known = std::isfinite(least);
  if (is_known && size <= SearchLimits::far * least) return false;
  if (size <= 0.0 || !(is_known || pencil.is_symmetric())) return false;
  shift.at = is_known ? -SearchLimits::near * least : SearchLimits::scales * shift.at;
  factorise_below(pencil, shift);
  return true;
}

}  // namespace

void factorise_below(Pencil& pencil, Shift& shift) {
  for (int i = 0; i < SearchLimits::shifts; ++i) {
    if (pencil.factorise(shift.at) == shift.below || !pencil.is_symmetric()) return;
    shift.at *= 4.0;
  }
}

Eigenpairs lowest_eigenpairs(Pencil& pencil, Shift& shift, const EigenSearch& search,
                             KrylovColumns& columns) {
  Eigenpairs out;
  const bool symmetric = pencil.is_symmetric();
  Index width = search.forces.cols() > 0 ? 0 : SearchLimits::block - search.near.cols() % SearchLimits::block;
  MatrixXd start = start_of(search.near, pencil.size(), width, 0U);
  bool is_scaled = false;
  for (unsigned seed = 1; seed <= SearchLimits::tries; ++seed) {
    search_at(pencil, shift.at, search, start, width, columns, out);
    if (out.values.empty()) break;
    if (symmetric) refine_small(pencil, shift.at, out);
    int others = 0;
    if (!is_scaled && move_to_scale(pencil, out, shift)) {
      is_scaled = true;
    } else {
      if (!search.counted || !symmetric) break;
      others = missed(pencil, shift, out);
      out.complete = others == 0;
      if (out.complete && out.converged) break;
      if (out.converged)
        pencil.factorise(shift.at);
      else
        move_nearer(pencil, out, shift);
    }
    if (search.forces.cols() == 0) width = std::max<Index>(SearchLimits::block, others);
    start = start_of(out.vectors, pencil.size(), width, seed);
  }
  return out;
}

}  // namespace snapthrough
