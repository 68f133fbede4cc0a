#pragma once
/// @file
/// The parts of check(): one function for each list of the model, each adding what it finds. Reentrant.

#include "solver/check/check_place.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::checks {

/// Every id that something else may refer to.
struct Names {
  Ids nodes{"node"};
  Ids sections{"section"};
  Ids members{"member"};
  Ids monitors{"monitor"};
};

// In each, `model` is the place "/model" and `names` is complete.
void check_nodes(const Place& model, const Model& data, Names& names);
void check_sections(const Place& model, const Model& data, Names& names);
void check_members(const Place& model, const Model& data, Names& names);
void check_supports(const Place& model, const Model& data, const Names& names);
void check_springs(const Place& model, const Model& data, const Names& names);
void check_foundations(const Place& model, const Model& data, const Names& names);
void check_loads(const Place& model, const Model& data, const Names& names);
void check_imperfections(const Place& model, const Model& data, const Names& names);
void check_monitors(const Place& model, const Model& data, Names& names);

/// A node of the model, or a member of it with a fraction in [0, 1].
void check_location(const Place& place, const Location& location, const Names& names);

/// Whether the request has anything that grows with the load factor and is not zero.
void check_something_proportional(const Place& model, const Model& data, const Analysis& analysis);

/// @param root the place ""
void check_analysis(const Place& root, const Model& model, const Analysis& analysis, const Names& names);

/// What the contract allows and this version does not do yet: findings with code "unsupported".
void check_supported(const Place& root, const Model& model, const Analysis& analysis);

}  // namespace snapthrough::checks
