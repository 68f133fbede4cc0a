/// Rings of equal segments with rotational joints, as tunnels are lined with, against own solutions: small
/// displacements under two opposite loads, and buckling under hydrostatic pressure.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Type = ReactionLaw::Type;

constexpr double kStiff = 1e14;  ///< EA of a ring that counts as inextensible

/// Ring of `segments` arcs, R = 1, turning left from node "0" at the angle 0. The joint at the start of each
/// arc connects it to its node, which turns with the end of the arc before.
/// @param EI 1 but for segments that count as rigid
Model ring(int segments, double EA, const std::function<void(Member&)>& join, double EI = 1.0) {
  Model model;
  model.sections = {{"s", EA, EI, {}}};
  for (int i = 0; i < segments; ++i) {
    const double angle = 2.0 * kPi * i / segments;
    model.nodes.push_back({std::to_string(i), std::cos(angle), std::sin(angle)});
    Member arc{"arc " + std::to_string(i),
               std::to_string(i),
               std::to_string((i + 1) % segments),
               "s",
               ArcCurve{360.0 / segments},
               false,
               false};
    join(arc);
    model.members.push_back(arc);
  }
  model.supports = {support("0", "xyr")};
  return model;
}

std::function<void(Member&)> with_stiffness(double stiffness) {
  return [stiffness](Member& member) {
    member.release_start_rotation = true;
    member.release_start_stiffness = stiffness;
  };
}

std::function<void(Member&)> with_law(const ReactionLaw& law) {
  return [law](Member& member) {
    member.release_start_rotation = true;
    member.release_start_law = law;
  };
}

// ---------------------------------------------------------------------------------------------------------
// Two opposite loads, small displacements

