/// From one mesh to the next: states that are carried over, critical points that are found again, and the
/// errors that follow.
#include "solver/accuracy/polish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/accuracy/buckling_loads.h"
#include "solver/accuracy/differences.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/element_reader.h"
#include "solver/discrete/transfer.h"
#include "solver/resolve/resolved_model.h"
#include "solver/trace/trace.h"
#include "tests/solver/linear_response.h"
#include "tests/solver/structures.h"
#include "tests/solver/trace/follow.h"

namespace snapthrough {
namespace {

/// The first difference counts twice; later ones must fall by four, or the larger one counts.
TEST(Differences, AreTwiceTheDistanceToTheFinerMesh) {
  Differences falling;
  EXPECT_DOUBLE_EQ(falling.add(1.1, 1.0), 2.0 * (1.1 - 1.0));
  EXPECT_DOUBLE_EQ(falling.add(1.0, 0.99), 2.0 * (1.0 - 0.99) / 0.99);
  Differences slow;
  EXPECT_NEAR(slow.add(1.1, 1.0), 0.2, 1e-12);
  EXPECT_NEAR(slow.add(1.0, 0.95), 0.2, 1e-12) << "it fell by less than four";
  Differences to_zero;
  EXPECT_DOUBLE_EQ(to_zero.add(1e-9, 0.0), 2.0) << "nothing to be relative to";
}

/// Two meshes that err alike agree by chance: one difference confirms with four times as much room as those
/// that were seen to fall.
TEST(Differences, ConfirmByTheFirstOneWithMoreRoom) {
  Differences first;
  EXPECT_NEAR(first.add(1.0001, 1.0), 2e-4, 1e-12);
  EXPECT_FALSE(first.confirm(7e-4));
  EXPECT_TRUE(first.confirm(9e-4));
  EXPECT_NEAR(first.add(1.0, 1.00001), 2e-5, 1e-9);
  EXPECT_TRUE(first.confirm(3e-5)) << "it fell";
}

/// On nested elements of the same order or a higher one the polynomials are the same.
TEST(Transfer, KeepsEveryDisplacement) {
  const Model model = testing::arch(120.0, 1e4, 10.0);
  const Structure coarse = make_structure(resolve(model), testing::fixed_mesh(4, 3), Geometry::nonlinear);
  // the response to a load, since displacements at ends of elements follow from their gradients
  const Eigen::VectorXd y = testing::linear_response(coarse);
  Mesh finer = *finer_mesh(coarse.mesh);
  finer.order = 5;
  const Structure fine = on_mesh(coarse, finer);
  const Eigen::VectorXd there = transfer(coarse, y, fine);
  for (double fraction = 0.013; fraction < 1.0; fraction += 0.031) {
    const MeshPlace a = place_of(coarse.mesh, 0, fraction);
    const MeshPlace b = place_of(fine.mesh, 0, fraction);
    const auto from = ElementReader(coarse, y, a.element).displacement(a.xi);
    const auto to = ElementReader(fine, there, b.element).displacement(b.xi);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(to[c], from[c], 1e-12 * y.norm()) << fraction << " " << c;
  }
  const Eigen::VectorXd twice = transfer(coarse, 2.0 * y, fine);
  EXPECT_NEAR((twice - 2.0 * there).norm(), 0.0, 1e-12 * there.norm()) << "linear, so that tangents go over";
}

/// The first critical point of a structure's path on a coarse mesh, and what FineMesh needs to know of it.
struct Coarse {
  explicit Coarse(const Model& drawn, const Discretization& mesh)
      : structure(make_structure(resolve(drawn), mesh, Geometry::nonlinear)),
        problem(structure),
        follower(problem) {
    TraceRules rules;
    rules.first_loss_of_stability = true;
    rules.locate.tolerance = 1e-11;
    testing::Observed observer;
    observer.point = [this](const PathPoint& at) { last = at; };
    observer.critical = [this](const CriticalEvent&) { before = last; };
    const TraceOutcome outcome =
        trace(follower, find_start(follower.solver()).point, rules, {}, {&observer}, {});
    EXPECT_EQ(outcome.critical.size(), 1U);
    if (!outcome.critical.empty()) event = outcome.critical[0];
  }
  [[nodiscard]] FineMesh finer() const {
    return {on_mesh(structure, *finer_mesh(structure.mesh)), follower, 1e-11};
  }

