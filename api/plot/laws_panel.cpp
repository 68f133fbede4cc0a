#include "api/plot/laws_panel.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "api/plot/labels.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr std::size_t kColours = 9;  // classes depth-0 to depth-8 of looks.cpp
constexpr double kApart = 1e-9;      // relative to what is drawn: displacements that differ by less are one
constexpr double kFallen = 1e-6;     // relative to the peak: a smaller fall is rounding
constexpr double kRow = 14;          // pixels; rows of the key
constexpr double kHead = 38;         // pixels above the plot area: title and note
constexpr double kTicks = 80;        // pixels between the numbers of the axis of displacements
constexpr double kFoot = 44;         // pixels below it
constexpr double kSwatch = 22;       // pixels; line of the key and the space beside it

Quantity displacement_of(const LawGroup& group) {
  return group.turns ? Quantity::rotation : Quantity::length;
}

Quantity reaction_of(const LawGroup& group) {
  if (group.turns) {
    return group.is_spring ? Quantity::moment : Quantity::force;  // a moment per length is a force
  }
  return group.is_spring ? Quantity::force : Quantity::line_load;
}

/// Whether two places are the same.
bool is_one(const LawPlace& one, const LawPlace& other) {
  return one.link == other.link && one.fraction == other.fraction && one.middle == other.middle;
}

/// Returns the place at a coordinate between two neighbours, or the nearer one where the law jumps.
LawPlace place_between(const LawGroup& group, const LawPlace& before, const LawPlace& after, double at) {
  const double share =
      group.is_even && are_joined(before, after) ? (at - before.to) / (after.from - before.to) : 0;
  if (!(share > 0 && share < 1)) {
    return std::abs(at - before.to) <= std::abs(at - after.from) ? before : after;
  }
  LawPlace place = after;
  place.fraction = before.last_fraction + share * (after.fraction - before.last_fraction);
  place.from = place.to = at;
  return place;
}

/// Returns the places that are drawn: all, or evenly spaced ones.
std::vector<LawPlace> chosen_places(const LawGroup& group, std::size_t most) {
  const std::vector<LawPlace>& all = group.places;
  if (all.size() <= most) {
    return all;
  }
  const bool named = group.whereabouts == Whereabouts::name;
  const double first = named ? 0 : all.front().from;
  const double last = named ? static_cast<double>(all.size() - 1) : all.back().to;
  const double sense = last < first ? -1 : 1;
  std::vector<LawPlace> chosen;
  const auto add = [&](const LawPlace& place) {
    if (chosen.empty() || !is_one(chosen.back(), place)) {
      chosen.push_back(place);
    }
  };
  for (std::size_t k = 0; k < most; ++k) {
    WorkLimit::poll();
    const double at = first + static_cast<double>(k) / static_cast<double>(most - 1) * (last - first);
    if (named) {
      add(all[static_cast<std::size_t>(std::lround(at))]);
      continue;
    }
    const auto next =
        std::find_if(all.begin(), all.end(), [&](const LawPlace& one) { return sense * (at - one.to) <= 0; });
    if (next == all.begin() || next == all.end() || sense * (at - next->from) >= 0) {
      add(next == all.end() ? all.back() : *next);
    } else {
      add(place_between(group, *(next - 1), *next, at));
    }
  }
  return chosen;
}

/// Returns the coordinates of a place. Where the law jumps, two places have one; they are told apart.
std::string name_of(const LawGroup& group, const LawPlace& place) {
  if (group.whereabouts == Whereabouts::name) {
    return place.name;
  }
  if (place.from != place.to) {
    return format_number(place.from) + " to " + format_number(place.to);
  }
  const bool down = group.whereabouts != Whereabouts::distance;
  std::string at = format_number(place.from);
  const auto here = std::find_if(group.places.begin(), group.places.end(),
                                 [&](const LawPlace& one) { return is_one(one, place); });
  if (here == group.places.end()) {
    return at;
  }
  if (here + 1 != group.places.end() && (here + 1)->from == place.to) {
    return at + (down ? " above" : " before");
  }
  return here != group.places.begin() && (here - 1)->to == place.from ? at + (down ? " below" : " beyond")
                                                                      : at;
}

std::string key_of(const LawGroup& group, const Units& units) {
  switch (group.whereabouts) {
    case Whereabouts::depth:
      return name_with_unit("depth", units.length);
    case Whereabouts::height:
      return name_with_unit("height y", units.length);
    case Whereabouts::distance:
      return name_with_unit("distance s", units.length);
    case Whereabouts::name:
      return "";
  }
  return "";
}

