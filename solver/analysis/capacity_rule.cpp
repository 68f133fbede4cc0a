#include "solver/analysis/capacity_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/analysis/analyses.h"
#include "solver/analysis/softest_point.h"
#include "solver/discrete/capacity_balance.h"
#include "solver/events/critical_mode.h"
#include "solver/numeric/number_text.h"
#include "solver/report/capacity.h"
#include "solver/report/mode.h"
#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

/// Limits of the end of a path at the capacity of supports; ratios without unit. Source: docs/decisions/0036.
struct CapacityLimits {
  /// Largest difference of rotations within a member, over the angle by which the largest displacement turns
  /// the member, of a motion that moves the member as a whole.
  static constexpr double bend = 0.1;
  static constexpr int points = 11;  ///< places of a member at which the rotation is read
};

/// Whether a motion turns each member as a whole.
bool moves_rigidly(const Mode& motion) {
  double displaced = 0.0;
  double turned = 0.0;
  for (const MemberMode& member : motion.members) {
    for (std::size_t i = 0; i < member.s.size(); ++i) {
      displaced = std::max(displaced, std::hypot(member.u[i], member.v[i]));
      turned = std::max(turned, std::abs(member.rotation[i]));
    }
  }
  return std::ranges::all_of(motion.members, [&](const MemberMode& member) {
    if (member.rotation.empty()) return true;
    const auto [least, most] = std::ranges::minmax(member.rotation);
    const double angle = member.s.back() > 0.0 ? displaced / member.s.back() : 0.0;
    return most - least <= CapacityLimits::bend * std::max(turned, angle);
  });
}

}  // namespace

std::optional<CapacityRule> capacity_rule(const CapacityEnds* ends, const Structure& structure,
                                          StructuralProblem& problem, const std::vector<double>& asked) {
  if (ends == nullptr) return std::nullopt;
  constexpr double any = std::numeric_limits<double>::infinity();
  const double scale = structure.scales.load;
  CapacityRule rule;
  rule.limits = {ends->falling ? ends->falling->factor * scale : -any,
                 ends->growing ? ends->growing->factor * scale : any};
  rule.range = {CapacityRule::reached * rule.limits[0], CapacityRule::reached * rule.limits[1]};
  for (const double factor : asked) {
    if (ends->is_beyond(factor)) continue;
    rule.range = {std::min(rule.range[0], factor * scale), std::max(rule.range[1], factor * scale)};
  }
  rule.moves_rigidly = [&structure, &problem](const CriticalEvent& event) {
    return moves_rigidly(mode_displacements(structure, mode_of(problem, event), CapacityLimits::points));
  };
  return rule;
}

double capacity_load(const CapacityEnds& ends, const Structure& structure, const TraceOutcome& outcome) {
  if (outcome.on_critical && outcome.critical.back().cause != CriticalCause::contact)
    return outcome.critical.back().point.lambda / structure.scales.load;
  return ends.of(outcome.last.lambda)->factor;
}

std::string report_capacity(const CapacityEnds& ends, const ResolvedModel& model, double load_factor,
                            Result& result) {
  const CapacityEnd& end = *ends.of(load_factor);
  result.capacity.push_back(capacity_limit(model, ends, end, load_factor));
  return "supports carry no more than load factor " + number(load_factor) + ": " +
         capacity_text(model, ends, end);
}

void report_capacity_point(const Analysis& analysis, const CapacityEnds& ends, const Structure& structure,
                           const TraceOutcome& outcome, std::size_t count, Result& result) {
  const ResolvedModel& model = *structure.model;
  if (!outcome.on_critical) {
    CriticalPoint point;
    point.load_factor = capacity_load(ends, structure, outcome);
    point.error_estimate = std::abs(1.0 - outcome.last.lambda / structure.scales.load / point.load_factor);
    point.arc_length = outcome.last.arc_length;
    point.negative_before = point.negative_after = outcome.last.negative;
    point.monitors = monitor_values(structure, outcome.last.y);
    result.critical_points.insert(result.critical_points.begin() + static_cast<std::ptrdiff_t>(count++),
                                  point);
  }
  CriticalPoint& point = result.critical_points[count - 1];
  point.type = CriticalType::capacity;
  point.confirmed = true;
  Summary& summary = result.summary;
  summary.message = report_capacity(ends, model, point.load_factor, result) + "; " + summary.message;
  const bool is_first = !summary.critical_load_factor || *summary.critical_load_factor == point.load_factor;
  if (!is_first || point.load_factor * path_direction(analysis) < 0.0) return;
  summary.critical_load_factor = point.load_factor;
  summary.critical_type = point.type;
  summary.error_estimate = point.error_estimate;
  if (!summary.at_critical) summary.at_critical = at_critical(structure, outcome.last.y);
}

std::string report_exceeded(const ResolvedModel& model, const CapacityEnds& ends,
                            const std::vector<double>& factors, Result& result) {
  std::string text;
  for (const auto* end : {&ends.growing, &ends.falling}) {
    const bool exceeded = std::ranges::any_of(
        factors, [&](double factor) { return &ends.of(factor) == end && ends.is_beyond(factor); });
    if (!exceeded) continue;
    result.capacity.push_back(capacity_limit(model, ends, **end, (*end)->factor));
    if (text.empty())
      text = "supports carry no more than load factor " + number((*end)->factor) + ": " +
             capacity_text(model, ends, **end);
  }
  return text;
}

}  // namespace snapthrough
