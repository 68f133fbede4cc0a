#pragma once
/// @file
/// Balance of what a state says acts on the structure: reactions, springs, bases and loads add up to nothing.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough::testing {

/// Sums and the largest of what is in them.
struct ReactionSum {
  double force[2] = {0.0, 0.0};
  double moment = 0.0;
  double largest_force = 0.0;
  double largest_moment = 0.0;
  double extent = 0.0;  ///< farthest from the origin that members reach

  void add(double fx, double fy, double about_origin) {
    force[0] += fx;
    force[1] += fy;
    moment += about_origin;
    largest_force = std::max({largest_force, std::abs(fx), std::abs(fy)});
    largest_moment = std::max(largest_moment, std::abs(about_origin));
  }
  void add(const Resultant& r) { add(r.fx, r.fy, r.moment); }
  /// What is left over, of the largest; zero where nothing acts. Where all forces pass through the origin
  /// their moments are what rounding makes of them, all alike.
  [[nodiscard]] double imbalance() const {
    const double forces = std::max(std::abs(force[0]), std::abs(force[1]));
    const double rounding = std::numeric_limits<double>::epsilon() * largest_force * extent;
    return std::max(largest_force > 0.0 ? forces / largest_force : 0.0,
                    largest_moment > rounding ? std::abs(moment) / largest_moment : 0.0);
  }
};

/// Adds the section forces to the largest forces only: members that press against each other may be all that
/// is strained.
inline void add_sizes(const State& state, ReactionSum& sum) {
  for (const MemberState& member : state.members)
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      const double force = std::hypot(member.axial_force[i], member.shear_force[i]);
      sum.largest_force = std::max(sum.largest_force, force);
      sum.extent = std::max(sum.extent, std::hypot(member.x[i], member.y[i]));
      sum.largest_moment = std::max({sum.largest_moment, std::abs(member.bending_moment[i]),
                                     force * std::hypot(member.x[i], member.y[i])});
    }
}

/// @brief Sums everything that acts on the structure in a state.
///
/// A reaction acts at its node's deformed position, where the first member of the node begins or ends; with a
/// linear geometry at the undeformed one.
inline ReactionSum reaction_sum(const Model& model, const State& state,
                                Geometry geometry = Geometry::nonlinear) {
  ReactionSum sum;
  for (const SupportState& support : state.supports) {
    double at[2] = {0.0, 0.0};
    for (std::size_t m = model.members.size(); m-- > 0;) {
      const MemberState& member = state.members[m];
      const auto& x = geometry == Geometry::linear ? member.x0 : member.x;
      const auto& y = geometry == Geometry::linear ? member.y0 : member.y;
      if (model.members[m].end == support.node) {
        at[0] = x.back();
        at[1] = y.back();
      }
      if (model.members[m].start == support.node) {
        at[0] = x.front();
        at[1] = y.front();
      }
    }
    sum.add(support.fx, support.fy, support.moment + at[0] * support.fy - at[1] * support.fx);
  }
  for (const SpringState& spring : state.springs) sum.add(spring.resultant);
  for (const FoundationState& base : state.foundations) sum.add(base.resultant);
  sum.add(state.loads);
  add_sizes(state, sum);
  return sum;
}

}  // namespace snapthrough::testing
