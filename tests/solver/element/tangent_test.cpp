/// The tangent of every element, load and base: against central differences of the residual, against the
/// solver that eliminates it, and its inertia against dense eigenvalues.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "solver/discrete/build_structure.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using testing::fixed_mesh;

/// A two-member frame with everything on it that this solver knows.
Model everything(bool shearable) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 3.0, 1.5}, {"c", 6.0, 0.2}};
  model.sections = {{"s", 800.0, 1.7, shearable ? std::optional<double>(90.0) : std::nullopt}};
  const Member left{"left", "a", "b", "s", ArcCurve{-80.0}, false, false};
  const Member right{"right", "b", "c", "s", SineCurve{0.15, 2}, true, false};
  model.members = {left, right};
  model.supports = {
      {"a", true, true, false, 25.0, PrescribedDisplacement{0.01, -0.02, 0.0, Pattern::proportional}},
      {"c", true, true, true, 0.0, PrescribedDisplacement{0.0, 0.02, 0.1, Pattern::constant}}};
  model.loads = {
      PointLoad{{"", "left", 0.37}, {0.3, -1.0}, 0.2, Pattern::proportional},
      PointLoad{{"b", "", 0.0}, {0.1, -0.4}, -0.3, Pattern::proportional},
      DistributedLoad{"right", {0.2, -0.7}, {0.2, 0.9}, LoadMeasure::length, Pattern::constant},
      DistributedLoad{"left", {0.0, -0.5}, {0.0, 1.0}, LoadMeasure::horizontal, Pattern::proportional},
      InitialStrain{"left", 1e-3, 0.1, Pattern::constant}};
  const Foundation bonded{"bonded", "left", 3.0, 2.0, Reaction::bilateral, Side::left, {0.1, 0.8}, 0.0, {}};
  const Foundation push{"push",      "right",    5.0,  0.0, Reaction::compression_only,
                        Side::right, {0.0, 1.0}, 0.01, {}};
  const Foundation fixed{
      "fixed", "left", 2.0, 0.0, Reaction::tension_only, Side::left, {0.0, 1.0}, 0.0, std::array{0.6, 0.8}};
  model.foundations = {bonded, push, fixed};
  model.springs = {{"s1", {"", "left", 0.61}, std::array{1.0, -0.5}, 4.0, Reaction::bilateral, 0.0},
                   {"s2", {"b", "", 0.0}, {}, 2.5, Reaction::bilateral, 0.0},
                   {"s3", {"", "right", 0.5}, std::array{0.0, 1.0}, 3.0, Reaction::compression_only, 0.05},
                   {"s4", {"b", "", 0.0}, std::array{0.0, -1.0}, 3.0, Reaction::compression_only, 0.0}};
  model.imperfections = {SineImperfection{"right", 2, 0.05},
                         PointsImperfection{"left", {{0.3, 0.02}, {0.6, -0.01}}}};
  return model;
}

/// Random unknowns with rotations of order one.
Eigen::VectorXd random_state(const StructuralProblem& problem, double size) {
  return size * Eigen::VectorXd::Random(problem.size());
}

/// Strains are no differences of direction cosines: where displacements are small their equations are those
/// of small displacements, to roundings of the displacements.
TEST(Residual, KeepsTheDigitsOfSmallDisplacements) {
  constexpr double kSize = 1e-12;
  std::srand(5u);
  const Structure structure =
      make_structure(resolve(testing::arch(120.0, 1e4, 10.0)), fixed_mesh(6, 3), Geometry::nonlinear);
  StructuralProblem problem(structure);
  const Eigen::VectorXd y = random_state(problem, kSize);
  Regime small;
  small.small_displacements = true;
  Eigen::VectorXd exact;
  Eigen::VectorXd linear;
  problem.residual(y, 0.0, exact);
  problem.residual(y, 0.0, linear, small);
  double strains = 0.0;
  double differences = 0.0;
  for (const ElementDofs& dofs : structure.dofs) {
    strains = std::max(strains, linear.segment(dofs.s, 9).lpNorm<Eigen::Infinity>());
    differences = std::max(differences, (exact - linear).segment(dofs.s, 9).lpNorm<Eigen::Infinity>());
  }
  EXPECT_LT(differences, 1e2 * kSize * strains);
}

class Tangent : public ::testing::TestWithParam<std::tuple<int, bool, FoundationRule>> {};

