/// Buried pipes that are lifted against a cover whose resistance rises to a peak (breakout) and falls to a
/// residual, against closed forms of rigid pipes and piecewise exact solutions of an elastic one.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Resistance of a cover per length: a line of slope k up to the lift w1, a line down to the residual at w2,
/// and the residual beyond.
struct Cover {
  double k;
  double w1;
  double w2;
  double residual;

  [[nodiscard]] double peak() const { return k * w1; }
  /// Slope, positive, with which the resistance falls.
  [[nodiscard]] double fall() const { return (peak() - residual) / (w2 - w1); }
  [[nodiscard]] double at(double w) const {
    if (w < w1) return k * w;
    return w < w2 ? peak() - fall() * (w - w1) : residual;
  }
  /// Integral of the resistance from lift 0 to w, times the lift to the power `n`.
  [[nodiscard]] double integral(double w, int n) const {
    const auto power = [n](double from, double to, int m) {
      return (std::pow(to, n + m) - std::pow(from, n + m)) / (n + m);
    };
    double sum = k * power(0.0, std::min(w, w1), 2);
    if (w > w1) {
      const double to = std::min(w, w2);
      sum += (peak() + fall() * w1) * power(w1, to, 1) - fall() * power(w1, to, 2);
    }
    return w > w2 ? sum + residual * power(w2, w, 1) : sum;
  }
};

Foundation foundation_of(const Cover& cover, ReactionLaw::Interpolation interpolation) {
  Foundation out = one_sided("m", 0.0, Side::left);
  out.id = "cover";
  out.law.emplace();
  out.law->type = ReactionLaw::Type::table;
  out.law->points = {{cover.w1, cover.peak()}, {cover.w2, cover.residual}};
  out.law->interpolation = interpolation;
  return out;
}

Foundation bed_of(double stiffness) {
  Foundation out = one_sided("m", stiffness, Side::right);
  out.id = "bed";
  return out;
}

/// Pipe "m" under a cover, lifted at its start or end.
Model lifted(Model model, const Cover& cover, const std::string& node, double force,
             ReactionLaw::Interpolation interpolation = ReactionLaw::Interpolation::linear) {
  model.foundations = {foundation_of(cover, interpolation)};
  model.loads = {force_at(at_node(node), 0.0, force)};
  model.monitors = {{"lift", at_node(node), Component::y}};
  return model;
}

/// Path to a lift of the loaded place.
Result path_to(const Model& model, double lift, double accuracy) {
  Analysis analysis = path_on(accurate(accuracy), 1);
  analysis.stop = {};
  analysis.stop.monitor = MonitorRange{"lift", {-lift, lift}};
  analysis.stop.steps = 2000;
  Result result = solve_soundly(model, analysis);
  EXPECT_EQ(result.branches.at(0).termination, "monitor");
  EXPECT_TRUE(result.capacity.empty()) << "a residual is no largest resistance";
  return result;
}

/// Expects that each computed point of the path has the load that belongs to its lift; counts points beyond
/// `beyond`.
/// @param tolerance absolute, for loads
int expect_loads(const Result& result, const std::function<double(double)>& load, double beyond,
                 double tolerance) {
  int count = 0;
  const Branch& path = result.branches[0];
  for (const int row : path.computed) {
    const double lift = path.monitors[0].values[static_cast<std::size_t>(row)];
    if (lift > beyond) ++count;
    EXPECT_NEAR(path.load_factor[static_cast<std::size_t>(row)], load(lift), tolerance) << lift;
  }
  return count;
}

void expect_maximum_first(const Result& result, double load) {
  const std::vector<CriticalPoint> limits = limits_of(result);
  ASSERT_FALSE(limits.empty());
  EXPECT_EQ(limits[0].type, CriticalType::limit_max);
  expect_relative(limits[0].load_factor, load, 1e-8, "limit load");
}

constexpr Cover kCovers[] = {{10.0, 0.1, 0.4, 0.3}, {10.0, 0.1, 0.15, 0.3}, {10.0, 0.1, 0.5, 0.9}};

/// A rigid pipe that rises without turning: Q = L p(w), whose maximum is the peak.
TEST(Breakout, OfARigidPipeThatRises) {
  constexpr double L = 2.0;
  for (const Cover& cover : kCovers) {
    const Model model = lifted(straight(L, 1e11, 1e13, "xr", ""), cover, "a", 1.0);
    const Result result = path_to(model, 0.7, 1e-9);
    expect_maximum_first(result, L * cover.peak());
    EXPECT_GT(expect_loads(
                  result, [&](double w) { return L * cover.at(w); }, cover.w2, 1e-8),
              0);
  }
}

