/// Flutter under loads that follow the structure.
///
/// Sources: Ziegler (1952) and Herrmann and Jong (1965), double pendulum; Beck (1952); Leipholz (1962); a
/// column under a partly following load diverges where (1 - eta) cos k = -eta, P = k^2 EI / L^2; chains of
/// rigid links, whose linear equations are exact in the straight state, by dense eigenvalues.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

PointLoad following(Location at, double fx, double fy) {
  PointLoad load = force_at(std::move(at), fx, fy);
  load.follows = true;
  return load;
}

Model cantilever(double EA) {
  Model model = straight(1.0, 1.0, EA, "xyr", "");
  model.sections[0].mass = 1.0;
  return model;
}

Analysis critical(double accuracy) {
  Analysis analysis;
  analysis.type = AnalysisType::critical;
  analysis.discretization.accuracy = accuracy;
  return analysis;
}

/// The load factor of a loss of stability of a type.
double load_of(const Model& model, CriticalType type, double accuracy) {
  const Result result = solve(model, critical(accuracy));
  EXPECT_FALSE(result.failure) << result.failure->detail;
  EXPECT_EQ(result.summary.critical_type, type);
  EXPECT_LE(result.summary.error_estimate.value_or(1.0), accuracy);
  return result.summary.critical_load_factor.value_or(0.0);
}

/// P = 20.0509536 EI / L^2 (by a Galerkin series of 14 polynomials); extension adds 2 P / EA to it.
TEST(Flutter, OfBecksColumn) {
  constexpr double kExact = 20.05095363;
  Model model = cantilever(1e10);
  model.loads = {following(at_node("b"), -1.0, 0.0)};
  EXPECT_NEAR(load_of(model, CriticalType::flutter, 1e-6) / kExact, 1.0, 1e-7);
  // a Winkler base raises all frequencies alike and does not change the load (Smith and Herrmann, 1972)
  model.foundations = {winkler("m", 50.0)};
  EXPECT_NEAR(load_of(model, CriticalType::flutter, 1e-6) / kExact, 1.0, 1e-7);
  // omega = 11.0156 where both frequencies meet
  model.foundations.clear();
  Analysis at;
  at.type = AnalysisType::vibration;
  at.modes = 2;
  at.load_factors = {0.999999 * kExact, 1.01 * kExact};
  const Result result = solve(model, at);
  ASSERT_EQ(result.vibrations->size(), 2U);
  EXPECT_NEAR(std::sqrt(0.5 * (result.vibrations->at(0).frequencies.squares[0] +
                               result.vibrations->at(0).frequencies.squares[1])),
              11.0156, 5e-5);  // its digits
  const std::vector<double>& imaginary = result.vibrations->at(1).frequencies.imaginary;
  ASSERT_EQ(imaginary.size(), 2U);
  EXPECT_GT(std::abs(imaginary[0]), 1.0);
  EXPECT_NEAR(imaginary[0], -imaginary[1], 1e-9 * std::abs(imaginary[0]));
}

/// Forces along the column as n following ones: Leipholz' uniform load, 40.0537365.
TEST(Flutter, OfLeipholzColumn) {
  constexpr int kForces = 40;
  Model model = cantilever(1e9);
  for (int i = 0; i < kForces; ++i)
    model.loads.emplace_back(following(at_member("m", (i + 0.5) / kForces), -1.0 / kForces, 0.0));
  Analysis analysis = critical(1e-3);
  analysis.discretization = fixed_mesh(kForces, 2);
  const Result result = solve(model, analysis);
  EXPECT_EQ(result.summary.critical_type, CriticalType::flutter);
  EXPECT_NEAR(result.summary.critical_load_factor.value_or(0.0) / 40.0537365, 1.0, 1e-5);
}

TEST(Flutter, OfPartlyFollowingLoadsGivesWayToDivergence) {
  for (const double eta : {0.2, 0.35, 0.45, 0.49}) {
    Model model = cantilever(1e10);
    model.loads = {following(at_node("b"), -eta, 0.0), force_at(at_node("b"), -(1.0 - eta), 0.0)};
    const double k = std::acos(-eta / (1.0 - eta));
    EXPECT_NEAR(load_of(model, CriticalType::bifurcation, 1e-6) / (k * k), 1.0, 1e-8) << eta;
  }
  for (const double eta : {0.51, 0.6, 0.9}) {
    Model model = cantilever(1e10);
    model.loads = {following(at_node("b"), -eta, 0.0), force_at(at_node("b"), -(1.0 - eta), 0.0)};
    EXPECT_GT(load_of(model, CriticalType::flutter, 1e-6), 16.0) << eta;
  }
}

