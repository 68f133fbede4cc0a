/// Heated pipes that lift off their bed or move sideways, and railway track, against Hobbs' linear theory.
///
/// Source: R. Hobbs, In-service buckling of heated pipelines, J. Transp. Eng. 110 (1984) 175. A half wave of
/// length h (half the buckle, or one of two half waves) has E I w'''' + P w'' = -q under the resistance q, no
/// bed, and w = w' = w'' = 0 at its end. Its axial force P is that of the pipe far away, P0, less what the
/// pipe that feeds in loses to friction. The tests take the shapes in closed form; the printed constants are
/// theirs to four digits, but 2.408e-3, which is 2.4068e-3. A bed of 1e9 EI / L^4 and friction with an
/// initial slope stand for what is rigid.
#include <functional>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

enum class Wave { symmetric, antisymmetric };

/// What a buckle depends on. Units kN, m and degrees.
struct Pipe {
  double EI, EA, expansion;
  double across;  ///< resistance q across the pipe, force per length
  double along;   ///< friction f along the pipe, force per length
  bool
      at_the_ends;  ///< friction f h acts where the pipe meets its bed, since the bed's reaction there is q h
  Wave wave = Wave::symmetric;

  /// The pipe with slopes s times as large, and the same forces in linear theory: s q and EA / s^2.
  [[nodiscard]] Pipe with_slopes(double s) const {
    Pipe out = *this;
    out.across *= s;
    out.EA /= s * s;
    return out;
  }
};

/// Half of a buckle in linear theory: w = A cos k x + B sin k x + C + D x - q x^2 / (2 P).
class Buckle {
 public:
  /// @param L length of the buckle, or of one of its two half waves
  Buckle(const Pipe& pipe, double L) : pipe_(pipe) {
    const bool even = pipe.wave == Wave::symmetric;
    const double q = pipe.across;
    h_ = even ? 0.5 * L : L;
    k_ = (even ? end_of_symmetric_wave() : 2.0 * kPi) / h_;
    P_ = pipe.EI * k_ * k_;
    if (even) {
      A_ = -q * h_ / (P_ * k_ * std::sin(k_ * h_));
      C_ = q * h_ * h_ / (2.0 * P_) - A_ * std::cos(k_ * h_);
    } else {
      A_ = -q / (P_ * k_ * k_);
      C_ = -A_;
      D_ = q * h_ / (2.0 * P_);
      B_ = D_ / k_;
    }
  }

  /// k h of w(h) = w'(h) = w''(h) = 0: tan(k h) = k h.
  static double end_of_symmetric_wave() {
    double low = 4.0;
    double high = 4.6;
    for (int i = 0; i < 100; ++i) {
      const double x = 0.5 * (low + high);
      (std::sin(x) - x * std::cos(x) > 0.0 ? low : high) = x;
    }
    return low;
  }
  [[nodiscard]] double half_length() const { return h_; }
  [[nodiscard]] double force() const { return P_; }
  /// Derivative of order n of the deflection.
  [[nodiscard]] double at(double x, int n) const {
    if (x >= h_) return 0.0;
    const double c = std::cos(k_ * x);
    const double s = std::sin(k_ * x);
    const double half = pipe_.across / P_;
    switch (n) {
      case 0:
        return A_ * c + B_ * s + C_ + D_ * x - 0.5 * half * x * x;
      case 1:
        return k_ * (B_ * c - A_ * s) + D_ - half * x;
      case 2:
        return -k_ * k_ * (A_ * c + B_ * s) - half;
      default:
        return k_ * k_ * k_ * (A_ * s - B_ * c);
    }
  }
  /// Length that the half gains over its chord: int w'^2 / 2, by Simpson's rule.
  [[nodiscard]] double shortening() const {
    constexpr int n = 400;
    double sum = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double slope = at(h_ * i / n * (1.0 - 1e-15), 1);
      sum += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * slope * slope;
    }
    return 0.5 * sum * h_ / (3.0 * n);
  }
  /// Axial force far away when friction begins at the distance h from the middle. With x = P0 - P: (x - f
  /// h)^2 / (2 EA f) + x h / EA is the shortening where the ends have friction, else x^2 / (2 EA f) + x h /
  /// EA.
  [[nodiscard]] double far_force(double h) const {
    const double fh = pipe_.along * h;
    const double fed = 2.0 * pipe_.EA * pipe_.along * shortening();
    return P_ + (pipe_.at_the_ends ? std::sqrt(fed - fh * fh) : std::sqrt(fh * fh + fed) - fh);
  }
  [[nodiscard]] double far_force() const { return far_force(h_); }
  /// Displacement of the pipe where it meets its bed.
  [[nodiscard]] double fed_in() const {
    const double loss = far_force() - P_ - (pipe_.at_the_ends ? pipe_.along * h_ : 0.0);
    return loss * loss / (2.0 * pipe_.EA * pipe_.along);
  }

 private:
  Pipe pipe_;
  double h_, k_, P_;
  double A_ = 0.0, B_ = 0.0, C_ = 0.0, D_ = 0.0;
};