/// The rising pipe with a cubic between the peak and the residual. A third point with the residual makes the
/// cubic's slope vanish at w2 as it does at the peak.
TEST(Breakout, OfARigidPipeUnderASmoothCover) {
  constexpr double L = 2.0;
  constexpr Cover cover{10.0, 0.1, 0.4, 0.3};
  Model model =
      lifted(straight(L, 1e11, 1e13, "xr", ""), cover, "a", 1.0, ReactionLaw::Interpolation::monotone_cubic);
  model.foundations[0].law->points.push_back({2.0 * cover.w2, cover.residual});
  const Result result = path_to(model, 0.7, 1e-9);
  expect_maximum_first(result, L * cover.peak());
  const auto load = [&](double w) {
    const double t = std::clamp((w - cover.w1) / (cover.w2 - cover.w1), 0.0, 1.0);
    return L * (cover.peak() + (cover.residual - cover.peak()) * t * t * (3.0 - 2.0 * t));
  };
  int beyond = 0;
  const Branch& path = result.branches[0];
  for (const int row : path.computed) {
    const double lift = path.monitors[0].values[static_cast<std::size_t>(row)];
    if (lift < cover.w1) continue;
    ++beyond;
    EXPECT_NEAR(path.load_factor[static_cast<std::size_t>(row)], load(lift), 1e-8) << lift;
  }
  EXPECT_GT(beyond, 3);
}

/// A rigid pipe that is hinged at one end and lifted at the other, by large rotations t: the cover's reaction
/// is vertical and depends on x sin t, so that Q L cos t = int p(x sin t) x cos t dx, and with W = L sin t:
/// Q = L / W^2 int_0^W p(w) w dw. It is largest where Q = L p(W) / 2: with the falling line of slope c,
/// W^3 = w1^3 (1 + k / c).
TEST(Breakout, OfARigidPipeThatTurns) {
  constexpr double L = 1.0;
  for (const Cover& cover : kCovers) {
    const Model model = lifted(straight(L, 1e11, 1e13, "xy", ""), cover, "b", 1.0);
    const Result result = path_to(model, 0.8, 1e-9);
    const double W = cover.w1 * std::cbrt(1.0 + cover.k / cover.fall());
    ASSERT_LT(W, cover.w2);
    expect_maximum_first(result, 0.5 * L * cover.at(W));
    EXPECT_EQ(limits_of(result).size(), 1U);
    EXPECT_NEAR(limits_of(result).at(0).monitors.at(0).value, W, 1e-5);
    const auto load = [&](double w) { return w == 0.0 ? 0.0 : L / (w * w) * cover.integral(w, 1); };
    EXPECT_GT(expect_loads(result, load, cover.w2, 1e-8), 0);
  }
}

/// The turning pipe again: a load that is a share `below` less than the limit load has one state before
/// breakout and one beyond it, however near the limit point they are.
TEST(Breakout, OfARigidPipeHasTwoStatesJustBelowTheLimitLoad) {
  constexpr Cover cover = kCovers[0];
  const Model model = lifted(straight(1.0, 1e11, 1e13, "xy", ""), cover, "b", 1.0);
  const double limit = 0.5 * cover.at(cover.w1 * std::cbrt(1.0 + cover.k / cover.fall()));
  for (const double below : {0.3, 0.03, 0.01, 1e-3}) {
    Analysis analysis = path_on(accurate(1e-9), 1);
    analysis.stop = {};
    analysis.stop.monitor = MonitorRange{"lift", {-0.8, 0.8}};
    analysis.output.states = StateOutput::at_load_factors;
    analysis.output.at_load_factors = {(1.0 - below) * limit};
    const Result result = solve_soundly(model, analysis);
    EXPECT_TRUE(result.not_reached.empty()) << below;
    EXPECT_EQ(result.states.size(), 2U) << below;
    for (const State& state : result.states) {
      const double w = state.members.at(0).v.back();
      expect_relative(state.load_factor, cover.integral(w, 1) / (w * w), 1e-8, "load at a lift");
    }
  }
}

