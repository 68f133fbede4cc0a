#include "solver/events/natural_motions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

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
  static constexpr double massless = 1e-13;   ///< eigenvalue of the inverse, over the largest: no mass moves
  static constexpr double far = 30.0;         ///< shift over the lowest eigenvalues at which it is moved
  static constexpr double below = 0.3;        ///< moved shift over the lowest eigenvalues
  static constexpr double zero =
      1e-6;  ///< eigenvalues over the shift that count as zero: no shift is near them
  static constexpr double first_shift = 0.1;  ///< first shift over the scale
  static constexpr int shifts = 60;           ///< shifts that are tried
  static constexpr int tries = 3;             ///< starts from other vectors when an eigenvalue was missed
  static constexpr double rounding = 1e-12;   ///< rest of a motion that is rounding, over the largest theta
  static constexpr double gap = 1e-9;         ///< distance of neighbours that one count tells apart
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
  [[nodiscard]] bool is_symmetric() const { return !problem_.is_unsymmetric(); }
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
  Eigen::VectorXcd combination;
  double rest = 0.0;  ///< norm of T x - theta x
};

/// Krylov basis V with M V, T V and the projection V^T M T V.
class Basis {
 public:
  Basis(ShiftedInverse& inverse, const MatrixXd& start) : inverse_(inverse) {
    add(inverse.apply(inverse.weighted(start)));
  }
  [[nodiscard]] Index size() const { return columns_; }
  [[nodiscard]] Index fresh() const { return columns_ - expanded_; }
  /// Adds T times the newest vectors.
  void expand() {
    const Index first = expanded_;
    const Index count = std::min(SearchLimits::block, columns_ - first);
    const MatrixXd image = inverse_.apply(MV_.middleCols(first, count));
    image_.conservativeResize(inverse_.size(), first + count);
    image_.rightCols(count) = image;
    expanded_ = first + count;
    add(image);
  }
  /// Eigenvalues of T on the expanded vectors, largest first, as those of the lowest mu.
  [[nodiscard]] std::vector<Ritz> ritz() const;
  [[nodiscard]] Eigen::VectorXcd motion(const Ritz& pair) const {
    return image_.leftCols(expanded_) * pair.combination;
  }

 private:
  void add(const MatrixXd& columns);

  ShiftedInverse& inverse_;
  Index columns_ = 0;
  Index expanded_ = 0;
  MatrixXd V_, MV_, image_;
};

/// Appends the part of each column that is orthogonal to the basis, but for rounding.
void Basis::add(const MatrixXd& columns) {
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd v = columns.col(j);
    VectorXd mv = inverse_.weighted(v);
    const double size = std::sqrt(std::max(0.0, v.dot(mv)));
    for (int pass = 0; pass < 2 && columns_ > 0; ++pass) {
      v -= V_ * (V_.transpose() * mv);
      mv = inverse_.weighted(v);
    }
    const double norm = std::sqrt(std::max(0.0, v.dot(mv)));
    if (!(norm > SearchLimits::dependent * size)) continue;
    V_.conservativeResize(inverse_.size(), columns_ + 1);
    MV_.conservativeResize(inverse_.size(), columns_ + 1);
    V_.col(columns_) = v / norm;
    MV_.col(columns_) = mv / norm;
    ++columns_;
  }
}