/// Length with the least value of f, by golden sections.
double least(const std::function<double(double)>& f, double low, double high) {
  const double share = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 100; ++i) {
    const double a = high - share * (high - low);
    const double b = low + share * (high - low);
    const bool is_left = f(a) < f(b);
    (is_left ? high : low) = is_left ? b : a;
  }
  return 0.5 * (low + high);
}

/// Length of the buckle with Hobbs' least force, where friction begins at the buckle's end.
double safe_length(const Pipe& pipe) {
  return least([&](double L) { return Buckle(pipe, L).far_force(); }, 5.0, 300.0);
}

double stiffness_of_bed(const Pipe& pipe, const Buckle& buckle) {
  return 1e9 * pipe.EI / std::pow(2.0 * buckle.half_length(), 4);
}

/// Half of the pipe with its bed, resistances and heat 1; the end of the friction-free part is that of
/// `buckle`.
Model half_of(const Pipe& pipe, const Buckle& buckle, double length, double friction_slope) {
  const double h = buckle.half_length();
  Model model = straight(length, pipe.EI, pipe.EA, pipe.wave == Wave::symmetric ? "xr" : "xy", "xr");
  model.sections[0].expansion = pipe.expansion;
  Foundation bed = one_sided("m", stiffness_of_bed(pipe, buckle), Side::right);
  bed.id = "bed";
  bed.direction = std::array{0.0, -1.0};
  Foundation friction = winkler("m", 0.0);
  friction.id = "friction";
  friction.component = FoundationComponent::tangent;
  friction.range = {h / length, 1.0};
  const auto law = [friction_slope](double capacity) {
    ReactionLaw out;
    out.type = ReactionLaw::Type::tanh;
    out.stiffness = friction_slope * capacity;
    out.capacity = capacity;
    return out;
  };
  friction.law = law(pipe.along);
  model.foundations = {bed, friction};
  if (pipe.at_the_ends) {
    Spring spring;
    spring.id = "end";
    spring.at = at_member("m", h / length);
    spring.direction = std::array{1.0, 0.0};
    spring.law = law(pipe.along * h);
    model.springs = {spring};
  }
  DistributedLoad resistance;
  resistance.member = "m";
  resistance.force = {0.0, -pipe.across};
  resistance.pattern = Pattern::constant;
  model.loads = {TemperatureLoad{"m", 1.0, 0.0, Pattern::proportional, {}, {}}, resistance};
  return model;
}

