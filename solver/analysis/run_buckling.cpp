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
#include "solver/discrete/build_structure.h"
#include "solver/discrete/free_motions.h"
#include "solver/events/buckling.h"
#include "solver/events/touching.h"
#include "solver/numeric/number_text.h"
#include "solver/report/mode.h"
#include "solver/report/neutral_motion.h"
#include "solver/report/result_parts.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Shares of a foundation's range, ratios. Chosen: they decide what a message says, and no number.
struct ContactShareLimits {
  static constexpr double touching = 1e-6;  ///< share that is within the tolerance of touching
  static constexpr double same = 0.01;      ///< difference of shares that is ignored
};

/// Difference of axial forces, over the largest, that is ignored. Chosen: it decides whether a warning is
/// given.
struct LawLimits {
  static constexpr double same = 0.01;
};

/// Bilateral part and total of a foundation's range, scaled lengths.
struct BilateralLength {
  double bilateral = 0.0;
  double all = 0.0;

  [[nodiscard]] double share() const { return bilateral / all; }
};

/// Contact of one-sided supports by id; the parts of a divided foundation are summed.
struct ContactShares {
  std::map<std::string, BilateralLength> foundations;
  std::map<std::string, bool> springs;  ///< by kind and id; rods are members
};

ContactShares shares_of(const Structure& structure, const StructuralProblem& problem,
                        const FrozenContact& contact) {
  const ResolvedModel& laws = *structure.laws;
  ContactShares out;
  for (std::size_t i = 0; i < laws.foundations.size(); ++i) {
    const ResolvedFoundation& foundation = laws.foundations[i];
    if (!is_one_sided(foundation)) continue;
    const int member = foundation.member;
    BilateralLength& length = out.foundations[foundation.id];
    length.all += (foundation.range[1] - foundation.range[0]) * structure.axes[member]->length() /
                  structure.scales.length;
    for (int e = structure.mesh.first[member]; e < structure.mesh.first[member + 1]; ++e)
      length.bilateral += length_of_element(structure, e) *
                          structure.elements->contacts().share(contact, e, static_cast<int>(i));
  }
  const TouchingMarks all_springs{std::vector<char>(contact.contacts.size(), 0),
                                  std::vector<char>(contact.element_springs.size(), 1),
                                  std::vector<char>(contact.node_springs.size(), 1)};
  for (const TouchingSupports::Spring& spring : problem.contact().touching(all_springs, &contact).springs) {
    const ResolvedSpring& law = laws.springs[static_cast<std::size_t>(spring.spring)];
    if (is_one_sided(law))
      out.springs[(law.rod ? "member " : "spring ") + law.id] = spring.touch == Touch::acts;
  }
  return out;
}

/// Share in per cent; shares within the tolerance of touching print as zero.
std::string percent(double share) {
  return rounded(share > ContactShareLimits::touching ? 100.0 * share : 0.0) + " %";
}

/// Message on the one-sided foundations that count as bilateral.
std::string contact_text(const ContactShares& shares, bool joined) {
  std::string text = joined ? "; one-sided supports that oppose one another act as bilateral ones" : "";
  for (const auto& [id, length] : shares.foundations)
    text += "; one-sided foundation " + id + " counted as bilateral on " + rounded(100.0 * length.share()) +
            " % of its range";
  return text;
}

/// Whether contact can depend on the load factor. The linear response to a single set of actions without gaps
/// is proportional to the load factor, and its contact constant.
bool contact_depends_on_load(const Structure& structure) {
  const ResolvedModel& laws = *structure.laws;
  const auto has_gap = [](const auto& support) { return is_one_sided(support) && support.gap > 0.0; };
  return structure.has_constant || std::any_of(laws.springs.begin(), laws.springs.end(), has_gap) ||
         std::any_of(laws.foundations.begin(), laws.foundations.end(), has_gap);
}

