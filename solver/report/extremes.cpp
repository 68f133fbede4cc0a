#include "solver/report/extremes.h"

#include <cmath>
#include <cstddef>

namespace snapthrough {
namespace {

void widen(const Extreme& at, ExtremeRange& range) {
  if (at.value < range.min.value) range.min = at;
  if (at.value > range.max.value) range.max = at;
}

/// Extremes of a member initialised with its first sampled place.
MemberExtremes first_place(const MemberState& member, int branch, double load_factor) {
  const auto at = [&](double value) { return Extreme{value, member.s.front(), branch, load_factor}; };
  const auto range = [&](const std::vector<double>& values) {
    return ExtremeRange{at(values.front()), at(values.front())};
  };
  return {member.id, range(member.axial_force), range(member.shear_force), range(member.bending_moment),
          at(std::hypot(member.u.front(), member.v.front()))};
}

}  // namespace

void widen_extremes(const std::vector<MemberState>& members, int branch, double load_factor,
                    std::vector<MemberExtremes>& extremes) {
  for (std::size_t m = 0; m < members.size(); ++m) {
    const MemberState& member = members[m];
    if (extremes.size() == m) extremes.push_back(first_place(member, branch, load_factor));
    MemberExtremes& out = extremes[m];
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      const auto at = [&](double value) { return Extreme{value, member.s[i], branch, load_factor}; };
      widen(at(member.axial_force[i]), out.axial_force);
      widen(at(member.shear_force[i]), out.shear_force);
      widen(at(member.bending_moment[i]), out.bending_moment);
      const Extreme moved = at(std::hypot(member.u[i], member.v[i]));
      if (moved.value > out.displacement.value) out.displacement = moved;
    }
  }
}

}  // namespace snapthrough
