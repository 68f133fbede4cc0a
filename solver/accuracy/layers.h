#pragma once
/// @file
/// Lengths of boundary layers of bending.

#include <Eigen/Core>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Shortest decay length of bending from the points of action on each member, in the model's units;
/// infinite for members without a boundary layer.
///
/// Bending decays as exp(-s sqrt(N / EI)) under tension N, and as exp(-s sqrt(K / GA)) on a foundation of
/// modulus K in shearable members. A bending law that softens to the slope c' concentrates the curvature on
/// 1 / sqrt(c') of the member. In thin members these lengths are much shorter than all lengths known
/// before the analysis.
[[nodiscard]] std::vector<double> bending_decays(const Structure& structure, const Eigen::VectorXd& y);

}  // namespace snapthrough