/// State of linear theory: deflections of the buckle, and what the rest feeds in; the rest has sunk into its
/// bed.
/// @param from distance from the middle at which friction begins
StartState linear_state(const Pipe& pipe, const Buckle& buckle, double length, double from) {
  const double h = buckle.half_length();
  const double far = buckle.far_force(from);
  const double start = buckle.force() + (pipe.at_the_ends ? pipe.along * from : 0.0);
  const auto force_at = [&](double x) {
    return x < from ? buckle.force() : std::min(far, start + pipe.along * (x - from));
  };
  StartState out;
  out.load_factor = far / (pipe.EA * pipe.expansion);
  MemberShape shape;
  shape.id = "m";
  for (int i = 0; i <= 2000; ++i)
    shape.s.push_back(i <= 400 ? h * i / 400 : h + (length - h) * (i - 400) / 1600);
  double u = 0.0;
  for (std::size_t i = 0; i < shape.s.size(); ++i) {
    const double x = shape.s[i];
    if (i > 0) {
      const double middle = 0.5 * (x + shape.s[i - 1]);
      u += (x - shape.s[i - 1]) *
           ((far - force_at(middle)) / pipe.EA - 0.5 * std::pow(buckle.at(middle, 1), 2));
    }
    shape.u.push_back(u);
    shape.v.push_back(x < h ? buckle.at(x, 0) : -pipe.across / stiffness_of_bed(pipe, buckle));
    shape.rotation.push_back(buckle.at(x, 1));
    shape.axial.push_back(-force_at(x));
    shape.shear.push_back(-pipe.EI * buckle.at(x, 3) - buckle.force() * buckle.at(x, 1));
    shape.bend.push_back(pipe.EI * buckle.at(x, 2));
  }
  out.members = {shape};
  return out;
}

/// Least force far away with an equilibrium of a buckled pipe, over that of linear theory: the limit point on
/// the path that begins with a buckle 1.1 times as long as that of Hobbs' least force. Friction begins in
/// both where that buckle ends.
double exact_over_linear(const Pipe& given, double slopes) {
  const Pipe pipe = given.with_slopes(slopes);
  const double L = safe_length(given);
  const Buckle safe(pipe, L);
  const Buckle longer(pipe, 1.1 * L);
  const double length = longer.half_length() + 1.1 * (longer.far_force() - longer.force()) / pipe.along;
  const Model model = half_of(pipe, safe, length, 1e4 / safe.fed_in());
  Analysis analysis = path_on(accurate(1e-4), 1);
  analysis.start = linear_state(pipe, longer, length, safe.half_length());
  analysis.step.direction = -1.0;
  const Result result = solve_soundly(model, analysis);
  const std::vector<CriticalPoint> limits = limits_of(result);
  if (limits.empty()) return std::nan("");
  EXPECT_EQ(limits[0].type, CriticalType::limit_min);
  const double from = safe.half_length();
  const auto force = [&](double length_of_buckle) { return Buckle(pipe, length_of_buckle).far_force(from); };
  return limits[0].load_factor * pipe.EA * pipe.expansion / force(least(force, 0.5 * L, 1.5 * L));
}

/// Pipe 650 x 15 mm, E = 206 GPa, weight 3.8 kN/m, friction 0.5.
Pipe pipeline() {
  const double A = kPi / 4.0 * (0.65 * 0.65 - 0.62 * 0.62);
  const double I = kPi / 64.0 * (std::pow(0.65, 4) - std::pow(0.62, 4));
  return {206e6 * I, 206e6 * A, 1.1e-5, 3.8, 1.9, true};
}

/// The closed forms of this file give Hobbs' constants and his least force of the pipe.
TEST(LiftedPipe, ClosedFormsAreHobbsConstants) {
  Pipe unit{1.0, 1.0, 1.0, 1.0, 1.0, true};
  const Buckle one(unit, 1.0);
  expect_relative(one.force(), 80.76, 5e-5, "P L^2 / EI");
  expect_relative(one.at(0.0, 0), 2.408e-3, 6e-4, "deflection");
  expect_relative(-one.at(0.0, 2), 0.06938, 5e-5, "moment");
  expect_relative(2.0 * one.shortening(), 1.597e-5, 5e-4, "1.597e-5 of upheaval");
  expect_relative(8.0 * one.shortening(), 6.391e-5, 5e-4, "k2 of mode 1");
  unit.wave = Wave::antisymmetric;
  const Buckle two(unit, 1.0);
  expect_relative(two.force(), 4.0 * kPi * kPi, 1e-12, "P of mode 2");
  expect_relative(2.0 * two.shortening(), 1.743e-4, 5e-4, "k2 of mode 2");
  const double L = safe_length(pipeline());
  EXPECT_NEAR(L, 97.2, 0.1);
  const double P0 = Buckle(pipeline(), L).far_force();
  EXPECT_NEAR(P0, 4168.0, 2.0);
  EXPECT_NEAR(P0 / (pipeline().EA * 1.1e-5), 61.5, 0.05);
}

