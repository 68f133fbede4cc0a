#include "api/plot/sweep_axes.h"

#include <algorithm>
#include <cmath>

#include "api/plot/labels.h"
#include "api/plot/plot_error.h"

namespace snapthrough::api::plot {

Scale axis_of(const Column& column, double start, double end, bool tight) {
  if (column.names) {
    return {-0.5, std::max(0.5, static_cast<double>(column.names->size()) - 0.5), start, end};
  }
  Range range;
  for (const double value : column.values) {
    range.include(value);
  }
  if (tight && is_logarithmic(column)) {
    return {range.low, range.high, start, end, true};
  }
  const Range shown = tight && range.low < range.high ? range : widened(range);
  return {shown.low, shown.high, start, end};
}

ChosenParameters default_parameters(const Table& table, const PlotRequest& request) {
  std::vector<const Column*> varied = varied_parameters(table);
  const Column* x = request.x ? &parameter(table, *request.x) : nullptr;
  const Column* by = request.by ? &parameter(table, *request.by) : nullptr;
  std::erase_if(varied, [&](const Column* one) { return one == x || one == by; });
  auto next = varied.begin();
  if (x == nullptr && next != varied.end()) {
    x = *next++;
  }
  if (by == nullptr && next != varied.end()) {
    by = *next;
  }
  if (x == nullptr) {
    throw PlotError("/columns", "has no second parameter with more than one value");
  }
  return {x, by};
}

std::string cross(Pixel at, double half) {
  const Pixel down[] = {{at.x - half, at.y - half}, {at.x + half, at.y + half}};
  const Pixel up[] = {{at.x - half, at.y + half}, {at.x + half, at.y - half}};
  return path_data(down) + path_data(up);
}

Shape failure_note(const std::string& text, Size size) {
  return group("failure-note", {path_of("mark failed", cross({70, 10}, 4)),
                                label("muted", {80, 14}, Anchor::start, fitted(text, size.width - 84))});
}

}  // namespace snapthrough::api::plot
