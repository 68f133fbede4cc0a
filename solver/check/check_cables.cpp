/// Checks of members that hang between their nodes.

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "solver/check/check_parts.h"

namespace snapthrough::checks {

namespace {

/// Self weights of a model.
struct Weights {
  double constant_x = 0.0;
  double constant_y = 0.0;
  bool grows = false;
};

Weights weights_of(const Model& model) {
  Weights out;
  for (const Load& load : model.loads) {
    const auto* weight = std::get_if<SelfWeight>(&load);
    if (weight == nullptr) continue;
    if (weight->pattern == Pattern::proportional) {
      out.grows = out.grows || weight->gravity[0] != 0.0 || weight->gravity[1] != 0.0;
    } else {
      out.constant_x += weight->gravity[0];
      out.constant_y += weight->gravity[1];
    }
  }
  return out;
}

/// Reports what a cable cannot have. @param place of the member
void check_cable(const Place& place, const Member& cable, const Section* section, const Weights& weights) {
  if (cable.reaction != Reaction::tension_only)
    (place / "reaction").report("not_supported", "a cable only pulls: leave reaction out");
  if (cable.pretension && cable.pretension->force)
    (place / "pretension" / "force")
        .report("not_supported", "the force of a cable varies along it: give unstressed_length");
  if (weights.grows)
    (place / "cable")
        .report("not_supported",
                "a cable hangs under its weight from the first load factor on: self_weight needs "
                "\"pattern\": \"constant\"");
  else if (!(std::hypot(weights.constant_x, weights.constant_y) > 0.0))
    (place / "cable")
        .report("no_weight",
                "a cable hangs under its weight: the model needs a load self_weight with \"pattern\": "
                "\"constant\" (a rod, \"reaction\": \"tension_only\", is straight without)");
  if (section == nullptr) return;
  if (section->mass && !(section->mass->least() > 0.0))
    (place / "section")
        .report("no_weight", "a cable hangs under its weight: its section needs a mass above 0");
  if (section->EA.varies() || (section->mass && section->mass->varies()))
    (place / "section").report("not_supported", "EA and mass of a cable do not vary along it");
}

/// Reports temperatures that vary along a cable.
void check_temperatures(const Place& model, const Model& data) {
  for (std::size_t i = 0; i < data.members.size(); ++i) {
    const auto varies = [&](const Load& load) {
      const auto* heat = std::get_if<TemperatureLoad>(&load);
      return heat != nullptr && heat->member == data.members[i].id && !heat->change_along.empty();
    };
    if (data.members[i].cable && std::ranges::any_of(data.loads, varies))
      (model / "members" / i / "cable")
          .report("not_supported", "the change of a cable's temperature does not vary along it");
  }
}

/// Reports analyses that small displacements or vibrations of a cable would need.
void check_analysis_of_cables(const Place& root, const Model& model, const Analysis& analysis) {
  if (analysis.traits().linearised)
    (root / "analysis" / "type")
        .report(
            "unsupported",
            "linearised buckling needs a stiffness that does not depend on the displacements, which a cable "
            "does not have; type critical takes cables");
  else if (analysis.geometry == Geometry::linear)
    (root / "analysis" / "geometry")
        .report("unsupported", "a cable hangs in its deformed shape: geometry must be nonlinear");
  if (analysis.traits().vibrates || analysis.output.frequencies > 0)
    (root / "analysis" / (analysis.traits().vibrates ? "type" : "output"))
        .report("unsupported",
                "a cable has no vibrations of its own: make it a chain of rods (\"reaction\": "
                "\"tension_only\") with point masses at their nodes");
  for (std::size_t i = 0; i < model.imperfections.size(); ++i)
    if (std::holds_alternative<ModeImperfection>(model.imperfections[i]))
      (root / "model" / "imperfections" / i)
          .report("not_supported", "buckling modes need a model without cables");
}

}  // namespace

void check_cables(const Place& root, const Model& model, const Analysis& analysis, const Names& names) {
  if (std::ranges::none_of(model.members, &Member::cable)) return;
  const Weights weights = weights_of(model);
  for (std::size_t i = 0; i < model.members.size(); ++i)
    if (model.members[i].cable)
      check_cable(root / "model" / "members" / i, model.members[i],
                  section_of(model.members[i], model, names), weights);
  check_temperatures(root / "model", model);
  check_analysis_of_cables(root, model, analysis);
}

}  // namespace snapthrough::checks