struct Vector {
  double x = 0.0;
  double y = 0.0;
};
Vector at_angle(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Ring that two opposite loads P press together at the angle `load` and at the opposite place, by the force
/// method. The ring is cut at the angle 0, before the joint there; X = (Fx, Fy, M) are force and moment that
/// act on the end of the cut. Along the ring M(x) = M - (x - x0) x F + sum of (x - x1) x p over the loads p
/// at x1 that were passed, and F changes by -p there. With the rotations t(M) of the joints the ring closes
/// if int M / EI ds + sum t = 0 and int N / EA e ds - int rot(x) M / EI ds - sum rot(x) t = 0, e the tangent,
/// rot a turn by 90 degrees.
class CutRing {
 public:
  /// Rotation of a joint by its moment, and the derivative.
  using Joint = std::function<std::array<double, 2>(double)>;

  CutRing(int segments, double EA, double load, Joint joint)
      : segments_(segments), EA_(EA), load_(load), joint_(std::move(joint)) {
    std::vector<double> ends;
    for (int i = 0; i <= 16 * segments; ++i) ends.push_back(2.0 * kPi * i / (16 * segments));
    ends.insert(ends.end(), {load_, load_ + kPi});
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) add_places(ends[i], ends[i + 1]);
  }

  /// Solves by Newton's method for loads that grow to P in steps.
  void press(double P) {
    constexpr int steps = 40;
    for (int step = 1; step <= steps; ++step) {
      P_ = P * step / steps;
      double change = 1.0;
      for (int i = 0; i < 60 && change > 1e-14; ++i) change = correct();
      EXPECT_LE(change, 1e-14) << "Newton's method converges at " << P_;
    }
  }
  [[nodiscard]] double moment(double angle) const {
    const std::array<double, 4> m = moment_parts(angle);
    return m[0] * X_[0] + m[1] * X_[1] + m[2] * X_[2] + m[3] * P_;
  }
  [[nodiscard]] double axial(double angle) const {
    const std::array<double, 4> n = axial_parts(angle);
    return n[0] * X_[0] + n[1] * X_[1] + n[3] * P_;
  }
  [[nodiscard]] double joint_angle(int i) const { return 2.0 * kPi * i / segments_; }
  [[nodiscard]] double joint_rotation(int i) const { return joint_(moment(joint_angle(i)))[0]; }

  /// Displacement at an angle relative to node 0, which is fixed: int N / EA e ds + sum and integral of
  /// rot(x(angle) - x) by the rotation that is gained at x.
  [[nodiscard]] Vector displacement(double angle) const {
    Vector out;
    const Vector here = at_angle(angle);
    const auto turn = [&](double where, double rotation) {
      const Vector there = at_angle(where);
      out.x -= (here.y - there.y) * rotation;
      out.y += (here.x - there.x) * rotation;
    };
    for (const Place& place : places_) {
      if (place.angle > angle) break;
      const double stretch = axial(place.angle) / EA_ * place.weight;
      out.x -= std::sin(place.angle) * stretch;
      out.y += std::cos(place.angle) * stretch;
      turn(place.angle, moment(place.angle) * place.weight);
    }
    for (int i = 0; i < segments_ && joint_angle(i) < angle - 1e-12; ++i)
      turn(joint_angle(i), joint_rotation(i));
    return out;
  }
  /// Shortening of the diameter between the loads.
  [[nodiscard]] double shortening() const {
    const Vector first = displacement(load_);
    const Vector second = displacement(load_ + kPi);
    return std::cos(load_) * (second.x - first.x) + std::sin(load_) * (second.y - first.y);
  }

 private:
  struct Place {
    double angle;
    double weight;
  };

  /// Gauss points of order 6 between two angles, which are at most pi / 16 apart: exact to rounding.
  void add_places(double from, double to) {
    static constexpr double x[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    static constexpr double w[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    if (to - from < 1e-14) return;
    const double half = 0.5 * (to - from);
    for (const int i : {2, 1, 0}) places_.push_back({0.5 * (from + to) - half * x[i], half * w[i]});
    for (const int i : {0, 1, 2}) places_.push_back({0.5 * (from + to) + half * x[i], half * w[i]});
  }
  /// Moment by Fx, Fy, M and P. The load at `load_` is -P at_angle(load_), the other one is opposite.
  [[nodiscard]] std::array<double, 4> moment_parts(double angle) const {
    const Vector here = at_angle(angle);
    std::array<double, 4> out{here.y, -(here.x - 1.0), 1.0, 0.0};
    // (x - e) x (-P e) = -P x x e, e = at_angle(load_); the opposite load has the other sign
    const Vector e = at_angle(load_);
    const double product = here.x * e.y - here.y * e.x;
    if (angle > load_) out[3] -= product;
    if (angle > load_ + kPi) out[3] += product;
    return out;
  }
  /// Axial force by Fx, Fy, M and P: (F - sum of the loads passed) e(angle).
  [[nodiscard]] std::array<double, 4> axial_parts(double angle) const {
    std::array<double, 4> out{-std::sin(angle), std::cos(angle), 0.0, 0.0};
    const double along = std::sin(load_ - angle);  // at_angle(load_) times the tangent
    if (angle > load_) out[3] += along;
    if (angle > load_ + kPi) out[3] -= along;
    return out;
  }
  /// One correction of X; returns its size.
  double correct() {
    Eigen::Vector3d gap = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
    const auto gain = [&](const std::array<double, 4>& parts, double value, double slope,
                          const Eigen::Vector3d& direction) {
      gap += value * direction;
      for (int i = 0; i < 3; ++i) rate.col(i) += slope * parts[static_cast<std::size_t>(i)] * direction;
    };
    const auto rotation_at = [](double angle) {
      return Eigen::Vector3d(std::sin(angle), -std::cos(angle), 1.0);
    };
    for (const Place& place : places_) {
      const double angle = place.angle;
      gain(moment_parts(angle), moment(angle) * place.weight, place.weight, rotation_at(angle));
      gain(axial_parts(angle), axial(angle) * place.weight / EA_, place.weight / EA_,
           Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0.0));
    }
    for (int i = 0; i < segments_; ++i) {
      const auto [rotation, slope] = joint_(moment(joint_angle(i)));
      gain(moment_parts(joint_angle(i)), rotation, slope, rotation_at(joint_angle(i)));
    }
    const Eigen::Vector3d change = rate.fullPivLu().solve(gap);
    X_ -= change;
    return change.norm() / (P_ + X_.norm());
  }

  int segments_;
  double EA_;
  double load_;
  double P_ = 0.0;
  Joint joint_;
  std::vector<Place> places_;
  Eigen::Vector3d X_ = Eigen::Vector3d::Zero();
};

/// Model of a ring with two opposite loads of size 1.
Model pressed(Model model, int segments, double load) {
  for (const double angle : {load, load + kPi}) {
    const double arcs = angle * segments / (2.0 * kPi);
    const int arc = static_cast<int>(std::floor(arcs + 1e-9)) % segments;
    const double fraction = std::max(0.0, arcs - std::floor(arcs + 1e-9));
    const Location place =
        fraction < 1e-9 ? at_node(std::to_string(arc)) : at_member("arc " + std::to_string(arc), fraction);
    const Vector e = at_angle(angle);
    model.loads.push_back(force_at(place, -e.x, -e.y));
    const std::string id = angle == load ? "first" : "second";
    model.monitors.push_back({id + " x", place, Component::x});
    model.monitors.push_back({id + " y", place, Component::y});
  }
  return model;
}

/// Shortening of the diameter between the loads, by the monitors of a row.
double shortening_of(const Result& result, std::size_t row, double load) {
  const std::vector<NamedSeries>& m = result.static_table.value().monitors;
  return std::cos(load) * (m[2].values[row] - m[0].values[row]) +
         std::sin(load) * (m[3].values[row] - m[1].values[row]);
}

/// Compares a state with the cut ring under the same load, relative to the size of each kind.
void expect_state(const CutRing& expected, const State& state, int segments, double tolerance) {
  const auto count = static_cast<std::size_t>(segments);
  const double P = state.load_factor;
  for (std::size_t i = 0; i < count; ++i) {
    const MemberState& arc = state.members[i];
    const MemberState& before = state.members[(i + count - 1) % count];
    const double angle = expected.joint_angle(static_cast<int>(i));
    EXPECT_NEAR(arc.bending_moment.front(), expected.moment(angle), tolerance * P) << i;
    EXPECT_NEAR(before.bending_moment.back(), expected.moment(angle), tolerance * P) << i;
    const double rotation = expected.joint_rotation(static_cast<int>(i));
    EXPECT_NEAR(arc.rotation.front() - before.rotation.back(), rotation, tolerance * P) << i;
    const Vector moved = expected.displacement(angle);
    EXPECT_NEAR(arc.u.front(), moved.x, tolerance * P) << i;
    EXPECT_NEAR(arc.v.front(), moved.y, tolerance * P) << i;
    EXPECT_NEAR(arc.bending_moment[50], expected.moment(angle + kPi / segments), tolerance * P) << i;
  }
}

CutRing::Joint linear_joint(double stiffness) {
  return [stiffness](double moment) { return std::array{moment / stiffness, 1.0 / stiffness}; };
}

struct Placed {
  int segments;
  double load;  ///< angle of the first load, below pi
};

/// Loads at a joint, at the middle of a segment, and elsewhere; rings with and without symmetry.
const Placed kPlaced[] = {{4, 0.25 * kPi}, {4, 0.5 * kPi}, {6, kPi / 6.0}, {7, 2.0 * kPi / 7.0},
                          {5, 1.1},        {8, 0.7},       {3, kPi / 3.0}};

/// An even number of segments, loaded at joints or at middles of segments, is symmetric about two axes. With
/// s = |sin| of the angle from the load, M = A - P s / 2 and N = -P s / 2. int M + sum M / c = 0 gives A, and
/// the energy's derivative by P the shortening of the diameter.
double symmetric_shortening(int segments, double EA, double c, double load) {
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < segments; ++i) {
    const double s = std::abs(std::sin(2.0 * kPi * i / segments - load));
    sum += s;
    squares += s * s;
  }
  const double A = (2.0 + sum / (2.0 * c)) / (2.0 * kPi + segments / c);
  const double of_arcs = 4.0 * A - 0.5 * kPi;
  const double of_joints = (A * sum - 0.5 * squares) / c;
  return -0.5 * (of_arcs + of_joints) + kPi / (4.0 * EA);
}

