#include "solver/report/critical_point.h"

#include <cmath>

#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

/// @brief d monitor / d load factor: a monitor is linear in the unknowns, so its rate is its value on the
/// path's tangent (dy/ds, dlambda/ds). The tangent is that of the point itself where the bifurcation was
/// solved for with its null motion; a point that was bracketed has the direction of a step. Empty: not finite
/// or not known.
std::vector<NamedValue> monitor_rate(const Structure& structure, const CriticalEvent& event) {
  if (event.type != CriticalType::bifurcation || event.cause != CriticalCause::smooth ||
      event.null.size() == 0)
    return {};
  std::vector<NamedValue> rates;
  for (const MonitorRow& monitor : structure.monitors) {
    const double rate = monitor.row.dot(event.point.tangent) / event.point.tangent_lambda;
    if (!std::isfinite(rate)) return {};
    rates.push_back({monitor.id, rate * structure.scales.load});
  }
  return rates;
}

}  // namespace

CriticalPoint critical_point(const Structure& structure, const CriticalEvent& event) {
  CriticalPoint point;
  point.type = event.type;
  point.cause = event.cause;
  point.arc_length = event.point.arc_length;
  point.negative_before = event.negative_before;
  point.negative_after = event.negative_after;
  point.multiplicity = event.multiplicity;
  point.after_growth = event.after_growth;
  set_values(structure, event, point);
  return point;
}

void set_values(const Structure& structure, const CriticalEvent& event, CriticalPoint& point) {
  point.load_factor = event.point.lambda / structure.scales.load;
  point.monitors = monitor_values(structure, event.point.y);
  point.monitor_rate = monitor_rate(structure, event);
}

}  // namespace snapthrough