/// Warns when contact under the critical load differs from that under the reference load, on which the
/// linearised analysis is based.
void warn_of_changed_contact(const Structure& structure, StructuralProblem& problem,
                             const LinearBuckling& buckling, Result& result) {
  if (!structure.traits.one_sided || !result.summary.critical_load_factor ||
      !contact_depends_on_load(structure))
    return;
  const auto contact = linear_contact(problem, buckling.loads.front(), result.diagnostics.factorizations);
  if (!contact) return;
  const ContactShares reference = shares_of(structure, problem, buckling.pressed);
  const ContactShares critical = shares_of(structure, problem, *contact);
  std::string changes;
  for (const auto& [id, length] : reference.foundations) {
    const double then = critical.foundations.at(id).share();
    if (std::abs(then - length.share()) <= ContactShareLimits::same) continue;
    changes += "; foundation " + id + " touches on " + percent(length.share()) +
               " of its range under the reference load and on " + percent(then) + " under the critical load";
  }
  for (const auto& [name, acts] : reference.springs)
    if (critical.springs.at(name) != acts)
      changes += "; " + name + (acts ? " acts" : " does not act") + " under the reference load and " +
                 (acts ? "not" : "acts") + " under the critical load";
  if (changes.empty()) return;
  result.warnings.push_back(
      {"contact_changes", "the load factor " + number(*result.summary.critical_load_factor) +
                              " is not to be relied on, because contact does not stay as "
                              "the linearised analysis takes it" +
                              changes + "; a path or a search for the critical load follows it"});
}

/// Largest difference of axial forces in two states, over the largest of the first.
double axial_difference(const Structure& structure, const VectorXd& first, const VectorXd& second) {
  double largest = 0.0;
  double difference = 0.0;
  for (const ElementDofs& dofs : structure.dofs) {
    const auto axial = first.segment(dofs.s, structure.mesh.order);
    largest = std::max(largest, axial.lpNorm<Eigen::Infinity>());
    difference = std::max(difference,
                          (axial - second.segment(dofs.s, structure.mesh.order)).lpNorm<Eigen::Infinity>());
  }
  return largest > 0.0 ? difference / largest : 0.0;
}

/// Warns when axial forces under the critical load differ from those of the linearised analysis, which grow
/// with the load factor from those under the reference load.
void warn_of_changed_laws(const Structure& structure, StructuralProblem& problem,
                          const LinearBuckling& buckling, Result& result) {
  if (buckling.prestress.size() == 0 || !result.summary.critical_load_factor) return;
  const auto state =
      small_displacement_state(problem, buckling.loads.front(), result.diagnostics.factorizations);
  const double difference = state ? axial_difference(structure, buckling.prestress, *state) : 0.0;
  if (state && difference <= LawLimits::same) return;
  const std::string change = state
                                 ? "the largest axial force differs by " + rounded(100.0 * difference) + " %"
                                 : "no equilibrium with small displacements was found";
  result.warnings.push_back(
      {"laws_change",
       "the load factor " + number(*result.summary.critical_load_factor) +
           " is not to be relied on, because reactions and moments by laws do not grow in proportion to "
           "the load: under the critical load " +
           change +
           "; a reference load near the critical load makes the linearised analysis exact, a "
           "path or a search for the critical load follows the laws"});
}

/// Sentence on buckling loads that an inertia count does not confirm.
constexpr const char* kIncomplete =
    "an inertia count does not confirm that the lowest buckling loads were all found";

/// Reports the largest error of the buckling loads; fails when a load is not confirmed within the accuracy.
void report_errors(const Analysis& analysis, Result& result) {
  const BucklingResult& buckling = *result.buckling;
  if (analysis.discretization.fixed_mesh || buckling.load_factors.empty()) return;
  double largest = 0.0;
  bool is_critical_confirmed = true;
  std::string unconfirmed;
  for (std::size_t i = 0; i < buckling.load_factors.size(); ++i) {
    const std::optional<double>& error = buckling.error_estimates[i];
    largest = std::max(largest, error.value_or(0.0));
    if (error && *error <= analysis.discretization.accuracy) continue;
    if (buckling.load_factors[i] == result.summary.critical_load_factor) is_critical_confirmed = false;
    unconfirmed +=
        "; " + number(buckling.load_factors[i]) +
        (error ? ": estimated error " + rounded(*error) : ": finer meshes have another number of modes");
  }
  result.discretization.estimated_accuracy = largest;
  if (unconfirmed.empty() || result.failure) return;
  fail(result, "not_confirmed",
       "finer meshes do not confirm all buckling loads within the accuracy asked for" + unconfirmed);
  if (!is_critical_confirmed) withdraw_critical_load(result);
}

