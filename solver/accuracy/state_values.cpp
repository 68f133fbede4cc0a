#include "solver/accuracy/state_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/layer_state.h"
#include "solver/discrete/transfer.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/rounding.h"
#include "solver/report/section_force.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Whether the one-sided foundations of a member react with the stiffness of the model on all its elements.
/// Else the peaks of their reaction at the ends of contact are those of the mesh, and so is the shear force
/// there.
bool is_resolved(const Structure& structure, std::size_t member) {
  const ResolvedModel& model = *structure.model;
  const auto first = structure.stiffest.begin() + structure.mesh.first[member];
  const auto end = structure.stiffest.begin() + structure.mesh.first[member + 1];
  const double bound = *std::min_element(first, end);
  for (std::size_t i = 0; i < model.foundations.size(); ++i) {
    const ResolvedFoundation& foundation = model.foundations[i];
    if (foundation.member != static_cast<int>(member) || !structure.foundation_laws[i].law.one_sided)
      continue;
    const bool is_rigid = !std::isfinite(initial_stiffness(foundation));
    if (is_rigid || structure.foundation_laws[i].law.stiffness > bound) return false;
  }
  return true;
}

/// Adds displacements and section forces at a place of an element.
/// @param shear whether the shear force counts
void add_place(const Structure& structure, int element, double xi, bool shear, const ElementReader& reader,
               const SectionForces& forces, StateValues& out) {
  const MeshElement& cell = structure.mesh.elements[element];
  const StressFreeAxis& axis = *structure.stress_free[cell.member];
  const auto u = reader.displacement(xi);
  const auto n = forces.at(xi);
  const double s = axis.perfect().length() * (cell.from + xi * (cell.to - cell.from));
  const double angle = axis.at(s).angle + (structure.geometry == Geometry::linear ? 0.0 : u[2]);
  const auto add = [&out](ValueKind kind, double value) { out[kind].back().push_back(std::abs(value)); };
  add(ValueKind::displacement, std::hypot(u[0], u[1]));
  add(ValueKind::rotation, u[2]);
  add(ValueKind::axial_force, n[0] * std::cos(angle) + n[1] * std::sin(angle));
  if (shear) add(ValueKind::shear_force, -n[0] * std::sin(angle) + n[1] * std::cos(angle));
  add(ValueKind::moment, n[2]);
}

/// Places of an element at which states are compared; `halves` as for values_of().
std::span<const double> places_of(bool halves) {
  static constexpr std::array whole{0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0};
  static constexpr std::array half{0.25, 0.5, 0.75, 1.0};
  return halves ? std::span<const double>(half) : std::span<const double>(whole);
}

/// Numbers of the comparison of states; ratios. Chosen by random structures: docs/theory.md, Accuracy of
/// states.
struct Comparison {
  /// Error over the difference of largest values: the errors of both may have opposite signs.
  static constexpr double safety = 2.0;
  static constexpr double near = 0.9;  ///< share of the largest magnitude from which on a place is near it
};

double largest_of(const std::vector<double>& magnitudes) {
  return magnitudes.empty() ? 0.0 : *std::max_element(magnitudes.begin(), magnitudes.end());
}

/// Error of the coarser of two lists of magnitudes at the same places; zero where only one of them counts.
/// @param beside whether differences beside the largest magnitude count
double error_of(const std::vector<double>& coarse, const std::vector<double>& fine, bool beside) {
  if (coarse.size() != fine.size()) return 0.0;
  const double largest = largest_of(fine);
  double out = Comparison::safety * std::abs(largest_of(coarse) - largest);
  for (std::size_t i = 0; beside && i < fine.size(); ++i)
    if (fine[i] >= Comparison::near * largest) out = std::max(out, std::abs(coarse[i] - fine[i]));
  return out;
}

bool is_force(std::size_t kind) { return kind >= static_cast<std::size_t>(ValueKind::axial_force); }

/// Whether differences beside the largest magnitude of a kind count.
bool counts_beside(std::size_t kind) {
  return kind == static_cast<std::size_t>(ValueKind::displacement) ||
         kind == static_cast<std::size_t>(ValueKind::moment);
}

/// Largest sizes of section forces and gradients of a state: N, Q, M, then u'_x, u'_y, b'.
std::array<double, 6> largest_unknowns(const Structure& structure, const VectorXd& y) {
  std::array<double, 6> out{};
  const int p = structure.mesh.order;
  for (const ElementDofs& dofs : structure.dofs) {
    for (int c = 0; c < 3; ++c) {
      out[c] = std::max(out[c], y.segment(dofs.s + c * p, p).lpNorm<Eigen::Infinity>());
      out[3 + c] = std::max(out[3 + c], y.segment(dofs.v + c * p, p).lpNorm<Eigen::Infinity>());
    }
  }
  const double force = std::max({out[0], out[1], out[2]});
  const double gradient = std::max({out[3], out[4], out[5]});
  for (std::size_t c = 0; c < 6; ++c)
    out[c] = std::max(out[c], Rounding::motion * (c < 3 ? force : gradient));
  return out;
}

