#include "bench/kernels.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <numeric>
#include <vector>

#include "bench/cases.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/structure.h"
#include "solver/numeric/symmetric_indefinite.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough::bench {
namespace {

/// The arch under a small load.
struct Kernel {
  Model model = case_named("shallow_arch").model;
  Discretization mesh = testing::fixed_mesh(5, 5);
  Structure structure = make_structure(resolve(model), mesh, Geometry::nonlinear);
  StructuralProblem problem{structure};
  Eigen::VectorXd y = Eigen::VectorXd::Zero(structure.size);
  Eigen::VectorXd residual;
  double lambda = 1e-3;

  Kernel() {
    problem.linearise(y, 0.0, residual);
    problem.load(y, 0.0, residual);
    problem.solve(residual);
    y = lambda * residual;
  }
};

using Work = void (*)(Kernel&);

void linearise(Kernel& k) { k.problem.linearise(k.y, k.lambda, k.residual); }

void solve_once(Kernel& k) {
  Eigen::VectorXd x = k.residual;
  k.problem.solve(x);
  benchmark::DoNotOptimize(x);
}

void add(const char* name, Work work) {
  benchmark::RegisterBenchmark(name, [work](benchmark::State& state) {
    Kernel kernel;
    linearise(kernel);
    for (auto unused : state) {
      (void)unused;
      work(kernel);
    }
  })->Unit(benchmark::kMillisecond);
}

/// The same tangent with all interiors, as one full matrix.
void add_dense() {
  benchmark::RegisterBenchmark("kernel/dense", [](benchmark::State& state) {
    Kernel kernel;
    const Eigen::Index n = kernel.structure.size;
    std::vector<Eigen::MatrixXd> matrix{Eigen::MatrixXd(n, n)};
    for (Eigen::Index j = 0; j < n; ++j)
      matrix[0].col(j) = kernel.problem.tangent_product(kernel.y, kernel.lambda, Eigen::VectorXd::Unit(n, j));
    std::vector<int> unknowns(static_cast<std::size_t>(n));
    std::iota(unknowns.begin(), unknowns.end(), 0);
    SymmetricIndefinite factor;
    factor.analyse(static_cast<int>(n), {unknowns});
    for (auto unused : state) {
      (void)unused;
      factor.factorise(matrix);
      benchmark::DoNotOptimize(factor.log_abs_det());
    }
    state.counters["unknowns"] = static_cast<double>(n);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

void add_kernels() {
  add("kernel/linearise", linearise);
  add("kernel/residual", [](Kernel& k) { k.problem.residual(k.y, k.lambda, k.residual); });
  add("kernel/solve", solve_once);
  add("kernel/one_factorisation_two_solves", [](Kernel& k) {
    linearise(k);
    solve_once(k);
    solve_once(k);
  });
  add("kernel/two_factorisations_two_solves", [](Kernel& k) {
    linearise(k);
    solve_once(k);
    linearise(k);
    solve_once(k);
  });
  add("kernel/structure_each_time", [](Kernel& k) {
    const Structure structure = make_structure(resolve(k.model), k.mesh, Geometry::nonlinear);
    StructuralProblem problem(structure);
    problem.linearise(k.y, k.lambda, k.residual);
  });
  add_dense();
}

}  // namespace snapthrough::bench
