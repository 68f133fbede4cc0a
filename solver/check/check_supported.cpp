/// Features of the contract that this version does not implement; delete an entry to enable its feature.

#include "solver/check/check_parts.h"

namespace snapthrough::checks {

namespace {

/// Feature of the contract, with a function that reports all its uses.
struct Feature {
  const char* what;  ///< completes the sentence "... is not supported yet"
  void (*find)(const Place& root, const Model& model, const Analysis& analysis, const char* what);
};

void report(const Place& place, const char* what) {
  place.report("unsupported", std::string(what) + " is not supported by this version yet");
}

/// Reports `/model/<list>/<index>/<field>` for each item with the feature (the item if `field` is empty).
template <class Items, class Has>
void report_items(const Place& root, std::string_view list, const Items& items, std::string_view field,
                  const char* what, Has has) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (has(items[i])) {
      const Place item = root / "model" / list / i;
      report(field.empty() ? item : item / field, what);
    }
  }
}

/// Only static analyses are possible with linear geometry, because small displacements lose no stability.
void find_linear_path(const Place& root, const Model&, const Analysis& analysis, const char* what) {
  if (analysis.geometry == Geometry::linear && analysis.type != AnalysisType::static_ &&
      analysis.type != AnalysisType::vibration) {
    report(root / "analysis" / "geometry", what);
  }
}

void find_one_sided_shear_layer(const Place& root, const Model& model, const Analysis&, const char* what) {
  report_items(root, "foundations", model.foundations, "shear_stiffness", what,
               [](const Foundation& foundation) {
                 return foundation.shear_stiffness > 0.0 && foundation.reaction != Reaction::bilateral;
               });
}

constexpr Feature kNotYet[] = {
    {"a one-sided foundation with shear_stiffness", find_one_sided_shear_layer},
    {"geometry linear with another analysis type than static or vibration", find_linear_path},
};

}  // namespace

void check_supported(const Place& root, const Model& model, const Analysis& analysis) {
  for (const Feature& feature : kNotYet) {
    feature.find(root, model, analysis, feature.what);
  }
}

}  // namespace snapthrough::checks
