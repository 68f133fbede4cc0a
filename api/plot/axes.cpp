#include "api/plot/axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "api/plot/labels.h"
#include "api/plot/numbers.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kTickRounding = 1e-9;  // relative to a step: tolerance for a tick at the end of a range

double position(const Scale& scale, double value) {
  return scale.log ? std::log10(value / scale.from) / std::log10(scale.to / scale.from)
                   : (value - scale.from) / (scale.to - scale.from);
}

std::vector<double> log_ticks(double low, double high, double count) {
  const double decades = std::log10(high / low);
  const double every = std::max(1.0, std::round(decades / count));
  const std::vector<double> shares = decades > 0.7 * count    ? std::vector<double>{1}
                                     : decades > 0.35 * count ? std::vector<double>{1, 3}
                                                              : std::vector<double>{1, 2, 5};
  std::vector<double> values;
  for (double power = std::floor(std::log10(low)); power <= std::ceil(std::log10(high)); ++power) {
    if (std::fmod(power, every) != 0) {
      continue;
    }
    for (const double share : shares) {
      const double value = share * std::pow(10, power);
      if (value >= low * (1 - kTickRounding) && value <= high * (1 + kTickRounding)) {
        values.push_back(value);
      }
    }
  }
  return values;
}

struct Written {
  double value;
  std::string text;
};

/// Returns the ticks of an axis with their texts: numbers, or as many of the names as find room.
std::vector<Written> written(const Scale& scale, const std::optional<std::vector<std::string>>& names,
                             const std::optional<std::vector<double>>& values, double spacing,
                             double name_room) {
  std::vector<Written> all;
  if (!names) {
    for (const double value : values ? *values : ticks(scale, spacing)) {
      all.push_back({value, format_number(value)});
    }
    return all;
  }
  const double room = std::max(1.0, std::floor(std::abs(scale.end - scale.start) / std::min(spacing, 60.0)));
  const auto every =
      static_cast<std::size_t>(std::max(1.0, std::ceil(static_cast<double>(names->size()) / room)));
  for (std::size_t i = 0; i < names->size(); i += every) {
    const double width = std::abs(scale.end - scale.start) / room;
    all.push_back({static_cast<double>(i), fitted((*names)[i], std::max(width, name_room))});
  }
  return all;
}

constexpr double kTickSpacingX = 80;
constexpr double kTickSpacingY = 50;

/// Angles from `middle` (rad) at which a line from the anchor passes all points so far within the tolerance.
struct Sector {
  double middle = 0;
  double low = 0;
  double high = 0;
  double reach = 0;
};

double turned(double angle, double from) {
  const double turn = angle - from;
  return turn - 2 * std::numbers::pi * std::round(turn / (2 * std::numbers::pi));
}

Sector first_sector(Pixel anchor, Pixel next, double tolerance) {
  const double distance = std::hypot(next.x - anchor.x, next.y - anchor.y);
  const double angle = std::atan2(next.y - anchor.y, next.x - anchor.x);
  if (distance <= tolerance) {
    return {angle, -std::numbers::pi, std::numbers::pi, distance};
  }
  const double half = std::asin(tolerance / distance);
  return {angle, -half, half, distance};
}

/// Returns the sector narrowed by the next point; nullopt when the point lies outside or the line turns back.
std::optional<Sector> narrowed(const Sector& sector, Pixel anchor, Pixel next, double tolerance) {
  const double distance = std::hypot(next.x - anchor.x, next.y - anchor.y);
  if (distance < sector.reach - tolerance) {
    return std::nullopt;
  }
  Sector result = sector;
  result.reach = std::max(sector.reach, distance);
  if (distance <= tolerance) {
    return result;
  }
  const double turn = turned(std::atan2(next.y - anchor.y, next.x - anchor.x), sector.middle);
  if (turn < sector.low || turn > sector.high) {
    return std::nullopt;
  }
  const double half = std::asin(tolerance / distance);
  result.low = std::max(sector.low, turn - half);
  result.high = std::min(sector.high, turn + half);
  return result;
}

}  // namespace

double place(const Scale& scale, double value) {
  return scale.start + position(scale, value) * (scale.end - scale.start);
}

Pixel place(const Frame& frame, double x, double y) { return {place(frame.x, x), place(frame.y, y)}; }

