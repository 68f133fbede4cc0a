#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/accuracy/buckling_loads.h"
#include "solver/analysis/analyses.h"
#include "solver/discrete/mechanism.h"
#include "solver/events/buckling.h"
#include "solver/events/touching.h"
#include "solver/model/id_index.h"
#include "solver/numeric/number_text.h"
#include "solver/report/mode.h"
#include "solver/report/neutral_motion.h"
#include "solver/report/result_parts.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Which one-sided foundations count as glued, in words.
std::string contact_text(const Structure& structure, const Model& model, const FrozenContact& contact) {
  const std::optional<Model> joined = with_joined_supports(model);
  const Model& laws = joined ? *joined : model;
  struct Share {
    double glued = 0.0;
    double all = 0.0;
  };
  std::map<std::string, Share> shares;  // of foundations that were cut into parts, too
  for (std::size_t i = 0; i < laws.foundations.size(); ++i) {
    const Foundation& foundation = laws.foundations[i];
    if (foundation.reaction == Reaction::bilateral || foundation.stiffness == 0.0) continue;
    const int member = index_of(laws.members, foundation.member);
    Share& share = shares[foundation.id];
    share.all += (foundation.range[1] - foundation.range[0]) * structure.axes[member]->length() /
                 structure.scales.length;
    for (int e = structure.mesh.first[member]; e < structure.mesh.first[member + 1]; ++e)
      share.glued +=
          length_of_element(structure, e) * structure.elements->frozen_share(contact, e, static_cast<int>(i));
  }
  std::string text = joined ? "; one-sided supports that oppose one another act as bilateral ones" : "";
  for (const auto& [id, share] : shares)
    text += "; one-sided foundation " + id + " counted as glued on " +
            rounded(100.0 * share.glued / share.all) + " % of its range";
  return text;
}

/// Reports the mesh of the loads and the largest error of them; loads that finer meshes do not confirm within
/// the accuracy are a failure.
void report_errors(const Analysis& analysis, const BucklingLoads& loads, Result& result) {
  report_mesh(*loads.structure, loads.level, result);
  if (analysis.discretization.fixed_mesh || loads.errors.empty()) return;
  const double accuracy = analysis.discretization.accuracy;
  const auto is_confirmed = [accuracy](const std::optional<double>& error) {
    return error && *error <= accuracy;
  };
  double largest = 0.0;
  std::string unconfirmed;
  for (std::size_t i = 0; i < loads.errors.size(); ++i) {
    largest = std::max(largest, loads.errors[i].value_or(0.0));
    if (is_confirmed(loads.errors[i])) continue;
    unconfirmed += "; " + number(result.buckling->load_factors[i]) +
                   (loads.errors[i] ? ": estimated error " + rounded(*loads.errors[i])
                                    : std::string(": finer meshes have another number of modes"));
  }
  result.discretization.estimated_accuracy = largest;
  if (unconfirmed.empty() || result.failure) return;
  fail(result, "not_confirmed",
       "finer meshes do not confirm all buckling loads within the accuracy asked for" + unconfirmed);
  if (is_confirmed(loads.errors.front())) return;
  withdraw_critical_load(result);
}

}  // namespace

void report_buckling(const Analysis& analysis, FoundLoads found, Result& result) {
  BucklingResult out{std::move(found.loads), std::move(found.errors), std::move(found.modes)};
  Summary& summary = result.summary;
  if (found.negative_at_start > 0) {
    summary.termination = "unstable_at_start";
    summary.message =
        "the constant actions alone exceed " + std::to_string(found.negative_at_start) + " buckling loads";
  } else if (out.load_factors.empty()) {
    summary.termination = "no_buckling";
    summary.message = "no positive load factor makes the structure buckle";
  } else {
    summary.critical_load_factor = out.load_factors.front();
    summary.critical_type = CriticalType::bifurcation;
    summary.error_estimate = out.error_estimates.front();
    summary.termination = "modes";
    summary.message = "linearised about the reference load";
  }
  if (static_cast<int>(out.load_factors.size()) < analysis.modes && !out.load_factors.empty())
    fail(result, "fewer_modes",
         "only " + std::to_string(out.load_factors.size()) + " of " + std::to_string(analysis.modes) +
             " buckling modes exist on this mesh");
  result.buckling = std::move(out);
}

void run_buckling(const Model& model, const Analysis& analysis, const Structure& first, Result& result) {
  const BucklingLoads loads = buckling_loads(model, analysis, first);
  const Structure& structure = *loads.structure;
  const LinearBuckling& buckling = loads.buckling;
  result.diagnostics.factorizations += loads.factorizations;
  if (buckling.is_mechanism) {
    fail(result, "mechanism",
         "a motion that no support resists is driven by the loads, or has no stiffness but theirs: "
         "there is no state to linearise about");
    return;
  }
  NeutralMotionLog(structure, model, result.neutral_motion).note(buckling.holds, 0.0);
  FoundLoads found{{}, {}, loads.errors, buckling.negative_at_start};
  for (std::size_t i = 0; i < buckling.loads.size(); ++i) {
    found.loads.push_back(buckling.loads[i] / structure.scales.load);
    found.modes.push_back(
        mode_displacements(structure, model, buckling.modes[i], analysis.output.points_per_member));
    scale_to_largest(found.modes.back());
  }
  report_buckling(analysis, std::move(found), result);
  warn_of_touching(structure, buckling.piece, result);
  result.summary.message += contact_text(structure, model, buckling.contact);
  report_errors(analysis, loads, result);
}

ModeOffsets mode_offsets(const Model& model, const Analysis& analysis, const std::stop_token& stop) {
  int highest = 0;
  for (const Imperfection& imperfection : model.imperfections)
    if (const auto* mode = std::get_if<ModeImperfection>(&imperfection))
      highest = std::max(highest, mode->number);
  if (highest == 0) return {};
  Model perfect = model;
  perfect.imperfections.clear();
  Structure structure = make_structure(perfect, analysis.discretization, Geometry::nonlinear);
  structure.free_motions = free_motions(perfect);
  structure.stop = stop;
  StructuralProblem problem(structure);
  const LinearBuckling buckling = linear_buckling(structure, problem, highest, structure.scales.load);
  if (static_cast<int>(buckling.loads.size()) < highest)
    throw std::runtime_error("an imperfection names buckling mode " + std::to_string(highest) +
                             ", but only " + std::to_string(buckling.loads.size()) + " exist");
  ModeOffsets offsets(model.members.size());
  for (const Imperfection& imperfection : model.imperfections) {
    const auto* mode = std::get_if<ModeImperfection>(&imperfection);
    if (mode == nullptr || mode->amplitude == 0.0) continue;
    const auto splines = normal_offsets(structure, model, buckling.modes[mode->number - 1], mode->amplitude);
    for (std::size_t m = 0; m < splines.size(); ++m) offsets[m].push_back(splines[m]);
  }
  return offsets;
}

}  // namespace snapthrough