TEST_P(Tangent, MatchesDifferencesOfTheResidualAtLargeRotations) {
  const auto [order, shearable, rule] = GetParam();
  std::srand(11u + static_cast<unsigned>(order));
  const Structure structure =
      make_structure(resolve(everything(shearable)), fixed_mesh(6, order, rule), Geometry::nonlinear);
  StructuralProblem problem(structure);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd y = random_state(problem, 0.9);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(problem.size());
    const Eigen::VectorXd exact = problem.tangent_product(y, 1.3, x);
    constexpr double kStep = 1e-6;
    Eigen::VectorXd plus;
    Eigen::VectorXd minus;
    problem.residual(y + kStep * x, 1.3, plus);
    problem.residual(y - kStep * x, 1.3, minus);
    EXPECT_LT(((plus - minus) / (2.0 * kStep) - exact).norm(), 1e-6 * exact.norm()) << "trial " << trial;
  }
}

TEST_P(Tangent, IsInvertedByTheElimination) {
  const auto [order, shearable, rule] = GetParam();
  std::srand(23u + static_cast<unsigned>(order));
  const Structure structure =
      make_structure(resolve(everything(shearable)), fixed_mesh(6, order, rule), Geometry::nonlinear);
  StructuralProblem problem(structure);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd y = random_state(problem, 0.3);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(problem.size());
    Eigen::VectorXd residual;
    problem.linearise(y, 1.0, residual);
    Eigen::VectorXd solved = problem.tangent_product(y, 1.0, x);
    problem.solve(solved);
    // random stresses make an indefinite tangent: the error allowed is rounding times a generous condition
    // number
    EXPECT_LT((solved - x).norm(), 1e-7 * x.norm()) << "trial " << trial;
    Eigen::VectorXd direct;
    problem.residual(y, 1.0, direct);
    EXPECT_LT((direct - residual).norm(), 1e-13 * direct.norm());
  }
}

/// Makes the translations of a direction continuous and zero at supports. The tangent holds the symmetric
/// part of a follower pressure's derivative; the rest belongs to element ends and cancels for such directions
/// only.
void make_compatible(const Structure& structure, Eigen::VectorXd& x) {
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  for (int j = 0; j < structure.nodes; ++j)
    if (structure.supports[j].fixed[0]) x.segment<2>(3 * j).setZero();
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
    const ElementDofs& dofs = structure.dofs[e];
    const double h = length_of_element(structure, static_cast<int>(e));
    for (int c = 0; c < 2; ++c) {
      double end = x[dofs.a[c]];
      for (int q = 0; q < rule.order(); ++q) end += h * rule.weight(q) * x[dofs.v + c * rule.order() + q];
      if (dofs.b[c] >= 3 * structure.nodes) {
        x[dofs.b[c]] = end;
      } else {
        for (int q = 0; q < rule.order(); ++q) x[dofs.v + c * rule.order() + q] += (x[dofs.b[c]] - end) / h;
      }
    }
  }
}

std::vector<Load> even_pressure() {
  return {PressureLoad{"left", 40.0, Side::left, Pattern::proportional},
          PressureLoad{"right", 40.0, Side::left, Pattern::proportional}};
}

/// Pressure that changes along both members and jumps between them.
std::vector<Load> varying_pressure() {
  return {PressureLoad{"left", 0.0, Side::left, Pattern::proportional, {{0.0, 40.0}, {0.5, 90.0}}},
          PressureLoad{"right", 0.0, Side::left, Pattern::constant, {{0.0, 60.0}, {1.0, -50.0}}}};
}

/// The tangent holds the symmetric part of a follower pressure's derivative, and the skew part where the
/// pressure changes or jumps. The rest belongs to the ends of elements and does no work on continuous motions
/// that vanish at supports: on these the tangent is that of the residual.
void expect_tangent_of_pressure(const std::tuple<int, bool, FoundationRule>& param,
                                const std::vector<Load>& loads) {
  const auto [order, shearable, rule] = param;
  std::srand(17u + static_cast<unsigned>(order));
  Model model = everything(shearable);
  model.loads = loads;
  const Structure structure = make_structure(resolve(model), fixed_mesh(6, order, rule), Geometry::nonlinear);
  StructuralProblem problem(structure);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd y = random_state(problem, 0.9);
    Eigen::VectorXd x = Eigen::VectorXd::Random(problem.size());
    Eigen::VectorXd z = Eigen::VectorXd::Random(problem.size());
    make_compatible(structure, x);
    make_compatible(structure, z);
    for (int c = 0; c < 3; ++c) z[c] = z[6 + c] = 0.0;  // rows of supports are no work
    constexpr double kStep = 1e-6;
    Eigen::VectorXd plus;
    Eigen::VectorXd minus;
    problem.residual(y + kStep * x, 1.3, plus);
    problem.residual(y - kStep * x, 1.3, minus);
    const double exact = z.dot(problem.tangent_product(y, 1.3, x));
    const double without = z.dot(problem.tangent_product(y, 0.0, x));
    EXPECT_NEAR(z.dot(plus - minus) / (2.0 * kStep), exact, 1e-6 * std::abs(exact) + 1e-7)
        << "trial " << trial;
    EXPECT_GT(std::abs(exact - without), 1e-4) << "the pressure does not matter here: the test shows nothing";
  }
}

