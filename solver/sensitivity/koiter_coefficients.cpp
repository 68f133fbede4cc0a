#include "solver/sensitivity/koiter_coefficients.h"

#include "solver/events/bordered_point.h"
#include "solver/events/koiter.h"
#include "solver/problem/structural_problem.h"
#include "solver/report/mode.h"

namespace snapthrough {
namespace {

/// Rate of the amplitude along the null motion with the load factor, on the path through the point.
std::optional<double> along_path(const CriticalEvent& event, const BorderedPoint& point) {
  const CriticalSolution& at = point.at();
  const double load = event.point.tangent_lambda;
  if (load == 0.0) return std::nullopt;
  return point.metric().inner(event.point.tangent, 0.0, at.null.col(0), 0.0) / load;
}

}  // namespace

std::optional<KoiterCoefficients> koiter_coefficients(const Structure& structure, const LocatedPoint& at,
                                                      int points, int& factorisations) {
  const CriticalEvent& event = at.event;
  if (event.type != CriticalType::bifurcation || event.cause != CriticalCause::smooth ||
      event.multiplicity > 1 || !structure.traits.symmetric)
    return std::nullopt;
  StructuralProblem problem(structure);
  problem.set_context(event.point.context);
  const PathMetric metric{&structure.metric, at.load_weight};
  const auto found = exact_point(problem, metric, at, factorisations);
  if (!found || found->solution.null.cols() != 1) return std::nullopt;
  const BorderedPoint point(problem, metric, found->solution, true);
  ++factorisations;
  if (!point.is_ready()) return std::nullopt;
  const auto path = along_path(event, point);
  const auto expansion = path ? koiter_expansion(point, *path) : std::nullopt;
  if (!expansion || (expansion->slope == 0.0 && !expansion->curvature)) return std::nullopt;
  Mode mode = mode_displacements(structure, point.at().null.col(0), points);
  const double scale = scale_to_largest(mode);
  const double load = point.at().lambda;
  KoiterCoefficients out;
  if (expansion->slope != 0.0) out.a = expansion->slope / load * scale;
  if (expansion->curvature) out.b = *expansion->curvature / load * scale * scale;
  if (!expansion->curvature)
    out.kind = BifurcationKind::asymmetric;
  else
    out.kind =
        expansion->stiffening > 0.0 ? BifurcationKind::stable_symmetric : BifurcationKind::unstable_symmetric;
  return out;
}

}  // namespace snapthrough