/// A rigid pipe of length L that lies free on a bed (stiffness b) and is lifted at its end by W: its lift is
/// W (1 - x / a), and the bed carries the part x > a. The moment about the lifted end gives a:
/// (a / W)^2 int_0^W p(w) (W - w) dw = b W / a int_a^L (x - a) x dx. Then Q = a / W int_0^W p dw - b W (L -
/// a)^2 / (2 a).
class TiltedPipe {
 public:
  static constexpr double L = 1.0;
  TiltedPipe(const Cover& cover, double bed) : cover_(cover), bed_(bed) {}
  [[nodiscard]] double load(double W) const {
    if (W == 0.0) return 0.0;
    const double force = cover_.integral(W, 0);
    const double moment = W * force - cover_.integral(W, 1);
    double lo = 0.0;
    double hi = L;
    for (int i = 0; i < 100; ++i) {
      const double a = 0.5 * (lo + hi);
      const double by_bed = bed_ * W / a * (std::pow(L, 3) / 3.0 - a * L * L / 2.0 + std::pow(a, 3) / 6.0);
      (a * a / (W * W) * moment < by_bed ? lo : hi) = a;
    }
    return lo / W * force - bed_ * W * (L - lo) * (L - lo) / (2.0 * lo);
  }
  /// Largest load, by golden sections in double: it is known to rounding, its place to the root of rounding.
  [[nodiscard]] double largest(double from, double to) const {
    const double share = 0.5 * (std::sqrt(5.0) - 1.0);
    for (int i = 0; i < 100; ++i) {
      const double left = to - share * (to - from);
      const double right = from + share * (to - from);
      const bool falls = load(left) > load(right);
      (falls ? to : from) = falls ? right : left;
    }
    return load(from);
  }

 private:
  Cover cover_;
  double bed_;
};

TEST(Breakout, OfARigidPipeThatIsLiftedAtItsEnd) {
  constexpr double bed = 50.0;
  for (const Cover& cover : kCovers) {
    const TiltedPipe tilted(cover, bed);
    Model model = lifted(straight(TiltedPipe::L, 1e11, 1e13, "x", ""), cover, "a", 1.0);
    model.foundations.push_back(bed_of(bed));
    const Result result = path_to(model, 0.6, 1e-9);
    ASSERT_FALSE(limits_of(result).empty());
    EXPECT_EQ(limits_of(result)[0].type, CriticalType::limit_max);
    expect_relative(limits_of(result)[0].load_factor, tilted.largest(cover.w1, cover.w2), 1e-8, "limit load");
    EXPECT_GT(expect_loads(
                  result, [&](double w) { return tilted.load(w); }, cover.w2, 1e-8),
              0);
  }
}

/// Half of an elastic pipe (EI = 1) that is lifted at its middle x = 0 by W and free at x = length. Where the
/// cover or the bed has the reaction k w + p0 per length, w'''' + k w + p0 = 0, whose solution is exact by
/// functions K_i = sum over j of (-k)^j x^(4 j + i) / (4 j + i)! for either sign of k: w = w(0) K_0 + w'(0)
/// K_1 + w''(0) K_2 + w'''(0) K_3 - p0 K_4. Pieces end where w passes 0, w1 or w2, which halving finds. Two
/// conditions at the free end give w''(0) and w'''(0) = Q / 2 by Newton's method; the product of the pieces'
/// matrices is its derivative, since the reaction does not jump between pieces.
class LiftedBeam {
 public:
  using Real = long double;

