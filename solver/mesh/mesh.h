#pragma once
/// @file
/// Members cut into elements.

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough {

/// A piece of a member, in fractions of the member's undeformed length.
struct MeshElement {
  int member = 0;
  double from = 0.0;
  double to = 1.0;
};

/// Elements in the order of members, and along each member from start to end.
struct Mesh {
  int order = 1;
  FoundationRule foundation = FoundationRule::consistent;
  /// Decay lengths that an element resolves: a one-sided foundation acts with the stiffness that makes it so
  /// many, at most. Infinite where the mesh was given.
  double decay_lengths = std::numeric_limits<double>::infinity();
  std::vector<MeshElement> elements;
  std::vector<int> first;  ///< first element of each member; one entry more than there are members
};

/// @brief Part of an element, in its own [0, 1], that a range of its member's fractions covers; from 0 or to
/// 1 where it ends at one place with the element. The range is empty where there is none.
[[nodiscard]] std::array<double, 2> part_of(const MeshElement& element, std::array<double, 2> range);

/// What a mesh that the solver chooses is for.
enum class MeshUse {
  final,  ///< nothing will check it: fine enough for every use
  path,   ///< of a path beyond its first critical point: fine enough for some half waves a member
  first   ///< the first of several, each finer, whose results are compared
};

/// @brief The mesh that an analysis asks for.
///
/// Elements end where something begins, ends or acts on a member (loads, springs, ranges, spline knots). A
/// fixed number of elements is shared out between those places by length, at least one each; where there are
/// fewer elements than pieces, they are equal and what lies inside an element acts inside it. Without a fixed
/// mesh the number follows from the turning of the axis, the decay length (4 EI / K)^(1/4) of the foundations
/// and the half waves of imperfections. Where finer meshes will check it, a one-sided foundation asks for no
/// more elements than the accuracy does: beyond that it acts with the stiffness that they resolve
/// (`Mesh::decay_lengths`), whose effect on a load is of the third order in their length.
/// @param use of the mesh where it isn't fixed
[[nodiscard]] Mesh make_mesh(const Model& model, const Discretization& discretization, const Axes& axes,
                             MeshUse use = MeshUse::final);

/// What make_mesh() is to be asked for so that every foundation acts with the stiffness that it has.
[[nodiscard]] inline Discretization as_stiff_as_given(Discretization discretization) {
  discretization.accuracy = 0.0;  // which no stiffness is too large for
  return discretization;
}

/// @brief The next finer mesh, on which the error is much less: every element cut in two. (One order more on
/// the same elements is no witness where an element is too long for what it carries: both err together.)
/// @return empty when it would have too many elements
[[nodiscard]] std::optional<Mesh> finer_mesh(const Mesh& mesh);

/// @brief The same elements on a changed model: their ends stay where something begins, ends or acts, which
/// may have moved, and keep their shares of the pieces between.
/// @param axes, moved_axes of the two models, which have the same members
/// @return fractions as they were on members where such places have come or gone, or elements do not end
/// there
[[nodiscard]] Mesh moved_mesh(const Mesh& mesh, const Model& model, const Axes& axes, const Model& moved,
                              const Axes& moved_axes);

/// @brief The same mesh with the elements beside each place where something acts on a member halved towards
/// it, until they resolve what decays from there.
/// @param decays a length of each member, in the model's units, over which it does; infinite: there is
/// nothing
[[nodiscard]] Mesh layered_mesh(const Mesh& mesh, const Model& model, const Axes& axes,
                                const std::vector<double>& decays);

}  // namespace snapthrough
