#include "solver/analysis/frequency_probe.h"

#include <algorithm>
#include <cmath>

namespace snapthrough {

FrequencyProbe::FrequencyProbe(const Structure& structure, const Model& model, int count, bool counted)
    : structure_(structure), problem_(structure), masses_(make_mass_matrix(structure, model)) {
  search_.count = count;
  search_.counted = counted;
}

std::optional<NaturalMotions> FrequencyProbe::at(const Eigen::VectorXd& y, double lambda) {
  if (structure_.one_sided && has_any(problem_.marks_at(y))) return std::nullopt;
  NaturalMotions found = natural_motions(structure_, problem_, masses_, y, lambda, search_);
  search_.near = found.motions;
  for (const auto& square : found.squares) search_.scale = std::max(search_.scale, std::abs(square));
  return found;
}

Frequencies FrequencyProbe::in_units(const NaturalMotions& motions) const {
  Frequencies out;
  for (const auto& square : motions.squares) {
    out.squares.push_back(square.real() * masses_.square);
    if (problem_.is_unsymmetric()) out.imaginary.push_back(square.imag() * masses_.square);
  }
  return out;
}

}  // namespace snapthrough