PointLoad on_fixed_line(Location at, double fx, double fy) {
  PointLoad load = force_at(std::move(at), fx, fy);
  load.fixed_line = true;
  return load;
}

/// The adjoint of Beck's column: the same load.
TEST(Flutter, OfReutsColumn) {
  Model model = cantilever(1e10);
  for (const Location& at : {at_node("b"), at_member("m", 1.0)}) {
    model.loads = {on_fixed_line(at, -1.0, 0.0)};
    EXPECT_NEAR(load_of(model, CriticalType::flutter, 1e-6) / 20.05095363, 1.0, 1e-7);
  }
}

/// A force on a fixed line is a dead force with its moment about the displaced place.
TEST(Flutter, ForcesOnAFixedLineHaveTheirMoment) {
  for (const double place : {0.6, 1.0}) {
    Model model = cantilever(100.0);
    model.loads = {on_fixed_line(at_member("m", place), -1.5, 6.0)};
    Analysis analysis;
    analysis.type = AnalysisType::static_;
    analysis.load_factors = {1.0};
    analysis.discretization = fixed_mesh(10, 5);
    const auto moved_by = [&](const Result& result) {
      const MemberState& member = result.states.at(0).members.at(0);
      for (std::size_t i = 0; i < member.s.size(); ++i)
        if (std::abs(member.s[i] - place) < 1e-12)
          return std::array{member.x[i] - member.x0[i], member.y[i] - member.y0[i], member.bending_moment[0]};
      ADD_FAILURE() << "no such place";
      return std::array{0.0, 0.0, 0.0};
    };
    const auto line = moved_by(solve(model, analysis));
    ASSERT_GT(std::hypot(line[0], line[1]), 0.3);
    PointLoad dead = force_at(at_member("m", place), -1.5, 6.0);
    dead.moment = line[1] * -1.5 - line[0] * 6.0;
    model.loads = {dead};
    const auto same = moved_by(solve(model, analysis));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(same[c], line[c], 1e-8) << place;
  }
}

/// A half ring, clamped at one end, under a pressure on its outside or inside that follows it.
///
/// Source: tests/verification/data/half_ring_flutter.py (Chebyshev collocation of the geometrically exact
/// arch), radius and stiffness 1, EA = 1e5; 6e-8 between two numbers of places.
TEST(Flutter, OfHalfARingUnderPressure) {
  for (const auto& [side, load] :
       {std::pair{Side::left, 0.9808309956}, std::pair{Side::right, 1.370039452}}) {
    Model model = straight(2.0, 1.0, 1e5, "xyr", "");
    model.members[0].curve = ArcCurve{-180.0};
    model.sections[0].mass = 1.0;
    model.loads = {PressureLoad{"m", 1.0, side}};
    EXPECT_NEAR(load_of(model, CriticalType::flutter, 1e-7) / load, 1.0, 1e-7 + 6e-8);
  }
}

/// Links with a spring at the lower end and a mass at the upper end of each, the last force following.
struct Chain {
  std::vector<double> length, spring, mass, base, force, share;
};

Model model_of(const Chain& chain) {
  Model model;
  model.nodes = {{"n0", 0.0, 0.0}};
  model.sections = {{"s", 1e7, 1e7, {}}};
  model.supports = {support("n0", "xyr")};
  for (std::size_t i = 0; i < chain.length.size(); ++i) {
    const std::string upper = "n" + std::to_string(i + 1);
    model.nodes.push_back({upper, model.nodes.back().x + chain.length[i], 0.0});
    Member link{"m" + std::to_string(i), model.nodes[i].id, upper, "s", LineCurve{}, true, false};
    link.release_start_stiffness = chain.spring[i];
    model.members.push_back(link);
    model.masses.push_back({at_node(upper), chain.mass[i], 0.0});
    if (chain.base[i] > 0.0) {
      Spring side{"c" + std::to_string(i), at_node(upper), std::array{0.0, 1.0}};
      side.stiffness = chain.base[i];
      model.springs.push_back(side);
    }
    if (chain.force[i] == 0.0) continue;
    model.loads.emplace_back(following(at_node(upper), -chain.force[i] * chain.share[i], 0.0));
    model.loads.emplace_back(force_at(at_node(upper), -chain.force[i] * (1.0 - chain.share[i]), 0.0));
  }
  return model;
}

