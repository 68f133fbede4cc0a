#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/analysis/analyses.h"
#include "solver/column/exact_column.h"
#include "solver/hooks.h"
#include "solver/report/mode.h"

namespace snapthrough {
namespace {

/// Samples a mode at equally spaced places of each member.
Mode sample(const ColumnLine& line, const ColumnMode& mode, const ResolvedModel& model,
            const std::vector<double>& lengths, int points) {
  Mode out;
  out.members.resize(model.members.size());
  for (std::size_t m = 0; m < out.members.size(); ++m) {
    MemberMode& member = out.members[m];
    member.id = model.members[m].id;
    for (auto* values : {&member.s, &member.u, &member.v, &member.rotation})
      values->resize(static_cast<std::size_t>(points));
  }
  for (std::size_t i = 0; i < line.spans.size(); ++i) {
    const ColumnSpan& span = line.spans[i];
    MemberMode& member = out.members[span.member];
    const double lo = std::min(span.fractions[0], span.fractions[1]);
    const double hi = std::max(span.fractions[0], span.fractions[1]);
    // a place between two spans gets the values of the later span, which agree with those of the earlier one
    for (int k = std::max(0, static_cast<int>(lo * (points - 1))); k < points; ++k) {
      const double fraction = static_cast<double>(k) / (points - 1);
      if (fraction < lo) continue;
      if (fraction > hi) break;
      const double share = (fraction - span.fractions[0]) / (span.fractions[1] - span.fractions[0]);
      const ColumnMode::Value value = mode.at(static_cast<int>(i), share * span.length);
      member.s[k] = fraction * lengths[span.member];
      member.u[k] = line.length * value.w * line.normal[0] + 0.0;  // no negative zeros
      member.v[k] = line.length * value.w * line.normal[1] + 0.0;
      member.rotation[k] = value.slope;
    }
  }
  return out;
}

/// Largest compression of each member at a load factor.
std::vector<double> compressions_of(const ColumnLine& line, const ResolvedModel& model, double load) {
  std::vector<double> out(model.members.size(), -std::numeric_limits<double>::infinity());
  for (const ColumnSpan& span : line.spans) {
    double& largest = out[static_cast<std::size_t>(span.member)];
    const double scaled = span.constant + load * span.proportional;
    largest = std::max(largest, scaled * line.stiffness / (line.length * line.length));
  }
  return out;
}

/// Buckling loads of a column with their modes.
struct Solution {
  ColumnBuckling buckling;
  FoundLoads found;
};

/// @param lengths one per member
/// @return empty when the column's equation cannot be solved to rounding
std::optional<Solution> solve_column(const ColumnLine& line, const ResolvedModel& model,
                                     const Analysis& analysis, const std::vector<double>& lengths) {
  auto buckling = column_buckling(line, analysis.modes);
  if (!buckling) return std::nullopt;
  const std::vector<ColumnMode> modes = column_modes(line, buckling->loads);
  if (modes.size() != buckling->loads.size()) return std::nullopt;
  FoundLoads found{buckling->loads, {}, {}, buckling->negative_at_start};
  for (std::size_t i = 0; i < modes.size(); ++i) {
    found.modes.push_back(sample(line, modes[i], model, lengths, analysis.output.points_per_member));
    scale_to_largest(found.modes.back());
    found.modes.back().effective_lengths =
        effective_lengths(model, lengths, compressions_of(line, model, buckling->loads[i]));
  }
  found.errors.assign(buckling->errors.begin(), buckling->errors.end());
  return Solution{*std::move(buckling), std::move(found)};
}

/// Column with the opposite proportional actions.
ColumnLine with_opposite_load(ColumnLine line) {
  for (ColumnSpan& span : line.spans) span.proportional = -span.proportional;
  return line;
}

void report_loads(const Analysis& analysis, const ColumnLine& line, const ColumnBuckling& buckling,
                  Result& result) {
  result.diagnostics.factorizations += buckling.counts;
  MeshReport& report = result.discretization;
  report.elements = static_cast<int>(line.spans.size());
  report.refinements = 0;
  report.unknowns = 0;
  report.requested_accuracy = analysis.discretization.accuracy;
  for (std::size_t i = 0; i < line.joints.size(); ++i) {
    const ColumnJoint& joint = line.joints[i];
    const bool left = i > 0 && (joint.hinge || i + 1 == line.joints.size());
    const bool right = i + 1 < line.joints.size();
    report.unknowns +=
        (joint.held ? 0 : 1) + (left && !joint.left.held ? 1 : 0) + (right && !joint.right.held ? 1 : 0);
  }
  for (const std::optional<double>& error : result.buckling->error_estimates)
    report.estimated_accuracy = std::max(report.estimated_accuracy.value_or(0.0), error.value_or(0.0));
}

}  // namespace

bool run_exact_column(const ResolvedModel& model, const Analysis& analysis, const Hooks& hooks,
                      Result& result) {
  if (analysis.discretization.fixed_mesh) return false;
  std::optional<ColumnLine> line = column_line(model);
  if (!line) return false;
  line->stop = hooks.stop;
  std::vector<double> lengths(model.members.size(), 0.0);
  for (const ColumnSpan& span : line->spans) lengths[span.member] += span.length * line->length;
  auto solution = solve_column(*line, model, analysis, lengths);
  if (!solution) return false;
  FoundLoads reversed;
  if (analysis.reversed && solution->buckling.negative_at_start == 0) {
    auto opposite = solve_column(with_opposite_load(*line), model, analysis, lengths);
    if (!opposite) return false;
    solution->buckling.counts += opposite->buckling.counts;
    reversed = std::move(opposite->found);
  }
  report_buckling(analysis, std::move(solution->found), std::move(reversed), result);
  report_loads(analysis, *line, solution->buckling, result);
  result.diagnostics.skipped.emplace_back(
      "mesh and its refinement: the column's differential equation was solved");
  return true;
}

}  // namespace snapthrough
