/// What the contract allows and this version does not do yet, one entry each. To implement one, delete its
/// entry.

#include "solver/check/check_parts.h"

namespace snapthrough::checks {

namespace {

/// Reports every use of one feature of the contract.
struct Feature {
  const char* what;  ///< completes the sentence "... is not supported yet"
  void (*find)(const Place& root, const Model& model, const Analysis& analysis, const char* what);
};

void report(const Place& place, const char* what) {
  place.report("unsupported", std::string(what) + " is not supported by this version yet");
}

/// Reports at `/model/<list>/<index>/<field>` for each item that has the feature (at the item when field is
/// empty).
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

/// Small displacements lose no stability: only equilibrium states can be asked for.
void find_linear_path(const Place& root, const Model&, const Analysis& analysis, const char* what) {
  if (analysis.geometry == Geometry::linear && analysis.type != AnalysisType::static_) {
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
    {"geometry linear with another analysis type than static", find_linear_path},
};

}  // namespace

void check_supported(const Place& root, const Model& model, const Analysis& analysis) {
  for (const Feature& feature : kNotYet) {
    feature.find(root, model, analysis, feature.what);
  }
}

}  // namespace snapthrough::checks
