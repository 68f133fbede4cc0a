#include "api/plot/contours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "api/plot/ink.h"

namespace snapthrough::api::plot {
namespace {

struct Corner {
  Pixel at;
  double value = 0;
};

/// Adds the contour segments of one cell. In a saddle, the mean of the corner values decides which crossings
/// are joined.
void add_pieces(const std::array<Corner, 4>& corners, double level, std::vector<Segment>& pieces) {
  std::array<Pixel, 4> found;
  std::size_t count = 0;
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Corner& a = corners[k];
    const Corner& b = corners[(k + 1) % 4];
    sum += a.value;
    if ((a.value < level) != (b.value < level)) {
      const double t = (level - a.value) / (b.value - a.value);
      found[count++] = {a.at.x + t * (b.at.x - a.at.x), a.at.y + t * (b.at.y - a.at.y)};
    }
  }
  if (count == 2) {
    pieces.emplace_back(found[0], found[1]);
  } else if (count == 4) {
    const bool with_first = (sum / 4 < level) == (corners[0].value < level);
    pieces.emplace_back(found[with_first ? 0 : 1], found[with_first ? 1 : 2]);
    pieces.emplace_back(found[with_first ? 2 : 3], found[with_first ? 3 : 0]);
  }
}

}  // namespace

std::vector<std::vector<Segment>> contours(const Grid& grid, const std::vector<double>& levels) {
  std::vector<std::vector<Segment>> pieces(levels.size());
  const std::size_t columns = grid.x.size();
  constexpr std::size_t kCoordinates = 4;  // numbers of a segment
  std::size_t found = 0;
  for (std::size_t j = 0; j + 1 < grid.y.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      Ink::require(kCoordinates * found);
      const auto corner = [&](std::size_t p, std::size_t q) {
        return Corner{{grid.x[p], grid.y[q]}, grid.values[q * columns + p]};
      };
      const std::array<Corner, 4> corners{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                          corner(i, j + 1)};
      if (!std::all_of(corners.begin(), corners.end(),
                       [](const Corner& c) { return std::isfinite(c.value); })) {
        continue;
      }
      for (std::size_t k = 0; k < levels.size(); ++k) {
        const std::size_t before = pieces[k].size();
        add_pieces(corners, levels[k], pieces[k]);
        found += pieces[k].size() - before;
      }
    }
  }
  return pieces;
}

}  // namespace snapthrough::api::plot
