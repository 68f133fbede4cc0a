#include "api/plot/looks.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "api/plot/labels.h"

namespace snapthrough::api::plot {
namespace {

/// Copy of the page's style sheet (web/src/figures/figures.css) for one theme; the last rule is an @ rule.
/// Names after $ are replaced by colours, because few programs except browsers support custom properties.
constexpr std::string_view kLooks = R"(
.figure { font-family: system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; font-size: 12px; }
text { fill: $ink; font-variant-numeric: tabular-nums; }
.paper { fill: $paper; }
.caption, .muted { fill: $muted; }
.caption { font-weight: 600; }
.heading { font-size: 13px; font-weight: 700; }
.strong { font-weight: 650; }
path, line, circle, rect { fill: none; }
rect.paper { fill: $paper; }
line, path { stroke-linecap: round; stroke-linejoin: round; }
.ground-body { fill: $ground; stroke: $ground; stroke-width: .8; }
.ground-hatch { stroke: $groundline; stroke-width: .8; opacity: .75; }
.ground-surface { stroke: $groundline; stroke-width: 1.2; }
.undeformed { stroke: $muted; stroke-width: 1.2; }
.member { stroke: $ink; stroke-width: 4; }
.slack { stroke: $muted; stroke-width: 1.6; stroke-dasharray: 6 4; }
.contact { stroke: $contact; stroke-width: 4; }
.reaction { fill: $contact; fill-opacity: .22; }
.reaction-line { stroke: $contact; stroke-width: 1.2; }
.contact-text { fill: $contacttext; }
.mode { stroke: $branch; stroke-width: 2.5; stroke-dasharray: 7 4; }
.support, .support-body { stroke: $ink; stroke-width: 1.2; }
.support-body { fill: $paper; }
.support-bar { stroke: $ink; stroke-width: 3; stroke-linecap: butt; }
.support-hatch { stroke: $muted; stroke-width: 1; }
.support-force { stroke: $muted; stroke-width: 1.6; }
.support-force-head { fill: $muted; }
.spring { stroke: $ink; stroke-width: 1.4; }
.contact-spring { stroke: $contact; stroke-width: 2; }
.hinge { fill: $paper; stroke: $ink; stroke-width: 1.4; }
.load { stroke: $ink; stroke-width: 1.6; }
.load-head { fill: $ink; }
.monitor { fill: $paper; stroke: $accent; stroke-width: 2; }
.monitor-way { stroke: $accent; stroke-width: 1.2; stroke-dasharray: 1.5 4; }
.monitor-text { fill: $accent; }
.dimension { stroke: $muted; stroke-width: .9; }
.dimension-text { fill: $muted; }
.symmetry { stroke: $muted; stroke-width: .9; stroke-dasharray: 10 3 1.5 3; }
.mirror-image { opacity: .55; }
.grid { stroke: $line; stroke-width: 1; }
.grid.zero { stroke: $strong; }
.tick, .legend-text { fill: $muted; }
.path { stroke: $accent; stroke-width: 2.2; }
.path.branch { stroke: $branch; stroke-width: 1.8; }
.untold { stroke-dasharray: 1.5 4; }
.unstable { stroke-dasharray: 5 5; }
.mark { stroke: $paper; stroke-width: 1.5; }
.limit { fill: $ink; }
.bifurcation { fill: $branch; }
.broken { fill: $paper; stroke: $branch; stroke-width: 1.8; }
.flutter { fill: $branch; }
.softest, .yield { fill: $paper; stroke: $ink; stroke-width: 2; }
.event { fill: $contact; stroke-width: 1; }
.event.open { fill: $paper; stroke: $contact; stroke-width: 1.6; }
.row { fill: $accent; }
.leader { stroke: $muted; stroke-width: .8; }
.axis { stroke: $strong; stroke-width: 1; }
.section-joint { stroke: $line; stroke-width: 1; }
.section-line { stroke-width: 1.6; }
.section-value { font-size: 11.5px; }
.section-N .section-line { stroke: $accent; } .section-N .section-area { fill: $accentsoft; }
.section-N .section-dot { fill: $accent; }
.section-Q .section-line { stroke: $branch; } .section-Q .section-area { fill: $branchsoft; }
.section-Q .section-dot { fill: $branch; }
.section-M .section-line { stroke: $moment; } .section-M .section-area { fill: $momentsoft; }
.section-M .section-dot { fill: $moment; }
.series-line { stroke-width: 2; }
.series-0 .series-line { stroke: $accent; } .series-0 .series-dot { fill: $accent; }
.series-1 .series-line { stroke: $contact; } .series-1 .series-dot { fill: $contact; }
.series-2 .series-line { stroke: $branch; } .series-2 .series-dot { fill: $branch; }
.series-3 .series-line { stroke: $ink; } .series-3 .series-dot { fill: $ink; }
.series-4 .series-line { stroke: $muted; } .series-4 .series-dot { fill: $muted; }
.series-5 .series-line { stroke: $moment; } .series-5 .series-dot { fill: $moment; }
.series-1 .series-line { stroke-dasharray: 8 3; } .series-2 .series-line { stroke-dasharray: 3 3; }
.series-3 .series-line { stroke-dasharray: 10 3 2 3; } .series-4 .series-line { stroke-dasharray: 1.5 4; }
.break-mark { fill: $paper; stroke: $ink; stroke-width: 1.4; }
.break-text { font-size: 12px; fill: $ink; }
.failed { stroke: $moment; stroke-width: 1.8; }
.failed-cell { fill: $neutralsoft; stroke: none; }
.failed-hatch { stroke: $moment; stroke-width: 1; opacity: .8; }
.band-0 { fill: #f1f6fc; } .band-1 { fill: #dfebf7; } .band-2 { fill: #cbdef1; }
.band-3 { fill: #b3cfe9; } .band-4 { fill: #98bee0; } .band-5 { fill: #7cabd6; }
.band-6 { fill: #6097ca; } .band-7 { fill: #4782bb; } .band-8 { fill: #316da9; }
.band-9 { fill: #205893; } .band-10 { fill: #134379; } .band-11 { fill: #0b2f5b; }
.band { shape-rendering: crispEdges; }
.no-value { fill: $neutralsoft; }
.dot { stroke: $muted; stroke-width: .8; }
.contour { stroke: #1c2430; stroke-width: .9; opacity: .7; }
.contour-text { font-size: 11px; fill: #1c2430; }
.contour-text.on-dark { fill: #fff; }
@supports (paint-order: stroke) {
  text { paint-order: stroke; stroke: $paper; stroke-width: 3px; stroke-linejoin: round; }
  .contour-text { stroke: none; }
}
)";

/// Looks of laws by depth, which the page does not draw and other figures do not need.
constexpr std::string_view kLawLooks = R"(
.law-line { stroke: currentColor; stroke-width: 1.8; } .law-flat { stroke-dasharray: 5 4; }
.law-peak { fill: currentColor; } .law-residual { fill: $paper; stroke: currentColor; stroke-width: 1.6; }
.law-value { fill: currentColor; font-size: 11px; }
.depth-0 { color: $depth0; } .depth-1 { color: $depth1; } .depth-2 { color: $depth2; }
.depth-3 { color: $depth3; } .depth-4 { color: $depth4; } .depth-5 { color: $depth5; }
.depth-6 { color: $depth6; } .depth-7 { color: $depth7; } .depth-8 { color: $depth8; }
)";

struct Colour {
  std::string_view name;
  std::string_view light;
  std::string_view dark;
};

/// depth0 to depth8: from top to bottom; equal steps of lightness, away from the paper, at a contrast of 3
/// and more. The search takes the first match: a name stands before its prefixes ("accentsoft" before
/// "accent").
constexpr Colour kColours[] = {{"paper", "#fff", "#161b22"},         {"ink", "#1c2430", "#e6eaf0"},
                               {"muted", "#6b7686", "#98a3b3"},      {"line", "#e3e6ea", "#2a323d"},
                               {"strong", "#c3c9d1", "#465160"},     {"accentsoft", "#dce8f5", "#1f3350"},
                               {"accent", "#1f5fae", "#6fa8ec"},     {"contacttext", "#a85305", "#f5a85c"},
                               {"contact", "#d9730d", "#f0923a"},    {"branchsoft", "#ece2f6", "#372a49"},
                               {"branch", "#7b3fb5", "#b98ae8"},     {"momentsoft", "#f6dddb", "#4a2523"},
                               {"moment", "#b3261e", "#ef7b73"},     {"neutralsoft", "#e9ecf0", "#252c36"},
                               {"groundline", "#b9a98c", "#7d7156"}, {"ground", "#f3ede2", "#262219"},
                               {"depth0", "#d67b19", "#954ea5"},     {"depth1", "#d06338", "#b157a3"},
                               {"depth2", "#c34f50", "#cc629d"},     {"depth3", "#b03f64", "#e46f95"},
                               {"depth4", "#983474", "#f97f8b"},     {"depth5", "#7c2d7f", "#ff998b"},
                               {"depth6", "#5e2884", "#feb497"},     {"depth7", "#3d2483", "#ffcca9"},
                               {"depth8", "#17207a", "#fee3c5"}};

/// Returns a declaration block with names replaced by colours.
std::string coloured(std::string_view block, bool dark) {
  std::string text;
  for (std::size_t at = 0; at < block.size();) {
    if (block[at] != '$') {
      text += block[at++];
      continue;
    }
    const std::string_view rest = block.substr(at + 1);
    const auto* colour = std::find_if(std::begin(kColours), std::end(kColours),
                                      [&](const Colour& one) { return rest.starts_with(one.name); });
    text += dark ? colour->dark : colour->light;
    at += 1 + colour->name.size();
  }
  return text;
}

/// Prefixes each selector with the class of one theme, so that the rules do not reach other figures of the
/// same page.
std::string scoped(std::string_view selectors, std::string_view scope) {
  std::string text;
  while (!selectors.empty()) {
    const std::size_t comma = std::min(selectors.find(','), selectors.size());
    std::string_view one = selectors.substr(0, comma);
    one.remove_prefix(std::min(one.find_first_not_of(" \n"), one.size()));
    text.append(text.empty() ? "" : ", ").append(scope);
    if (!one.starts_with(".figure")) {
      text.append(" ").append(one);
    }
    selectors.remove_prefix(std::min(comma + 1, selectors.size()));
  }
  return text;
}

/// Appends the rules of a style sheet for one theme.
void append_rules(std::string& text, std::string_view rest, bool dark) {
  const std::string_view scope = dark ? ".figure.dark" : ".figure.light";
  while (rest.find('{') != std::string_view::npos) {
    rest.remove_prefix(rest.find_first_not_of(" \n"));
    if (rest.starts_with('@') || rest.starts_with('}')) {  // start or end of an @ rule's block
      const std::size_t end = rest.find_first_of("{}") + 1;
      text.append(rest.substr(0, end)).append("\n");
      rest.remove_prefix(end);
      continue;
    }
    const std::size_t open = rest.find('{');
    const std::size_t close = rest.find('}') + 1;
    std::string_view selectors = rest.substr(0, open);
    selectors.remove_suffix(selectors.size() - 1 - selectors.find_last_not_of(' '));
    text.append(scoped(selectors, scope)).append(" ");
    text.append(coloured(rest.substr(open, close - open), dark)).append("\n");
    rest.remove_prefix(close);
  }
}

std::string looks(bool dark, bool has_laws) {
  std::string text;
  if (has_laws) {
    append_rules(text, kLawLooks, dark);
  }
  append_rules(text, kLooks, dark);
  return text + "}\n";  // the last } ends the @ rule
}

constexpr double kMargin = 14;
constexpr double kHeadingSize = 13;
constexpr double kHeadingRow = 18;
constexpr std::size_t kHeadingRows = 2;

/// Returns the heading in at most kHeadingRows rows, broken between words; an ellipsis ends a longer heading.
std::vector<std::string> heading_rows(const std::string& heading, double width) {
  std::vector<std::string> rows;
  std::string_view rest = heading;
  while (!rest.empty() && rows.size() + 1 < kHeadingRows) {
    std::size_t cut = 0;
    for (std::size_t space = rest.find(' '); space != std::string_view::npos;
         space = rest.find(' ', space + 1)) {
      if (text_width(rest.substr(0, space), kHeadingSize, true) > width) {
        break;
      }
      cut = space;
    }
    if (cut == 0 || text_width(rest, kHeadingSize, true) <= width) {
      break;
    }
    rows.emplace_back(rest.substr(0, cut));
    rest.remove_prefix(cut + 1);
  }
  if (!rest.empty()) {
    rows.push_back(fitted(rest, width, kHeadingSize, true));
  }
  return rows;
}

double heading_height(const std::string& heading, double width) {
  const std::size_t rows = heading_rows(heading, width).size();
  return rows == 0 ? 0 : kHeadingRow * static_cast<double>(rows) + 8;
}

}  // namespace

Size content_size(Size file, const std::string& heading) {
  const double width = file.width - 2 * kMargin;
  return {width, file.height - 2 * kMargin - heading_height(heading, width)};
}

std::string file_of(Figure figure, Size file, const std::string& heading, bool dark) {
  const double width = file.width - 2 * kMargin;
  std::vector<Shape> shapes;
  shapes.push_back(
      element("title", {}, {text_node(heading.empty() ? figure.title : heading + ": " + figure.title)}));
  shapes.push_back(element("desc", {}, {text_node(figure.description)}));
  shapes.push_back(element("style", {}, {text_node(looks(dark, figure.has_laws))}));
  shapes.push_back(rectangle("paper", {0, 0, file.width, file.height}));
  double y = kMargin + kHeadingSize - 2;
  for (const std::string& row : heading_rows(heading, width)) {
    shapes.push_back(label("heading", {kMargin, y}, Anchor::start, row));
    y += kHeadingRow;
  }
  shapes.push_back(element("g",
                           {{"transform", "translate(" + coordinate(kMargin) + " " +
                                              coordinate(kMargin + heading_height(heading, width)) + ")"}},
                           std::move(figure.shapes)));
  const Shape svg = element("svg",
                            {{"xmlns", "http://www.w3.org/2000/svg"},
                             {"class", dark ? "figure dark" : "figure light"},
                             {"viewBox", "0 0 " + coordinate(file.width) + " " + coordinate(file.height)},
                             {"width", coordinate(file.width)},
                             {"height", coordinate(file.height)},
                             {"role", "img"}},
                            std::move(shapes));
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + to_text(svg) + "\n";
}

}  // namespace snapthrough::api::plot