/// The cut ring has the closed forms: (pi / 4 - 2 / pi) P R^3 / EI without joints, and those of symmetric
/// rings.
TEST(SegmentedRing, ClosedFormsOfOvalisation) {
  EXPECT_NEAR(symmetric_shortening(4, 1e300, 1e300, 0.0), 0.25 * kPi - 2.0 / kPi, 1e-15);
  for (const auto& [segments, load] : {kPlaced[0], kPlaced[1], kPlaced[2]})
    for (const double EA : {50.0, kStiff}) {
      CutRing cut(segments, EA, load, linear_joint(3.0));
      cut.press(1.0);
      EXPECT_NEAR(cut.shortening(), symmetric_shortening(segments, EA, 3.0, load), 1e-13);
    }
}

TEST(SegmentedRing, OvalisesUnderTwoOppositeLoads) {
  for (const auto& [segments, load] : kPlaced)
    for (const double EA : {50.0, 1e12})
      for (const double c : {0.2, 3.0, 1e3}) {
        SCOPED_TRACE(std::to_string(segments) + " segments, EA " + std::to_string(EA) + ", c " +
                     std::to_string(c));
        const Model model = pressed(ring(segments, EA, with_stiffness(c)), segments, load);
        const Result result = solve_soundly(model, static_on(fixed_mesh(6, 7), Geometry::linear, {0.01}));
        ASSERT_EQ(result.states.size(), 1U);
        CutRing cut(segments, EA, load, linear_joint(c));
        cut.press(0.01);
        expect_relative(shortening_of(result, 0, load), cut.shortening(), 1e-9, "shortening");
        expect_state(cut, result.states[0], segments, 1e-9);
      }
}

