#pragma once
/// @file
/// Arches whose critical loads are followed over a parameter.

#include <string>

#include "tests/solver/structures.h"

namespace snapthrough::testing {

/// A clamped arch of 60 degrees with a load off its crown, which has a limit point; on a base of stiffness k.
inline void add_arch(Model& model, const std::string& name, double height, double k, double force = 1.0) {
  model.nodes.push_back({name + "0", 0.0, height});
  model.nodes.push_back({name + "1", 10.0, height});
  model.members.push_back({name, name + "0", name + "1", "s", ArcCurve{-60.0}, false, false});
  for (const char* end : {"0", "1"}) {
    Support support;
    support.node = name + end;
    support.x = support.y = support.rotation = true;
    model.supports.push_back(support);
  }
  PointLoad load;
  load.at = Location{};
  load.at.member = name;
  load.at.fraction = 0.45;
  load.force = {0.0, -force};
  model.loads.push_back(load);
  if (k > 0.0) {
    Foundation base;
    base.id = "base of " + name;
    base.member = name;
    base.stiffness = k;
    model.foundations.push_back(base);
  }
}

inline Model one_arch(double k) {
  Model model;
  model.sections = {{"s", 1e5, 1.0, {}}};
  add_arch(model, "arch", 0.0, k);
  return model;
}

/// Pinned circular arch, R = 100, half angle 10 degrees, EA = 420, with a unit load down at its crown: the
/// path has a maximum and a minimum of the load up to EI = 254, and none beyond.
inline Model pinned_shallow_arch(double EI) {
  Model model = arch(20.0, 420.0, EI);
  model.loads = {PointLoad{{"", "arch", 0.5}, {0.0, -1.0}, 0.0, Pattern::proportional}};
  return model;
}

}  // namespace snapthrough::testing
