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
};

}  // namespace

FrequencyProbe::FrequencyProbe(const Structure& structure, const Model& model, const Analysis& analysis)
    : structure_(structure), problem_(structure), masses_(make_mass_matrix(structure, model)) {
  const Discretization& mesh = analysis.discretization;
  search_.counted = analysis.type == AnalysisType::vibration;
  search_.count = search_.counted ? analysis.modes : analysis.output.frequencies;
  if (search_.counted) return;
  search_.tolerance = mesh.fixed_mesh
                          ? RowTolerance::on_given_mesh
                          : std::min(RowTolerance::most, RowTolerance::over_accuracy * mesh.accuracy);
}

std::optional<NaturalMotions> FrequencyProbe::at(const Eigen::VectorXd& y, double lambda) {
  if (structure_.one_sided && has_any(problem_.marks_at(y))) return std::nullopt;
  NaturalMotions found = natural_motions(structure_, problem_, masses_, y, lambda, search_, columns_);
  search_.begin_with(found);
  if (!search_.counted && !found.converged) return std::nullopt;
  return found;
}

Frequencies in_units(const NaturalMotions& motions, const Structure& structure, double unit) {
  Frequencies out;
  for (const auto& square : motions.squares) {
    out.squares.push_back(square.real() * unit);
    if (structure.unsymmetric()) out.imaginary.push_back(square.imag() * unit);
  }
  return out;
}

}  // namespace snapthrough
