#pragma once
/// @file
/// Division of members into elements.

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Decay lengths (4 EI / K)^(1/4) of contact per element up to which elements resolve a stiff foundation.
inline constexpr double kResolvedDecays = 3.0;

/// Element as a part of a member, in fractions of its undeformed length.
struct MeshElement {
  int member = 0;
  double from = 0.0;
  double to = 1.0;
  bool operator==(const MeshElement&) const = default;
};

/// Elements in the order of members, along each member from start to end.
struct Mesh {
  int order = 1;
  FoundationRule foundation = FoundationRule::consistent;
  /// Number of decay lengths per element up to which one-sided foundations keep their stiffness; a stiffer
  /// one acts with the stiffness at this limit. Infinite on a given mesh.
  double decay_lengths = std::numeric_limits<double>::infinity();
  std::vector<MeshElement> elements;
  std::vector<int> first;  ///< index of each member's first element; one entry more than members
};

/// @brief Part of an element, in its own [0, 1], within a range of member fractions; snapped to 0 or 1 at
/// coinciding ends. Empty range (from >= to) when they do not overlap.
[[nodiscard]] std::array<double, 2> part_of(const MeshElement& element, std::array<double, 2> range);

/// Purpose of a mesh that the solver chooses.
enum class MeshUse {
  final,  ///< not checked on finer meshes: fine enough for all analyses
  path,   ///< path beyond its first critical point: resolves some half waves per member
  first   ///< coarsest of several meshes whose results are compared
};

/// @brief Purpose of the mesh of an analysis, unless its mesh is fixed.
[[nodiscard]] MeshUse mesh_use(const Analysis& analysis);

/// @brief Makes the mesh of an analysis.
///
/// Elements end at the places of loads and springs, at ends of ranges, at spline knots and at the points of
/// numbers along the member. A fixed number of
/// elements is distributed over the pieces between these places by length, at least one each; if fewer
/// elements than pieces are given, the elements are equal and actions lie inside elements. Otherwise the
/// number follows from the turning of the axis, the decay length (4 EI / K)^(1/4) of foundations, and the
/// half waves or intervals of imperfections. If the mesh will be refined, one-sided foundations get no more
/// elements than the accuracy needs and act with the stiffness that these resolve (`Mesh::decay_lengths`);
/// the error in a load is of third order in their length. Rigid foundations get them on every mesh that is
/// not fixed. A bending law that softens gets short elements at places of action on every mesh that is not
/// fixed.
/// @param use purpose of the mesh, unless it is fixed
[[nodiscard]] Mesh make_mesh(const ResolvedModel& model, const Discretization& discretization,
                             const Axes& axes, MeshUse use = MeshUse::final);

/// Number of elements of a whole mesh, and the order of each.
struct MeshSize {
  long long elements = 0;
  int order = 1;
};

/// @brief Size of the mesh that make_mesh() would make, counted member by member without making it: its
/// memory is that of one member's axis.
/// @pre check() found nothing
[[nodiscard]] MeshSize mesh_size(const ResolvedModel& model, const Discretization& discretization,
                                 MeshUse use = MeshUse::final);

/// Number of elements that a request gives to members. @pre the mesh is fixed
[[nodiscard]] long long given_elements(const std::vector<Member>& members,
                                       const Discretization& discretization);

/// Discretization with which make_mesh() keeps the full stiffness of every foundation.
[[nodiscard]] inline Discretization as_stiff_as_given(Discretization discretization) {
  discretization.full_stiffness = true;
  return discretization;
}

/// @brief Mesh with every element halved. (Raising the order instead would not reveal errors of elements that
/// are too long.)
/// @return empty when the mesh would have too many elements
[[nodiscard]] std::optional<Mesh> finer_mesh(const Mesh& mesh);

/// @brief Transfers a mesh to a changed model: element ends stay at places of action, which may have moved,
/// and keep their proportions in between.
/// @param axes, moved_axes axes of both models, which have the same members
/// @return the mesh; fractions are unchanged where places of action differ in number or are no element ends
[[nodiscard]] Mesh moved_mesh(const Mesh& mesh, const ResolvedModel& model, const Axes& axes,
                              const ResolvedModel& moved, const Axes& moved_axes);

/// @brief Refines a mesh at boundary layers: elements next to places of action are halved towards them until
/// they resolve the decay length.
/// @param decays decay length for each member, in the model's units; infinite: no boundary layer
[[nodiscard]] Mesh layered_mesh(const Mesh& mesh, const ResolvedModel& model, const Axes& axes,
                                const std::vector<double>& decays);

}  // namespace snapthrough
