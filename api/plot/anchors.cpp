#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "api/plot/scene.h"

namespace snapthrough::api::plot {
namespace {

/// Largest number of pairs (foundation, member) or (support, member end) to compare. Documents have some
/// hundreds; for a larger one, foundations and supports are not searched.
constexpr double kMostComparisons = 1e7;

/// Largest relative difference of forces taken as equal. Its cause is the linear interpolation of forces
/// between the sampled places of a state.
constexpr double kSameForce = 0.1;

/// Integrals of a foundation's reactions along a member, for an assumed direction into the medium.
struct Sum {
  double fx = 0, fy = 0, moment = 0;
  double size = 0;           ///< integral of |reaction|
  double missed = 0;         ///< sum of |difference| of the displacements into the medium
  double displacements = 0;  ///< sum of the |displacements|
};

Sum sum_of(const DrawnMember& member, const MemberState& moved, const FoundationState& state,
           const ModelFoundation& assumed) {
  Sum sum;
  for (std::size_t i = 0; i < state.s.size(); ++i) {
    const double before = i == 0 ? state.s[i] : state.s[i - 1];
    const double after = i + 1 == state.s.size() ? state.s[i] : state.s[i + 1];
    const double weight = (after - before) / 2 * state.reaction[i];
    const double s = state.s[i];
    const Point d = way_into(assumed, member, s).into;
    const double x = interpolate(moved.s, moved.x, s);
    const double y = interpolate(moved.s, moved.y, s);
    sum.fx -= weight * d.x;
    sum.fy -= weight * d.y;
    sum.moment -= weight * (x * d.y - y * d.x);
    sum.size += std::abs(weight);
    const double w = interpolate(moved.s, moved.u, s) * d.x + interpolate(moved.s, moved.v, s) * d.y;
    sum.missed += std::abs(w - state.displacement[i]);
    sum.displacements += std::abs(w) + std::abs(state.displacement[i]);
  }
  return sum;
}

/// Returns the relative error of an assumption: 0 when resultant and displacements agree with the state.
double misfit(const Sum& sum, const Force& resultant, double arm) {
  if (!(sum.size > 0)) {
    return std::numeric_limits<double>::infinity();
  }
  // Displacements decide between the sides of a closed ring: reactions are in equilibrium on both.
  constexpr double kOfDisplacements = 0.2;
  const double forces = std::hypot(sum.fx - resultant.fx, sum.fy - resultant.fy) / sum.size;
  const double moments = std::abs(sum.moment - resultant.moment) / (sum.size * arm);
  return std::max(forces, moments) +
         kOfDisplacements * (sum.displacements > 0 ? sum.missed / sum.displacements : 0);
}

/// Assumed directions: left, right, and against the resultant (a medium with its own direction).
std::vector<ModelFoundation> assumptions(const std::string& id, const std::string& member,
                                         const Force& resultant) {
  std::vector<ModelFoundation> all(2);
  all[1].side = -1;
  const double size = std::hypot(resultant.fx, resultant.fy);
  if (size > 0) {
    ModelFoundation along;
    along.direction = Point{-resultant.fx / size, -resultant.fy / size};
    all.push_back(along);
  }
  for (ModelFoundation& one : all) {
    one.id = id;
    one.member = member;
  }
  return all;
}

/// Lever arm that makes moments comparable with forces: largest distance from the origin.
double arm_of(const std::vector<DrawnMember>& members) {
  double arm = 0;
  for (const DrawnMember& member : members) {
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      arm = std::max(arm, std::hypot(member.x0[i], member.y0[i]));
    }
  }
  return arm > 0 ? arm : 1;
}

/// Returns whether no reaction is tension; the state does not say more about a one-sided foundation.
bool presses_only(const FoundationState& state) {
  const auto [least, most] = std::minmax_element(state.reaction.begin(), state.reaction.end());
  return *least >= -1e-6 * std::abs(*most);  // tolerance for rounding
}

/// Member ends at one position, with the sum of the forces that balance their internal forces.
struct Corner {
  Point at;
  double fx = 0;
  double fy = 0;
  bool taken = false;
};

using End = std::tuple<double, double, const DrawnMember*, bool>;  // undeformed x, y; member; at its start

/// Returns all member ends sorted by position, so that ends at one position are adjacent.
std::vector<End> ends_of(const std::vector<DrawnMember>& members, double slack) {
  std::vector<End> ends;
  for (const DrawnMember& member : members) {
    for (const bool start : {true, false}) {
      const std::size_t i = start ? 0 : member.s.size() - 1;
      ends.emplace_back(std::round(member.x0[i] / slack), std::round(member.y0[i] / slack), &member, start);
    }
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::pair(std::get<0>(a), std::get<1>(a)) < std::pair(std::get<0>(b), std::get<1>(b));
  });
  return ends;
}

