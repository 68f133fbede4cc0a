/// Flutter and divergence of elastic columns, against finite elements that share no code with the solver.
///
/// In the straight state of a slender column the axial force follows from the loads alone, so that the linear
/// equations of small vibrations are exact. Cubic elements for the deflection w give K + P G and M; Eigen's
/// dense solver gives the eigenvalues at each load P of a fine grid.
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector4d;

constexpr int kElements = 16;

/// Compressive force at a node of the elements; a share of the force turns with the section.
struct Push {
  int node = 0;
  double force = 0.0;
  double share = 0.0;
};

/// A column of length one on a Winkler base; values at its start and its end, linear between.
struct Column {
  std::array<double, 2> EI{1.0, 1.0};
  std::array<double, 2> mass{1.0, 1.0};
  double base = 0.0;
  std::array<double, 2> side{0.0, 0.0};  ///< springs across; infinite: held
  std::array<double, 2> turn{0.0, 0.0};  ///< springs in rotation; infinite: held
  double tip_mass = 0.0;
  std::array<Push, 2> pushes{};
};

double along(const std::array<double, 2>& ends, double x) { return ends[0] + (ends[1] - ends[0]) * x; }

/// M q'' + (K + P G) q = 0 in deflections and slopes of the nodes.
class Beam {
 public:
  explicit Beam(const Column& column)
      : M_(MatrixXd::Zero(kSize, kSize)), K_(MatrixXd::Zero(kSize, kSize)), G_(MatrixXd::Zero(kSize, kSize)) {
    for (int e = 0; e < kElements; ++e) add_element(column, e);
    M_(kSize - 2, kSize - 2) += column.tip_mass;
    std::vector<Index> free;
    const auto hold = [&](Index unknown, double stiffness) {
      if (std::isfinite(stiffness)) K_(unknown, unknown) += stiffness;
      return !std::isfinite(stiffness);
    };
    for (Index i = 0; i < kSize; ++i) {
      const bool end = i >= kSize - 2;
      const bool at_end = i < 2 || end;
      if (at_end && hold(i, (i % 2 == 0 ? column.side : column.turn)[end ? 1 : 0])) continue;
      free.push_back(i);
    }
    for (const Push& push : column.pushes)
      G_(Index{2} * push.node, 2 * push.node + 1) += push.force * push.share;
    for (MatrixXd* matrix : {&M_, &K_, &G_}) *matrix = MatrixXd((*matrix)(free, free));
    const Eigen::LLT<MatrixXd> masses(M_);
    K_ = masses.solve(K_);
    G_ = masses.solve(G_);
  }
  enum class State { stable, diverges, flutters };
  [[nodiscard]] State at(double load) const {
    const Eigen::VectorXcd squares = (K_ + load * G_).eigenvalues();
    const double largest = squares.cwiseAbs().maxCoeff();
    State out = State::stable;
    for (const auto& square : squares) {
      // rounding of the highest eigenvalues
      if (std::abs(square.imag()) > 1e-5 * std::abs(square) + 1e-12 * largest) return State::flutters;
      if (square.real() < 0.0) out = State::diverges;
    }
    return out;
  }

 private:
  static constexpr Index kSize = 2 * (kElements + 1);

  void add_element(const Column& column, int e) {
    constexpr double h = 1.0 / kElements;
    // four points of Gauss: exact for a linear taper
    constexpr std::array<std::pair<double, double>, 4> kGauss{{{-0.8611363115940526, 0.3478548451374538},
                                                               {-0.3399810435848563, 0.6521451548625461},
                                                               {0.3399810435848563, 0.6521451548625461},
                                                               {0.8611363115940526, 0.3478548451374538}}};
    double compression = 0.0;
    for (const Push& push : column.pushes) compression += push.node > e ? push.force : 0.0;
    for (const auto& [at, weight] : kGauss) {
      const double t = 0.5 * (1.0 + at);
      const double x = (e + t) * h;
      const Vector4d w{1 - 3 * t * t + 2 * t * t * t, h * t * (1 - t) * (1 - t), t * t * (3 - 2 * t),
                       h * t * t * (t - 1)};
      const Vector4d slope =
          Vector4d{-6 * t * (1 - t), h * (1 - t) * (1 - 3 * t), 6 * t * (1 - t), h * t * (3 * t - 2)} / h;
      const Vector4d bend = Vector4d{12 * t - 6, h * (6 * t - 4), 6 - 12 * t, h * (6 * t - 2)} / (h * h);
      const double dx = 0.5 * weight * h;
      M_.block<4, 4>(2 * e, 2 * e) += dx * along(column.mass, x) * w * w.transpose();
      K_.block<4, 4>(2 * e, 2 * e) +=
          dx * (along(column.EI, x) * bend * bend.transpose() + column.base * w * w.transpose());
      G_.block<4, 4>(2 * e, 2 * e) -= dx * compression * slope * slope.transpose();
    }
  }

