/// Checks of members that hang between their nodes.

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>
#include <variant>

#include "solver/check/check_parts.h"
#include "solver/resolve/rods.h"

namespace snapthrough::checks {

namespace {

/// Whether some self weight of a model grows with the load factor.
bool weight_grows(const Model& model) {
  return std::ranges::any_of(model.loads, [](const Load& load) {
    const auto* weight = std::get_if<SelfWeight>(&load);
    return weight != nullptr && weight->pattern == Pattern::proportional &&
           (weight->gravity[0] != 0.0 || weight->gravity[1] != 0.0);
  });
}

/// Reports what a cable cannot have. @param place of the member
/// @param has_weight, grows whether the model has a constant self weight, and one that grows
void check_cable(const Place& place, const Member& cable, const Section* section, bool has_weight,
                 bool grows) {
  if (cable.reaction != Reaction::tension_only)
    (place / "reaction").report("not_supported", "a cable only pulls: leave reaction out");
  if (cable.pretension && cable.pretension->force)
    (place / "pretension" / "force")
        .report("not_supported", "the force of a cable varies along it: give unstressed_length");
  if (grows)
    (place / "cable")
        .report("not_supported",
                "a cable hangs under its weight from the first load factor on: self_weight needs "
                "\"pattern\": \"constant\"");
  else if (!has_weight)
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
  std::unordered_set<std::string> varies;
  for (const Load& load : data.loads) {
    const auto* heat = std::get_if<TemperatureLoad>(&load);
    if (heat != nullptr && !heat->change_along.empty()) varies.insert(heat->member);
  }
  for (std::size_t i = 0; i < data.members.size(); ++i)
    if (data.members[i].cable && varies.contains(data.members[i].id))
      (model / "members" / i / "cable")
          .report("not_supported", "the change of a cable's temperature does not vary along it");
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
  const auto [x, y] = gravity_of(model, Pattern::constant);
  const bool has_weight = std::hypot(x, y) > 0.0;
  const bool grows = weight_grows(model);
  for (std::size_t i = 0; i < model.members.size(); ++i)
    if (model.members[i].cable)
      check_cable(root / "model" / "members" / i, model.members[i],
                  section_of(model.members[i], model, names), has_weight, grows);
  check_temperatures(root / "model", model);
  check_analysis_of_cables(root, model, analysis);
}

}  // namespace snapthrough::checks
