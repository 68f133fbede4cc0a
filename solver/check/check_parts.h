#pragma once
/// @file
/// Parts of check(): one function per list of the model, which reports its findings. Reentrant.

#include <cstddef>
#include <string>
#include <unordered_set>

#include "solver/check/check_place.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::checks {

/// All ids that other objects may refer to.
struct Names {
  Ids nodes{"node"};
  Ids sections{"section"};
  Ids members{"member"};
  Ids monitors{"monitor"};
  std::unordered_set<std::string> rods;  ///< one-sided members
};

// For each function, `model` is the place "/model" and `names` is complete.
void check_texts(const Place& model, const Model& data);
void check_nodes(const Place& model, const Model& data, Names& names);
void check_sections(const Place& model, const Model& data, Names& names);
void check_members(const Place& model, const Model& data, Names& names);
void check_supports(const Place& model, const Model& data, const Names& names);
void check_springs(const Place& model, const Model& data, const Names& names);
void check_foundations(const Place& model, const Model& data, const Names& names);
void check_loads(const Place& model, const Model& data, const Names& names);
void check_imperfections(const Place& model, const Model& data, const Names& names);
/// Checks a worst imperfection against the rest of the request.
void check_worst_imperfection(const Place& root, const Model& data, const Analysis& analysis);
/// Checks supports beside rigid obstacles. @pre every other check of the request found nothing
void check_obstacles(const Place& root, const Model& model, const Analysis& analysis);
void check_masses(const Place& model, const Model& data, const Names& names);
void check_monitors(const Place& model, const Model& data, Names& names);

/// Requires ascending fractions, at most `most` of them; `check_value(place, value)` checks each value.
template <class T, class Check>
void check_along(const Place& field, const Along<T>& along, std::size_t most, Check check_value) {
  const Place place = field / "along";
  require_count(place, along.size(), most);
  double previous = -1.0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const auto& [fraction, value] = along[i];
    require_next_fraction(place / i / std::size_t{0}, fraction, previous);
    check_value(place / i / std::size_t{1}, value);
    previous = fraction;
  }
}

/// Checks the law of what acts at one place, whose numbers must be constant.
/// @param owner place of the spring or joint; its law is at `law` there
void check_law_at_one_place(const Place& owner, const ReactionLaw& law);
/// Requires a node of the model, or a member with a fraction in [0, 1].
void check_location(const Place& place, const Location& location, const Names& names);
/// Requires a member of the model that is not one-sided.
bool require_beam(const Place& place, const std::string& member, const Names& names);
/// Requires what one-sided members cannot have to be left out.
void check_rod(const Place& place, const Member& rod);
/// Checks cables (Member::cable); where the model has some, also whether the analysis takes them.
/// @param root the place ""
void check_cables(const Place& root, const Model& model, const Analysis& analysis, const Names& names);
/// Section of a member; null: it names a section that does not exist.
[[nodiscard]] const Section* section_of(const Member& member, const Model& data, const Names& names);
/// Checks the pretension of a member. @pre member.pretension; the names of nodes and sections are known
void check_pretension(const Place& place, const Member& member, const Model& data, const Names& names);
/// Checks the pretension of a spring. @pre spring.pretension; the names of nodes are known
void check_pretension(const Place& place, const Spring& spring, const Model& data, const Names& names);
/// Nodes whose rotation no member, support or spring to ground resists.
[[nodiscard]] std::unordered_set<std::string> nodes_free_to_turn(const Model& model);
/// Checks the ends of a spring between two nodes.
/// @param free_to_turn nodes_free_to_turn(), read for rotational springs only
/// @pre spring.to
void check_other_end(const Place& place, const Spring& spring,
                     const std::unordered_set<std::string>& free_to_turn, const Names& names);

/// Requires an action that is proportional to the load factor and not zero.
void check_something_proportional(const Place& model, const Model& data, const Analysis& analysis);

/// @param root the place ""
void check_analysis(const Place& root, const Model& model, const Analysis& analysis, const Names& names);

/// Reports features of the contract that this version does not implement, with code "unsupported".
void check_supported(const Place& root, const Model& model, const Analysis& analysis);

}  // namespace snapthrough::checks
