#pragma once
/// @file
/// What a state of a structure looks like: deformed shape, section forces, base reactions, contact.

#include <Eigen/Core>
#include <vector>

#include "solver/assembly/structure.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Deformed shape, section forces and base reactions at `points` equally spaced places of each member.
/// @param y unknowns of the structure's problem (scaled units); the result is in the model's units
/// @param lambda scaled load factor of that state
/// @pre points >= 2
[[nodiscard]] State make_state(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                               double lambda, int points);

/// @brief Share of each foundation's range that is in contact; 1 for a bilateral one.
[[nodiscard]] std::vector<double> contact_fractions(const Structure& structure, const Model& model,
                                                    const Eigen::VectorXd& y);

/// @brief Displacements of an eigenvector: s in the model's units; x, y (displacements) and rotation
/// unscaled.
[[nodiscard]] std::vector<MemberState> mode_displacements(const Structure& structure, const Model& model,
                                                          const Eigen::VectorXd& mode, int points);

/// @brief Offsets along the initial left normals, over the arc length in the model's units, of an eigenvector
/// scaled so that the largest is `amplitude` (and positive with it); one spline a member.
[[nodiscard]] std::vector<CubicSpline> normal_offsets(const Structure& structure, const Model& model,
                                                      const Eigen::VectorXd& mode, double amplitude);

}  // namespace snapthrough
