#include "solver/problem/contact_questions.h"

#include <algorithm>
#include <cmath>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

/// What counts as touching without pressure; ratios. Source: docs/decisions/0009 and 0022.
struct TouchingLimits {
  static constexpr double distance = 1e-9;  ///< distance of a support over the largest displacement
  static constexpr double force = 1e-6;     ///< force of a support over the largest force
};

}  // namespace

/// Distances at which supports count as touching at y, from the largest displacement and force.
TouchingDistance ContactQuestions::touching_distance(const VectorXd& y) const {
  const double largest = y.head(DofMap::count(structure_.nodes)).lpNorm<Eigen::Infinity>();
  return {TouchingLimits::distance * largest + Rounding::coordinate,
          TouchingLimits::force * scales_.largest(y, unloaded_),
          Rounding::displacement * largest + Rounding::coordinate};
}

double ContactQuestions::displacement(const NodeSpring& spring, const VectorXd& y,
                                      bool small_displacements) const {
  return spring.motion(y, small_displacements || structure_.geometry == Geometry::linear).w;
}

FrozenContact ContactQuestions::frozen(const VectorXd& y, bool small_displacements) const {
  const double tolerance = touching_distance(y).any;
  FrozenContact out;
  structure_.elements->contacts().freeze(y, tolerance, out);
  for (const NodeSpring& spring : structure_.node_springs)
    out.node_springs.push_back(!spring.law.one_sided ||
                               displacement(spring, y, small_displacements) - spring.law.gap > -tolerance);
  return out;
}

FrozenContact ContactQuestions::frozen(const MovingZones& zones, const VectorXd& y) const {
  FrozenContact out;
  structure_.elements->contacts().freeze(zones, y, out);
  for (const NodeSpring& spring : structure_.node_springs)
    out.node_springs.push_back(spring.acts(displacement(spring, y, false)));
  return out;
}

TouchingMarks ContactQuestions::marks_at(const VectorXd& y, bool small_displacements) const {
  const TouchingDistance near = touching_distance(y);
  TouchingMarks out;
  structure_.elements->contacts().mark_touching(y, near, out);
  for (const NodeSpring& spring : structure_.node_springs)
    out.node_springs.push_back(spring.law.one_sided &&
                               std::abs(displacement(spring, y, small_displacements) - spring.law.gap) <=
                                   near.of(spring.law.stiffness));
  return out;
}

std::size_t ContactQuestions::springs(const TouchingMarks& marks) const {
  return static_cast<std::size_t>(std::count(marks.node_springs.begin(), marks.node_springs.end(), 1) +
                                  std::count(marks.element_springs.begin(), marks.element_springs.end(), 1));
}

void ContactQuestions::displacements(const TouchingMarks& marks, const VectorXd& mode,
                                     std::vector<double>& out) const {
  out.clear();
  for (std::size_t i = 0; i < marks.node_springs.size(); ++i)
    if (marks.node_springs[i] != 0) out.push_back(structure_.node_springs[i].linear(mode));
  structure_.elements->contacts().touching_displacements(marks, mode, out);
}

void ContactQuestions::set(const TouchingMarks& marks, const VectorXd& mode, std::span<const char> springs,
                           FrozenContact& out) const {
  std::size_t next = 0;
  for (std::size_t i = 0; i < marks.node_springs.size(); ++i)
    if (marks.node_springs[i] != 0) out.node_springs[i] = springs[next++];
  structure_.elements->contacts().set_touching(marks, mode, springs.subspan(next), out);
}

TouchingSupports ContactQuestions::touching(const TouchingMarks& marks, const FrozenContact* frozen) const {
  const auto touch = [](bool acts) { return acts ? Touch::acts : Touch::absent; };
  TouchingSupports out;
  for (std::size_t i = 0; i < marks.node_springs.size(); ++i)
    if (marks.node_springs[i] != 0)
      out.springs.push_back(
          {structure_.node_springs[i].spring, touch(frozen != nullptr && frozen->node_springs[i] != 0)});
  for (const TouchingSpring& support : structure_.elements->contacts().touching_springs(marks, frozen))
    if (support.spring >= 0) out.springs.push_back({support.spring, touch(support.acts)});
  for (const TouchingContact& contact : structure_.elements->contacts().touching_contacts(marks, frozen)) {
    const MeshElement& cell = structure_.mesh.elements[contact.element];
    const auto add = [&](double from, double to, bool acts) {
      const double width = cell.to - cell.from;
      if (to - from > kOnePlace)
        out.foundations.push_back(
            {contact.foundation, {cell.from + from * width, cell.from + to * width}, touch(acts)});
    };
    double from = contact.range[0];
    for (const ElementPart& interval : contact.acting) {
      add(from, interval.from, false);
      add(interval.from, interval.to, true);
      from = interval.to;
    }
    add(from, contact.range[1], false);
  }
  return out;
}

}  // namespace snapthrough
