/// Checks of worst imperfections: one per model, and analyses that have a first critical load.

#include <string>
#include <variant>

#include "solver/check/check_parts.h"
#include "solver/model/limits.h"

namespace snapthrough::checks {

namespace {

/// Reports analyses whose path does not begin at the unloaded structure with a growing load factor.
void check_path(const Place& place, const Analysis& analysis) {
  if (!analysis.traits().reports_path) return;
  if (analysis.start)
    (place / "start")
        .report("not_supported",
                "a worst imperfection is sought from the unloaded structure: a path with it has no start");
  if (analysis.step.direction < 0.0) {
    (place / "step" / "direction")
        .report("not_supported",
                "a worst imperfection is sought along a growing load factor: change the signs of the "
                "proportional actions instead");
  }
}

}  // namespace

void check_worst_imperfection(const Place& root, const Model& data, const Analysis& analysis) {
  int count = 0;
  for (std::size_t i = 0; i < data.imperfections.size(); ++i) {
    if (!std::holds_alternative<WorstImperfection>(data.imperfections[i])) continue;
    const Place place = root / "model" / "imperfections" / i;
    if (++count > 1) place.report("too_many", "a model has at most one worst imperfection");
    if (analysis.traits().linearised || analysis.geometry == Geometry::linear) {
      (place / "type")
          .report("not_supported",
                  "a worst imperfection lowers the first critical load of a path: linearised buckling and "
                  "small displacements have none");
    }
  }
  if (count == 0) return;
  if (data.members.size() > kMaxWorstMembers) {
    (root / "model" / "members")
        .report("too_many", "a worst imperfection is sought in models of at most " +
                                std::to_string(kMaxWorstMembers) + " members, got " +
                                std::to_string(data.members.size()));
  }
  check_path(root / "analysis", analysis);
}

}  // namespace snapthrough::checks
