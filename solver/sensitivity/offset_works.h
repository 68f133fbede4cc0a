#pragma once
/// @file
/// How stress-free offsets act on a critical point.

#include <Eigen/Core>
#include <optional>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/sensitivity/exact_point.h"
#include "solver/sensitivity/offset_space.h"

namespace snapthrough {

/// Work of the residual's derivatives by offsets on the softest motions at a critical point.
///
/// With F(y, lambda, w) = 0 and a motion n, column n has n.dF/dw for each offset of an OffsetSpace. At a
/// limit point with null vector n the load factor changes by n.dF/dw / n.load. At a bifurcation the work on
/// its null vectors breaks it: the load falls by the power 1/2 or 2/3 of the work (Koiter, 1945).
struct OffsetWorks {
  Eigen::MatrixXd works;  ///< columns: the null motions of the point, then motions of small stiffness
  /// d load factor / d offset, in the user's units; empty unless the point is a smooth limit point that was
  /// solved to rounding.
  std::optional<Eigen::VectorXd> load_rate;
};

/// @brief Works on at most three motions. Costs two residuals of a changed structure per offset, and a
/// factorisation.
///
/// The derivative by an offset is a central difference of step eps^(1/3) of the member's length, at which its
/// errors of truncation and of rounding are equal.
/// @param structure structure on which the point was found
/// @param modes offsets of the model's mode imperfections
/// @param factorisations incremented by the number of factorisations
[[nodiscard]] OffsetWorks offset_works(const Structure& structure, const LocatedPoint& at,
                                       const OffsetSpace& space, const ModeOffsets& modes,
                                       int& factorisations);

}  // namespace snapthrough