/// A rigid bed without friction: at the axial force P the crown is at y and has the moment M of the closed
/// form. The bed of stiffness K changes them as K^(-3/4).
TEST(LiftedPipe, OnABedThatBecomesRigid) {
  const Pipe pipe{1.0, 1e10, 1.0, 1e-3, 1.0, false};
  const Buckle buckle(pipe, 1.0);
  const double load = 85.0;
  const Buckle there(pipe, std::sqrt(buckle.force() / load));
  std::vector<double> deflection;
  for (const double K : {1e8, 1e10}) {
    Model model = straight(1.0, 1.0, 1e10, "xr", "r");
    model.foundations = {one_sided("m", K, Side::right)};
    DistributedLoad weight;
    weight.member = "m";
    weight.force = {0.0, -pipe.across};
    weight.pattern = Pattern::constant;
    model.loads = {force_at(at_node("b"), -1.0, 0.0), weight};
    Analysis analysis = path_on(accurate(1e-6), 1);
    analysis.stop = {};
    analysis.stop.load_factor = std::array{60.0, 86.0};
    analysis.output.states = StateOutput::at_load_factors;
    analysis.output.at_load_factors = {load};
    StartState start = linear_state(pipe, buckle, 1.0, buckle.half_length());
    start.load_factor = buckle.force();
    start.members[0].u.assign(start.members[0].s.size(), 0.0);
    start.members[0].axial.assign(start.members[0].s.size(), -buckle.force());
    analysis.start = start;
    const Result result = solve_soundly(model, analysis);
    ASSERT_EQ(result.states.size(), 1U) << K;
    const MemberState& m = result.states[0].members[0];
    deflection.push_back(m.v.front() / there.at(0.0, 0) - 1.0);
    expect_relative(m.bending_moment.front(), there.at(0.0, 2), K == 1e8 ? 1e-4 : 5e-6,
                    "moment at the crown");
  }
  EXPECT_LT(std::abs(deflection[0]), 2e-4);
  EXPECT_LT(std::abs(deflection[1]), 1e-5);
  EXPECT_GT(std::abs(deflection[0] / deflection[1]), 20.0);
}

/// Slopes a tenth of the real ones give linear theory, but for the stiffness of bed and friction. With its
/// own slopes, up to 0.085, the pipe's least force is lower by 1e-4 to 2.5e-4: the difference goes with the
/// square of the slopes.
void expect_linear_theory(const Pipe& pipe, const std::string& what) {
  EXPECT_NEAR(exact_over_linear(pipe, 0.1), 1.0, 3e-5) << what;
  const double lower = 1.0 - exact_over_linear(pipe, 1.0);
  EXPECT_GT(lower, 0.5e-4) << what;
  EXPECT_LT(lower, 3e-4) << what;
}

TEST(LiftedPipe, Upheaval) { expect_linear_theory(pipeline(), "pipe that lifts off"); }

/// Lateral modes 1 and 2: the resistance q pushes the pipe back to a line that it cannot cross, and friction
/// acts along the part that does not move sideways.
TEST(LiftedPipe, LateralModes) {
  for (const Wave wave : {Wave::symmetric, Wave::antisymmetric}) {
    Pipe pipe = pipeline();
    pipe.across = 1.9;
    pipe.at_the_ends = false;
    pipe.wave = wave;
    expect_linear_theory(pipe, "mode " + std::to_string(1 + static_cast<int>(wave)));
  }
}

/// Two rails UIC 60, EA = 3.23 GN and EI = 2.15 MN m^2 sideways, in ballast that resists 5 kN/m across and 10
/// kN/m along the track.
TEST(LiftedPipe, RailwayTrack) {
  for (const Wave wave : {Wave::symmetric, Wave::antisymmetric})
    expect_linear_theory({2.15e3, 3.23e6, 1.15e-5, 5.0, 10.0, false, wave},
                         "track in mode " + std::to_string(1 + static_cast<int>(wave)));
}

}  // namespace
}  // namespace snapthrough
