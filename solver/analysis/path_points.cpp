#include "solver/analysis/path_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "solver/numeric/rounding.h"
#include "solver/path/segment.h"

namespace snapthrough {
namespace {

/// Number of negative eigenvalues at an arc length after an accepted point.
int negative_at(const PathPoint& from, const std::vector<CriticalEvent>& critical, double arc) {
  int negative = from.negative;
  for (const CriticalEvent& event : critical)
    if (event.point.arc_length <= arc) negative = event.negative_after;
  return negative;
}

}  // namespace

std::vector<PathPoint> PathPoints::spread(PointSolver& solver, int count, const std::stop_token& stop,
                                          int& missing) const {
  std::vector<PathPoint> out;
  missing = 0;
  if (accepted_.empty()) return out;
  const double length = accepted_.back().point.arc_length - accepted_.front().point.arc_length;
  const double spacing = length / (count - 1);
  for (std::size_t i = 0; i < accepted_.size(); ++i) {
    const PathPoint& from = accepted_[i].point;
    out.push_back(from);
    if (i + 1 == accepted_.size()) break;
    const PathPoint& to = accepted_[i + 1].point;
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    for (const CriticalEvent& event : accepted_[i].then) {
      if (to.arc_length - event.point.arc_length <= Rounding::distance * length) continue;
      out.push_back(event.point);
      out.back().negative = event.negative_after;
    }
    const int pieces =
        spacing > 0.0 ? static_cast<int>(std::ceil((to.arc_length - from.arc_length) / spacing)) : 1;
    const Segment step(solver, from, to);
    for (int k = 1; k < pieces; ++k) {
      auto point = stop.stop_requested() ? std::nullopt : step.point_at(static_cast<double>(k) / pieces);
      if (!point) {
        ++missing;
        continue;
      }
      point->negative = negative_at(from, accepted_[i].then, point->arc_length);
      solver.find_modes(*point, from.modes);
      out.push_back(std::move(*point));
    }
    std::stable_sort(out.begin() + first, out.end(),
                     [](const PathPoint& a, const PathPoint& b) { return a.arc_length < b.arc_length; });
  }
  return out;
}

}  // namespace snapthrough
