#include "solver/accuracy/state_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/layer_state.h"
#include "solver/discrete/transfer.h"
#include "solver/numeric/rounding.h"
#include "solver/report/section_force.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Adds displacements and section forces at a place of an element.
void add_place(const Structure& structure, int element, double xi, const ElementReader& reader,
               const SectionForces& forces, StateValues& out) {
  const MeshElement& cell = structure.mesh.elements[element];
  const StressFreeAxis& axis = *structure.stress_free[cell.member];
  const auto u = reader.displacement(xi);
  const auto n = forces.at(xi);
  const double s = axis.perfect().length() * (cell.from + xi * (cell.to - cell.from));
  const double angle = axis.at(s).angle + (structure.geometry == Geometry::linear ? 0.0 : u[2]);
  const auto raise = [&out](ValueKind kind, double value) {
    out[kind].back() = std::max(out[kind].back(), std::abs(value));
  };
  raise(ValueKind::displacement, std::hypot(u[0], u[1]));
  raise(ValueKind::rotation, u[2]);
  raise(ValueKind::axial_force, n[0] * std::cos(angle) + n[1] * std::sin(angle));
  raise(ValueKind::shear_force, -n[0] * std::sin(angle) + n[1] * std::cos(angle));
  raise(ValueKind::moment, n[2]);
}

/// Places of an element at which states are compared; `halves` as for values_of().
std::span<const double> places_of(int element, int first, bool halves) {
  static constexpr std::array whole{0.25, 1.0};
  static constexpr std::array half{0.5, 1.0};
  if (!halves) return whole;
  return std::span(half).subspan((element - first) % 2 == 0 ? 0 : 1, 1);
}

/// Largest size of the numbers.
double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Largest sizes of section forces and gradients of a state: N, Q, M, then u'_x, u'_y, b'.
std::array<double, 6> largest_unknowns(const Structure& structure, const VectorXd& y) {
  std::array<double, 6> out{};
  const int p = structure.mesh.order;
  for (const ElementDofs& dofs : structure.dofs)
    for (int c = 0; c < 3; ++c) {
      out[c] = std::max(out[c], y.segment(dofs.s + c * p, p).lpNorm<Eigen::Infinity>());
      out[3 + c] = std::max(out[3 + c], y.segment(dofs.v + c * p, p).lpNorm<Eigen::Infinity>());
    }
  const double force = std::max({out[0], out[1], out[2]});
  const double gradient = std::max({out[3], out[4], out[5]});
  for (std::size_t c = 0; c < 6; ++c)
    out[c] = std::max(out[c], Rounding::motion * (c < 3 ? force : gradient));
  return out;
}

/// Force that is rounding beside those that would bend the softest section as the displacements do: a
/// statically determinate structure that is strained has displacements, and no forces.
double least_force_of(const Structure& structure, const Model& model, const VectorXd& y) {
  double softest = std::numeric_limits<double>::infinity();
  for (const Section& section : model.sections) softest = std::min(softest, section.EI.least());
  double gradient = 0.0;
  for (const ElementDofs& dofs : structure.dofs)
    gradient = std::max(gradient, y.segment(dofs.v, 3 * structure.mesh.order).lpNorm<Eigen::Infinity>());
  const Scales& scales = structure.scales;
  return Rounding::motion * gradient * softest / (scales.force * scales.length * scales.length);
}

}  // namespace

StateValues values_of(const Structure& structure, const Model& model, const VectorXd& y, double lambda,
                      bool halves) {
  StateValues out;
  const std::vector<LayerState> layers = layer_states(structure, y);
  for (std::size_t m = 0; m + 1 < structure.mesh.first.size(); ++m) {
    const int first = structure.mesh.first[m];
    for (auto& values : out.of) values.push_back(0.0);
    for (int e = first; e < structure.mesh.first[m + 1]; ++e) {
      const ElementReader reader(structure, y, e);
      const SectionForces forces(structure, model, y, lambda, layers, e);
      if (e == first) add_place(structure, e, 0.0, reader, forces, out);
      for (const double xi : places_of(e, first, halves)) add_place(structure, e, xi, reader, forces, out);
    }
  }
  out.least_force = least_force_of(structure, model, y);
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const bool turns = !model.springs[i].direction && !model.springs[i].rod;
    out[turns ? ValueKind::moment : ValueKind::axial_force].push_back(
        reading_of(structure, model, i, y).force);
  }
  return out;
}

double relative_difference(const StateValues& coarse, const StateValues& fine) {
  constexpr std::size_t forces = static_cast<std::size_t>(ValueKind::axial_force);
  std::array<double, kValueKinds> largest{};
  std::array<double, 2> of_all{};
  for (std::size_t k = 0; k < kValueKinds; ++k) {
    largest[k] = largest_of(fine.of[k]);
    double& all = of_all[k < forces ? 0 : 1];
    all = std::max(all, largest[k]);
  }
  double out = 0.0;
  for (std::size_t k = 0; k < kValueKinds; ++k) {
    const double rounding =
        k < forces ? Rounding::force * of_all[0] : std::max(Rounding::force * of_all[1], fine.least_force);
    for (std::size_t i = 0; i < fine.of[k].size(); ++i) {
      const double difference = std::abs(coarse.of[k][i] - fine.of[k][i]) - rounding;
      if (difference > 0.0) out = std::max(out, difference / std::max(largest[k], rounding));
    }
  }
  return out;
}

std::vector<double> local_differences(const Structure& coarse, const Structure& fine, const VectorXd& y) {
  const Eigen::MatrixXd back = transfer(coarse, transfer(fine, y, coarse), fine);
  const std::array<double, 6> largest = largest_unknowns(fine, y);
  const int p = fine.mesh.order;
  std::vector<double> out(coarse.dofs.size(), 0.0);
  for (std::size_t e = 0; e < fine.dofs.size(); ++e)
    for (int c = 0; c < 3; ++c)
      for (const auto& [first, size] :
           {std::pair{fine.dofs[e].s, largest[c]}, std::pair{fine.dofs[e].v, largest[3 + c]}}) {
        const Eigen::Index at = first + c * p;
        const double difference = (back.col(0).segment(at, p) - y.segment(at, p)).lpNorm<Eigen::Infinity>();
        if (size > 0.0) out[e / 2] = std::max(out[e / 2], difference / size);
      }
  return out;
}

}  // namespace snapthrough
