#pragma once
/// @file
/// Surfaces of media for the checker, written from the table of outlines in docs/requests.md.

#include <Eigen/Core>
#include <array>
#include <memory>

#include "solver/model/model.h"

namespace snapthrough::testing {

/// Depth of a point below a surface.
struct RodDepth {
  double value = 0.0;                              ///< negative outside the medium
  Eigen::Vector2d into = Eigen::Vector2d::Zero();  ///< its gradient: normal at the nearest point
  double bend = 0.0;  ///< its second derivative along the tangent; that along the normal is zero
};

class RodSurface {
 public:
  virtual ~RodSurface() = default;
  [[nodiscard]] virtual RodDepth at(const Eigen::Vector2d& x) const = 0;
};

/// @param origin, length place x of the model is (x - origin) / length
[[nodiscard]] std::shared_ptr<const RodSurface> surface_of(const Outline& outline,
                                                           const std::array<double, 2>& origin,
                                                           double length);

}  // namespace snapthrough::testing
