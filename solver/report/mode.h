#pragma once
/// @file
/// What a mode looks like: displacements of an eigenvector or of a path's direction.

#include <Eigen/Core>
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

/// @brief Offsets along the initial left normals, over the arc length in the model's units, of an eigenvector
/// scaled so that the largest is `amplitude` (and positive with it); one spline a member.
[[nodiscard]] std::vector<CubicSpline> normal_offsets(const Structure& structure, const Model& model,
                                                      const Eigen::VectorXd& mode, double amplitude);

}  // namespace snapthrough