/// Joint that yields, and its rotation by the moment.
struct YieldingJoint {
  ReactionLaw law;
  CutRing::Joint rotation;
};

YieldingJoint tanh_joint(double k, double C) {
  YieldingJoint out;
  out.law.type = Type::tanh;
  out.law.stiffness = k;
  out.law.capacity = C;
  out.rotation = [k, C](double m) {
    return std::array{C / k * std::atanh(m / C), 1.0 / (k * (1.0 - m * m / (C * C)))};
  };
  return out;
}

YieldingJoint hyperbolic_joint(double k, double C) {
  YieldingJoint out;
  out.law.type = Type::hyperbolic;
  out.law.stiffness = k;
  out.law.capacity = C;
  out.rotation = [k, C](double m) {
    const double rest = 1.0 - std::abs(m) / C;
    return std::array{m / (k * rest), 1.0 / (k * rest * rest)};
  };
  return out;
}

/// Straight lines of slopes 4, 1 and 0.2 with bends at the rotations 0.02 and 0.1.
YieldingJoint joint_of_lines() {
  YieldingJoint out;
  out.law.type = Type::table;
  out.law.interpolation = ReactionLaw::Interpolation::linear;
  out.law.points = {{0.02, 0.08}, {0.1, 0.16}, {10.0, 2.14}};
  out.rotation = [](double m) {
    const double size = std::abs(m);
    if (size < 0.08) return std::array{m / 4.0, 0.25};
    if (size < 0.16) return std::array{std::copysign(0.02 + (size - 0.08), m), 1.0};
    return std::array{std::copysign(0.1 + (size - 0.16) / 0.2, m), 5.0};
  };
  return out;
}

