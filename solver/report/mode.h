#pragma once
/// @file
/// Displacements of eigenvectors and path directions, for results.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Displacements of a vector of unknowns at `points` equally spaced places per member, not normalised.
/// @param mode scaled unknowns; the result is in the model's units
/// @pre points >= 2
[[nodiscard]] Mode mode_displacements(const Structure& structure, const Eigen::VectorXd& mode, int points);

/// @brief Normalises a mode: largest sampled displacement one, first large component positive; by the largest
/// rotation if only rotations occur.
/// @param parts real and imaginary part of one motion, which get one factor; or one mode
/// @return the factor applied
double scale_to_largest(std::span<Mode> parts);
inline double scale_to_largest(Mode& mode) { return scale_to_largest(std::span(&mode, 1)); }

/// @brief Effective length of each member at a buckling load.
/// @param lengths of the axes, one per member
/// @param compressions largest compression of each member, in the model's units
[[nodiscard]] std::vector<EffectiveLength> effective_lengths(const ResolvedModel& model,
                                                             const std::vector<double>& lengths,
                                                             const std::vector<double>& compressions);

/// @brief End of a sentence on the place and direction of a mode's largest displacement: "is largest at node
/// ..., along (x, y)".
[[nodiscard]] std::string motion_text(const Mode& mode, const ResolvedModel& model);

/// @brief The member that buckles by itself: it has at least nine tenths of the strain energy of the motion,
/// as a rod between stiff members does. A swaying frame has no such member.
/// @param mode scaled unknowns including section forces
/// @return index of the member; empty when no member has that share
[[nodiscard]] std::optional<std::size_t> member_that_buckles(const Structure& structure,
                                                             const Eigen::VectorXd& mode);

/// @brief Offsets along the initial left normals over arc length (model's units), from an eigenvector scaled
/// to the largest offset `amplitude`; one spline per member.
[[nodiscard]] std::vector<CubicSpline> normal_offsets(const Structure& structure, const Eigen::VectorXd& mode,
                                                      double amplitude);

}  // namespace snapthrough