/// Converts the loads of one sense of the proportional actions to the model's units.
FoundLoads found_loads(const ResolvedModel& model, const Analysis& analysis, const BucklingLoads& loads) {
  const LinearBuckling& buckling = loads.buckling;
  FoundLoads found{{}, {}, loads.errors, buckling.negative_at_start};
  std::vector<double> lengths;
  for (const auto& axis : loads.structure->axes) lengths.push_back(axis->length());
  for (std::size_t i = 0; i < buckling.loads.size(); ++i) {
    found.loads.push_back(buckling.loads[i] / loads.structure->scales.load);
    found.modes.push_back(
        mode_displacements(*loads.structure, buckling.modes[i], analysis.output.points_per_member));
    scale_to_largest(found.modes.back());
    std::vector<double> compressions;
    for (const double force : buckling.compressions[i])
      compressions.push_back(force * loads.structure->scales.force);
    found.modes.back().effective_lengths = effective_lengths(model, lengths, compressions);
  }
  return found;
}

/// Merges the loads of both senses by magnitude; loads of the opposite actions become negative.
BucklingResult in_order(FoundLoads found, FoundLoads reversed) {
  BucklingResult out;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < found.loads.size() || j < reversed.loads.size()) {
    const bool is_reversed =
        i == found.loads.size() || (j < reversed.loads.size() && reversed.loads[j] < found.loads[i]);
    FoundLoads& from = is_reversed ? reversed : found;
    const std::size_t at = is_reversed ? j++ : i++;
    out.load_factors.push_back(is_reversed ? -from.loads[at] : from.loads[at]);
    out.error_estimates.push_back(from.errors[at]);
    out.modes.push_back(std::move(from.modes[at]));
  }
  return out;
}

/// Message on the buckling load of the opposite actions.
std::string reversed_text(const FoundLoads& reversed) {
  return reversed.loads.empty()
             ? "; no negative load factor makes the structure buckle"
             : "; the opposite actions make it buckle at load factor " + number(-reversed.loads.front());
}

/// Sentence on a reference load without an equilibrium. @param share of it that has one
std::string unheld_reference(double share) {
  return "no equilibrium with small displacements was found under the reference load (load factor 1), about "
         "which buckling is linearised; supports and joints hold load factors up to about " +
         rounded(share);
}

/// Sets a failure when some, but fewer than the requested modes exist.
void require_modes(const Analysis& analysis, const FoundLoads& found, Result& result) {
  if (static_cast<int>(found.loads.size()) >= analysis.modes || found.loads.empty()) return;
  fail(result, "fewer_modes",
       "only " + std::to_string(found.loads.size()) + " of " + std::to_string(analysis.modes) +
           " buckling modes exist on this mesh");
}

}  // namespace

void report_buckling(const Analysis& analysis, FoundLoads found, FoundLoads reversed, Result& result) {
  Summary& summary = result.summary;
  if (found.negative_at_start > 0) {
    // loads above a lost stability belong to higher modes and are not critical
    summary.termination = "unstable_at_start";
    summary.message =
        "the constant actions alone exceed " + std::to_string(found.negative_at_start) + " buckling loads";
    result.buckling.emplace();
    return;
  }
  if (found.loads.empty()) {
    summary.termination = "no_buckling";
    summary.message = "no positive load factor makes the structure buckle";
  } else {
    summary.critical_load_factor = found.loads.front();
    summary.critical_type = CriticalType::bifurcation;
    summary.error_estimate = found.errors.front();
    summary.termination = "modes";
    summary.message = "linearised about the reference load";
  }
  if (analysis.reversed) summary.message += reversed_text(reversed);
  require_modes(analysis, found, result);
  require_modes(analysis, reversed, result);
  result.buckling = in_order(std::move(found), std::move(reversed));
}

