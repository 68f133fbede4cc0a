#include "solver/accuracy/buckling_loads.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "solver/accuracy/differences.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/transfer.h"

namespace snapthrough {
namespace {

/// Structure on one mesh with its buckling loads.
struct Level {
  std::shared_ptr<const Structure> structure;
  LinearBuckling buckling;
};

/// @param coarser solution on the previous mesh; null: first mesh
Level solve_on(std::shared_ptr<const Structure> structure, int count, LoadSense sense, const Level* coarser) {
  StructuralProblem problem(*structure);
  Eigen::VectorXd near;
  if (coarser != nullptr && coarser->buckling.piece.motion.size() > 0)
    near = transfer(*coarser->structure, coarser->buckling.piece.motion, *structure);
  LinearBuckling buckling = linear_buckling(*structure, problem, count, structure->scales.load, near, sense);
  return {std::move(structure), std::move(buckling)};
}

bool within(const std::vector<std::optional<double>>& errors, double accuracy) {
  return std::all_of(errors.begin(), errors.end(),
                     [accuracy](const std::optional<double>& e) { return e && *e <= accuracy; });
}

}  // namespace

BucklingLoads buckling_loads(const Analysis& analysis, const Structure& structure, LoadSense sense) {
  const bool fixed = analysis.discretization.fixed_mesh;
  BucklingLoads out;
  Level now = solve_on({std::shared_ptr<const Structure>(), &structure}, analysis.modes, sense, nullptr);
  int factorizations = now.buckling.factorizations;
  std::vector<Differences> differences(static_cast<std::size_t>(analysis.modes));
  for (int level = 0;; ++level) {
    out = {now.structure, now.buckling, {}, level, factorizations};
    out.errors.resize(now.buckling.loads.size());
    if (now.buckling.is_mechanism || now.buckling.held_share) break;
    auto mesh = finer_mesh(now.structure->mesh);
    if (!mesh) break;
    Level next = solve_on(std::make_shared<const Structure>(on_mesh(structure, *std::move(mesh))),
                          analysis.modes, sense, &now);
    factorizations += next.buckling.factorizations;
    out.factorizations = factorizations;
    const bool same_count = now.buckling.complete && next.buckling.complete &&
                            next.buckling.loads.size() == now.buckling.loads.size();
    for (std::size_t i = 0; same_count && i < out.errors.size(); ++i)
      out.errors[i] = differences[i].add(now.buckling.loads[i], next.buckling.loads[i]);
    const bool enough = same_count && within(out.errors, analysis.discretization.accuracy);
    if (fixed || enough || level + 1 == Differences::most_levels) break;
    now = std::move(next);
  }
  return out;
}

}  // namespace snapthrough