/// M q'' + (K + P G) q = 0 in the angles q of the links.
class Links {
 public:
  explicit Links(const Chain& chain) {
    const auto n = static_cast<Eigen::Index>(chain.length.size());
    const auto diagonal = [n](const std::vector<double>& list) {
      return MatrixXd(Eigen::Map<const VectorXd>(list.data(), n).asDiagonal());
    };
    sides_ = MatrixXd::Zero(n, n);
    MatrixXd turns = MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) sides_(i, j) = chain.length[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 1; i < n; ++i) turns(i, i - 1) = -1.0;
    M_ = sides_.transpose() * diagonal(chain.mass) * sides_;
    K_ = turns.transpose() * diagonal(chain.spring) * turns +
         sides_.transpose() * diagonal(chain.base) * sides_;
    G_ = MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) {
        const double p = chain.force[static_cast<std::size_t>(i)] * chain.length[static_cast<std::size_t>(j)];
        G_(j, j) -= p;
        G_(j, i) += p * chain.share[static_cast<std::size_t>(i)];
      }
  }
  enum class State { stable, diverges, flutters };
  [[nodiscard]] State at(double load) const {
    const Eigen::VectorXcd squares = M_.partialPivLu().solve(K_ + load * G_).eigenvalues();
    State out = State::stable;
    for (const auto& square : squares) {
      if (std::abs(square.imag()) > 1e-7 * std::abs(square)) return State::flutters;
      if (square.real() < 0.0) out = State::diverges;
    }
    return out;
  }

  /// Displacements across of the growing vibration's eigenvalue, that with Im > 0, at a load with one pair.
  [[nodiscard]] Eigen::VectorXcd motion(double load) const {
    const Eigen::EigenSolver<MatrixXd> solver(M_.partialPivLu().solve(K_ + load * G_));
    Eigen::Index which = 0;
    solver.eigenvalues().imag().maxCoeff(&which);
    return sides_ * solver.eigenvectors().col(which);
  }

 private:
  MatrixXd M_, K_, G_;
  MatrixXd sides_;  ///< displacements across by angles
};

Chain random_chain(std::mt19937& random) {
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const auto sometimes = [&](double lo, double hi, double otherwise) {
    return uniform(0.0, 1.0) < 0.3 ? uniform(lo, hi) : otherwise;
  };
  Chain out;
  const int n = 2 + static_cast<int>(random() % 4);
  for (int i = 0; i < n; ++i) {
    out.length.push_back(uniform(0.5, 1.5));
    out.spring.push_back(uniform(0.3, 3.0));
    out.mass.push_back(uniform(0.2, 3.0));
    out.base.push_back(sometimes(0.0, 2.0, 0.0));
    out.force.push_back(i + 1 < n ? sometimes(0.1, 1.0, 0.0) : 1.0);
    out.share.push_back(sometimes(0.2, 1.2, 1.0));
  }
  return out;
}

/// No chain has flutter or divergence that is missed, or told at another load.
TEST(Flutter, OfRandomChainsIsThatOfDenseEigenvalues) {
  constexpr double kMost = 60.0;
  constexpr int kLoads = 3000;
  std::mt19937 random(20261126U);
  int flutters = 0;
  for (int model = 0; model < 100; ++model) {
    const Chain chain = random_chain(random);
    const Links links(chain);
    const double hi = first_unstable_load([&](double load) { return links.at(load) == Links::State::stable; },
                                          kMost, kLoads, 1e-9);
    ASSERT_GT(hi, 0.0) << model;
    const bool is_flutter = links.at(hi) == Links::State::flutters;
    Analysis analysis = critical(1e-3);
    analysis.discretization = fixed_mesh(1, 3);
    const Result result = solve(model_of(chain), analysis);
    EXPECT_EQ(result.summary.critical_type, is_flutter ? CriticalType::flutter : CriticalType::bifurcation)
        << model << " " << hi;
    // links are rigid to 1e-6
    EXPECT_NEAR(result.summary.critical_load_factor.value_or(0.0) / hi, 1.0, 1e-5) << model;
    flutters += is_flutter ? 1 : 0;
  }
  EXPECT_GT(flutters, 30);
}

