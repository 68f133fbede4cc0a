/// Chains and nets of members that only pull, which are loose without load, against closed forms and against
/// an energy minimisation of their own.
#include <Eigen/Dense>
#include <array>
#include <random>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Ropes between nodes, of the axial stiffness EA, that have the lengths `unstressed` without force.
struct Net {
  std::vector<std::array<double, 2>> nodes;
  std::vector<bool> held;
  std::vector<std::array<int, 2>> ropes;
  std::vector<double> unstressed;
  std::vector<std::array<double, 2>> forces;  ///< at the nodes
  double EA = 1000.0;

  /// The net as a model.
  [[nodiscard]] Model model() const {
    Model out;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      out.nodes.push_back({std::to_string(i), nodes[i][0], nodes[i][1]});
      if (held[i]) out.supports.push_back(support(std::to_string(i), "xy"));
      if (forces[i] != std::array{0.0, 0.0})
        out.loads.push_back(force_at(at_node(std::to_string(i)), forces[i][0], forces[i][1]));
    }
    out.sections = {{"rope", EA, 1.0, {}}};
    for (std::size_t i = 0; i < ropes.size(); ++i) {
      Member rope{"rope " + std::to_string(i), std::to_string(ropes[i][0]), std::to_string(ropes[i][1]),
                  "rope", LineCurve{}};
      rope.reaction = Reaction::tension_only;
      rope.pretension.emplace();
      rope.pretension->unstressed_length = unstressed[i];
      out.members.push_back(rope);
    }
    return out;
  }

  /// Gradient and second derivative of the energy: ropes of the length l have the force EA (l / lu - 1) where
  /// that is a tension.
  void differentiate(const VectorXd& x, VectorXd& gradient, MatrixXd& hessian) const {
    const auto n = static_cast<Eigen::Index>(2 * nodes.size());
    gradient = VectorXd::Zero(n);
    hessian = MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (Eigen::Index c = 0; c < 2; ++c)
        gradient[2 * static_cast<Eigen::Index>(i) + c] -= forces[i][static_cast<std::size_t>(c)];
    for (std::size_t i = 0; i < ropes.size(); ++i) {
      const Eigen::Index a = 2 * ropes[i][0];
      const Eigen::Index b = 2 * ropes[i][1];
      const Eigen::Vector2d d = x.segment<2>(b) - x.segment<2>(a);
      const double l = d.norm();
      const double T = EA * (l / unstressed[i] - 1.0);
      if (!(T > 0.0)) continue;
      const Eigen::Vector2d e = d / l;
      const Eigen::Matrix2d k =
          EA / unstressed[i] * e * e.transpose() + T / l * (Eigen::Matrix2d::Identity() - e * e.transpose());
      gradient.segment<2>(b) += T * e;
      gradient.segment<2>(a) -= T * e;
      hessian.block<2, 2>(a, a) += k;
      hessian.block<2, 2>(b, b) += k;
      hessian.block<2, 2>(a, b) -= k;
      hessian.block<2, 2>(b, a) -= k;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!held[i]) continue;
      for (Eigen::Index c = 2 * static_cast<Eigen::Index>(i); c < 2 * static_cast<Eigen::Index>(i) + 2; ++c) {
        gradient[c] = 0.0;
        hessian.row(c).setZero();
        hessian.col(c).setZero();
        hessian(c, c) = 1.0;
      }
    }
  }

  [[nodiscard]] double energy(const VectorXd& x) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sum -= forces[i][0] * x[2 * static_cast<Eigen::Index>(i)] +
             forces[i][1] * x[2 * static_cast<Eigen::Index>(i) + 1];
    for (std::size_t i = 0; i < ropes.size(); ++i) {
      const double l = (x.segment<2>(2 * ropes[i][1]) - x.segment<2>(2 * ropes[i][0])).norm();
      const double longer = std::max(l - unstressed[i], 0.0);
      sum += 0.5 * EA / unstressed[i] * longer * longer;
    }
    return sum;
  }

  /// Positions of least energy, by the method of Levenberg and Marquardt. The energy is convex, so that every
  /// place at which its gradient vanishes is one.
  /// @param x positions to begin with
  [[nodiscard]] VectorXd rest(VectorXd x) const {
    double damping = 1e-3 * EA;
    VectorXd gradient;
    MatrixXd hessian;
    for (int step = 0; step < 2000; ++step) {
      differentiate(x, gradient, hessian);
      if (gradient.norm() < 1e-12) break;
      hessian.diagonal().array() += damping;
      const VectorXd change = -hessian.ldlt().solve(gradient);
      if (energy(x + change) <= energy(x) + 1e-14 * std::abs(energy(x))) {
        x += change;
        damping = std::max(0.3 * damping, 1e-13 * EA);
      } else {
        damping *= 4.0;
      }
    }
    return x;
  }
};

