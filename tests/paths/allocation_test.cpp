/// Newton iterations do not allocate: malloc itself is counted (Eigen's matrices don't go through operator
/// new).
#include <atomic>
#include <cstddef>
#include <thread>

#include "server/worker/sanitizer.h"
#include "solver/discrete/build_structure.h"
#include "solver/path/path_follower.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/paths/reference_problems.h"

#if !SNAPTHROUGH_SANITIZED  // sanitizers replace malloc themselves

namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t);  // NOLINT: glibc's own name
void* malloc(std::size_t size) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
}

namespace snapthrough {
namespace {

using namespace testing;

/// Allocations of corrections from the same predictor, after one that brings all buffers to their size.
long allocations_of_corrections(const ReferenceProblem& problem) {
  const Structure structure = make_structure(resolve(problem.model), {}, Geometry::nonlinear);
  StructuralProblem equations(structure);
  PathFollower follower(equations);
  auto at = find_start(follower.solver()).point;
  if (!at) return -1;
  StepSize size{0.0, 0.02};
  PathPoint next = *at;
  for (int i = 0; i < 5; ++i) {
    if (follower.step(*at, size, next) != StepOutcome::advanced) return -1;
    std::swap(*at, next);
  }
  SideCondition side;
  side.normal = equations.metric().cwiseProduct(at->tangent);
  side.normal_lambda = follower.norm().metric().load_weight * at->tangent_lambda;
  Workspace work;
  Eigen::VectorXd y;
  long counted = 0;
  for (int run = 0; run < 3; ++run) {
    y = at->y + 0.05 * at->tangent;
    double lambda = at->lambda + 0.05 * at->tangent_lambda;
    const long before = allocations.load();
    const auto outcome = correct(equations, follower.norm().metric(), side, 0.05, {}, y, lambda, work);
    counted = allocations.load() - before;
    EXPECT_EQ(outcome.status, CorrectorStatus::converged) << problem.name;
    EXPECT_GE(outcome.factorisations, 2) << problem.name;
  }
  return counted;
}

TEST(Allocation, NewtonIterationsDoNotAllocate) {
  EXPECT_EQ(allocations_of_corrections(shallow_arch(0.0, Side::left, {})), 0);
  EXPECT_EQ(allocations_of_corrections(shallow_arch(1e7, Side::left, {})), 0);
  EXPECT_EQ(allocations_of_corrections(deep_arch(215.0, 1e4, 0.0)), 0);
  EXPECT_EQ(allocations_of_corrections(ring_in_medium(1200.0, {}, 0.0)), 0);
  EXPECT_EQ(allocations_of_corrections(lee_frame_path({})), 0);
  EXPECT_EQ(allocations_of_corrections(one_sided_column(50.0)), 0);
}

TEST(Allocation, IsCounted) {
  const long before = allocations.load();
  const Eigen::VectorXd some = Eigen::VectorXd::Ones(1000);
  EXPECT_GT(allocations.load(), before) << some.sum();
}

}  // namespace
}  // namespace snapthrough

#endif