std::string note_of(const LawGroup& group, std::size_t shown, bool both) {
  const std::string count = std::to_string(group.places.size());
  const char* const words[] = {"depths", "heights", "places", "different laws"};
  const std::string what = words[static_cast<std::size_t>(group.whereabouts)];
  std::vector<std::string> parts;
  if (!group.sense.empty()) {
    parts.push_back(group.sense);
  }
  if (shown < group.places.size()) {
    parts.push_back(std::to_string(shown) + (group.whereabouts == Whereabouts::name
                                                 ? " of " + count + " " + what
                                                 : " " + what + ", given at " + count));
  } else if (group.places.size() == 1 && group.whereabouts != Whereabouts::name) {
    parts.emplace_back("the same everywhere");
  }
  if (both) {
    parts.emplace_back("alike in both senses");
  }
  std::string note;
  for (const std::string& part : parts) {
    note += (note.empty() ? "" : "; ") + part;
  }
  return note;
}

/// Returns the displacements at which a sum is computed: close where it bends.
std::vector<double> samples_of(const LawSum& sum, double reach) {
  std::vector<double> all;
  for (const LawCurve& part : sum.parts) {
    all.insert(all.end(), part.ends.begin(), part.ends.end());
  }
  const double own = sum.reach();
  for (int i = 0; i <= LawDrawing::pieces; ++i) {
    const double share = static_cast<double>(i) / LawDrawing::pieces;
    all.push_back(share * reach);
    all.push_back(share * share * own);
    all.push_back(2 * share * own);
  }
  std::erase_if(all, [&](double w) { return w > reach; });
  std::sort(all.begin(), all.end());
  const double apart = kApart * reach;  // rounding must not leave a peak outside of its neighbours
  const auto is_near = [&](double before, double after) { return after - before <= apart; };
  all.erase(std::unique(all.begin(), all.end(), is_near), all.end());
  return all;
}

/// Returns the place of the largest force between two displacements that enclose one maximum.
double largest_between(const LawSum& sum, double from, double to) {
  constexpr int kThirds = 40;  // (2/3)^40 = 9e-8 of the interval is left
  for (int i = 0; i < kThirds; ++i) {
    const double third = (to - from) / 3;
    if (sum.force_at(from + third) < sum.force_at(to - third)) {
      from += third;
    } else {
      to -= third;
    }
  }
  return 0.5 * (from + to);
}

/// Sets the peak of a sum that falls beyond it, and where it ends to fall.
void set_peak(const LawSum& sum, const std::vector<double>& samples, const std::vector<double>& forces,
              DrawnLaw& drawn) {
  const auto most = static_cast<std::size_t>(std::max_element(forces.begin(), forces.end()) - forces.begin());
  if (!(forces.back() < (1 - kFallen) * forces[most])) {
    return;
  }
  const double from = samples[most > 0 ? most - 1 : 0];
  const double at = largest_between(sum, from, samples[std::min(most + 1, samples.size() - 1)]);
  const bool between = sum.force_at(at) > forces[most];
  drawn.peak = between ? Point{at, sum.force_at(at)} : Point{samples[most], forces[most]};
  if (sum.flat_from() <= samples.back()) {
    drawn.residual = Point{sum.flat_from(), sum.force_at(sum.flat_from())};
  }
}

/// Moves a law to its gap and turns it to its sense.
void place_law(const LawPlace& place, bool both, double reach, DrawnLaw& drawn) {
  const double sense = place.reaction == "tension_only" ? -1 : 1;
  const auto move = [&](Point& point) { point = {sense * (place.gap + point.x), sense * point.y + 0.0}; };
  std::for_each(drawn.points.begin(), drawn.points.end(), move);
  std::for_each(drawn.flat.begin(), drawn.flat.end(), move);
  for (std::optional<Point>* mark : {&drawn.peak, &drawn.residual}) {
    if (*mark) {
      move(**mark);
    }
  }
  if (place.reaction != "bilateral") {
    drawn.points.insert(drawn.points.begin(), Point{-sense * LawDrawing::free * (place.gap + reach), 0});
  } else if (both) {
    std::vector<Point> other(drawn.points.rbegin(), drawn.points.rend());
    drawn.other_flat.assign(drawn.flat.rbegin(), drawn.flat.rend());
    for (std::vector<Point>* points : {&other, &drawn.other_flat}) {
      for (Point& point : *points) {
        point = {-point.x, -point.y};
      }
    }
    drawn.points.insert(drawn.points.begin(), other.begin(), other.end());
  }
}

/// @param both whether a law of both senses is drawn in both
DrawnLaw drawn_law(const LawGroup& group, const LawPlace& place, double reach, bool both) {
  const LawSum sum = group.sum_at(place);
  const std::vector<double> samples = samples_of(sum, reach);
  const double flat = sum.flat_from();
  DrawnLaw drawn;
  drawn.name = name_of(group, place);
  std::vector<double> forces;
  for (const double w : samples) {
    WorkLimit::poll();
    forces.push_back(sum.force_at(w));
    if (w <= flat) {
      drawn.points.push_back({w, forces.back()});
    }
    if (w >= flat) {
      drawn.flat.push_back({w, forces.back()});
    }
  }
  set_peak(sum, samples, forces, drawn);
  place_law(place, both, reach, drawn);
  return drawn;
}