/// Loads up to 0.9 of the limit load 4 C / R of four segments with tanh joints that are loaded at joints.
TEST(SegmentedRing, OvalisesWithJointsThatYield) {
  const std::vector<double> loads{0.2, 0.6, 0.9};
  for (const YieldingJoint& joint : {tanh_joint(4.0, 0.25), hyperbolic_joint(4.0, 0.3), joint_of_lines()})
    for (const auto& [segments, load] : kPlaced) {
      SCOPED_TRACE(std::to_string(segments) + " segments, law " +
                   std::to_string(static_cast<int>(joint.law.type)));
      const Model model = pressed(ring(segments, 500.0, with_law(joint.law)), segments, load);
      const Result result = solve_soundly(model, static_on(fixed_mesh(6, 7), Geometry::linear, loads));
      ASSERT_EQ(result.states.size(), loads.size());
      for (std::size_t row = 0; row < loads.size(); ++row) {
        CutRing cut(segments, 500.0, load, joint.rotation);
        cut.press(loads[row]);
        expect_relative(shortening_of(result, row, load), cut.shortening(), 1e-8, "shortening");
        expect_state(cut, result.states[row], segments, 1e-8);
      }
    }
}

/// Four segments that are loaded at joints: M at the loads and beside them differ by P R / 2, so that with
/// the capacity C of all four joints no load above 4 C / R has an equilibrium with small displacements.
TEST(SegmentedRing, HasALimitLoadByItsJoints) {
  constexpr double C = 0.25;
  const Model model = pressed(ring(4, 500.0, with_law(tanh_joint(4.0, C).law)), 4, 0.5 * kPi);
  const auto solve_at = [&](double load) {
    return solve(model, static_on(fixed_mesh(6, 7), Geometry::linear, {load}));
  };
  EXPECT_FALSE(solve_at(0.99 * 4.0 * C).failure);
  const Result beyond = solve_at(1.01 * 4.0 * C);
  ASSERT_TRUE(beyond.failure);
  EXPECT_EQ(beyond.failure->code, "no_convergence");
}

// ---------------------------------------------------------------------------------------------------------
// Buckling under hydrostatic pressure

/// Buckling of a ring (R = EI = 1) of n segments with joints of stiffness c under the pressure q per deformed
/// length. The compressed circle has the stretch e = 1 - q / (EA + q) and the axial force -q e. With small
/// changes n, v of axial and shear force and m of the moment, along the undeformed axis:
///   n' = v,  v' = -n + q e m - q n / EA,  m' = -e v,
/// and at a joint v grows by q e m / c, since the tangent turns by m / c. n + m / e is constant. A mode whose
/// segments differ by the factor exp(i j a), a = 2 pi / n, has the constant 0 unless j = 0; then m'' = -k^2 m
/// with k^2 = 1 + q e^2 + q / EA, and a segment with its joint has a matrix of the determinant 1 and the
/// trace 2 cos(j a) = 2 cos(k a) - q e^2 / (c k) sin(k a). Translations (j = 1) have q = 0. The turned
/// pressure and forces are one vector that does not change along the ring, so that the displacements close by
/// themselves.
class PressedRing {
 public:
  PressedRing(int segments, double EA, double c) : a_(2.0 * kPi / segments), EA_(EA), c_(c) {
    for (int j = 1; 2 * j < segments; ++j)
      conditions_.emplace_back([this, j](double q) { return of_wave(j, q); });
    conditions_.emplace_back([this](double q) { return of_equal_segments(q); });
    conditions_.emplace_back([this](double q) { return std::sin(0.5 * wave_number(q) * a_); });
    if (segments % 2 == 0) {
      conditions_.emplace_back([this](double q) { return of_opposite_segments(q); });
      conditions_.emplace_back([this](double q) { return std::cos(0.5 * wave_number(q) * a_); });
    }
  }
  PressedRing(const PressedRing&) = delete;
  PressedRing& operator=(const PressedRing&) = delete;