  LiftedBeam(const Cover& cover, double bed, double length) : length_(length) {
    const Real fall = cover.fall();
    pieces_ = {{-kFar, 0.0L, bed, 0.0L},
               {0.0L, cover.w1, cover.k, 0.0L},
               {cover.w1, cover.w2, -fall, cover.peak() + fall * cover.w1},
               {cover.w2, kFar, 0.0L, cover.residual}};
  }
  /// Goes to the lift W in steps of at most `step`. A solution has each piece of its start.
  void go_to(Real W, Real step) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(W - W_) / step)));
    const Real from = W_;
    for (int i = 1; i <= steps; ++i) solve(from + (W - from) * i / steps);
  }
  [[nodiscard]] double load() const { return static_cast<double>(2.0L * start_[1]); }
  [[nodiscard]] double moment() const { return static_cast<double>(start_[0]); }
  /// Number of changes from one piece to another along the pipe.
  [[nodiscard]] int changes() const { return changes_; }
  /// dQ / dW.
  [[nodiscard]] Real slope() const { return 2.0L * rate_[1]; }

 private:
  struct Piece {
    Real from, to;  ///< lifts
    Real k, p0;
  };
  using Four = Eigen::Matrix<Real, 4, 1>;
  using Four4 = Eigen::Matrix<Real, 4, 4>;
  using Two = Eigen::Matrix<Real, 2, 1>;
  static constexpr Real kFar = 1e9L;

  static std::array<Real, 5> functions(Real k, Real x) {
    std::array<Real, 5> out{};
    Real first = 1.0L;
    for (int i = 0; i < 5; ++i) {
      Real term = first;
      for (int n = i; std::abs(term) > 1e-22L * std::abs(out[i]); n += 4) {
        out[i] += term;
        term *= -k * x * x * x * x / (Real(n + 1) * (n + 2) * (n + 3) * (n + 4));
      }
      first *= x / (i + 1);
    }
    return out;
  }
  /// Moves w and its derivatives by x within a piece.
  static Four moved(const Piece& piece, Real x, const Four& at, Four4* matrix = nullptr) {
    const std::array<Real, 5> K = functions(piece.k, x);
    Four4 T;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        T(row, column) = column >= row ? K[column - row] : -piece.k * K[4 + column - row];
    Four out = T * at;
    for (int row = 0; row < 4; ++row) out[row] -= piece.p0 * K[4 - row];
    if (matrix != nullptr) *matrix = T;
    return out;
  }
  static bool is_outside(const Piece& piece, Real w) { return w > piece.to || w < piece.from; }

  /// Distance within `step` at which w leaves the piece: by halving, then by Newton's method.
  static Real end_of(const Piece& piece, Real step, const Four& at) {
    Real inside = 0.0L;
    Real outside = step;
    for (int i = 0; i < 12; ++i) {
      const Real middle = 0.5L * (inside + outside);
      (is_outside(piece, moved(piece, middle, at)[0]) ? outside : inside) = middle;
    }
    const Real bound = moved(piece, outside, at)[0] > piece.to ? piece.to : piece.from;
    for (int i = 0; i < 4; ++i) {
      const Four there = moved(piece, outside, at);
      outside += (bound - there[0]) / there[1];
    }
    return outside;
  }
  /// Values at the free end; `matrix_` is their derivative by those at the middle.
  Four along(Four at) {
    matrix_.setIdentity();
    changes_ = 0;
    std::size_t i = 0;
    while (at[0] > pieces_[i].to) ++i;
    Real x = 0.0L;
    while (length_ - x > 1e-15L) {
      const Piece& piece = pieces_[i];
      Real step = std::min(0.2L, length_ - x);
      const Real w = moved(piece, step, at)[0];
      const bool ends = is_outside(piece, w);
      if (ends) step = end_of(piece, step, at);
      Four4 matrix;
      at = moved(piece, step, at, &matrix);
      matrix_ = matrix * matrix_;
      x += step;
      if (!ends) continue;
      const bool up = w > piece.to;
      at[0] = up ? piece.to : piece.from;
      i = up ? i + 1 : i - 1;
      ++changes_;
    }
    return at;
  }
  void solve(Real W) {
    start_ += (W - W_) * rate_;
    W_ = W;
    Real correction = 1.0L;
    for (int i = 0; i < 50 && correction > 1e-15L; ++i) {
      const Four end = along(Four(W, 0.0L, start_[0], start_[1]));
      const Two change = matrix_.block<2, 2>(2, 2).fullPivLu().solve(end.tail<2>());
      start_ -= change;
      correction = change.cwiseAbs().maxCoeff() / start_.cwiseAbs().maxCoeff();
    }
    EXPECT_LE(correction, 1e-15L) << "Newton's method converges at the lift " << static_cast<double>(W);
    rate_ = -matrix_.block<2, 2>(2, 2).fullPivLu().solve(matrix_.block<2, 1>(2, 0));
  }

  std::vector<Piece> pieces_;
  Real length_;
  Real W_ = 0.0L;
  Two start_ = Two::Zero();      ///< w''(0), w'''(0)
  Two rate_ = Two(-2.0L, 4.0L);  ///< derivatives of `start_` by W: those of k = 4 without end, at first
  Four4 matrix_;
  int changes_ = 0;
};

struct Turn {
  double load;
  double lift;
};

