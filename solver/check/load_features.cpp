#include "solver/check/load_features.h"

#include <variant>

namespace snapthrough {
namespace {

LoadFeatures features(const PointLoad& load) { return {&load.at, load.moment, is_dead(load)}; }
LoadFeatures features(const DistributedLoad&) { return {}; }
LoadFeatures features(const PressureLoad&) { return {}; }
LoadFeatures features(const InitialStrain&) { return {}; }
LoadFeatures features(const SelfWeight&) { return {}; }
LoadFeatures features(const TemperatureLoad&) { return {}; }

}  // namespace

LoadFeatures features_of(const Load& load) {
  return std::visit([](const auto& one) { return features(one); }, load);
}

}  // namespace snapthrough