void run_buckling(const Analysis& analysis, const Structure& first, Result& result) {
  const ResolvedModel& model = *first.model;
  const BucklingLoads loads = buckling_loads(analysis, first);
  const Structure& structure = *loads.structure;
  const LinearBuckling& buckling = loads.buckling;
  result.diagnostics.factorizations += loads.factorizations;
  if (buckling.is_mechanism) {
    fail(result, "mechanism",
         "a motion that no support resists is driven by the loads, or has no stiffness but theirs: "
         "there is no state to linearise about");
    return;
  }
  if (buckling.held_share) {
    fail(result, "not_held", unheld_reference(*buckling.held_share));
    return;
  }
  NeutralMotionLog(structure, result.neutral_motion).note(buckling.holds, 0.0);
  report_mesh(structure, loads.level, result);
  FoundLoads reversed;
  if (analysis.reversed && buckling.negative_at_start == 0) {
    const BucklingLoads others = buckling_loads(analysis, first, LoadSense::reversed);
    result.diagnostics.factorizations += others.factorizations;
    reversed = found_loads(model, analysis, others);
    if (others.level > loads.level) report_mesh(*others.structure, others.level, result);
  }
  report_buckling(analysis, found_loads(model, analysis, loads), std::move(reversed), result);
  warn_of_touching(structure, buckling.piece, result);
  StructuralProblem problem(structure);
  // without one-sided supports no contact was frozen
  const ContactShares shares =
      structure.traits.one_sided ? shares_of(structure, problem, buckling.contact) : ContactShares{};
  result.summary.message += contact_text(shares, structure.laws != structure.model);
  report_errors(analysis, result);
  if (!buckling.complete && buckling.negative_at_start == 0) {
    withdraw_critical_load(result);
    fail(result, "no_convergence", kIncomplete);
  }
  warn_of_changed_contact(structure, problem, buckling, result);
  warn_of_changed_laws(structure, problem, buckling, result);
}

ModeOffsets mode_offsets(const ResolvedModel& model, const Analysis& analysis, const std::stop_token& stop) {
  int highest = 0;
  for (const ResolvedImperfection& imperfection : model.imperfections)
    if (const auto* mode = std::get_if<ModeImperfection>(&imperfection))
      highest = std::max(highest, mode->number);
  if (highest == 0) return {};
  ResolvedModel perfect = model;
  perfect.imperfections.clear();
  Structure structure = make_structure(perfect, analysis.discretization, Geometry::nonlinear);
  structure.free_motions = free_motions(perfect);
  structure.stop = stop;
  StructuralProblem problem(structure);
  const LinearBuckling buckling = linear_buckling(structure, problem, highest, structure.scales.load);
  if (buckling.held_share)
    throw std::runtime_error("an imperfection names a buckling mode: " +
                             unheld_reference(*buckling.held_share));
  if (!buckling.complete)
    throw std::runtime_error(std::string("an imperfection names a buckling mode: ") + kIncomplete);
  if (static_cast<int>(buckling.loads.size()) < highest)
    throw std::runtime_error("an imperfection names buckling mode " + std::to_string(highest) +
                             ", but only " + std::to_string(buckling.loads.size()) + " exist");
  ModeOffsets offsets(model.members.size());
  for (const ResolvedImperfection& imperfection : model.imperfections) {
    const auto* mode = std::get_if<ModeImperfection>(&imperfection);
    if (mode == nullptr || mode->amplitude == 0.0) continue;
    const auto splines = normal_offsets(structure, buckling.modes[mode->number - 1], mode->amplitude);
    for (std::size_t m = 0; m < splines.size(); ++m) offsets[m].push_back(splines[m]);
  }
  return offsets;
}

}  // namespace snapthrough