/// Loads between 0 and the lift `most` at which dQ / dW changes its sign.
std::vector<Turn> turns_of(LiftedBeam& beam, double most) {
  constexpr double step = 0.02;
  std::vector<Turn> out;
  beam.go_to(0.5L, step);
  for (double W = 0.5 + step; W < most; W += step) {
    const LiftedBeam before = beam;
    beam.go_to(W, step);
    if ((before.slope() > 0.0L) == (beam.slope() > 0.0L)) continue;
    long double lo = W - step;
    long double hi = W;
    LiftedBeam near = before;
    for (int i = 0; i < 55; ++i) {
      const long double middle = 0.5L * (lo + hi);
      near.go_to(middle, step);
      ((near.slope() > 0.0L) == (before.slope() > 0.0L) ? lo : hi) = middle;
    }
    out.push_back({near.load(), static_cast<double>(lo)});
  }
  return out;
}

constexpr double kSmall = 1e-5;  ///< unit of lifts, so small that squares of slopes do not matter

/// Half of an elastic pipe under a cover whose lifts are in units of kSmall, on a bed.
Model elastic_pipe(const Cover& cover, double bed, double length) {
  const Cover small{cover.k, cover.w1 * kSmall, cover.w2 * kSmall, cover.residual * kSmall};
  Model model = lifted(straight(length, 1.0, 1e6, "xr", ""), small, "a", 0.5 * kSmall);
  model.foundations.push_back(bed_of(bed));
  return model;
}

struct ElasticCase {
  Cover cover;
  double length;
  double most;  ///< lift at which the path ends
};

/// Path of an elastic pipe, with states at three loads: one before breakout, and two between the least load
/// beyond and the breakout load, which the path passes three times.
Result path_of(const ElasticCase& one, double bed, const std::vector<Turn>& turns) {
  Analysis analysis = path_on(accurate(1e-9), 1);
  analysis.stop = {};
  analysis.stop.monitor = MonitorRange{"lift", {-one.most * kSmall, one.most * kSmall}};
  analysis.output.states = StateOutput::at_load_factors;
  const double difference = turns[0].load - turns[1].load;
  analysis.output.at_load_factors = {0.5 * turns[0].load, turns[1].load + 0.2 * difference,
                                     turns[1].load + 0.35 * difference};
  return solve_soundly(elastic_pipe(one.cover, bed, one.length), analysis);
}

/// The limit load at which the pipe breaks out, the least load that holds it up beyond, and lift and moment
/// at the middle of states before, between and beyond.
TEST(Breakout, OfALongElasticPipe) {
  constexpr double bed = 16.0;
  const ElasticCase cases[] = {{{4.0, 1.0, 3.0, 2.0}, 6.0, 6.0},
                               {{4.0, 1.0, 2.0, 1.2}, 6.0, 8.0},
                               {{4.0, 1.0, 1.5, 2.0}, 5.0, 4.0},
                               {{4.0, 1.0, 4.0, 2.0}, 5.0, 6.0}};
  for (const ElasticCase& one : cases) {
    SCOPED_TRACE(one.cover.w2);
    LiftedBeam beam(one.cover, bed, one.length);
    const std::vector<Turn> turns = turns_of(beam, one.most);
    ASSERT_EQ(turns.size(), 2U);
    EXPECT_GT(turns[1].lift, one.cover.w2) << "the residual acts";
    const Result result = path_of(one, bed, turns);
    const std::vector<CriticalPoint> limits = limits_of(result);
    ASSERT_EQ(limits.size(), 2U);
    EXPECT_EQ(limits[0].type, CriticalType::limit_max);
    EXPECT_EQ(limits[1].type, CriticalType::limit_min);
    for (std::size_t i = 0; i < 2; ++i) {
      expect_relative(limits[i].load_factor, turns[i].load, 1e-8, "limit load");
      expect_relative(limits[i].monitors.at(0).value, turns[i].lift * kSmall, 1e-4, "lift at the limit load");
    }
    EXPECT_GT(result.states.back().members.at(0).v.front(), one.cover.w1 * kSmall);
    for (const State& state : result.states) {
      const MemberState& pipe = state.members.at(0);
      LiftedBeam at(one.cover, bed, one.length);
      at.go_to(pipe.v.front() / kSmall, 0.02L);
      expect_relative(state.load_factor, at.load(), 1e-8, "load at a lift");
      expect_relative(pipe.bending_moment.front() / kSmall, at.moment(), 1e-8, "moment at the middle");
    }
  }
}

}  // namespace
}  // namespace snapthrough
