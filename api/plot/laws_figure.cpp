#include <algorithm>
#include <cmath>

#include "api/plot/figures.h"
#include "api/plot/labels.h"
#include "api/plot/laws.h"
#include "api/plot/laws_panel.h"
#include "api/plot/result.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kCaption = 26;       // pixels above the diagrams
constexpr double kGap = 16;           // pixels between diagrams
constexpr double kPanel = 270;        // pixels; height of a diagram where the figure chooses it
constexpr double kLeastHeight = 200;  // pixels; lowest diagram
constexpr double kLeastWidth = 290;
constexpr std::size_t kMostPanels = 12;

/// Places of diagrams in rows.
struct Grid {
  std::size_t columns = 1;
  std::size_t shown = 1;  ///< number of diagrams
  Size size;              ///< size of a diagram
  [[nodiscard]] std::size_t rows() const { return (shown + columns - 1) / columns; }
  [[nodiscard]] Pixel corner(std::size_t i) const {
    const std::size_t row = i / columns;
    return {static_cast<double>(i % columns) * (size.width + kGap),
            kCaption + static_cast<double>(row) * (size.height + kGap)};
  }
};

/// @param asked whether the height was asked for
Grid grid_of(std::size_t count, Size size, bool asked) {
  Grid grid;
  grid.shown = std::min(count, kMostPanels);
  grid.columns = grid.shown > 1 && size.width >= 2 * kLeastWidth + kGap ? 2 : 1;
  grid.size.width = grid.columns == 2 ? 0.5 * (size.width - kGap) : size.width;
  const double room = size.height - kCaption;
  if (asked) {
    const double most = std::max(1.0, std::floor((room + kGap) / (kLeastHeight + kGap)));
    grid.shown = std::min(grid.shown, static_cast<std::size_t>(most) * grid.columns);
  }
  const auto rows = static_cast<double>(grid.rows());
  grid.size.height = asked || grid.rows() == 1 ? (room - (rows - 1) * kGap) / rows : kPanel;
  return grid;
}

/// Draws what dashes and marks mean, behind the caption, as far as diagrams have them.
std::vector<Shape> meaning_shapes(const std::vector<LawPanel>& panels, double x, double width) {
  bool flat = false;
  bool peak = false;
  bool residual = false;
  for (const LawPanel& panel : panels) {
    for (const DrawnLaw& law : panel.laws) {
      flat = flat || law.flat.size() > 1;
      peak = peak || law.peak;
      residual = residual || law.residual;
    }
  }
  std::vector<Shape> shapes;
  const auto add = [&](bool has, Shape sample, double size, const std::string& text) {
    if (has && x + size + text_width(text) < width) {
      shapes.push_back(std::move(sample));
      shapes.push_back(label("legend-text", {x + size, 12}, Anchor::start, text));
      x += size + text_width(text) + 14;
    }
  };
  const Pixel ends[] = {{x, 8}, {x + 22, 8}};
  add(flat, path("law-line law-flat", ends), 28, "constant");
  add(peak, circle("law-peak", {x + 4, 8}, 3.4), 12, "peak");
  add(residual, circle("law-residual", {x + 4, 8}, 3.4), 12, "residual");
  return shapes;
}

}  // namespace

Figure laws_figure(const Field& model, const PlotRequest& request, Size size) {
  const std::vector<LawGroup> groups = read_law_groups(model, request.law);
  const Units units = read_model_units(model);
  const Grid grid = grid_of(groups.size(), size, request.height.has_value());
  Figure figure;
  figure.title = "Laws of supports";
  figure.has_laws = true;
  std::vector<LawPanel> panels;
  for (std::size_t i = 0; i < grid.shown; ++i) {
    panels.push_back(law_panel(groups[i], units, grid.size));
  }
  std::string caption = figure.title;
  if (panels.size() < groups.size()) {
    caption += ": " + std::to_string(panels.size()) + " of " + std::to_string(groups.size()) + " diagrams";
  }
  caption = fitted(caption, size.width, 12, true);
  figure.shapes.push_back(label("caption", {0, 12}, Anchor::start, caption));
  figure.shapes.push_back(
      group("legend depth-4", meaning_shapes(panels, text_width(caption, 12, true) + 18, size.width)));
  figure.description = caption + ".";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    figure.shapes.push_back(law_panel_shape(panels[i], grid.size, grid.corner(i), i));
    figure.description += " " + law_panel_text(panels[i], units);
  }
  if (!request.height && grid.rows() > 1) {
    figure.height = grid.corner(panels.size() - 1).y + grid.size.height;
  }
  return figure;
}

}  // namespace snapthrough::api::plot