std::vector<Corner> corners_of(const std::vector<DrawnMember>& members, const State& state, double slack) {
  std::vector<Corner> corners;
  std::pair<double, double> last(0, 0);
  for (const auto& [kx, ky, member, start] : ends_of(members, slack)) {
    const MemberState& moved = state.members.at(member->id);
    const std::size_t i = start ? 0 : member->s.size() - 1;
    const Point n = left_normals(moved.x, moved.y)[i];
    const double sign = start ? -1 : 1;  // the section force acts on a member's end, minus it on the start
    const double normal = sign * moved.shear_force[i];
    const double along = sign * moved.axial_force[i];
    if (corners.empty() || last != std::pair(kx, ky)) {
      corners.push_back({{member->x[i], member->y[i]}});
      last = {kx, ky};
    }
    corners.back().fx += along * n.y + normal * n.x;
    corners.back().fy += -along * n.x + normal * n.y;
  }
  return corners;
}

double largest_force(const State& state) {
  double largest = 0;
  for (const auto& [node, force] : state.supports) {
    largest = std::max(largest, std::hypot(force.fx, force.fy));
  }
  return largest;
}

}  // namespace

std::vector<ModelFoundation> foundations_of(const std::vector<DrawnMember>& members, const State& state) {
  std::vector<ModelFoundation> found;
  if (static_cast<double>(state.foundations.size()) * static_cast<double>(members.size()) >
      kMostComparisons) {
    return found;
  }
  const double arm = arm_of(members);
  for (const auto& [id, foundation] : state.foundations) {
    if (foundation.s.size() < 2) {
      continue;
    }
    double least = kSameForce + 0.2;  // 0.2 accepts any displacements: a base may report its own surface
    std::optional<ModelFoundation> best;
    for (const DrawnMember& member : members) {
      if (foundation.s.back() > member.s.back() * (1 + 1e-9)) {
        continue;
      }
      for (ModelFoundation& assumed : assumptions(id, member.id, foundation.resultant)) {
        const double off = misfit(sum_of(member, state.members.at(member.id), foundation, assumed),
                                  foundation.resultant, arm);
        if (off < least) {
          least = off;
          best = std::move(assumed);
        }
      }
    }
    if (best) {
      best->one_sided = best->compression_only = presses_only(foundation);
      found.push_back(std::move(*best));
    }
  }
  return found;
}

std::vector<SupportForce> support_forces_of(const std::vector<DrawnMember>& members, const State& state) {
  std::vector<SupportForce> found;
  if (static_cast<double>(state.supports.size()) * static_cast<double>(2 * members.size()) >
      kMostComparisons) {
    return found;
  }
  constexpr double kVisible = 0.02;  // smallest force drawn, relative to the largest
  const double largest = largest_force(state);
  std::vector<Corner> corners = corners_of(members, state, 1e-6 * arm_of(members));
  for (const auto& [node, force] : state.supports) {
    const double size = std::hypot(force.fx, force.fy);
    if (!(size > kVisible * largest)) {
      continue;
    }
    Corner* best = nullptr;
    double least = kSameForce * size;
    for (Corner& corner : corners) {
      const double off = std::hypot(corner.fx - force.fx, corner.fy - force.fy);
      if (!corner.taken && off < least) {
        least = off;
        best = &corner;
      }
    }
    if (best != nullptr) {
      best->taken = true;
      found.push_back({best->at, force.fx, force.fy});
    }
  }
  return found;
}

}  // namespace snapthrough::api::plot
