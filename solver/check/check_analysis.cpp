/// Checks of the analysis: type, mesh, output.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solver/check/check_parts.h"
#include "solver/check/load_features.h"
#include "solver/discrete/mass_matrix.h"
#include "solver/model/limits.h"
#include "solver/numeric/max_order.h"
#include "solver/support/law.h"

namespace snapthrough::checks {

namespace {

/// Total number of elements; 0 when unknown. Reports members without elements.
long long check_member_elements(const Place& elements, const Model& model, const Discretization& mesh,
                                const Names& names) {
  Ids given("number of elements for member");
  long long total = 0;
  for (const auto& [member, count] : mesh.member_elements) {
    const Place place = elements / member;
    require_beam(place, member, names);
    given.add(place, member);
    if (require_between(place, count, 1, kMaxElementsPerMember)) {
      total += count;
    }
  }
  for (const Member& member : model.members) {
    if (is_rod(member)) {
      continue;
    }
    if (!given.contains(member.id) && mesh.elements == 0) {
      elements.report("missing_field", "no number of elements for member " + in_quotes(member.id));
    }
    total += given.contains(member.id) ? 0 : mesh.elements;
  }
  return total;
}

void check_fixed_mesh(const Place& place, const Model& model, const Discretization& mesh,
                      const Names& names) {
  const Place elements = place / "elements";
  if (mesh.member_elements.empty() || mesh.elements != 0) {
    require_between(elements, mesh.elements, 1, kMaxElementsPerMember);
  }
  const long long total = check_member_elements(elements, model, mesh, names);
  if (total > kMaxElements) {
    elements.report("too_many", "a mesh has at most " + std::to_string(kMaxElements) + " elements, got " +
                                    std::to_string(total));
  }
  require_between(place / "order", mesh.order, 1, kMaxOrder);
}

void check_discretization(const Place& place, const Model& model, const Discretization& mesh,
                          const Names& names) {
  if (mesh.fixed_mesh) {
    check_fixed_mesh(place, model, mesh, names);
    if (mesh.foundation == FoundationRule::lumped &&
        std::ranges::any_of(model.foundations, has_one_sided_layer)) {
      (place / "foundation")
          .report("not_supported", "a one-sided foundation with a shear layer is not lumped: use consistent");
    }
  } else if (!(mesh.accuracy > 0.0 && mesh.accuracy <= kMaxAccuracy)) {
    (place / "accuracy")
        .report("out_of_range", "accuracy must be above 0 and at most " + text(kMaxAccuracy) + ", got " +
                                    text(mesh.accuracy));
  }
}

void check_step(const Place& place, const StepOptions& step) {
  bool positive = true;
  const auto check_one = [&](std::string_view key, const std::optional<double>& value) {
    positive = (!value || require_positive(place / key, *value)) && positive;
  };
  check_one("initial", step.initial);
  check_one("min", step.min);
  check_one("max", step.max);
  const auto above = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b && *a > *b;
  };
  if (positive &&
      (above(step.min, step.initial) || above(step.initial, step.max) || above(step.min, step.max))) {
    place.report("out_of_range", "steps must satisfy min <= initial <= max");
  }
  if (std::abs(step.direction) != 1.0) {
    (place / "direction")
        .report("out_of_range", "direction must be 1 (the load factor begins to grow) or -1 (to fall), got " +
                                    text(step.direction));
  }
}

/// Reports mistakes of a given start: a shape per member, increasing positions, one value per position.
void check_start(const Place& place, const Model& model, const StartState& start, const Names& names) {
  require_finite(place / "load_factor", start.load_factor);
  const Place members = place / "members";
  Ids given("shape of member");
  for (const MemberShape& shape : start.members) {
    const Place at = members / shape.id;
    names.members.require(at, shape.id);
    given.add(at, shape.id);
    const std::size_t count = shape.s.size();
    if (count < 2 || std::ranges::adjacent_find(shape.s, std::greater_equal<>()) != shape.s.end()) {
      (at / "s").report("not_increasing", "s must grow from each place to the next, from 2 places on");
    }
    const std::pair<const char*, const std::vector<double>*> series[] = {{"u", &shape.u},
                                                                         {"v", &shape.v},
                                                                         {"rotation", &shape.rotation},
                                                                         {"axial_force", &shape.axial},
                                                                         {"shear_force", &shape.shear},
                                                                         {"bending_moment", &shape.bend}};
    for (const auto& [key, values] : series) {
      if (values->size() != count) {
        (at / key).report("out_of_range", std::string(key) + " must hold as many numbers as s (" +
                                              std::to_string(count) + "), got " +
                                              std::to_string(values->size()));
      }
    }
  }
  for (const Member& member : model.members) {
    if (!given.contains(member.id)) {
      members.report("unknown_reference", "the start has no member \"" + member.id + "\"");
    }
  }
}

void check_stop(const Place& place, const StopRules& stop, const Names& names) {
  if (stop.limit_points) {
    require_between(place / "limit_points", *stop.limit_points, 1, kMaxSteps);
  }
  if (stop.load_factor) {
    require_interval(place / "load_factor", *stop.load_factor);
  }
  if (stop.monitor) {
    names.monitors.require(place / "monitor" / "id", stop.monitor->id);
    require_interval(place / "monitor" / "range", stop.monitor->range);
  }
  if (stop.steps) {
    require_between(place / "steps", *stop.steps, 1, kMaxSteps);
  }
  if (stop.negative_eigenvalues) {
    require_between(place / "negative_eigenvalues", *stop.negative_eigenvalues, 0, kMaxSteps);
  }
}

/// Reports reversed buckling with one-sided supports: the opposite load has another contact.
void check_reversed(const Place& place, const Model& model, const Analysis& analysis) {
  if (!analysis.reversed || !analysis.traits().linearised) {
    return;
  }
  const auto one_sided = [](const auto& support) { return is_one_sided(support); };
  if (std::any_of(model.members.begin(), model.members.end(), is_rod) ||
      std::any_of(model.springs.begin(), model.springs.end(), one_sided) ||
      std::any_of(model.foundations.begin(), model.foundations.end(), one_sided)) {
    place.report(
        "unsupported",
        "reversed needs bilateral members, springs and foundations: the opposite load has another contact; "
        "change the signs of the proportional actions instead");
  }
}

void check_load_factors(const Place& place, const std::vector<double>& factors) {
  require_count(place, factors.size(), kMaxLoadFactors);
  if (factors.empty()) {
    place.report("empty", place.name() + " must hold at least one load factor");
  }
  for (std::size_t i = 0; i < factors.size(); ++i) {
    require_finite(place / i, factors[i]);
  }
}

/// A static analysis has states at its load factors only.
void check_static_states(const Place& place, const Analysis& analysis) {
  const std::vector<double>& asked = analysis.output.at_load_factors;
  const std::set<double> known(analysis.load_factors.begin(), analysis.load_factors.end());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (!known.contains(asked[i])) {
      (place / i).report("unknown_reference", "a static analysis has states at its load_factors, and " +
                                                  text(asked[i]) + " is none of them");
    }
  }
}