  /// Least pressure above zero that meets a condition, by a grid and by halving.
  [[nodiscard]] double least() const {
    double out = 1e9;
    for (const auto& condition : conditions_)
      for (double q = 1e-9; q < std::min(out, 80.0); q *= 1.002)
        if ((condition(q) > 0.0) != (condition(1.002 * q) > 0.0))
          out = std::min(out, root(condition, q, 1.002 * q));
    return out;
  }

 private:
  static double root(const std::function<double(double)>& f, double lo, double hi) {
    const bool rises = f(hi) > 0.0;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (lo + hi);
      (((f(middle) > 0.0) == rises) ? hi : lo) = middle;
    }
    return 0.5 * (lo + hi);
  }
  [[nodiscard]] double stretch(double q) const { return 1.0 - q / (EA_ + q); }
  [[nodiscard]] double wave_number(double q) const {
    return std::sqrt(1.0 + q * stretch(q) * stretch(q) + q / EA_);
  }
  [[nodiscard]] double of_wave(int j, double q) const {
    const double k = wave_number(q);
    const double e = stretch(q);
    return std::cos(k * a_) - q * e * e / (2.0 * c_ * k) * std::sin(k * a_) - std::cos(j * a_);
  }
  /// 2 j = n: the condition is a product with the factor cos(k a / 2), whose modes leave joints without
  /// moment.
  [[nodiscard]] double of_opposite_segments(double q) const {
    const double k = wave_number(q);
    const double e = stretch(q);
    return std::cos(0.5 * k * a_) - q * e * e / (2.0 * c_ * k) * std::sin(0.5 * k * a_);
  }
  /// j = 0, where segments are symmetric about their middles (else sin(k a / 2) = 0, without moments in the
  /// joints): m = D + A cos k (x - a / 2). Its shear force jumps at the joints, and the segments do not turn
  /// altogether: int m + m(0) / c = 0.
  [[nodiscard]] double of_equal_segments(double q) const {
    const double k = wave_number(q);
    const double e = stretch(q);
    const double s = std::sin(0.5 * k * a_);
    const double co = std::cos(0.5 * k * a_);
    // coefficients of D and A in both conditions
    const double jump_D = q * e / c_;
    const double jump_A = q * e / c_ * co + 2.0 * k / e * s;
    const double turn_D = a_ + 1.0 / c_;
    const double turn_A = 2.0 * s / k + co / c_;
    return jump_D * turn_A - jump_A * turn_D;
  }

  double a_, EA_, c_;
  std::vector<std::function<double(double)>> conditions_;
};

/// Least pressure of a ring with another EI.
double least_pressure(int segments, double EA, double c, double EI) {
  return EI * PressedRing(segments, EA / EI, c / EI).least();
}

Model under_pressure(Model model) {
  for (const Member& member : model.members)
    model.loads.push_back(PressureLoad{member.id, 1.0, Side::right, Pattern::proportional});
  return model;
}

/// @param is_told whether the type of the critical point must be right
double buckling_pressure(const Model& model, const Discretization& mesh = fixed_mesh(4, 7),
                         bool is_told = true) {
  const Result result = solve_soundly(model, analysis_of(AnalysisType::critical, mesh));
  if (is_told) {
    EXPECT_EQ(result.summary.critical_type, CriticalType::bifurcation);
  }
  return result.summary.critical_load_factor.value_or(std::nan(""));
}

/// Rigid joints give Levy's 3 EI / R^3, hinges of three segments the pressure at which one hinged arc of 120
/// degrees buckles, (pi^2 / (pi / 3)^2 / 4 - 1) = 1.25.
TEST(SegmentedRing, ClosedFormsOfItsBucklingPressure) {
  for (const int segments : {2, 3, 4, 5, 8}) {
    EXPECT_NEAR(PressedRing(segments, 1e30, 1e12).least(), 3.0, 1e-9) << segments;
  }
  EXPECT_NEAR(PressedRing(3, 1e30, 1e-9).least(), 1.25, 1e-7);
}

