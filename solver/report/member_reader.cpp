#include "solver/report/member_reader.h"

#include <algorithm>

#include "solver/report/utilisation.h"

namespace snapthrough {
namespace {

/// Fractions at which the numbers of a strength bend.
std::vector<double> bends_of(const Strength& strength) {
  std::vector<double> out;
  for (const AlongMember* number : {&strength.axial_force, &strength.bending_moment})
    for (const auto& point : number->points) out.push_back(point.first);
  return out;
}

}  // namespace

MemberReader::MemberReader(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                           const std::vector<LayerState>& layers, int member)
    : structure_(structure), axis_(*structure.stress_free[member]), member_(member) {
  const int first = structure.mesh.first[static_cast<std::size_t>(member)];
  const int end = structure.mesh.first[static_cast<std::size_t>(member) + 1];
  for (int e = first; e < end; ++e)
    elements_.push_back({ElementReader(structure, y, e), SectionForces(structure, y, lambda, layers, e)});
}

MemberReader::Values MemberReader::at(const MeshPlace& place) const {
  const Element& element = elements_[index_of(place.element)];
  const double L = structure_.scales.length;
  const double F = structure_.scales.force;
  const auto u = element.displacements.displacement(place.xi);
  const auto n = element.forces.at(place.xi);
  // small displacements: equilibrium of the undeformed shape
  const double angle = undeformed(s_of(place)).angle + (structure_.geometry == Geometry::linear ? 0.0 : u[2]);
  return {{L * u[0], L * u[1], u[2]},
          F * (n[0] * std::cos(angle) + n[1] * std::sin(angle)),
          F * (-n[0] * std::sin(angle) + n[1] * std::cos(angle)),
          F * L * n[2]};
}

const Strength* MemberReader::strength() const {
  const ResolvedModel& model = *structure_.model;
  const Section& section = model.section_of(model.members[static_cast<std::size_t>(member_)]);
  return section.strength ? &*section.strength : nullptr;
}

std::array<double, 2> MemberReader::utilisations(const MeshPlace& place) const {
  const Values values = at(place);
  return fibre_utilisations(*strength(), fraction_of(place), values.axial_force, values.bending_moment);
}

/// Places inside an element, ascending, at which forces jump or turn, or one of some fractions lies.
std::vector<double> MemberReader::breaks_of(std::size_t index, const std::vector<double>& bends) const {
  const int first = structure_.mesh.first[static_cast<std::size_t>(member_)];
  const MeshElement& cell = structure_.mesh.elements[static_cast<std::size_t>(first) + index];
  std::vector<double> out = elements_[index].forces.breaks();
  for (const double bend : bends) {
    const double xi = (bend - cell.from) / (cell.to - cell.from);
    if (xi > kOnePlace && xi < 1.0 - kOnePlace) out.push_back(xi);
  }
  std::ranges::sort(out);
  const auto is_one = [](double a, double b) { return b - a <= 2.0 * kOnePlace; };
  out.erase(std::ranges::unique(out, is_one).begin(), out.end());
  return out;
}

/// Search for extremes of functions of a place along the member.
/// @param bends fractions of the member at which a function turns
/// @param known arc lengths, ascending, whose values known_values(index) gives
/// @param values_at values at a MeshPlace
template <std::size_t count, class KnownValues, class ValuesAt>
PeakSearch<count> MemberReader::search(const std::vector<double>& bends, const std::vector<double>& known,
                                       const KnownValues& known_values, const ValuesAt& values_at) const {
  PeakSearch<count> out;
  const auto values_at_s = [&](double s) { return values_at(place(s)); };
  const int first = structure_.mesh.first[static_cast<std::size_t>(member_)];
  const auto sample = [&](std::size_t element, double xi) {
    const MeshPlace place{first + static_cast<int>(element), xi};
    return typename PeakSearch<count>::Sample{s_of(place), values_at(place)};
  };
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    auto from = sample(i, 0.0);
    for (const double xi : breaks_of(i, bends)) {
      // forces have the value beyond a jump at the jump itself
      out.add_piece(known, known_values, from, sample(i, xi - kOnePlace), values_at_s);
      from = sample(i, xi);
    }
    out.add_piece(known, known_values, from, sample(i, 1.0), values_at_s);
  }
  out.refine(values_at_s);
  return out;
}

MemberPeaks MemberReader::peaks(const MemberState& known) const {
  const auto known_values = [&known](std::size_t i) {
    return std::array{known.axial_force[i], known.shear_force[i], known.bending_moment[i],
                      std::hypot(known.u[i], known.v[i])};
  };
  const auto values_at = [this](const MeshPlace& place) {
    const Values values = at(place);
    return std::array{values.axial_force, values.shear_force, values.bending_moment,
                      std::hypot(values.displacement[0], values.displacement[1])};
  };
  const auto values_at_s = [&](double s) { return values_at(place(s)); };
  const PeakSearch<4> found = search<4>({}, known.s, known_values, values_at);
  return {found.range(0, values_at_s),
          found.range(1, values_at_s),
          found.range(2, values_at_s),
          found.largest(3, 1.0, values_at_s),
          {}};
}

Utilisation MemberReader::largest_utilisation(const MemberState& known) const {
  const auto values_at = [this](const MeshPlace& place) { return utilisations(place); };
  const auto values_at_s = [&](double s) { return values_at(place(s)); };
  const auto known_values = [&known](std::size_t i) {
    return std::array{known.utilisation_left[i], known.utilisation_right[i]};
  };
  const PeakSearch<2> found = search<2>(bends_of(*strength()), known.s, known_values, values_at);
  Utilisation largest;
  for (const Fibre fibre : {Fibre::left, Fibre::right}) {
    const PeakRange range = found.range(static_cast<std::size_t>(fibre), values_at_s);
    for (const Peak& peak : {range.max, range.min})
      if (const Utilisation one{peak.value, peak.s, fibre}; exceeds(one, largest)) largest = one;
  }
  return largest;
}

Utilisation MemberReader::sampled_utilisation() const {
  const std::vector<double> bends = bends_of(*strength());
  const int first = structure_.mesh.first[static_cast<std::size_t>(member_)];
  Utilisation largest;
  const auto take = [&](const MeshPlace& place) {
    const auto [left, right] = utilisations(place);
    const double s = s_of(place);
    for (const Utilisation& one : {Utilisation{left, s, Fibre::left}, Utilisation{right, s, Fibre::right}})
      if (exceeds(one, largest)) largest = one;
  };
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const int element = first + static_cast<int>(i);
    if (i == 0) take({element, 0.0});
    for (const double xi : {0.5, 1.0}) take({element, xi});
    for (const double xi : breaks_of(i, bends)) {
      take({element, xi - kOnePlace});
      take({element, xi});
    }
  }
  return largest;
}

}  // namespace snapthrough