/// A chain of n ropes between two places, whose drawn nodes lie on the line between them. Each is longer than
/// drawn by a share `slack`.
Net chain(int n, std::array<double, 2> from, std::array<double, 2> to, double slack) {
  Net out;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]) / n;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    out.nodes.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
    out.held.push_back(i == 0 || i == n);
    out.forces.push_back({0.0, 0.0});
    if (i > 0) {
      out.ropes.push_back({i - 1, i});
      out.unstressed.push_back(length * (1.0 + slack));
    }
  }
  return out;
}

/// Compares the positions of the nodes at load factor 1 with those of least energy, which are sought from
/// positions beside them.
void expect_at_rest(const Net& net, double tolerance, const std::string& what) {
  const Result result = solve_soundly(net.model(), static_on(fixed_mesh(1, 4), Geometry::nonlinear));
  ASSERT_EQ(result.states.size(), 1U) << what;
  VectorXd found(static_cast<Eigen::Index>(2 * net.nodes.size()));
  for (std::size_t i = 0; i < net.ropes.size(); ++i) {
    const MemberState& rope = member_of(result.states[0], "rope " + std::to_string(i));
    const auto place = [&](int node) { return found.segment<2>(2 * node); };
    place(net.ropes[i][0]) = Eigen::Vector2d(rope.x.front(), rope.y.front());
    place(net.ropes[i][1]) = Eigen::Vector2d(rope.x.back(), rope.y.back());
  }
  VectorXd moved = found;
  for (Eigen::Index i = 0; i < moved.size(); ++i)
    if (!net.held[static_cast<std::size_t>(i) / 2]) moved[i] += 0.01 * std::sin(7.0 * static_cast<double>(i));
  const VectorXd x = net.rest(moved);
  VectorXd gradient;
  MatrixXd hessian;
  net.differentiate(x, gradient, hessian);
  EXPECT_LT(gradient.norm(), 1e-9) << what << ": the minimisation has not come to an end";
  EXPECT_LT((x - found).lpNorm<Eigen::Infinity>(), tolerance) << what;
}

/// A straight rope of two parts under a force P across it: with the angle t of the parts,
/// 2 EA (1 / cos t - 1) sin t = P.
TEST(Cable, StraightRopeUnderAForceAcrossIt) {
  for (const double P : {1e-2, 1.0, 100.0}) {
    Net net = chain(2, {0.0, 0.0}, {10.0, 0.0}, 0.0);
    net.forces[1] = {0.0, -P};
    double lo = 0.0;
    double hi = 1.5;
    for (int i = 0; i < 200; ++i) {
      const double t = 0.5 * (lo + hi);
      (2.0 * net.EA * (1.0 / std::cos(t) - 1.0) * std::sin(t) < P ? lo : hi) = t;
    }
    const Result result = solve_soundly(net.model(), static_on(fixed_mesh(1, 4), Geometry::nonlinear));
    ASSERT_EQ(result.states.size(), 1U) << P;
    const MemberState& rope = member_of(result.states[0], "rope 0");
    EXPECT_NEAR(rope.v.back(), -5.0 * std::tan(lo), 1e-8 * 5.0 * std::tan(lo)) << P;
    const double T = net.EA * (1.0 / std::cos(lo) - 1.0);
    EXPECT_NEAR(rope.axial_force.front(), T, 1e-8 * T) << P;
  }
}