std::vector<Ritz> Basis::ritz() const {
  // images lie in the span of the basis: what a motion leaves is in the vectors that are not expanded
  const MatrixXd all = MV_.leftCols(columns_).transpose() * image_;
  const MatrixXd H = all.topRows(expanded_);
  const MatrixXd beyond = all.bottomRows(columns_ - expanded_);
  std::vector<Ritz> out;
  if (inverse_.is_symmetric()) {
    const SymmetricEigen found = symmetric_eigen(symmetric_part(H));
    for (Index i = 0; i < found.values.size(); ++i)
      out.push_back({found.values[i], found.vectors.col(i).cast<std::complex<double>>(), 0.0});
  } else {
    const ComplexEigen found = complex_eigen(H);
    for (Index i = 0; i < found.values.size(); ++i)
      out.push_back({found.values[i], found.vectors.col(i), 0.0});
  }
  for (Ritz& pair : out) pair.rest = (beyond * pair.combination).norm();
  double largest = 0.0;
  for (const Ritz& pair : out) largest = std::max(largest, std::abs(pair.theta));
  std::erase_if(
      out, [largest](const Ritz& pair) { return std::abs(pair.theta) <= SearchLimits::massless * largest; });
  const auto square = [](const Ritz& pair) { return 1.0 / pair.theta; };
  std::sort(out.begin(), out.end(), [&](const Ritz& a, const Ritz& b) {
    const auto x = square(a);
    const auto y = square(b);
    // conjugates differ by rounding in their real parts
    const bool pair = a.theta.imag() != 0.0 && std::abs(x.real() - y.real()) <= 1e-12 * std::abs(x);
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
  out.motions.resize(basis.motion(pairs[0]).size(), static_cast<Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    out.squares.push_back(shift + 1.0 / pairs[i].theta);
    const Eigen::VectorXcd motion = basis.motion(pairs[i]);
    const bool second =
        pairs[i].theta.imag() != 0.0 && i > 0 && pairs[i - 1].theta == std::conj(pairs[i].theta);
    out.motions.col(static_cast<Index>(i)) = second ? VectorXd(motion.imag()) : VectorXd(motion.real());
  }
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
               NaturalMotions& out) {
  Basis basis(inverse, start_of(search, inverse.size(), seed));
  const Index most = 3 * search.count + SearchLimits::spare;
  std::vector<Ritz> pairs;
  out.converged = false;
  while (basis.fresh() > 0) {
    basis.expand();
    if (basis.fresh() > SearchLimits::block && basis.size() < most) continue;
    pairs = basis.ritz();
    out.converged = basis.fresh() == 0 || has_converged(pairs, search.count, search.tolerance);
    if (out.converged || basis.size() >= most) break;
  }
  if (pairs.empty()) return;
  take(basis, pairs, search.count, shift, out);
}

/// Factorises at a shift below all eigenvalues; doubles it while some are lower.
double factorise_below(ShiftedInverse& inverse, double shift) {
  for (int i = 0; i < SearchLimits::shifts; ++i) {
    if (inverse.factorise(shift) == 0 || !inverse.is_symmetric()) break;
    shift *= 4.0;
  }
  return shift;
}

/// Whether an inertia count finds as many eigenvalues as the search, just above the last of them.
/// @param shift of the search, by whose size eigenvalues are told apart
bool is_complete(ShiftedInverse& inverse, double shift, const NaturalMotions& found) {
  const std::size_t n = found.squares.size();
  const auto at = [&](std::size_t i) { return found.squares[i].real(); };
  const double above = at(n - 1) + SearchLimits::gap * (std::abs(at(n - 1)) + std::abs(shift));
  return inverse.factorise(above) == static_cast<int>(n);
}

}  // namespace

NaturalMotions natural_motions(const Structure& structure, StructuralProblem& problem,
                               const MassMatrix& masses, const VectorXd& y, double lambda,
                               const MotionSearch& search) {
  NaturalMotions out;
  ShiftedInverse inverse(structure, problem, masses, y, lambda);
  const double scale = search.scale > 0.0 ? search.scale : masses.scale;
  double shift = factorise_below(inverse, -SearchLimits::first_shift * scale);
  for (unsigned seed = 0; seed < SearchLimits::tries; ++seed) {
    search_at(inverse, shift, search, seed, out);
    if (out.squares.empty()) break;
    // a shift far below the eigenvalues makes them alike: they lose digits, and the iteration is slow
    double size = 0.0;
    for (const auto& mu : out.squares) size = std::max(size, std::abs(mu));
    if (-shift > SearchLimits::far * size && size > SearchLimits::zero * -shift) {
      shift = factorise_below(inverse, -SearchLimits::below * size);
      search_at(inverse, shift, search, seed, out);
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
