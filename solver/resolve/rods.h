#pragma once
/// @file
/// One-sided members as springs between their nodes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "solver/model/model.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Replaces each one-sided member by a spring of the stiffness EA / length between its nodes, along
/// the line through them, or by a cable between them (Spring::cable), and its weight by half at each node.
/// The length, also that which weighs, is the unstressed one where that is given, else the distance of the
/// nodes. A temperature lengthens the spring; a point load without force takes its place in the list of
/// loads.
///
/// The springs follow those of the model, in the order of the members. A compression is a positive force of
/// such a spring. Members, springs and foundations otherwise keep their order.
/// @return empty: no member is one-sided
/// @pre the model passed all checks but that of mechanisms
[[nodiscard]] std::optional<Model> with_rods_as_springs(const Model& model);

/// Accelerations of all self weights of a pattern together; zero: none.
[[nodiscard]] std::array<double, 2> gravity_of(const Model& model, Pattern pattern);

/// Length of the longest rod among the springs of a model, on the undeformed structure; 0: none is a rod.
[[nodiscard]] double longest_rod(const std::vector<ResolvedSpring>& springs);

/// @brief Inserts what was made for each rod, in the order of `rods`, into a list of what was made for each
/// other member, so that both have the order of the members.
/// @param rods springs of a model; those that stand for no rod are skipped
/// @param make called with the index of a spring that stands for a rod
template <class T, class Make>
void insert_rods(const std::vector<ResolvedSpring>& rods, const Make& make, std::vector<T>& list) {
  for (std::size_t i = 0; i < rods.size(); ++i)
    if (rods[i].rod) list.insert(list.begin() + static_cast<std::ptrdiff_t>(*rods[i].rod), make(i));
}

}  // namespace snapthrough