/// Force that is rounding beside the loads, and beside those that would bend the softest section as the
/// displacements do: a statically determinate structure that is strained has displacements and no forces, and
/// a block that lies evenly on a bed has loads and no section forces.
double least_force_of(const Structure& structure, const VectorXd& y, double lambda) {
  const ResolvedModel& model = *structure.model;
  double softest = std::numeric_limits<double>::infinity();
  for (const Section& section : model.sections) softest = std::min(softest, section.EI.least());
  double gradient = 0.0;
  for (const ElementDofs& dofs : structure.dofs)
    gradient =
        std::max(gradient, y.segment(dofs.v, DofMap::count(structure.mesh.order)).lpNorm<Eigen::Infinity>());
  const Scales& scales = structure.scales;
  const double loads = (lambda * structure.proportional_load + structure.constant_load).lpNorm<1>();
  return Rounding::force *
         std::max(loads, gradient * softest / (scales.force * scales.length * scales.length));
}

}  // namespace

StateValues values_of(const Structure& structure, const VectorXd& y, double lambda, bool halves) {
  const ResolvedModel& model = *structure.model;
  StateValues out;
  const std::vector<LayerState> layers = layer_states(structure, y);
  for (std::size_t m = 0; m + 1 < structure.mesh.first.size(); ++m) {
    const int first = structure.mesh.first[m];
    for (auto& values : out.of) values.emplace_back();
    const bool shear = is_resolved(structure, m);
    for (int e = first; e < structure.mesh.first[m + 1]; ++e) {
      const ElementReader reader(structure, y, e);
      const SectionForces forces(structure, y, lambda, layers, e);
      if (e == first) add_place(structure, e, 0.0, shear, reader, forces, out);
      for (const double xi : places_of(halves)) add_place(structure, e, xi, shear, reader, forces, out);
    }
  }
  out.least_force = least_force_of(structure, y, lambda);
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const bool turns = !model.springs[i].direction && !model.springs[i].rod;
    out[turns ? ValueKind::moment : ValueKind::axial_force].push_back(
        {std::abs(reading_of(structure, i, y).force)});
  }
  return out;
}

double relative_error(const StateValues& coarse, const StateValues& fine, double accuracy) {
  std::array<double, kValueKinds> largest{};
  double of_motions = 0.0;
  double of_forces = 0.0;
  for (std::size_t k = 0; k < kValueKinds; ++k) {
    for (const std::vector<double>& one : fine.of[k]) largest[k] = std::max(largest[k], largest_of(one));
    double& of_all = is_force(k) ? of_forces : of_motions;
    of_all = std::max(of_all, largest[k]);
  }
  // scaled lengths are of the order of one
  const double least_force = std::max(Rounding::force * of_forces, fine.least_force);
  double out = 0.0;
  for (std::size_t k = 0; k < kValueKinds; ++k) {
    if (!(largest[k] > (is_force(k) ? least_force : Rounding::coordinate))) continue;
    const double rounding =
        is_force(k) ? Rounding::cancelled_sum * of_forces : Rounding::displacement * of_motions;
    for (std::size_t i = 0; i < fine.of[k].size(); ++i) {
      const double difference = error_of(coarse.of[k][i], fine.of[k][i], counts_beside(k));
      const double beyond_rounding = (difference - rounding) / largest[k];
      out = std::max(
          out, beyond_rounding > accuracy ? beyond_rounding : std::min(difference / largest[k], accuracy));
    }
  }
  return out;
}

std::vector<double> local_differences(const Structure& coarse, const Structure& fine, const VectorXd& y) {
  const Eigen::MatrixXd back = transfer(coarse, transfer(fine, y, coarse), fine);
  const std::array<double, 6> largest = largest_unknowns(fine, y);
  const int p = fine.mesh.order;
  std::vector<double> out(coarse.dofs.size(), 0.0);
  for (std::size_t e = 0; e < fine.dofs.size(); ++e) {
    for (int c = 0; c < 3; ++c) {
      for (const auto& [first, size] :
           {std::pair{fine.dofs[e].s, largest[c]}, std::pair{fine.dofs[e].v, largest[3 + c]}}) {
        const Eigen::Index at = first + c * p;
        const double difference = (back.col(0).segment(at, p) - y.segment(at, p)).lpNorm<Eigen::Infinity>();
        if (size > 0.0) out[e / 2] = std::max(out[e / 2], difference / size);
      }
    }
  }
  return out;
}

}  // namespace snapthrough
