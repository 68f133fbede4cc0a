#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "solver/column/column_frame.h"
#include "solver/column/exact_column.h"

namespace snapthrough {
namespace {

/// Modes of equal loads. Source: docs/theory.md, Straight columns without a mesh.
struct ModeLimits {
  static constexpr double equal_loads = 1e-9;  ///< relative difference up to which loads are equal
  static constexpr double own_part = 0.05;  ///< least squared distance from the span of modes of equal loads
};

using Pair = std::array<double, 2>;
using ColumnState = std::array<double, 4>;

Pair product(const Matrix2& m, const Pair& x) {
  return {m[0][0] * x[0] + m[0][1] * x[1], m[1][0] * x[0] + m[1][1] * x[1]};
}

ColumnState product(const ColumnFrame& f, const Pair& x) {
  ColumnState z{};
  for (int i = 0; i < 4; ++i) z[i] = f.rows[i][0] * x[0] + f.rows[i][1] * x[1];
  return z;
}

/// Transforms a state to the view from the other end of the column.
ColumnState turned(const ColumnState& z) { return {z[0], -z[1], -z[2], z[3]}; }

/// Place where solutions from both sides may be matched: coordinates in the left frame, and misfit.
struct Match {
  std::size_t piece = 0;
  Pair coordinates{};
  double misfit = 0.0;
};

/// Best matches of the planes from the left and from the right at the start of a piece: singular vectors of
/// their matrix of symplectic products, which vanish for common states.
std::array<Match, 2> matches_at(const ColumnFrame& left, const ColumnFrame& right, std::size_t piece) {
  Matrix2 w{};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const ColumnState r = turned({right.rows[0][j], right.rows[1][j], right.rows[2][j], right.rows[3][j]});
      w[i][j] =
          left.rows[0][i] * r[2] + left.rows[1][i] * r[3] - left.rows[2][i] * r[0] - left.rows[3][i] * r[1];
    }
  }
  // eigenvectors of w w^T
  const double a = w[0][0] * w[0][0] + w[0][1] * w[0][1];
  const double b = w[0][0] * w[1][0] + w[0][1] * w[1][1];
  const double c = w[1][0] * w[1][0] + w[1][1] * w[1][1];
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  const Pair large{std::cos(angle), std::sin(angle)};
  const Pair small{-large[1], large[0]};
  const auto size = [&w](const Pair& x) {
    return std::hypot(w[0][0] * x[0] + w[1][0] * x[1], w[0][1] * x[0] + w[1][1] * x[1]);
  };
  return {Match{piece, small, size(small)}, Match{piece, large, size(large)}};
}

}  // namespace

/// Searches the modes of one load, which may be multiple.
class ModeSearch {
 public:
  ModeSearch(const ColumnLine& line, const ColumnLine& back, double load)
      : line_(line), left_(pieces_at(line, load)), right_(pieces_at(back, load)) {}

  /// Appends `count` independent modes, or as many as exist.
  void find(std::size_t count, std::vector<ColumnMode>& out) const;

 private:
  [[nodiscard]] std::vector<Match> best_matches(std::size_t count) const;
  [[nodiscard]] ColumnMode mode_of(const Match& match) const;
  [[nodiscard]] static ColumnMode::Piece series(const ColumnPiece& piece, const ColumnState& state);
  [[nodiscard]] static double scalar_product(const ColumnMode& a, const ColumnMode& b);
  /// Part of a mode that is independent of the others, in [0, 1].
  [[nodiscard]] static double independence(const ColumnMode& mode, const std::vector<ColumnMode>& others,
                                           std::size_t first);

  const ColumnLine& line_;
  std::vector<ColumnPiece> left_;
  std::vector<ColumnPiece> right_;  ///< pieces of the column seen from its other end
};

std::vector<Match> ModeSearch::best_matches(std::size_t count) const {
  std::vector<Match> all;
  for (std::size_t i = 0; i < left_.size(); ++i)
    for (const Match& match : matches_at(left_[i].start, right_[left_.size() - 1 - i].end, i)) {
      if (count == 1 && !all.empty()) {
        if (match.misfit < all[0].misfit) all[0] = match;
      } else {
        all.push_back(match);
      }
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Match& l, const Match& r) { return l.misfit < r.misfit; });
  return all;
}

ColumnMode::Piece ModeSearch::series(const ColumnPiece& piece, const ColumnState& state) {
  ColumnMode::Piece out;
  out.from = piece.from;
  out.length = piece.length;
  auto& c = out.coefficients;
  c[0] = state[0];
  c[1] = state[1];
  c[2] = state[3] / piece.EI / 2.0;
  c[3] = (-state[2] / piece.EI - piece.q * state[1]) / 6.0;
  for (int k = 0; k + 4 < ColumnMode::terms; ++k)
    c[k + 4] = -(piece.q * (k + 1) * (k + 2) * c[k + 2] + piece.r * c[k]) /
               static_cast<double>((k + 1) * (k + 2) * (k + 3) * (k + 4));
  return out;
}