  Structure structure;
  StructuralProblem problem;
  PathFollower follower;
  CriticalEvent event;
  PathPoint last, before;
};

/// Half the elements' length, 2^2p of the error: a pinned column buckles at P (1 - P / EA) = pi^2.
TEST(FineMesh, HasTheSameBifurcationNearerToTheTruth) {
  Coarse coarse(testing::column(1.0, 1.0, 1e3, 0.0), testing::fixed_mesh(3, 2));
  const double exact = 500.0 * (1.0 - std::sqrt(1.0 - 4.0 * std::numbers::pi * std::numbers::pi / 1e3));
  FineMesh fine = coarse.finer();
  const auto found = fine.find(coarse.structure, coarse.event, coarse.structure, coarse.before);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->event.type, CriticalType::bifurcation);
  const double unit = coarse.structure.scales.load;
  const double before = std::abs(coarse.event.point.lambda / unit - exact);
  const double after = std::abs(found->event.point.lambda / unit - exact);
  EXPECT_GT(before, 1e-5 * exact) << "the coarse mesh has no error to speak of";
  EXPECT_LT(after, before / 12.0);
  EXPECT_GT(after, before / 20.0) << "2^4 for order 2";
  EXPECT_TRUE(fine.has(coarse.structure, coarse.before));
}

/// The limit point of the clamped and pinned arch of 215 degrees, P R^2 / EI = 8.97 (DaDeppo and Schmidt, J.
/// Appl. Mech. 42, 1975).
TEST(FineMesh, HasTheSameLimitPointNearerToTheTruth) {
  constexpr double kReference = 8.97;  // three digits published
  Coarse coarse(testing::arch(215.0, 1e8, 1e4, true), testing::fixed_mesh(6, 2));
  ASSERT_EQ(coarse.event.type, CriticalType::limit_max);
  FineMesh fine = coarse.finer();
  const auto found = fine.find(coarse.structure, coarse.event, coarse.structure, coarse.before);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->event.type, CriticalType::limit_max);
  const double unit = coarse.structure.scales.load;
  EXPECT_NEAR(found->event.point.lambda / unit, kReference, 0.01 * kReference);
  EXPECT_LT(std::abs(found->event.point.lambda / unit - kReference),
            std::abs(coarse.event.point.lambda / unit - kReference));
}

/// What the finer mesh does not have is not found: a point with another inertia, or far from any.
TEST(FineMesh, HasNothingElse) {
  Coarse coarse(testing::column(1.0, 1.0, 1e3, 0.0), testing::fixed_mesh(3, 2));
  FineMesh fine = coarse.finer();
  CriticalEvent other = coarse.event;
  other.negative_before = 4;
  other.negative_after = 5;
  EXPECT_FALSE(fine.find(coarse.structure, other, coarse.structure, coarse.before));
  PathPoint unstable = coarse.before;
  unstable.negative = 1;
  EXPECT_FALSE(fine.has(coarse.structure, unstable));
}

/// Loads on the first mesh that is fine enough, with an error that is at least the true one.
TEST(BucklingLoads, AreRefinedUntilTheEstimateIsWithinTheAccuracy) {
  const Model model = testing::column(1.0, 1.0, 1e10, 0.0);
  int last = -1;
  for (const double accuracy : {1e-2, 1e-5, 1e-9}) {
    Analysis analysis;
    analysis.type = AnalysisType::buckling;
    analysis.modes = 3;
    analysis.discretization.accuracy = accuracy;
    Structure first = make_structure(resolve(model), testing::fixed_mesh(2, 4), Geometry::nonlinear);
    const BucklingLoads found = buckling_loads(analysis, first);
    ASSERT_EQ(found.buckling.loads.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const double n = static_cast<double>(i + 1);
      const double exact = n * n * std::numbers::pi * std::numbers::pi;
      ASSERT_TRUE(found.errors[i]);
      EXPECT_LE(*found.errors[i], accuracy);
      const double error = std::abs(found.buckling.loads[i] / found.structure->scales.load / exact - 1.0);
      EXPECT_LE(error, *found.errors[i] + 1e-9) << n << " at " << accuracy;
    }
    EXPECT_GT(found.level, last) << accuracy;
    last = found.level;
  }
}

}  // namespace
}  // namespace snapthrough