double key_width(const LawPanel& panel, double width) {
  double widest = text_width(panel.key);
  for (const DrawnLaw& law : panel.laws) {
    widest = std::max(widest, kSwatch + text_width(law.name));
  }
  return std::min(widest, 0.3 * width);
}

void set_frame(LawPanel& panel, const Units& units, Size size) {
  Range w;
  Range p;
  for (const DrawnLaw& law : panel.laws) {
    for (const auto* points : {&law.points, &law.flat, &law.other_flat}) {
      for (const Point& point : *points) {
        w.include(point.x);
        p.include(point.y);
      }
    }
  }
  const LawGroup& group = *panel.group;
  const Range up = widened(p);
  Frame& frame = panel.frame;
  frame.x_label = name_with_unit(std::string(group.turns ? "rotation w" : "displacement w") +
                                     (group.gap_varies ? " beyond the gap" : ""),
                                 unit_of(units, displacement_of(group)));
  const std::string reaction =
      group.turns ? (group.is_spring ? "moment p" : "moment/length p") : "reaction p";
  frame.y_label = name_with_unit(reaction, unit_of(units, reaction_of(group)));
  frame.y = {up.low, up.high, std::max(kHead + 20, size.height - kFoot), kHead};
  const double left = std::max(66.0, room_for_numbers(frame));
  frame.x = {w.low, w.high, left, std::max(left + 28, size.width - key_width(panel, size.width) - 14)};
  if (ticks(frame.x, kTicks).size() < 3) {
    frame.x_values = ticks(frame.x, 0.5 * kTicks);
  }
}

std::string looks_of(std::size_t i, std::size_t count) {
  const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.5;
  return "depth-" + std::to_string(std::lround(share * static_cast<double>(kColours - 1)));
}

Shape curve_shape(const LawPanel& panel, std::size_t i, Occupancy& taken) {
  const DrawnLaw& law = panel.laws[i];
  std::vector<Shape> shapes;
  const auto add = [&](const char* looks, const std::vector<Point>& points) {
    std::vector<Pixel> pixels;
    pixels.reserve(points.size());
    for (const Point& point : points) {
      pixels.push_back(place(panel.frame, point.x, point.y));
    }
    taken.add_line(pixels);
    shapes.push_back(path(looks, thinned_points(pixels, LawDrawing::tolerance)));
  };
  add("law-line", law.points);
  for (const std::vector<Point>* flat : {&law.flat, &law.other_flat}) {
    if (flat->size() > 1) {
      add("law-line law-flat", *flat);
    }
  }
  for (const auto& [mark, looks] :
       {std::pair(&law.peak, "law-peak"), std::pair(&law.residual, "law-residual")}) {
    if (*mark) {
      const Pixel at = place(panel.frame, (*mark)->x, (*mark)->y);
      taken.add_box({at.x - 4, at.y - 4, at.x + 4, at.y + 4});
      shapes.push_back(circle(looks, at, 3.4));
    }
  }
  return group("law " + looks_of(i, panel.laws.size()), std::move(shapes));
}

/// Writes the reactions of peaks and residuals that find room beside them.
void add_values(const LawPanel& panel, Occupancy& taken, std::vector<Shape>& shapes) {
  for (std::size_t i = 0; i < panel.laws.size(); ++i) {
    const DrawnLaw& law = panel.laws[i];
    std::vector<Shape> texts;
    for (const std::optional<Point>* mark : {&law.peak, &law.residual}) {
      if (!*mark) {
        continue;
      }
      LabelRequest wanted{place(panel.frame, (*mark)->x, (*mark)->y),
                          {{format_number((*mark)->y, 3), "", false}},
                          "law-value",
                          7,
                          6};
      wanted.rings = 1;
      if (std::optional<Shape> text = place_label(wanted, taken)) {
        texts.push_back(std::move(*text));
      }
    }
    if (!texts.empty()) {
      shapes.push_back(group(looks_of(i, panel.laws.size()), std::move(texts)));
    }
  }
}

/// Draws a line of each law with its place, from top to bottom.
Shape key_shape(const LawPanel& panel, Size size) {
  const double x = panel.frame.x.end + 12;
  const double room = size.width - x - kSwatch;
  double y = kHead + 4;
  std::vector<Shape> shapes;
  if (!panel.key.empty()) {
    shapes.push_back(label("legend-text", {x, y}, Anchor::start, fitted(panel.key, room + kSwatch)));
    y += kRow + 2;
  }
  for (std::size_t i = 0; i < panel.laws.size(); ++i, y += kRow) {
    const Pixel ends[] = {{x, y - 4}, {x + kSwatch - 6, y - 4}};
    shapes.push_back(group(looks_of(i, panel.laws.size()), {path("law-line", ends)}));
    shapes.push_back(label("legend-text", {x + kSwatch, y}, Anchor::start, fitted(panel.laws[i].name, room)));
  }
  return group("legend", std::move(shapes));
}

