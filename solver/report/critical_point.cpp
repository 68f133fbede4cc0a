#include "solver/report/critical_point.h"

namespace snapthrough {

CriticalPoint critical_point(const Structure& structure, const CriticalEvent& event) {
  CriticalPoint point;
  point.type = event.type;
  point.cause = event.cause;
  point.arc_length = event.point.arc_length;
  point.negative_before = event.negative_before;
  point.negative_after = event.negative_after;
  point.multiplicity = event.multiplicity;
  set_values(structure, event, point);
  return point;
}

void set_values(const Structure& structure, const CriticalEvent& event, CriticalPoint& point) {
  point.load_factor = event.point.lambda / structure.scales.load;
  point.monitors.clear();
  for (const MonitorRow& monitor : structure.monitors)
    point.monitors.push_back({monitor.id, monitor.row.dot(event.point.y)});
}

}  // namespace snapthrough
