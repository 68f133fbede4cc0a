#include "solver/events/natural_motions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Limits of the search for natural motions; ratios.
struct MotionLimits {
  static constexpr double first_shift = 0.1;  ///< first shift over the scale
  static constexpr std::size_t lowest = 3;  ///< number of eigenvalues that tell the scale of the next search
  /// Eigenvalues over that of a member alone that tell no scale: those of rigid motions are rounding.
  static constexpr double zero = 1e-6;
  static constexpr double deeper = 1e3;  ///< growth of a shift at which heavier motions hide others
  static constexpr int depths = 6;       ///< such shifts at most
};

/// The pencil J - mu M, with inner product x^T M y and a shift below all eigenvalues.
class Vibrations final : public Pencil {
 public:
  Vibrations(const Structure& structure, StructuralProblem& problem, const MassMatrix& masses,
             const VectorXd& y, double lambda)
      : structure_(structure), problem_(problem), masses_(masses), y_(y), lambda_(lambda) {}

  int factorise(double shift) override {
    Regime regime;
    regime.masses = &masses_.elements;
    regime.shift = shift;
    ++factorizations_;
    return problem_.linearise(y_, lambda_, residual_, regime).negative;
  }
  [[nodiscard]] MatrixXd weighted(const MatrixXd& x) override {
    return mass_products(structure_, masses_, x);
  }
  [[nodiscard]] MatrixXd apply(const MatrixXd&, const MatrixXd& weighted) override {
    return response(weighted);
  }
  [[nodiscard]] MatrixXd response(MatrixXd forces) override {
    problem_.to_rows(forces);
    problem_.solve(forces);
    return forces;
  }
  [[nodiscard]] MatrixXd works(const MatrixXd& x) override {
    const MatrixXd forces = problem_.tangent_products(y_, lambda_, x);
    MatrixXd out(x.cols(), x.cols());
    for (Index i = 0; i < x.cols(); ++i)
      for (Index j = 0; j < x.cols(); ++j) out(i, j) = problem_.work(forces.col(j), x.col(i));
    return out;
  }
  [[nodiscard]] Index size() const override { return problem_.size(); }
  [[nodiscard]] Index rank() const override { return masses_.rank; }
  [[nodiscard]] bool is_symmetric() const override { return structure_.traits.symmetric; }
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

}  // namespace

void MotionSearch::begin_with(const NaturalMotions& found) {
  if (!found.motions.allFinite()) {
    near.resize(0, 0);
    return;
  }
  near = found.motions;
  scale = 0.0;
  for (std::size_t i = 0; i < std::min(found.squares.size(), MotionLimits::lowest); ++i)
    scale = std::max(scale, std::abs(found.squares[i]));
}

NaturalMotions natural_motions(const Structure& structure, StructuralProblem& problem,
                               const MassMatrix& masses, const VectorXd& y, double lambda,
                               const MotionSearch& search, KrylovColumns& columns) {
  Vibrations pencil(structure, problem, masses, y, lambda);
  // squares of rigid motions are rounding and tell no scale
  const double scale = search.scale > MotionLimits::zero * masses.scale ? search.scale : masses.scale;
  Shift shift{-MotionLimits::first_shift * scale, 0};
  factorise_below(pencil, shift);
  Eigenpairs found = lowest_eigenpairs(pencil, shift, search, columns);
  // motions whose square is far smaller than the others' are all that is left of a column after a solution
  const int depths = pencil.is_symmetric() ? MotionLimits::depths : 0;
  for (int i = 0; i < depths && static_cast<int>(found.values.size()) < search.count; ++i) {
    shift.at *= MotionLimits::deeper;
    factorise_below(pencil, shift);
    found = lowest_eigenpairs(pencil, shift, search, columns);
  }
  return {std::move(found.values), std::move(found.vectors), found.complete, found.converged,
          pencil.factorizations()};
}

}  // namespace snapthrough
