#include "solver/analysis/path_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "solver/analysis/path_curve.h"
#include "solver/numeric/cancelled.h"
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

/// Whether the tangent of an event's point is that of the path there; at a bifurcation it is that of the
/// step.
bool has_tangent(const CriticalEvent& event) {
  return event.type != CriticalType::bifurcation && event.point.tangent.size() > 0;
}

/// The point of a critical event, with the number of negative eigenvalues beyond it, and its tangent where
/// that is known.
PathPoint point_of(const CriticalEvent& event) {
  PathPoint point = event.point;
  point.negative = event.negative_after;
  if (!has_tangent(event)) point.tangent.resize(0);
  return point;
}

bool comes_first(const PathRow& a, const PathRow& b) { return a.point.arc_length < b.point.arc_length; }
bool lies_first(const PathPoint& a, const PathPoint& b) { return a.arc_length < b.arc_length; }

/// Turns the tangents of rows, of norm one, into rates by arc length.
void set_rates(const PathNorm& norm, std::vector<PathRow>& rows) {
  for (PathRow& row : rows) {
    const double step = row.point.tangent.size() > 0 ? norm.arc_per_step(row.point) : 0.0;
    if (step == 0.0) {
      row.point.tangent.setZero(row.point.y.size());
      row.point.tangent_lambda = 0.0;
      continue;
    }
    row.point.tangent /= step;
    row.point.tangent_lambda /= step;
  }
}

/// Sets a tangent to that of the parabola through a point and its neighbour's tangent.
/// @param sense 1 when the neighbour follows, -1 when it precedes
void set_by_parabola(const PathNorm& norm, PathPoint& point, const PathPoint& neighbour, double sense) {
  point.tangent = neighbour.tangent;
  point.tangent_lambda = neighbour.tangent_lambda;
  const double length = norm.distance(point, neighbour);
  if (length == 0.0) return;
  point.tangent = (2.0 * sense / length) * (neighbour.y - point.y) - neighbour.tangent;
  point.tangent_lambda = 2.0 * sense / length * (neighbour.lambda - point.lambda) - neighbour.tangent_lambda;
  const double size = norm.metric().norm(point.tangent, point.tangent_lambda);
  point.tangent /= size;
  point.tangent_lambda /= size;
}

/// Sets the rate of a row to that of the parabola through it and the rows beside it.
void set_rate_by_neighbours(const PathPoint& before, const PathPoint& after, PathPoint& point) {
  const double back = point.arc_length - before.arc_length;
  const double ahead = after.arc_length - point.arc_length;
  const double first = ahead / (back * (back + ahead));
  const double second = back / (ahead * (back + ahead));
  point.tangent = first * (point.y - before.y) + second * (after.y - point.y);
  point.tangent_lambda = first * (point.lambda - before.lambda) + second * (after.lambda - point.lambda);
}

}  // namespace

/// Completes the tangent of a branch's first point, and of a bifurcation that is its last one.
void PathPoints::complete_tangents(const PathNorm& norm, bool last) {
  const std::size_t count = accepted_.size();
  if (count < 2) return;
  PathPoint& first = accepted_[0].point;
  if (first.tangent.size() == 0) set_by_parabola(norm, first, accepted_[1].point, 1.0);
  PathPoint& end = accepted_[count - 1].point;
  const std::vector<CriticalEvent>& events = accepted_[count - 2].then;
  if (last && !events.empty() && !has_tangent(events.back()) && events.back().point.y == end.y)
    set_by_parabola(norm, end, accepted_[count - 2].point, -1.0);
}