void check_output(const Place& place, const Model& model, const OutputOptions& output) {
  if (output.states == StateOutput::every) {
    require_between(place / "states" / "every", output.every, 1, kMaxSteps);
  } else if (output.states == StateOutput::at_load_factors) {
    check_load_factors(place / "states" / "at_load_factors", output.at_load_factors);
  }
  if (output.path_points) {
    require_between(place / "path_points", *output.path_points, 2, kMaxPathPoints);
  }
  const Place points = place / "points_per_member";
  const auto members = static_cast<long long>(model.members.size());
  if (require_between(points, output.points_per_member, 2, kMaxPointsPerMember) &&
      members * output.points_per_member > kMaxStatePoints) {
    points.report("too_many", "a state holds at most " + std::to_string(kMaxStatePoints) +
                                  " points, members times points_per_member");
  }
}

/// Checks the places whose tangent stiffness is asked for.
void check_stiffness_at(const Place& root, const Analysis& analysis, const Names& names) {
  const Place asked = root / "analysis" / "output" / "stiffness_at";
  const std::vector<Location>& places = analysis.output.stiffness_at;
  require_count(asked, places.size(), kMaxStiffnesses);
  if (!places.empty() && (analysis.traits().linearised || analysis.traits().vibrates))
    asked.report("unsupported",
                 "only states of a critical, path or static analysis have a tangent stiffness");
  for (std::size_t i = 0; i < places.size(); ++i) check_location(asked / i, places[i], names);
}

