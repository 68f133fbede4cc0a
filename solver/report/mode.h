#pragma once
/// @file
/// What a mode looks like: displacements of an eigenvector or of a path's direction.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Displacements of a vector of unknowns at `points` equally spaced places of each member, not scaled.
/// @param mode scaled unknowns; the result is in the model's units
/// @pre points >= 2
[[nodiscard]] Mode mode_displacements(const Structure& structure, const Model& model,
                                      const Eigen::VectorXd& mode, int points);

/// @brief Scales a mode so that its largest displacement at the sampled places is one, its first large
/// component positive; one that only turns members at these places, by its largest rotation.
/// @return what it was multiplied by
double scale_to_largest(Mode& mode);

/// @brief Where a mode is largest and which way it moves there, as the end of a sentence: "is largest at node
/// ..., along (x, y)".
[[nodiscard]] std::string motion_text(const Mode& mode, const Model& model);

/// @brief The member that alone bends in a motion: it has nine tenths of the strain energy of the motion's
/// section forces. A rod that buckles between stiff members does; a frame that sways has no such member.
/// @param mode scaled unknowns, with their section forces
/// @return index among the model's members; empty where no member has so much
[[nodiscard]] std::optional<std::size_t> member_that_buckles(const Structure& structure, const Model& model,
                                                             const Eigen::VectorXd& mode);

/// @brief Offsets along the initial left normals, over the arc length in the model's units, of an eigenvector
/// scaled so that the largest is `amplitude` (and positive with it); one spline a member.
[[nodiscard]] std::vector<CubicSpline> normal_offsets(const Structure& structure, const Model& model,
                                                      const Eigen::VectorXd& mode, double amplitude);

}  // namespace snapthrough