TEST_P(Tangent, OfFollowerPressureMatchesOnContinuousMotions) {
  expect_tangent_of_pressure(GetParam(), even_pressure());
}

TEST_P(Tangent, OfVaryingPressureMatchesOnContinuousMotions) {
  expect_tangent_of_pressure(GetParam(), varying_pressure());
}

TEST_P(Tangent, OfVaryingPressureIsInvertedByTheElimination) {
  const auto [order, shearable, rule] = GetParam();
  std::srand(29u + static_cast<unsigned>(order));
  Model model = everything(shearable);
  model.loads = varying_pressure();
  const Structure structure = make_structure(resolve(model), fixed_mesh(6, order, rule), Geometry::nonlinear);
  ASSERT_GE(structure.follower_ends.size(), 9u * static_cast<std::size_t>(order));
  StructuralProblem problem(structure);
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::VectorXd y = random_state(problem, 0.3);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(problem.size());
    Eigen::VectorXd residual;
    problem.linearise(y, 1.0, residual);
    Eigen::VectorXd solved = problem.tangent_product(y, 1.0, x);
    problem.solve(solved);
    EXPECT_LT((solved - x).norm(), 1e-7 * x.norm()) << "trial " << trial;
  }
}

/// Model of everything(), with two forces that turn with their places and two that stay on their lines.
Model with_following_forces(bool shearable) {
  Model model = everything(shearable);
  const auto add = [&](const Location& at, bool fixed_line, Pattern pattern) {
    PointLoad load{at, {0.7, -1.1}, 0.0, pattern};
    (fixed_line ? load.fixed_line : load.follows) = true;
    model.loads.emplace_back(load);
  };
  for (const bool fixed_line : {false, true}) {
    add({"", "left", 0.45}, fixed_line, Pattern::proportional);
    add({"b", "", 0.0}, fixed_line, Pattern::constant);
  }
  return model;
}

TEST_P(Tangent, OfFollowingForces) {
  const auto [order, shearable, rule] = GetParam();
  std::srand(37u + static_cast<unsigned>(order));
  const Structure structure = make_structure(resolve(with_following_forces(shearable)),
                                             fixed_mesh(6, order, rule), Geometry::nonlinear);
  ASSERT_EQ(structure.follower_forces.size(), 4U);
  StructuralProblem problem(structure);
  constexpr double kStep = 1e-6;
  const auto differences = [](const auto& function) -> Eigen::VectorXd {
    return (function(kStep) - function(-kStep)) / (2.0 * kStep);
  };
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::VectorXd y = random_state(problem, 0.3);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(problem.size());
    const Eigen::VectorXd exact = problem.tangent_product(y, 1.3, x);
    const auto residual_at = [&](double step) {
      Eigen::VectorXd f;
      problem.residual(y + step * x, 1.3, f);
      return f;
    };
    EXPECT_LT((differences(residual_at) - exact).norm(), 1e-6 * exact.norm()) << "trial " << trial;
    const Eigen::VectorXd moved = Eigen::VectorXd::Random(problem.size());
    const PathDirection along{moved, 0.7};
    const auto product_at = [&](double step) {
      return Eigen::VectorXd(problem.tangent_product(y + step * along.y, 1.3 + step * along.lambda, x));
    };
    const Eigen::VectorXd change = problem.tangent_change(y, 1.3, along, x);
    EXPECT_LT((differences(product_at) - change).norm(), 1e-6 * change.norm()) << "trial " << trial;
    Eigen::VectorXd residual;
    problem.linearise(y, 1.3, residual);
    Eigen::VectorXd solved = exact;
    problem.solve(solved);
    EXPECT_LT((solved - x).norm(), 1e-7 * x.norm()) << "trial " << trial;
  }
}

