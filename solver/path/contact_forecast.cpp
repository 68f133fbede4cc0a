#include "solver/path/contact_forecast.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace snapthrough {
namespace {

/// Distance by which a zone's end moves on a step, by the quadratic through its last two places and its rate.
/// Where the end slows down a hyperbola is taken instead, which does not turn back.
/// @param way move of the end over the step before, whose length is `chord`
double extrapolated_move(double way, double chord, double rate, double step) {
  const bool slows = way * rate > 0.0 && std::abs(way) > std::abs(rate) * chord;
  if (slows) return rate * step / (1.0 + (1.0 - rate * chord / way) * step / chord);
  const double share = step / chord;
  return rate * step + (rate * chord - way) * share * share;
}

bool meet(const MovingZone& a, const MovingZone& b) { return a.from <= b.to && b.from <= a.to; }

/// Sorts zones and joins those that overlap.
void join(std::vector<MovingZone>& zones) {
  std::sort(zones.begin(), zones.end(),
            [](const MovingZone& a, const MovingZone& b) { return a.from < b.from; });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < zones.size(); ++i) {
    if (meet(zones[kept], zones[i]))
      zones[kept].to = std::max(zones[kept].to, zones[i].to);
    else
      zones[++kept] = zones[i];
  }
  if (!zones.empty()) zones.resize(kept + 1);
}

}  // namespace

void ContactForecast::begin(const EquilibriumProblem& problem, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& tangent) {
  now_ = problem.moving_zones(y, tangent);
}

void ContactForecast::follow(double chord) {
  last_ = std::move(now_);
  chord_ = chord;
}

void ContactForecast::forget() { last_.clear(); }

MovingZones ContactForecast::extrapolated(double step) const {
  MovingZones out = now_;
  for (std::size_t f = 0; f < out.size(); ++f) {
    const bool known = f < last_.size() && last_[f].size() == out[f].size() && chord_ > 0.0;
    for (std::size_t i = 0; i < out[f].size(); ++i) {
      MovingZone& zone = out[f][i];
      const double from_way = known ? zone.from - last_[f][i].from : 0.0;
      const double to_way = known ? zone.to - last_[f][i].to : 0.0;
      zone.from += known ? extrapolated_move(from_way, chord_, zone.from_rate, step) : step * zone.from_rate;
      zone.to += known ? extrapolated_move(to_way, chord_, zone.to_rate, step) : step * zone.to_rate;
    }
    std::erase_if(out[f], [](const MovingZone& zone) { return zone.to < zone.from; });
  }
  return out;
}

const FrozenContact* ContactForecast::at(const EquilibriumProblem& problem, double step,
                                         const Eigen::VectorXd& predicted) {
  if (now_.empty()) return nullptr;
  MovingZones zones = extrapolated(step);
  const MovingZones next = problem.moving_zones(predicted, predicted);
  changes_ = false;
  for (std::size_t f = 0; f < zones.size(); ++f) {
    // a predicted zone that meets none of the present ones is a part that lands on the foundation
    for (const MovingZone& zone : next[f])
      if (std::none_of(now_[f].begin(), now_[f].end(),
                       [&](const MovingZone& old) { return meet(old, zone); }))
        zones[f].push_back(zone);
    join(zones[f]);
    changes_ = changes_ || zones[f].size() != now_[f].size();
  }
  ahead_ = problem.freeze(zones, predicted);
  return &ahead_;
}

double ContactForecast::missed(const EquilibriumProblem& problem, const Eigen::VectorXd& y) const {
  return now_.empty() ? 0.0 : problem.missed_contact(ahead_, y);
}

}  // namespace snapthrough