/// Reports frequencies that are asked for without masses, or where no analysis gives them.
void check_frequencies(const Place& root, const Model& model, const Analysis& analysis, const Names& names) {
  const Place asked = root / "analysis" / "output" / "frequencies";
  const bool vibrates = analysis.traits().vibrates;
  if (!require_between(asked, analysis.output.frequencies, 0, kMaxFrequencies)) return;
  if (!vibrates && analysis.output.frequencies == 0) return;
  if (vibrates && analysis.output.frequencies > 0)
    asked.report("unsupported", "an analysis of type vibration gives as many frequencies as modes");
  if (!analysis.traits().has_rows && !analysis.traits().reports_path)
    asked.report("unsupported", "only points of a path and states of a static analysis have frequencies");
  if (!has_mass(model))
    (root / "model" / "masses")
        .report("no_mass",
                "frequencies need masses: give sections a mass or a density, or give point masses");
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const Member& member = model.members[i];
    if (!is_rod(member) || member.cable || !names.sections.contains(member.section)) continue;
    const Section& section = model.sections[names.sections.index(member.section)];
    if (section.mass && section.mass->largest() > 0.0) {
      (root / "model" / "members" / i / "section")
          .report("unsupported",
                  "a one-sided member has no mass in vibrations: give it a section without mass, and its "
                  "nodes point masses");
    }
  }
}

/// Reports forces that are not dead where buckling is linearised, whose loads then need not be real.
void check_linearised(const Place& root, const Model& model, const Analysis& analysis) {
  const bool follows = std::any_of(model.loads.begin(), model.loads.end(),
                                   [](const Load& load) { return !features_of(load).is_dead; });
  if (!follows) return;
  if (analysis.traits().linearised) {
    (root / "analysis" / "type")
        .report("unsupported",
                "linearised buckling needs dead loads; type critical takes forces that follow or keep "
                "their line, and finds flutter where there are masses");
  }
  for (std::size_t i = 0; i < model.imperfections.size(); ++i)
    if (std::holds_alternative<ModeImperfection>(model.imperfections[i]))
      (root / "model" / "imperfections" / i).report("not_supported", "buckling modes need dead loads");
}

}  // namespace

void check_analysis(const Place& root, const Model& model, const Analysis& analysis, const Names& names) {
  const Place place = root / "analysis";
  require_between(place / "modes", analysis.modes, 1, kMaxModes);
  check_load_factors(place / "load_factors", analysis.load_factors);
  check_discretization(place / "discretization", model, analysis.discretization, names);
  if (analysis.control.type == ControlType::displacement) {
    names.monitors.require(place / "control" / "displacement", analysis.control.monitor);
  }
  check_reversed(place / "reversed", model, analysis);
  check_step(place / "step", analysis.step);
  if (analysis.start) {
    if (!analysis.traits().reports_path) {
      (place / "start").report("unsupported", "only analyses of type path begin with a given state");
    }
    check_start(place / "start", model, *analysis.start, names);
  }
  check_stop(place / "stop", analysis.stop, names);
  if (analysis.branches.limit) {
    require_between(place / "branches" / "limit", *analysis.branches.limit, 1, kMaxSteps);
  }
  check_output(place / "output", model, analysis.output);
  require_count(place / "sensitivities", analysis.sensitivities.size(), kMaxSensitivities);
  check_frequencies(root, model, analysis, names);
  check_stiffness_at(root, analysis, names);
  check_linearised(root, model, analysis);
  if (analysis.traits().has_rows && !analysis.traits().vibrates &&
      analysis.output.states == StateOutput::at_load_factors) {
    check_static_states(place / "output" / "states" / "at_load_factors", analysis);
  }
}

}  // namespace snapthrough::checks