TEST(Cable, ChainsOfAllLengths) {
  for (const int n : {3, 10, 30, 100}) {
    for (const double slack : {0.0, 0.02, 0.3}) {
      Net net = chain(n, {0.0, 0.0}, {20.0, 4.0}, slack);
      for (int i = 1; i < n; ++i) net.forces[static_cast<std::size_t>(i)] = {0.0, -10.0 / n};
      expect_at_rest(net, 1e-6, std::to_string(n) + " ropes, slack " + std::to_string(slack));
    }
  }
}

/// A net of two families of ropes in a vertical plane, drawn as a grid, under its weight and a force aside.
TEST(Cable, ANet) {
  Net net;
  constexpr int kColumns = 5;
  constexpr int kRows = 3;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      net.nodes.push_back({1.0 * i, -1.0 * j});
      net.held.push_back(j == 0 && (i == 0 || i == kColumns - 1));
      net.forces.push_back(net.held.back() ? std::array{0.0, 0.0} : std::array{0.1 * j, -0.5});
      const int here = static_cast<int>(net.nodes.size()) - 1;
      if (i > 0) net.ropes.push_back({here - 1, here});
      if (j > 0) net.ropes.push_back({here - kColumns, here});
    }
  for (std::size_t i = 0; i < net.ropes.size(); ++i)
    net.unstressed.push_back(1.0 + 0.05 * static_cast<double>(i % 3));
  expect_at_rest(net, 1e-6, "net");
}

/// Random chains have a state, and it is that of least energy.
TEST(Cable, RandomChains) {
  std::mt19937 random(7);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int seed = 0; seed < 60; ++seed) {
    const int n = 2 + static_cast<int>(between(0.0, 12.0));
    Net net = chain(n, {0.0, 0.0}, {between(1.0, 20.0), between(-5.0, 5.0)}, 0.0);
    net.EA = std::pow(10.0, between(1.0, 5.0));
    for (double& length : net.unstressed) length *= between(0.97, 1.4);
    for (int i = 1; i < n; ++i)
      net.forces[static_cast<std::size_t>(i)] = {between(-1.0, 1.0), between(-3.0, 0.0)};
    expect_at_rest(net, 1e-5, "seed " + std::to_string(seed));
  }
}

/// A rope hangs from the middle of a chain, and then all of it from one end.
TEST(Cable, PartsThatHang) {
  Net net = chain(2, {0.0, 0.0}, {4.0, 0.0}, 0.1);
  net.nodes.push_back({2.0, -3.0});  // hangs from the middle
  net.held.push_back(false);
  net.forces.push_back({0.0, -1.0});
  net.ropes.push_back({1, 3});
  net.unstressed.push_back(3.0);
  expect_at_rest(net, 1e-6, "hangs");
  net.held[2] = false;  // the far end floats as well: the chain hangs from one end, and keeps a state
  net.forces[2] = {0.0, -0.5};
  expect_at_rest(net, 1e-6, "hangs from one end");
}

/// A node without load between two slack ropes may be anywhere.
TEST(Cable, APartOnSlackRopesIsNamed) {
  Net net = chain(4, {0.0, 0.0}, {4.0, 0.0}, 0.0);
  net.forces[2] = {0.3, -1.0};
  net.unstressed = {1.0, 1.0, 2.5, 2.5};
  const Result result = solve(net.model(), static_on(fixed_mesh(1, 4), Geometry::nonlinear));
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "loose_part");
  EXPECT_NE(result.failure->detail.find("near node \"3\""), std::string::npos) << result.failure->detail;
}

}  // namespace
}  // namespace snapthrough
