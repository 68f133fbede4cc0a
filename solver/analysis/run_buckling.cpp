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
#include "solver/discrete/free_motions.h"
#include "solver/events/buckling.h"
#include "solver/events/touching.h"
#include "solver/model/id_index.h"
#include "solver/numeric/number_text.h"
#include "solver/report/mode.h"
#include "solver/report/neutral_motion.h"
#include "solver/report/result_parts.h"
#include "solver/support/joined_supports.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Of a foundation's range: what is glued of it, and all of it, scaled lengths.
struct GluedLength {
  double glued = 0.0;
  double all = 0.0;

  [[nodiscard]] double share() const { return glued / all; }
};

/// Where one-sided supports act, by their ids: foundations that were cut into parts are one again.
struct ContactShares {
  std::map<std::string, GluedLength> foundations;
  std::map<std::string, bool> springs;
};

/// @param laws the model, its opposite supports joined
ContactShares shares_of(const Structure& structure, const Model& laws, const StructuralProblem& problem,
                        const FrozenContact& contact) {
  ContactShares out;
  for (std::size_t i = 0; i < laws.foundations.size(); ++i) {
    const Foundation& foundation = laws.foundations[i];
    if (!is_one_sided(foundation)) continue;
    const int member = index_of(laws.members, foundation.member);
    GluedLength& length = out.foundations[foundation.id];
    length.all += (foundation.range[1] - foundation.range[0]) * structure.axes[member]->length() /
                  structure.scales.length;
    for (int e = structure.mesh.first[member]; e < structure.mesh.first[member + 1]; ++e)
      length.glued +=
          length_of_element(structure, e) * structure.elements->frozen_share(contact, e, static_cast<int>(i));
  }
  const TouchingMarks all_springs{std::vector<char>(contact.contacts.size(), 0),
                                  std::vector<char>(contact.element_springs.size(), 1),
                                  std::vector<char>(contact.node_springs.size(), 1)};
  for (const TouchingSupports::Spring& spring : problem.touching(all_springs, &contact).springs) {
    const Spring& law = laws.springs[static_cast<std::size_t>(spring.spring)];
    if (is_one_sided(law)) out.springs[law.id] = spring.touch == Touch::acts;
  }
  return out;
}

/// A share in per cent; less than a millionth is the tolerance of touching.
std::string percent(double share) {
  constexpr double kNothing = 1e-6;
  return rounded(share > kNothing ? 100.0 * share : 0.0) + " %";
}

/// Which one-sided foundations count as glued, in words.
std::string contact_text(const ContactShares& shares, bool joined) {
  std::string text = joined ? "; one-sided supports that oppose one another act as bilateral ones" : "";
  for (const auto& [id, length] : shares.foundations)
    text += "; one-sided foundation " + id + " counted as glued on " + rounded(100.0 * length.share()) +
            " % of its range";
  return text;
}

/// Whether contact can differ between load factors: a linear response to one set of actions without gaps is
/// proportional to them, imposed strains and displacements among them, and so is where it touches.
bool contact_depends_on_load(const Structure& structure, const Model& laws) {
  const auto has_gap = [](const auto& support) { return is_one_sided(support) && support.gap > 0.0; };
  return structure.has_constant || std::any_of(laws.springs.begin(), laws.springs.end(), has_gap) ||
         std::any_of(laws.foundations.begin(), laws.foundations.end(), has_gap);
}

/// Warns where one-sided supports touch elsewhere under the critical load than under the reference load,
/// whose contact the linearised analysis keeps.
void warn_of_changed_contact(const Structure& structure, const Model& laws, StructuralProblem& problem,
                             const LinearBuckling& buckling, Result& result) {
  constexpr double kSameShare = 0.01;  // of a foundation's range
  if (!structure.one_sided || !result.summary.critical_load_factor ||
      !contact_depends_on_load(structure, laws))
    return;
  const auto contact = linear_contact(problem, buckling.loads.front(), result.diagnostics.factorizations);
  if (!contact) return;
  const ContactShares reference = shares_of(structure, laws, problem, buckling.pressed);
  const ContactShares critical = shares_of(structure, laws, problem, *contact);
  std::string changes;
  for (const auto& [id, length] : reference.foundations) {
    const double then = critical.foundations.at(id).share();
    if (std::abs(then - length.share()) <= kSameShare) continue;
    changes += "; foundation " + id + " touches on " + percent(length.share()) +
               " of its range under the reference load and on " + percent(then) + " under the critical load";
  }
  for (const auto& [id, acts] : reference.springs)
    if (critical.springs.at(id) != acts)
      changes += "; spring " + id + (acts ? " acts" : " does not act") + " under the reference load and " +
                 (acts ? "not" : "acts") + " under the critical load";
  if (changes.empty()) return;
  result.warnings.push_back(
      {"contact_changes", "the load factor " + number(*result.summary.critical_load_factor) +
                              " is not to be relied on, because contact does not stay as "
                              "the linearised analysis takes it" +
                              changes + "; a path or a search for the critical load follows it"});
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
  StructuralProblem problem(structure);
  const std::optional<Model> joined = with_joined_supports(model);
  const Model& laws = joined ? *joined : model;
  result.summary.message +=
      contact_text(shares_of(structure, laws, problem, buckling.contact), joined.has_value());
  report_errors(analysis, loads, result);
  warn_of_changed_contact(structure, laws, problem, buckling, result);
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