Chain zieglers_pendulum() { return {{1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}, {0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}; }

/// Both parts of a motion that flutters have one scale and one phase.
TEST(Flutter, MotionsHaveTwoParts) {
  Analysis at;
  at.type = AnalysisType::vibration;
  at.modes = 2;
  at.load_factors = {3.0};
  at.discretization = fixed_mesh(1, 3);
  const Result result = solve(model_of(zieglers_pendulum()), at);
  const Vibration& vibration = result.vibrations->at(0);
  ASSERT_LT(vibration.frequencies.imaginary.at(0), 0.0);
  ASSERT_GT(vibration.frequencies.imaginary.at(1), 0.0);
  const auto across = [&](std::size_t member) {
    return std::complex(vibration.modes.at(0).members.at(member).v.back(),
                        vibration.modes.at(1).members.at(member).v.back());
  };
  const Eigen::VectorXcd exact = Links(zieglers_pendulum()).motion(3.0);
  ASSERT_GT(std::abs(std::imag(exact[1] / exact[0])), 0.1);
  EXPECT_LT(std::abs(across(1) / across(0) - exact[1] / exact[0]), 1e-5);
  double largest = 0.0;
  for (const Mode& part : vibration.modes)
    for (const MemberMode& member : part.members) largest = std::max(largest, std::abs(member.v.back()));
  EXPECT_NEAR(largest, 1.0, 1e-9);
}

/// P = (7/2 - sqrt 2) c / l without damping, 41/28 + b^2 / 2 with dampers b at both joints, however small.
TEST(Flutter, OfZieglersPendulumIsLowerWithSmallDamping) {
  Model model = model_of(zieglers_pendulum());
  EXPECT_NEAR(load_of(model, CriticalType::flutter, 1e-6), 3.5 - std::sqrt(2.0), 1e-6);
  for (const double damper : {0.1, 0.01, 0.001}) {
    model.damping.stiffness = damper;
    EXPECT_NEAR(load_of(model, CriticalType::flutter, 1e-6), 41.0 / 28.0 + 0.5 * damper * damper, 1e-6);
  }
}

/// The path goes on beyond flutter, and through what follows it, to the load that was asked for.
TEST(Flutter, DoesNotEndAPath) {
  std::mt19937 random(7U);
  for (int model = 0; model < 40; ++model) {
    Analysis analysis;
    analysis.type = AnalysisType::path;
    analysis.discretization = fixed_mesh(1, 3);
    analysis.stop.load_factor = {{0.0, 60.0}};
    const Result result = solve(model_of(random_chain(random)), analysis);
    EXPECT_FALSE(result.failure) << model << ": " << result.failure->detail;
    EXPECT_EQ(result.summary.termination, "load_factor") << model;
  }
}

/// Without masses only divergence is tested, and the result says so.
TEST(Flutter, IsNotTestedWithoutMasses) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "");
  model.loads = {following(at_node("b"), -1.0, 0.0)};
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.stop.load_factor = {{0.0, 30.0}};
  const Result result = solve(model, analysis);
  EXPECT_FALSE(result.summary.critical_load_factor);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].code, "flutter_not_tested");
}

/// A following force keeps its angle to the section: forces, moments and reactions balance in a large
/// displacement, and the end moment is that of the turned force.
TEST(FollowingForce, TurnsWithItsSection) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "");
  model.loads = {following(at_member("m", 0.75), 0.0, 4.0)};
  Analysis analysis = static_on(fixed_mesh(8, 4), Geometry::nonlinear, {1.0});
  const Result result = solve(model, analysis);
  ASSERT_FALSE(result.failure);
  const State& state = result.states.at(0);
  const MemberState& m = state.members[0];
  const std::size_t at = 3 * (m.s.size() - 1) / 4;
  const double angle = m.rotation[at];
  EXPECT_GT(angle, 0.5);
  EXPECT_NEAR(state.loads.fx, -4.0 * std::sin(angle), 1e-9);
  EXPECT_NEAR(state.loads.fy, 4.0 * std::cos(angle), 1e-9);
  EXPECT_NEAR(state.supports[0].fx, -state.loads.fx, 1e-9);
  EXPECT_NEAR(state.supports[0].fy, -state.loads.fy, 1e-9);
  EXPECT_NEAR(m.bending_moment[0], m.x[at] * state.loads.fy - m.y[at] * state.loads.fx, 1e-8);
}

}  // namespace
}  // namespace snapthrough
