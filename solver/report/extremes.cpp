#include "solver/report/extremes.h"

#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

Extreme extreme(const Peak& peak, int branch, double load_factor) {
  return {peak.value, peak.s, branch, load_factor};
}

void widen(const PeakRange& by, int branch, double load_factor, ExtremeRange& range) {
  if (by.min.value < range.min.value) range.min = extreme(by.min, branch, load_factor);
  if (by.max.value > range.max.value) range.max = extreme(by.max, branch, load_factor);
}

/// Extremes of a member over its first state.
MemberExtremes first_state(const MemberState& member, int branch, double load_factor) {
  const auto range = [&](const PeakRange& of) {
    return ExtremeRange{extreme(of.min, branch, load_factor), extreme(of.max, branch, load_factor)};
  };
  const MemberPeaks& peaks = member.extremes;
  MemberExtremes out{member.id,
                     range(peaks.axial_force),
                     range(peaks.shear_force),
                     range(peaks.bending_moment),
                     extreme(peaks.displacement, branch, load_factor),
                     {}};
  if (peaks.utilisation) out.utilisation = {*peaks.utilisation, branch, load_factor};
  return out;
}

}  // namespace

void widen_extremes(const std::vector<MemberState>& members, int branch, double load_factor,
                    std::vector<MemberExtremes>& extremes) {
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (extremes.size() == m) {
      extremes.push_back(first_state(members[m], branch, load_factor));
      continue;
    }
    const MemberPeaks& peaks = members[m].extremes;
    MemberExtremes& out = extremes[m];
    widen(peaks.axial_force, branch, load_factor, out.axial_force);
    widen(peaks.shear_force, branch, load_factor, out.shear_force);
    widen(peaks.bending_moment, branch, load_factor, out.bending_moment);
    if (peaks.displacement.value > out.displacement.value)
      out.displacement = extreme(peaks.displacement, branch, load_factor);
    if (peaks.utilisation && std::abs(peaks.utilisation->value) > std::abs(out.utilisation->place.value))
      out.utilisation = {*peaks.utilisation, branch, load_factor};
  }
}

}  // namespace snapthrough
