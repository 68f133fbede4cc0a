#include "solver/trace/imperfect_bifurcations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace snapthrough {
namespace {

/// Numbers of steps beside a bifurcation; ratios without unit.
struct NearBifurcation {
  static constexpr double step = 0.5;       ///< largest step over the distance to the bifurcation
  static constexpr double expected = 2e-3;  ///< least step near an expected load, over that load
  /// Imperfection on a finer mesh, over that on the path's own, of a bifurcation which the mesh breaks.
  static constexpr double fall = 0.1;
};

bool is_near_load(double load, double other) { return std::abs(load - other) <= kSameLoad * std::abs(load); }

}  // namespace

bool ImperfectBifurcations::is_perfect(const std::vector<CriticalEvent>& events) {
  if (events.empty()) return false;
  const CriticalEvent& first = events.front();
  if (first.imperfection <= rules_.locate.perfect) return true;
  if (last_ && is_near_load(first.point.lambda, last_->point.lambda)) return false;
  const auto finer = rules_.finer_imperfection ? rules_.finer_imperfection(first) : first.imperfection;
  if (finer && *finer <= NearBifurcation::fall * first.imperfection) return true;
  last_ = first;
  if (!finer) return false;
  CriticalEvent event = first;
  event.type = CriticalType::broken_bifurcation;
  pending_.push_back(std::move(event));
  return false;
}

double ImperfectBifurcations::limit_step(const PathPoint& from, double wanted) const {
  if (last_) {
    const double load = broken_share(last_->imperfection) * std::abs(last_->point.lambda);
    const double reach = load / std::abs(last_->point.tangent_lambda);
    wanted = std::min(wanted, std::max(NearBifurcation::step * norm_.distance(from, last_->point), reach));
  }
  for (const double load : rules_.expected) {
    const double room = std::max(NearBifurcation::step * std::abs(load - from.lambda),
                                 NearBifurcation::expected * std::abs(load));
    wanted = std::min(wanted, room / std::abs(from.tangent_lambda));
  }
  return wanted;
}

void ImperfectBifurcations::report_passed(const PathPoint& to, bool may_end,
                                          std::vector<CriticalEvent>& events) {
  const auto is_met = [&](const CriticalEvent& broken) {
    return std::any_of(events.begin(), events.end(), [&](const CriticalEvent& event) {
      return event.type == CriticalType::bifurcation && is_near_load(broken.point.lambda, event.point.lambda);
    });
  };
  std::erase_if(pending_, is_met);
  const auto is_passed = [&](const CriticalEvent& broken) {
    return norm_.metric().inner(broken.point.y - to.y, broken.point.lambda - to.lambda, to.tangent,
                                to.tangent_lambda) <= 0.0;
  };
  const bool all = may_end || !events.empty();
  const auto end = all ? pending_.end() : std::stable_partition(pending_.begin(), pending_.end(), is_passed);
  // one that the path turns away from is reported where it does
  const double reached = events.empty() ? to.arc_length : events.front().point.arc_length;
  for (auto event = pending_.begin(); event != end; ++event)
    event->point.arc_length = std::min(event->point.arc_length, reached);
  events.insert(events.begin(), pending_.begin(), end);
  pending_.erase(pending_.begin(), end);
}

}  // namespace snapthrough
