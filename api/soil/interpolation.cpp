#include "api/soil/interpolation.h"

#include <algorithm>
#include <cmath>

namespace snapthrough::api::soil {

namespace {

/// Returns the largest step up to `longest` for which `fits(step)` holds, to a relative 1e-9.
template <class Fits>
double largest_step(double longest, const Fits& fits) {
  constexpr int kHalvings = 60;
  if (fits(longest)) {
    return longest;
  }
  double fitting = 0.0;
  double too_long = longest;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (fitting + too_long);
    (fits(middle) ? fitting : too_long) = middle;
  }
  return fitting;
}

}  // namespace

std::optional<std::vector<double>> divide_depth(double from, double to, double shortest,
                                                const std::function<bool(double, double)>& fits) {
  std::vector<double> depths{from};
  while (depths.back() < to) {
    const double start = depths.back();
    const double rest = to - start;
    const double step = largest_step(rest, [&](double part) { return fits(start, start + part); });
    if (step == rest) {
      depths.push_back(to);
      break;
    }
    if (step < shortest || depths.size() >= kMaxBreakPoints) {
      return std::nullopt;
    }
    depths.push_back(start + std::min(step, 0.5 * rest));  // half leaves no last part that is short
  }
  return depths;
}

double resistance_at(const Piece& piece, double depth) { return std::max(piece.value(depth), 0.0); }

double chord_error(const Piece& piece, double a, double b) {
  const double ends = std::sqrt(resistance_at(piece, a)) + std::sqrt(resistance_at(piece, b));
  const double curvature = piece.value.largest_curvature(a, b);
  return curvature > 0.0 ? curvature * (b - a) * (b - a) / (2.0 * ends * ends) : 0.0;
}

std::optional<std::vector<double>> break_depths(std::span<const Piece> pieces, double shortest,
                                                double accuracy) {
  std::vector<double> depths{pieces.front().from};
  for (const Piece& piece : pieces) {
    const auto part = divide_depth(piece.from, piece.to, shortest, [&](double a, double b) {
      const double error = chord_error(piece, a, b);
      return error < 1.0 && error / (1.0 - error) <= accuracy;  // relative to f instead of L
    });
    if (!part) {
      return std::nullopt;
    }
    depths.insert(depths.end(), part->begin() + 1, part->end());
  }
  return depths.size() <= kMaxBreakPoints ? std::optional(depths) : std::nullopt;
}

double value_at(std::span<const Piece> pieces, double depth) {
  const auto found =
      std::find_if(pieces.begin(), pieces.end(), [&](const Piece& piece) { return depth <= piece.to; });
  return resistance_at(found == pieces.end() ? pieces.back() : *found, depth);
}

}  // namespace snapthrough::api::soil