Shape title_shape(const LawPanel& panel, Size size) {
  const std::string title = fitted(panel.group->title, size.width, 12, true);
  std::vector<Shape> runs{element("tspan", {{"class", "strong"}}, {text_node(title)})};
  const double left = size.width - text_width(title + "  ", 12, true);
  if (!panel.given_by.empty() && left > 40) {
    runs.push_back(text_node(" "));
    runs.push_back(element("tspan", {{"class", "muted"}}, {text_node(fitted(panel.given_by, left))}));
  }
  return label_of("law-title", {0, 12}, Anchor::start, std::move(runs));
}

}  // namespace

LawPanel law_panel(const LawGroup& group, const Units& units, Size size) {
  LawPanel panel;
  panel.group = &group;
  panel.key = key_of(group, units);
  const double rows = std::floor((size.height - kHead - kFoot) / kRow) - 1;
  const std::vector<LawPlace> chosen =
      chosen_places(group, static_cast<std::size_t>(std::clamp(rows, 2.0, static_cast<double>(kColours))));
  double reach = 0;
  bool both = false;
  bool any_bilateral = false;
  for (const LawPlace& place : chosen) {
    reach = std::max(reach, LawDrawing::room * group.sum_at(place).reach());
    both = both || place.reaction == "tension_only";
    any_bilateral = any_bilateral || place.reaction == "bilateral";
  }
  for (const LawPlace& place : chosen) {
    panel.laws.push_back(drawn_law(group, place, reach, both));
  }
  panel.note = note_of(group, chosen.size(), any_bilateral && !both);
  panel.given_by = group.given_by;
  if (group.places.size() == 1) {
    panel.given_by += panel.given_by.empty() ? panel.laws[0].name : "";
    panel.key = "";
    panel.laws[0].name = "";
  }
  set_frame(panel, units, size);
  return panel;
}

Shape law_panel_shape(const LawPanel& panel, Size size, Pixel corner, std::size_t number) {
  Occupancy taken(size);
  taken.add_box({0, 0, size.width, kHead - 8});
  taken.add_box({0, 0, panel.frame.x.start, size.height});
  taken.add_box({panel.frame.x.end, 0, size.width, size.height});
  taken.add_box({0, panel.frame.y.start, size.width, size.height});
  std::vector<Shape> shapes{title_shape(panel, size)};
  shapes.push_back(label("muted", {0, 27}, Anchor::start, fitted(panel.note, size.width)));
  shapes.push_back(frame_shape(panel.frame, size));
  for (std::size_t i = 0; i < panel.laws.size(); ++i) {
    shapes.push_back(curve_shape(panel, i, taken));
  }
  add_values(panel, taken, shapes);
  if (panel.laws.size() > 1 || !panel.laws[0].name.empty()) {
    shapes.push_back(key_shape(panel, size));
  }
  return element("g",
                 {{"class", "law-panel panel-" + std::to_string(number)},
                  {"transform", "translate(" + coordinate(corner.x) + " " + coordinate(corner.y) + ")"}},
                 std::move(shapes));
}

std::string law_panel_text(const LawPanel& panel, const Units& units) {
  const LawGroup& group = *panel.group;
  const std::string unit = unit_of(units, reaction_of(group));
  const std::string length = unit_of(units, displacement_of(group));
  const auto at = [&](const Point& point) {
    return with_unit(std::abs(point.y), unit) + " at " + with_unit(std::abs(point.x), length);
  };
  std::string text = group.title + (panel.given_by.empty() ? "" : " (" + panel.given_by + ")") + ": " +
                     panel.frame.y_label + " over " + panel.frame.x_label +
                     (panel.key.empty() ? "" : ", by " + panel.key) +
                     (panel.note.empty() ? "" : ", " + panel.note) + ".";
  for (const DrawnLaw& law : panel.laws) {
    const std::vector<Point>& last = law.flat.empty() ? law.points : law.flat;
    const Point end =
        law.flat.empty() ? (std::abs(last.back().y) > 0 ? last.back() : last.front()) : last.front();
    text += " " + law.name + (law.name.empty() ? "" : ": ");
    if (law.peak) {
      text += "peak " + at(*law.peak) + (law.residual ? ", residual " + at(*law.residual) : "") + ".";
    } else {
      text += (law.flat.empty() ? "drawn up to " : "constant ") + at(end) + ".";
    }
  }
  return text;
}

}  // namespace snapthrough::api::plot