ColumnMode ModeSearch::mode_of(const Match& match) const {
  const std::size_t n = left_.size();
  ColumnMode mode;
  mode.pieces_.resize(n);
  Pair x = match.coordinates;
  for (std::size_t i = match.piece; i-- > 0;) {
    x = product(left_[i].start_from_end, product(left_[i].end_from_next, x));
    mode.pieces_[i] = series(left_[i], product(left_[i].start, x));
  }
  const ColumnState seen = turned(product(left_[match.piece].start, match.coordinates));
  const ColumnFrame& frame = right_[n - 1 - match.piece].end;
  x = {0.0, 0.0};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 2; ++j) x[j] += frame.rows[i][j] * seen[i];
  for (std::size_t i = match.piece; i < n; ++i) {
    const ColumnPiece& piece = right_[n - 1 - i];
    if (i > match.piece) x = product(piece.end_from_next, x);
    x = product(piece.start_from_end, x);
    mode.pieces_[i] = series(piece, product(piece.start, x));
    mode.pieces_[i].from = left_[i].from;
    mode.pieces_[i].direction = -1.0;
  }
  mode.first_.assign(line_.spans.size() + 1, static_cast<int>(n));
  for (std::size_t i = n; i-- > 0;) mode.first_[left_[i].span] = static_cast<int>(i);
  return mode;
}

double ModeSearch::scalar_product(const ColumnMode& a, const ColumnMode& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.first_.size() - 1; ++i) {
    for (int k = a.first_[i]; k < a.first_[i + 1]; ++k) {
      const double x = a.pieces_[k].from + 0.5 * a.pieces_[k].length;
      const auto span = static_cast<int>(i);
      sum += a.pieces_[k].length * a.at(span, x).w * b.at(span, x).w +
             a.pieces_[k].length * a.at(span, x).slope * b.at(span, x).slope;
    }
  }
  return sum;
}

double ModeSearch::independence(const ColumnMode& mode, const std::vector<ColumnMode>& others,
                                std::size_t first) {
  // ratio of Gram determinants with and without the mode, by elimination
  std::vector<const ColumnMode*> all;
  for (std::size_t i = first; i < others.size(); ++i) all.push_back(&others[i]);
  all.push_back(&mode);
  const std::size_t n = all.size();
  std::vector<double> g(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) g[i * n + j] = scalar_product(*all[i], *all[j]);
  const double whole = g[n * n - 1];
  for (std::size_t k = 0; k + 1 < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = n; j-- > k;) g[i * n + j] -= g[i * n + k] / g[k * n + k] * g[k * n + j];
  return whole > 0.0 ? g[n * n - 1] / whole : 0.0;
}

void ModeSearch::find(std::size_t count, std::vector<ColumnMode>& out) const {
  const std::size_t first = out.size();
  for (const Match& match : best_matches(count)) {
    if (out.size() == first + count) break;
    ColumnMode mode = mode_of(match);
    if (count == 1 || independence(mode, out, first) > ModeLimits::own_part) out.push_back(std::move(mode));
  }
}

ColumnMode::Value ColumnMode::at(int span, double x) const {
  const int n = first_[span + 1] - first_[span];
  const double length = pieces_[first_[span]].length;
  const int k = std::clamp(static_cast<int>(x / length), 0, n - 1);
  const Piece& piece = pieces_[first_[span] + k];
  const double y = piece.direction > 0.0 ? x - piece.from : piece.from + piece.length - x;
  Value out;
  for (int i = terms - 1; i >= 0; --i) {
    out.slope = out.slope * y + out.w;
    out.w = out.w * y + piece.coefficients[i];
  }
  out.slope *= piece.direction;
  return out;
}

std::vector<ColumnMode> column_modes(const ColumnLine& line, const std::vector<double>& loads) {
  const ColumnLine back = reversed(line);
  std::vector<ColumnMode> out;
  for (std::size_t i = 0; i < loads.size();) {
    std::size_t end = i + 1;
    while (end < loads.size() && loads[end] - loads[end - 1] <= ModeLimits::equal_loads * loads[end]) ++end;
    ModeSearch(line, back, 0.5 * (loads[i] + loads[end - 1])).find(end - i, out);
    if (out.size() != end) break;
    i = end;
  }
  return out;
}

}  // namespace snapthrough
