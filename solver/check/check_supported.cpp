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

/// Only static analyses are possible with linear geometry, because small displacements lose no stability.
void find_linear_path(const Place& root, const Model&, const Analysis& analysis, const char* what) {
  if (analysis.geometry == Geometry::linear && !analysis.traits().has_rows) {
    report(root / "analysis" / "geometry", what);
  }
}

constexpr Feature kNotYet[] = {
    {"geometry linear with another analysis type than static or vibration", find_linear_path},
};

}  // namespace

void check_supported(const Place& root, const Model& model, const Analysis& analysis) {
  for (const Feature& feature : kNotYet) {
    feature.find(root, model, analysis, feature.what);
  }
}

}  // namespace snapthrough::checks
