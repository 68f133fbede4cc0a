#include "solver/trace/asked_states.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/events/root_finder.h"

namespace snapthrough {
namespace {

/// Ends of the pieces of a step between its limit points.
std::vector<const PathPoint*> ends_of(const PathPoint& from, const std::vector<PathPoint>& turns,
                                      const PathPoint& to) {
  std::vector<const PathPoint*> out{&from};
  for (const PathPoint& turn : turns) out.push_back(&turn);
  out.push_back(&to);
  return out;
}

bool is_at(const PathPoint& point, double load) {
  return std::abs(point.lambda - load) <= kSameLoadFactor * std::abs(load);
}

}  // namespace

/// Whether the path passes an asked load between the ends of a step, without beginning or ending there.
bool AskedStateSearch::passes(std::size_t index, const PathPoint& from, const PathPoint& to) const {
  const double load = asked_.loads[index].load;
  if (is_at(from, load) || is_at(to, load)) return false;
  return (from.lambda > load) != (to.lambda > load);
}

bool AskedStateSearch::look_on(const PathPoint& from, const std::vector<PathPoint>& turns,
                               const PathPoint& to) {
  found_.clear();
  const std::vector<const PathPoint*> ends = ends_of(from, turns, to);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (!look_on_piece(i, *ends[i], *ends[i + 1])) return false;
  return true;
}

bool AskedStateSearch::look_on_piece(std::size_t piece, const PathPoint& from, const PathPoint& to) {
  for (std::size_t i = 0; i < asked_.loads.size(); ++i) {
    if ((asked_.once && told_[i] != 0) || !passes(i, from, to)) continue;
    std::optional<PathPoint> state = point_at_load(solver_, from, to, asked_.loads[i].load);
    if (!state) return false;
    found_.push_back({piece, i, *std::move(state)});
  }
  return true;
}

std::optional<PathPoint> AskedStateSearch::state_on(std::size_t piece, std::size_t index,
                                                    const PathPoint& from, const PathPoint& to) {
  const double load = asked_.loads[index].load;
  if (is_at(to, load)) return to;
  if (at_start_ && is_at(from, load)) return from;
  if (!passes(index, from, to)) return std::nullopt;
  const auto found = std::find_if(found_.begin(), found_.end(),
                                  [&](const Found& one) { return one.piece == piece && one.index == index; });
  return found != found_.end() ? found->state : point_at_load(solver_, from, to, load);
}

void AskedStateSearch::tell(const PathPoint& from, const std::vector<PathPoint>& turns, const PathPoint& to,
                            const Receiver& receive) {
  const std::vector<const PathPoint*> ends = ends_of(from, turns, to);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) tell_piece(i, *ends[i], *ends[i + 1], receive);
  found_.clear();
}

void AskedStateSearch::tell_piece(std::size_t piece, const PathPoint& from, const PathPoint& to,
                                  const Receiver& receive) {
  for (std::size_t i = 0; i < asked_.loads.size(); ++i) {
    if (asked_.once && told_[i] != 0) continue;
    const auto state = state_on(piece, i, from, to);
    if (!state) continue;
    told_[i] = 1;
    receive(asked_.loads[i].row, *state);
  }
  at_start_ = false;
}

}  // namespace snapthrough