TEST(SegmentedRing, BucklesUnderHydrostaticPressure) {
  for (const int segments : {2, 3, 4, 5, 6, 8})
    for (const double EA : {50.0, 1.2e5, kStiff})
      for (const double c : {0.2, 2.0, 30.0}) {
        const double expected = PressedRing(segments, EA, c).least();
        const std::string what =
            std::to_string(segments) + " segments, EA " + std::to_string(EA) + ", c " + std::to_string(c);
        const Model model = under_pressure(ring(segments, EA, with_stiffness(c)));
        expect_relative(buckling_pressure(model), expected, 1e-8, what);
      }
}

/// Linearised buckling leaves the compression of the circle out: it has the pressure of the inextensible
/// ring.
TEST(SegmentedRing, LinearisedBucklingIsThatOfAnInextensibleRing) {
  for (const int segments : {2, 3, 4, 5, 8})
    for (const double c : {0.2, 2.0, 30.0}) {
      const Model model = under_pressure(ring(segments, kStiff, with_stiffness(c)));
      const Result result = solve_soundly(model, buckling_on(fixed_mesh(8, 7)));
      expect_relative(result.summary.critical_load_factor.value_or(0.0),
                      PressedRing(segments, 1e30, c).least(), 1e-8, std::to_string(segments));
    }
}

/// No joint carries a moment before the ring buckles, so that the first slope of a law counts.
TEST(SegmentedRing, BucklesAtTheFirstSlopeOfItsJoints) {
  for (const int segments : {3, 6})
    for (const YieldingJoint& joint : {tanh_joint(4.0, 0.16), hyperbolic_joint(4.0, 0.3), joint_of_lines()}) {
      const Model model = under_pressure(ring(segments, 1.2e5, with_law(joint.law)));
      expect_relative(buckling_pressure(model), PressedRing(segments, 1.2e5, 4.0).least(), 1e-8,
                      std::to_string(segments));
    }
}

/// A ring whose segments have another EI, at its exact buckling pressure and near 2 c (cos a - cos 2 a) /
/// (R^2 sin a), that of segments that do not bend, where only joints turn.
void expect_buckling_by_joints(int segments, double EI) {
  constexpr double c = 1.5;
  const double a = 2.0 * kPi / segments;
  const double limit = 2.0 * c * (std::cos(a) - std::cos(2.0 * a)) / std::sin(a);
  const double expected = least_pressure(segments, 100.0 * EI, c, EI);
  EXPECT_NEAR(expected, limit, limit * c / EI);
  const Model model = under_pressure(ring(segments, 100.0 * EI, with_stiffness(c), EI));
  // the sum of EA and c in a pivot keeps c to a relative 1e-16 EA / c
  const double tolerance = std::max(1e-8, 1e-15 * 100.0 * EI / c);
  // rounding of EI / c near 1e6 may turn the load at a double bifurcation
  expect_relative(buckling_pressure(model, fixed_mesh(4, 7), EI < 1e6), expected, tolerance,
                  std::to_string(segments) + " segments, EI " + std::to_string(EI));
}

TEST(SegmentedRing, BucklesByItsJointsWhereSegmentsAreStiff) {
  for (const int segments : {4, 5, 6, 9})
    for (const double EI : {1e2, 1e4}) expect_buckling_by_joints(segments, EI);
}

TEST(SegmentedRing, BucklesByItsJointsWhereSegmentsAreNearlyRigid) {
  for (const int segments : {4, 5, 6, 9}) expect_buckling_by_joints(segments, 1e6);
}

/// The ring of eight segments has two modes at its buckling pressure, by symmetry: a bifurcation on any mesh.
TEST(SegmentedRing, HasABifurcationOnAFinerMesh) {
  const Model model = under_pressure(ring(8, 1.2e5, with_stiffness(2.0)));
  expect_relative(buckling_pressure(model, fixed_mesh(8, 7)), PressedRing(8, 1.2e5, 2.0).least(), 1e-8,
                  "pressure");
}

}  // namespace
}  // namespace snapthrough
