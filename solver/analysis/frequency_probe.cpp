#include "solver/analysis/frequency_probe.h"

#include <algorithm>
#include <cmath>

namespace snapthrough {
namespace {

/// Relative errors of the squares of frequencies of paths and static analyses, beside the error of the mesh.
struct RowTolerance {
  static constexpr double on_given_mesh = 1e-9;
  static constexpr double most = 1e-6;           ///< where the accuracy chooses the mesh, at most
  static constexpr double over_accuracy = 1e-3;  ///< over the accuracy that was asked for
  /// Least where the tangent is not symmetric: a motion's residual is as large as the error of its
  /// eigenvalue, and rounding leaves 1e-12 to 1e-11 of it.
  static constexpr double unsymmetric = 1e-10;
};

}  // namespace

FrequencyProbe::FrequencyProbe(const Structure& structure, const Analysis& analysis)
    : structure_(structure), problem_(structure), masses_(make_mass_matrix(structure)) {
  const Discretization& mesh = analysis.discretization;
  is_asked_alone_ = analysis.traits().vibrates;
  search_.count = is_asked_alone_ ? analysis.modes : analysis.output.frequencies;
  if (!is_asked_alone_)
    search_.tolerance = mesh.fixed_mesh
                            ? RowTolerance::on_given_mesh
                            : std::min(RowTolerance::most, RowTolerance::over_accuracy * mesh.accuracy);
  if (!structure.traits.symmetric) search_.tolerance = std::max(search_.tolerance, RowTolerance::unsymmetric);
}

std::optional<NaturalMotions> FrequencyProbe::at(const Eigen::VectorXd& y, double lambda) {
  if (structure_.traits.one_sided && has_any(problem_.contact().marks_at(y))) return std::nullopt;
  NaturalMotions found = natural_motions(structure_, problem_, masses_, y, lambda, search_, columns_);
  search_.begin_with(found);
  if (!is_asked_alone_ && !(found.converged && found.complete)) return std::nullopt;
  return found;
}

Frequencies in_units(const NaturalMotions& motions, const Structure& structure, double unit) {
  Frequencies out;
  for (const auto& square : motions.squares) {
    out.squares.push_back(square.real() * unit);
    if (!structure.traits.symmetric) out.imaginary.push_back(square.imag() * unit);
  }
  return out;
}

}  // namespace snapthrough
