#include "solver/events/touching.h"

#include <cmath>
#include <string>
#include <utility>

#include "solver/discrete/build_structure.h"
#include "solver/discrete/transfer.h"
#include "solver/events/buckling.h"
#include "solver/newton/corrector.h"
#include "solver/numeric/number_text.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Supports that touch without pressure; ratios. Source: docs/decisions/0009.
struct TouchingLimits {
  static constexpr double on_the_way = 0.5;  ///< share of the critical load up to which supports must touch
  static constexpr double lost = 1e-6;       ///< loss of touching supports that is ignored, see amount()
  /// Ratio of the start's response to that with bilateral supports: above it rounding alone holds contact.
  static constexpr double loose = 1e3;
};

/// Number of springs plus the summed lengths of foundations (fractions of their members).
double amount(const TouchingSupports& touching) {
  auto sum = static_cast<double>(touching.springs.size());
  for (const TouchingSupports::FoundationRange& part : touching.foundations)
    sum += part.range[1] - part.range[0];
  return sum;
}

/// Whether all touching supports still touch in equilibrium under a load, starting from the state `from`.
bool still_touch(const Structure& structure, const VectorXd& from, double lambda) {
  StructuralProblem problem(structure);
  const PathMetric metric{&structure.metric, 0.0};
  VectorXd displacement;
  Workspace work;
  problem.linearise(from, 0.0, work.residual);
  problem.load(from, 0.0, displacement);
  problem.solve(displacement);
  VectorXd y = from + lambda * displacement;
  const auto outcome =
      correct(problem, metric, {}, lambda * metric.norm(displacement, 0.0), {}, y, lambda, work);
  if (outcome.status != CorrectorStatus::converged) return false;
  const TouchingMarks marks = problem.contact().marks_at(y);
  return has_any(marks) && std::abs(amount(problem.contact().touching(marks, nullptr)) -
                                    amount(structure.touching)) <= TouchingLimits::lost;
}

bool is_known(const TouchingSupports& touching) {
  return !touching.springs.empty() || !touching.foundations.empty();
}

/// Finds which of the supports that touch under a reference load act; empty: no buckling load was found.
TouchingSupports least_piece(const Structure& structure, double reference, const VectorXd& near,
                             LinearBuckling& buckling) {
  const Structure unknown = with_touching(structure, {});
  StructuralProblem problem(unknown);
  buckling = linear_buckling(unknown, problem, 1, reference, near);
  if (!buckling.piece.found || !buckling.complete || buckling.loads.empty()) return {};
  TouchingSupports out = problem.contact().touching(buckling.marks, &buckling.contact);
  out.motion = buckling.piece.motion;
  out.reference = reference;
  return out;
}

/// Whether supports touch without pressure in the response of the structure with bilateral supports.
bool bilateral_touches(const Structure& structure, StructuralProblem& problem) {
  if (structure.has_constant) return false;
  const VectorXd zero = VectorXd::Zero(structure.size);
  VectorXd residual;
  VectorXd response;
  Regime bilateral;
  bilateral.contact = Regime::Contact::bilateral;
  problem.linearise(zero, 0.0, residual, bilateral);
  problem.load(zero, 0.0, response);
  problem.solve(response);
  return has_any(problem.contact().marks_at(structure.scales.load * response));
}

}  // namespace

std::optional<Structure> with_least_piece(const Structure& structure, StructuralProblem& problem,
                                          const PathNorm& norm, const PathStart& start, Result& result) {
  if (!structure.traits.one_sided || is_known(structure.touching)) return std::nullopt;
  const std::optional<PathPoint>& point = start.point;
  const bool is_loose = start.contact_flexibility_ratio > TouchingLimits::loose;
  if (point ? point->tangent_lambda <= 0.0 : structure.has_constant) return std::nullopt;
  const double ahead =
      point && !is_loose ? TouchingLimits::on_the_way * norm.load_scale() : structure.scales.load;
  if (point) {
    const VectorXd linear = point->y + (ahead / point->tangent_lambda) * point->tangent;
    if (!has_any(problem.contact().marks_at(linear)) && !(is_loose && bilateral_touches(structure, problem)))
      return std::nullopt;
  }
  LinearBuckling buckling;
  TouchingSupports touching = least_piece(structure, ahead, {}, buckling);
  result.diagnostics.factorizations += buckling.factorizations;
  if (!is_known(touching)) return std::nullopt;
  std::optional<Structure> out = with_touching(structure, std::move(touching));
  const VectorXd from = point ? point->y : VectorXd::Zero(structure.size);
  if (!still_touch(*out, from, TouchingLimits::on_the_way * buckling.loads.front())) return std::nullopt;
  warn_of_touching(structure, buckling.piece, result);
  return out;
}

Structure with_finer_piece(const Structure& coarse, Mesh mesh) {
  Structure fine = on_mesh(coarse, std::move(mesh));
  const auto& parts = fine.touching.foundations;
  const auto acts = [](const TouchingSupports::FoundationRange& part) { return part.touch == Touch::acts; };
  // without contact ends the result does not depend on the mesh
  if (std::none_of(parts.begin(), parts.end(), acts) || std::all_of(parts.begin(), parts.end(), acts))
    return fine;
  LinearBuckling buckling;
  const VectorXd near = transfer(coarse, coarse.touching.motion, fine);
  TouchingSupports touching = least_piece(fine, coarse.touching.reference, near, buckling);
  return is_known(touching) ? with_touching(fine, std::move(touching)) : std::move(fine);
}

void warn_of_touching(const Structure& structure, const LeastPiece& piece, Result& result) {
  if (!piece.found || piece.certain) return;
  result.warnings.push_back(
      {"touching_supports",
       "one-sided supports touch without pressure, and each motion of the structure meets other ones: the "
       "critical "
       "load is the least that was found over the ways in which they can act; it is at least " +
           number(piece.above / structure.scales.load) + ", what the structure carries without them"});
}

}  // namespace snapthrough
