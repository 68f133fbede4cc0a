#include "solver/sensitivity/offset_works.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/events/bordered_point.h"
#include "solver/events/critical_mode.h"
#include "solver/path/soft_mode.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Softest motions at a critical point. Chosen: they start a search that judges each shape by its own path.
struct MotionLimits {
  static constexpr Index count = 3;  ///< motions, with the null motions
  static constexpr int iterations =
      8;  ///< block inverse iterations; each gains a digit where modes are apart
};

/// State at which works are taken, with motions as columns.
struct MotionsAt {
  VectorXd y;
  double lambda = 0.0;
  MatrixXd motions;
  double load_along = 0.0;  ///< work of the reference load on the first motion
  bool exact = false;       ///< the state is solved to rounding, and the first motion is its null vector
};

/// Appends the softest motions of the tangent that `problem` has factorised.
void add_soft_motions(EquilibriumProblem& problem, MatrixXd& motions) {
  const SoftModes soft =
      soft_modes(problem, motions, std::max(MotionLimits::count, motions.cols()), MotionLimits::iterations);
  const Index known = motions.cols();
  if (soft.count() <= known) return;
  motions.conservativeResize(Eigen::NoChange, soft.count());
  motions.rightCols(soft.count() - known) = soft.motions.rightCols(soft.count() - known);
}

/// The point as path following located it, where no smooth critical point is within reach.
MotionsAt located(StructuralProblem& problem, const CriticalEvent& event, int& factorisations) {
  MotionsAt out{event.point.y, event.point.lambda, mode_of(problem, event), 0.0, false};
  VectorXd residual;
  problem.linearise(out.y, out.lambda, residual);
  factorisations += 2;
  add_soft_motions(problem, out.motions);
  return out;
}

MotionsAt motions_at(StructuralProblem& problem, const PathMetric& metric, const Structure& structure,
                     const LocatedPoint& at, int& factorisations) {
  const CriticalEvent& event = at.event;
  const bool smooth = event.cause == CriticalCause::smooth && structure.traits.symmetric;
  const auto point = smooth ? exact_point(problem, metric, at, factorisations) : std::nullopt;
  if (!point) return located(problem, event, factorisations);
  const BorderedPoint bordered(problem, metric, point->solution, true);
  ++factorisations;
  if (!bordered.is_ready()) return located(problem, event, factorisations);
  MotionsAt out{point->solution.y, point->solution.lambda, point->solution.null, bordered.load_along()[0],
                true};
  add_soft_motions(problem, out.motions);
  return out;
}

/// Residual of the model with an offset at one point of a member, at a given state.
VectorXd residual_with(const Structure& structure, const ResolvedPointsImperfection& offset,
                       const ModeOffsets& modes, const MotionsAt& at, const PointContext& context) {
  ResolvedModel changed = *structure.model;
  changed.imperfections.emplace_back(offset);
  const Structure other = with_changed_model(structure, std::move(changed), modes);
  StructuralProblem problem(other);
  problem.set_context(context);
  VectorXd out;
  problem.residual(at.y, at.lambda, out);
  return out;
}

}  // namespace

OffsetWorks offset_works(const Structure& structure, const LocatedPoint& at, const OffsetSpace& space,
                         const ModeOffsets& modes, int& factorisations) {
  const ResolvedModel& model = *structure.model;
  const PointContext& context = at.event.point.context;
  StructuralProblem problem(structure);
  problem.set_context(context);
  const PathMetric metric{&structure.metric, at.load_weight};
  const MotionsAt here = motions_at(problem, metric, structure, at, factorisations);
  OffsetWorks out;
  out.works.resize(space.size(), here.motions.cols());
  for (Index i = 0; i < space.size(); ++i) {
    const auto member = static_cast<std::size_t>(i / OffsetSpace::kPoints);
    const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * structure.axes[member]->length();
    const auto residual = [&](double offset) {
      const VectorXd one = offset * VectorXd::Unit(space.size(), i);
      const MemberOffsets offsets = space.member_offsets(model, one)[member];
      return residual_with(structure, {{offsets.member, offsets.offsets}, static_cast<int>(member)}, modes,
                           here, context);
    };
    const VectorXd change = (residual(step) - residual(-step)) / (2.0 * step);
    for (Index j = 0; j < here.motions.cols(); ++j)
      out.works(i, j) = problem.work(change, here.motions.col(j));
  }
  if (here.exact && is_limit(at.event.type))
    out.load_rate = out.works.col(0) / (here.load_along * structure.scales.load);
  return out;
}

}  // namespace snapthrough