/// Haynsworth: negative eigenvalues of the full mixed matrix = one a stress and multiplier + those of the
/// stiffness.
class LowOrderTangent : public Tangent {};

TEST_P(LowOrderTangent, InertiaIsThatOfTheDenseMatrix) {
  const auto [order, shearable, rule] = GetParam();
  std::srand(31u + static_cast<unsigned>(order));
  const Structure structure =
      make_structure(resolve(everything(shearable)), fixed_mesh(4, order, rule), Geometry::nonlinear);
  StructuralProblem problem(structure);
  std::vector<Eigen::Index> kept;
  int multipliers = 0;
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    const bool fixed = i < 3 * structure.nodes && structure.supports[i / 3].fixed[i % 3];
    if (!fixed) kept.push_back(i);
  }
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) multipliers += 3 * order + 3;
  int indefinite = 0;
  for (int trial = 0; trial < 4; ++trial) {
    Eigen::VectorXd y = random_state(problem, trial == 0 ? 0.01 : 0.9);
    for (const ElementDofs& dofs : structure.dofs) y.segment(dofs.s, 2 * order) *= 100.0 * trial;
    for (const ElementDofs& dofs : structure.dofs) y.segment(dofs.s, order).array() -= 50.0 * trial;
    Eigen::MatrixXd dense(problem.size(), problem.size());
    for (Eigen::Index j = 0; j < problem.size(); ++j)
      dense.col(j) = problem.tangent_product(y, 1.0, Eigen::VectorXd::Unit(problem.size(), j));
    const Eigen::MatrixXd inner = dense(kept, kept);
    EXPECT_LT((inner - inner.transpose()).norm(), 1e-12 * inner.norm());
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(inner).eigenvalues();
    Eigen::VectorXd residual;
    const TangentReport report = problem.linearise(y, 1.0, residual);
    EXPECT_EQ(report.negative, (values.array() < 0.0).count() - multipliers) << "trial " << trial;
    indefinite += report.negative > 0 ? 1 : 0;
  }
  EXPECT_GT(indefinite, 0) << "no trial was indefinite: the test shows nothing";
}

INSTANTIATE_TEST_SUITE_P(Orders, Tangent,
                         ::testing::Combine(::testing::Values(1, 2, 3, 4, 5, 8), ::testing::Bool(),
                                            ::testing::Values(FoundationRule::consistent,
                                                              FoundationRule::lumped)));

INSTANTIATE_TEST_SUITE_P(Orders, LowOrderTangent,
                         ::testing::Combine(::testing::Values(1, 2, 3, 4), ::testing::Bool(),
                                            ::testing::Values(FoundationRule::consistent,
                                                              FoundationRule::lumped)));

/// u = (R - I) X at the nodes with rotation 2 rad is a motion without strain, for every order, on a curved
/// member.
TEST(RigidMotion, RotationByTwoRadiansHasNoStrain) {
  for (int order = 1; order <= kMaxOrder; ++order) {
    Model model = testing::arch(150.0, 900.0, 2.0);
    model.supports.clear();
    const Structure structure = make_structure(resolve(model), fixed_mesh(5, order), Geometry::nonlinear);
    StructuralProblem problem(structure);
    const double angle = 2.0;
    const double c = std::cos(angle) - 1.0;
    const double s = std::sin(angle);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.size());
    const AxisCurve& axis = *structure.axes[0];
    const auto place = [&](const std::array<int, 3>& dofs, double fraction) {
      const AxisPoint p = axis.at(fraction * axis.length());
      const double x = p.x / structure.scales.length;
      const double z = p.y / structure.scales.length;
      y[dofs[0]] = c * x - s * z;
      y[dofs[1]] = s * x + c * z;
      y[dofs[2]] = angle;
    };
    for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
      const ElementDofs& dofs = structure.dofs[e];
      const MeshElement& cell = structure.mesh.elements[e];
      place(dofs.a, cell.from);
      place(dofs.b, cell.to);
      const ElementShape shape = shape_of_element(structure, static_cast<int>(e));
      for (int q = 0; q < order; ++q) {
        y[dofs.v + q] = c * shape.t[q][0] - s * shape.t[q][1];
        y[dofs.v + order + q] = s * shape.t[q][0] + c * shape.t[q][1];
      }
    }
    Eigen::VectorXd residual;
    problem.residual(y, 0.0, residual);
    EXPECT_LT(residual.lpNorm<Eigen::Infinity>(), 1e-14) << "order " << order;
  }
}

}  // namespace
}  // namespace snapthrough