int PathPoints::spread(PointSolver& solver, int count, const std::stop_token& stop, const RowVisitor& visit) {
  int missing = 0;
  std::vector<PathRow> rows;
  if (accepted_.empty()) return missing;
  complete_tangents(solver.norm(), true);
  const double length = accepted_.back().point.arc_length - accepted_.front().point.arc_length;
  const double spacing = length / (count - 1);
  for (std::size_t i = 0; i < accepted_.size(); ++i) {
    const PathPoint& from = accepted_[i].point;
    rows.push_back({from, true, accepted_[i].ratio});
    if (i + 1 == accepted_.size()) break;
    const PathPoint& to = accepted_[i + 1].point;
    const auto first = static_cast<std::ptrdiff_t>(rows.size());
    for (const CriticalEvent& event : accepted_[i].then)
      if (to.arc_length - event.point.arc_length > Rounding::distance * length)
        rows.push_back({point_of(event)});
    const int pieces =
        spacing > 0.0 ? static_cast<int>(std::ceil((to.arc_length - from.arc_length) / spacing)) : 1;
    const Segment step(solver, from, to);
    for (int k = 1; k < pieces; ++k) {
      std::optional<PathPoint> point;
      const bool done = !stop.stop_requested() && unless_cancelled([&] {
        point = step.point_at(static_cast<double>(k) / pieces);
        if (point) solver.find_modes(*point, from.modes);
      });
      if (!done || !point) {
        ++missing;
        continue;
      }
      point->negative = negative_at(from, accepted_[i].then, point->arc_length);
      rows.push_back({*std::move(point)});
    }
    std::stable_sort(rows.begin() + first, rows.end(), comes_first);
  }
  set_rates(solver.norm(), rows);
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    if (rows[i].point.tangent.isZero(0.0))
      set_rate_by_neighbours(rows[i - 1].point, rows[i + 1].point, rows[i].point);
  for (PathRow& row : rows) visit(row);
  return missing;
}

/// @param least distance of points along the path that are one
/// @param last the vectors of the accepted points are not needed any more
PathPoints::Parts PathPoints::parts(double least, bool last) {
  Parts out;
  for (std::size_t i = 0; i < accepted_.size(); ++i) {
    out.nodes.push_back(last ? std::move(accepted_[i].point) : accepted_[i].point);
    out.counts[out.nodes.back().arc_length] = out.nodes.back().negative;
    if (accepted_[i].ratio) out.ratios[out.nodes.back().arc_length] = *accepted_[i].ratio;
    if (i + 1 == accepted_.size()) break;
    const PathPoint& to = accepted_[i + 1].point;
    std::vector<PathPoint> between = accepted_[i].changes;
    for (const CriticalEvent& event : accepted_[i].then) {
      if (!(to.arc_length - event.point.arc_length > least)) continue;
      (has_tangent(event) ? between : out.passed).push_back(point_of(event));
      out.counts[event.point.arc_length] = event.negative_after;
    }
    std::stable_sort(between.begin(), between.end(), lies_first);
    for (PathPoint& point : between)
      if (point.arc_length - out.nodes.back().arc_length > least && to.arc_length - point.arc_length > least)
        out.nodes.push_back(std::move(point));
  }
  return out;
}

int PathPoints::follow(PointSolver& solver, const ShownValues& shown, bool last, const std::stop_token& stop,
                       const RowVisitor& visit) {
  if (accepted_.empty()) return 0;
  complete_tangents(solver.norm(), last);
  Parts parts = this->parts(Rounding::distance * accepted_.back().point.arc_length, last);
  const RowVisitor complete = [&](PathRow& row) {
    row.point.negative = std::prev(parts.counts.upper_bound(row.point.arc_length))->second;
    if (const auto ratio = parts.ratios.find(row.point.arc_length); ratio != parts.ratios.end())
      row.stiffness_ratio = ratio->second;
    visit(row);
  };
  if (parts.nodes.size() < 2) {
    std::vector<PathRow> rows{{parts.nodes.front()}};
    set_rates(solver.norm(), rows);
    complete(rows[0]);
    return 0;
  }
  const std::size_t kept =
      last ? 0 : 3;  // the piece before the next row, and the one that it is compared with
  const double to = accepted_[accepted_.size() - (last ? 1 : 2)].point.arc_length;
  if (kept > 0)
    accepted_.erase(accepted_.begin(), accepted_.end() - static_cast<std::ptrdiff_t>(kept));
  else
    accepted_.clear();
  PathCurve curve(solver, shown, std::move(parts.nodes), range_);
  const CurvePart part{visited_to_.value_or(-1.0), to};
  const int missing = curve.refine(part, stop);
  curve.rows(part, parts.passed, complete);
  visited_to_ = to;
  return missing;
}

}  // namespace snapthrough
