#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/accuracy/differences.h"
#include "solver/analysis/analyses.h"
#include "solver/analysis/frequency_probe.h"
#include "solver/discrete/build_structure.h"
#include "solver/numeric/number_text.h"
#include "solver/report/mode.h"
#include "solver/report/result_parts.h"

namespace snapthrough {
namespace {

/// Limits of the comparison of meshes, ratios.
struct VibrationLimits {
  /// Share of the largest asked eigenvalue of a state, or of that of a member alone, below which eigenvalues
  /// count as zero: twice the digits to which natural_motions() finds them, for the motions of free bodies.
  static constexpr double zero = 1e-9;
};

/// Natural motions at each requested load factor, on one mesh.
struct Level {
  std::shared_ptr<const Structure> structure;
  std::vector<std::optional<NaturalMotions>> rows;
  double unit = 1.0;
  double scale = 0.0;  ///< MassMatrix::scale
  Result result;       ///< the states, as a static analysis gives them
};

Level solve_on(const Analysis& analysis, std::shared_ptr<const Structure> structure, const HeldRows& held,
               const Hooks& hooks) {
  Level out;
  out.structure = std::move(structure);
  out.rows.resize(analysis.load_factors.size());
  out.result.diagnostics = {0, 0, 0, 0, 0.0, {}, {}};
  FrequencyProbe probe(*out.structure, analysis);
  out.unit = probe.unit();
  out.scale = probe.scale();
  Analysis states = analysis;
  states.type = AnalysisType::static_;
  states.unstable = Unstable::follow;
  states.output.frequencies = 0;
  run_static(states, *out.structure, held, hooks, out.result,
             [&](std::size_t row, const Eigen::VectorXd& y, double lambda) {
               out.rows[row] = probe.at(y, lambda);
               if (out.rows[row]) out.result.diagnostics.factorizations += out.rows[row]->factorizations;
             });
  return out;
}

/// Error estimates of one rank of eigenvalues at one load factor, by the differences between meshes.
struct RankError {
  Differences differences;
  std::optional<double> error;  ///< absolute, scaled
};

/// Adds the differences of two meshes. @return whether every estimate is within the accuracy
bool compare(const Level& coarse, const Level& fine, double accuracy,
             std::vector<std::vector<RankError>>& errors) {
  bool within = true;
  for (std::size_t row = 0; row < coarse.rows.size(); ++row) {
    for (RankError& rank : errors[row]) rank.error.reset();
    if (!coarse.rows[row] || !fine.rows[row]) continue;
    const auto& a = coarse.rows[row]->squares;
    const auto& b = fine.rows[row]->squares;
    if (a.size() != b.size()) {
      within = false;
      continue;
    }
    double largest = fine.scale;
    for (const auto& square : b) largest = std::max(largest, std::abs(square));
    errors[row].resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      // relative to a size that is not zero where the eigenvalue is
      const double size = std::max(std::abs(b[i]), VibrationLimits::zero * largest);
      const double relative = errors[row][i].differences.add(size + std::abs(a[i] - b[i]), size);
      errors[row][i].error = relative * size;
      within = within && relative <= std::max(accuracy, VibrationLimits::zero * largest / size);
    }
  }
  return within;
}

Vibration vibration_at(const Analysis& analysis, const Level& level, std::size_t row,
                       const std::vector<RankError>& errors) {
  const NaturalMotions& motions = *level.rows[row];
  Vibration out;
  out.load_factor = analysis.load_factors[row];
  out.frequencies = in_units(motions, *level.structure, level.unit);
  for (std::size_t i = 0; i < motions.squares.size(); ++i) {
    out.error_estimates.push_back(
        i < errors.size() && errors[i].error ? std::optional(*errors[i].error * level.unit) : std::nullopt);
    out.modes.push_back(mode_displacements(*level.structure,
                                           motions.motions.col(static_cast<Eigen::Index>(i)),
                                           analysis.output.points_per_member));
    // the second part of a conjugate pair completes its motion
    const double imaginary = motions.squares[i].imag();
    if (imaginary > 0.0) scale_to_largest(std::span(out.modes).last(2));
    if (imaginary == 0.0) scale_to_largest(out.modes.back());
  }
  return out;
}

/// Reports states without linear vibrations, and those with fewer frequencies than asked for.
void report_missing(const Analysis& analysis, const Level& level, Result& result) {
  for (std::size_t row = 0; row < level.rows.size(); ++row) {
    const double factor = analysis.load_factors[row];
    const bool reached =
        std::find(result.not_reached.begin(), result.not_reached.end(), factor) == result.not_reached.end();
    if (!level.rows[row]) {
      if (reached) {
        fail(result, "no_linear_vibration",
             "one-sided supports touch without pressure at load factor " + number(factor) +
                 ": they act in one direction of the smallest motion and not in the other, so that no "
                 "frequency exists");
      }
      continue;
    }
    const NaturalMotions& found = *level.rows[row];
    if (static_cast<int>(found.squares.size()) < analysis.modes) {
      fail(result, "fewer_modes",
           "the structure has only " + std::to_string(found.squares.size()) +
               " natural motions on its mesh; " + std::to_string(analysis.modes) + " were asked for");
    } else if (!found.complete || !found.converged) {
      fail(result, "no_convergence",
           "the natural motions at load factor " + number(factor) +
               (found.complete ? " did not converge" : " are not all found, by an inertia count"));
    }
  }
}

void report_rows(const Analysis& analysis, const Level& level,
                 const std::vector<std::vector<RankError>>& errors, Result& result) {
  auto& out = result.vibrations.emplace();
  for (std::size_t row = 0; row < level.rows.size(); ++row)
    if (level.rows[row] && !level.rows[row]->squares.empty())
      out.push_back(vibration_at(analysis, level, row, errors[row]));
  report_missing(analysis, level, result);
}

}  // namespace

void run_vibration(const Analysis& analysis, const Structure& structure, const HeldRows& held,
                   const Hooks& hooks, Result& result) {
  const double accuracy = analysis.discretization.accuracy;
  std::vector<std::vector<RankError>> errors(analysis.load_factors.size());
  Level now = solve_on(analysis, {std::shared_ptr<const Structure>(), &structure}, held, hooks);
  int factorizations = now.result.diagnostics.factorizations;
  bool within = false;
  int level = 0;
  for (;; ++level) {
    if (now.result.failure || hooks.stop.stop_requested()) break;
    auto mesh = finer_mesh(now.structure->mesh);
    if (!mesh) break;
    Level next = solve_on(analysis, std::make_shared<const Structure>(on_mesh(structure, *std::move(mesh))),
                          held, hooks);
    factorizations += next.result.diagnostics.factorizations;
    if (next.result.failure) break;
    within = compare(now, next, accuracy, errors);
    if (within || analysis.discretization.fixed_mesh || level + 1 == Differences::most_levels) break;
    now = std::move(next);
  }
  const std::vector<std::string> skipped = std::move(result.diagnostics.skipped);
  result = std::move(now.result);
  result.diagnostics.skipped = skipped;
  result.diagnostics.factorizations = factorizations;
  report_mesh(*now.structure, level, result);
  report_rows(analysis, now, errors, result);
  result.summary.message = "small free vibrations about the equilibrium at " +
                           std::to_string(result.vibrations->size()) + " of " +
                           std::to_string(analysis.load_factors.size()) + " load factors";
  if (!within && !analysis.discretization.fixed_mesh && !result.failure)
    fail(result, "not_confirmed",
         "finer meshes do not confirm all frequencies within the accuracy asked for");
}

}  // namespace snapthrough