  MatrixXd M_, K_, G_;
};

Model model_of(const Column& column) {
  Model model = straight(1.0, 1.0, 1e9, "", "");
  model.sections[0].EI = AlongMember({{0.0, column.EI[0]}, {1.0, column.EI[1]}});
  model.sections[0].mass = AlongMember({{0.0, column.mass[0]}, {1.0, column.mass[1]}});
  if (column.base > 0.0) model.foundations = {winkler("m", column.base)};
  if (column.tip_mass > 0.0) model.masses.push_back({at_node("b"), column.tip_mass, 0.0});
  for (const std::size_t end : {0U, 1U}) {
    const std::string node = end == 0 ? "a" : "b";
    Support held = support(node, end == 0 ? "x" : "");
    held.y = std::isinf(column.side[end]);
    held.rotation = std::isinf(column.turn[end]);
    if (held.x || held.y || held.rotation) model.supports.push_back(held);
    Spring spring{"side " + node, at_node(node), std::array{0.0, 1.0}};
    spring.stiffness = column.side[end];
    if (!held.y && spring.stiffness > 0.0) model.springs.push_back(spring);
    spring = {"turn " + node, at_node(node), std::nullopt};
    spring.stiffness = column.turn[end];
    if (!held.rotation && spring.stiffness > 0.0) model.springs.push_back(spring);
  }
  for (const Push& push : column.pushes) {
    if (push.force == 0.0) continue;
    const Location at =
        push.node == kElements ? at_node("b") : at_member("m", static_cast<double>(push.node) / kElements);
    PointLoad load = force_at(at, -push.force * push.share, 0.0);
    load.follows = true;
    model.loads.emplace_back(load);
    model.loads.emplace_back(force_at(at, -push.force * (1.0 - push.share), 0.0));
  }
  return model;
}

Column random_column(std::mt19937& random) {
  constexpr double kHeld = std::numeric_limits<double>::infinity();
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const auto by_chance = [&](double share) { return uniform(0.0, 1.0) < share; };
  Column out;
  if (by_chance(0.5)) out.EI[1] = uniform(0.2, 1.0);
  if (by_chance(0.5)) out.mass[1] = uniform(0.2, 2.0);
  if (by_chance(0.4)) out.base = uniform(1.0, 300.0);
  if (by_chance(0.3)) out.tip_mass = uniform(0.1, 2.0);
  out.side[0] = kHeld;
  out.turn[0] = by_chance(0.7) ? kHeld : uniform(0.5, 20.0);
  const double end = uniform(0.0, 1.0);
  if (end > 0.6) out.side[1] = end > 0.9 ? kHeld : uniform(0.5, 100.0);
  if (by_chance(0.2)) out.turn[1] = uniform(0.5, 20.0);
  out.pushes[0] = {kElements, 1.0, by_chance(0.5) ? 1.0 : uniform(-0.3, 1.3)};
  if (by_chance(0.4))
    out.pushes[1] = {4 + 4 * static_cast<int>(random() % 3), uniform(0.2, 1.5), uniform(0.0, 1.2)};
  return out;
}

/// No column has flutter or divergence that is missed, or told at another load.
TEST(FlutterOfColumns, AtRandomIsThatOfFiniteElements) {
  constexpr int kModels = 200;
  constexpr double kMost = 300.0;
  constexpr int kLoads = 1500;
  std::mt19937 random(53U);
  std::array<int, 3> found{};
  for (int model = 0; model < kModels; ++model) {
    const Column column = random_column(random);
    const Beam beam(column);
    const double hi = first_unstable_load([&](double load) { return beam.at(load) == Beam::State::stable; },
                                          kMost, kLoads, 1e-7);
    const Beam::State state = hi > 0.0 ? beam.at(hi) : Beam::State::stable;
    ++found[static_cast<std::size_t>(state)];
    Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-4));
    analysis.stop.load_factor = {{0.0, kMost}};
    const Result result = solve(model_of(column), analysis);
    if (state == Beam::State::stable) {
      EXPECT_FALSE(result.summary.critical_load_factor) << model;
      continue;
    }
    EXPECT_EQ(result.summary.critical_type,
              state == Beam::State::flutters ? CriticalType::flutter : CriticalType::bifurcation)
        << model << " " << hi;
    EXPECT_NEAR(result.summary.critical_load_factor.value_or(0.0) / hi, 1.0, 3e-4) << model << " " << hi;
  }
  EXPECT_GT(found[1], kModels / 3);  // diverge
  EXPECT_GT(found[2], kModels / 3);  // flutter
}

}  // namespace
}  // namespace snapthrough