double round_step(double length, double parts) {
  const double rough = length / std::max(1.0, parts);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

double multiple(double k, double step) {
  const double value = k * step;
  if (value == 0) {
    return 0;
  }
  const double digits = std::pow(10, 11 - std::floor(std::log10(std::abs(value))));
  return std::isfinite(digits) && digits > 0 ? std::round(value * digits) / digits : value;
}

std::vector<double> ticks(const Scale& scale, double spacing) {
  const double count = std::max(1.0, std::abs(scale.end - scale.start) / spacing);
  const double low = std::min(scale.from, scale.to);
  const double high = std::max(scale.from, scale.to);
  if (!(high > low) || !std::isfinite(high - low)) {
    return {low};
  }
  if (scale.log) {
    return log_ticks(low, high, count);
  }
  const double step = round_step(high - low, count);
  std::vector<double> values;
  // A step is at least 1/20 of the range over `count`; the bound ends the loop when rounding would not.
  const double first = std::ceil(low / step - kTickRounding);
  for (double i = 0; i <= 20 * count && (first + i) * step <= high + kTickRounding * step; ++i) {
    values.push_back(multiple(first + i, step));
  }
  return values;
}

Range::Range()
    : low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity()) {}

void Range::include(double value) {
  if (std::isfinite(value)) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

Range widened(const Range& range) {
  constexpr double kRoom = 0.06;
  constexpr double kFlat = 1e-12;  // smallest range that ticks resolve, relative to its larger end
  const auto [low, high] = std::pair(range.low, range.high);
  if (range.empty()) {
    return {0, 1};
  }
  if (high - low < kFlat * std::max(std::abs(low), std::abs(high)) || high == low) {
    const double half = low == 0 ? 1 : 0.5 * std::abs(low);
    return {low - half, high + half};
  }
  const double room = kRoom * (high - low);
  return {low == 0 || (low > 0 && low < 0.25 * high) ? 0 : low - room,
          high == 0 || (high < 0 && high > 0.25 * low) ? 0 : high + room};
}

double room_for_numbers(const Frame& frame) {
  double widest = 0;
  for (const auto& [value, text] :
       written(frame.y, frame.y_names, frame.y_values, kTickSpacingY, frame.y_name_room)) {
    widest = std::max(widest, text_width(text));
  }
  return std::max(62.0, widest + 34);
}

Shape frame_shape(const Frame& frame, Size size) {
  const auto& [x, y, x_label, y_label, x_names, y_names, x_values, y_values, y_name_room] = frame;
  std::vector<Shape> shapes;
  double free_from = -1e9;
  for (const auto& [value, text] : written(x, x_names, x_values, kTickSpacingX, 40)) {
    const double px = place(x, value);
    shapes.push_back(
        line(value == 0 && !x.log && !x_names ? "grid zero" : "grid", {px, y.start}, {px, y.end}));
    const double half = text_width(text) / 2;
    if (px - half >= free_from) {
      shapes.push_back(label("tick", {px, y.start + 16}, Anchor::middle, text));
      free_from = px + half + 10;
    }
  }
  for (const auto& [value, text] : written(y, y_names, y_values, kTickSpacingY, y_name_room)) {
    const double py = place(y, value);
    shapes.push_back(
        line(value == 0 && !y.log && !y_names ? "grid zero" : "grid", {x.start, py}, {x.end, py}));
    shapes.push_back(label("tick", {x.start - 8, py + 4}, Anchor::end, text));
  }
  const double below = std::min(size.height - 4, y.start + 36);
  shapes.push_back(label("axis-label", {(x.start + x.end) / 2, below}, Anchor::middle,
                         fitted(x_label, std::min(size.width, 2 * std::abs(x.end - x.start)))));
  shapes.push_back(upright_label("axis-label", {12, (y.start + y.end) / 2},
                                 fitted(y_label, std::abs(y.start - y.end) + 40)));
  return group("frame", std::move(shapes));
}

std::vector<std::size_t> thinned(std::span<const Pixel> points, double tolerance) {
  std::vector<std::size_t> kept;
  if (points.size() < 3) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      kept.push_back(i);
    }
    return kept;
  }
  kept.push_back(0);
  Pixel anchor = points[0];
  Sector sector = first_sector(anchor, points[1], tolerance);
  for (std::size_t i = 2; i < points.size(); ++i) {
    if (const std::optional<Sector> narrower = narrowed(sector, anchor, points[i], tolerance)) {
      sector = *narrower;
      continue;
    }
    kept.push_back(i - 1);
    anchor = points[i - 1];
    sector = first_sector(anchor, points[i], tolerance);
  }
  kept.push_back(points.size() - 1);
  return kept;
}

std::vector<Pixel> thinned_points(std::span<const Pixel> points, double tolerance) {
  std::vector<Pixel> kept;
  for (const std::size_t i : thinned(points, tolerance)) {
    kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace snapthrough::api::plot
