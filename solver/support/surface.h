#pragma once
/// @file
/// Surfaces of media that are fixed in the plane.

#include <array>
#include <memory>
#include <vector>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Signed distance of a displaced point to a surface, with its derivatives with respect to the displacement.
struct SurfacePoint {
  double depth = 0.0;            ///< distance, positive inside the medium
  std::array<double, 2> into{};  ///< gradient: unit normal into the medium at the nearest point
  double bend = 0.0;             ///< second derivative along the tangent (-into[1], into[0])
  double bend_rate = 0.0;        ///< derivative of `bend` along the tangent
  double size = 0.0;             ///< largest coordinate whose rounding the depth has, beside that of u
};

/// Point of a surface at which a second or third derivative of the distance jumps.
struct SurfaceSeam {
  std::array<double, 2> x{};
  std::array<double, 2> tangent{};  ///< along the surface, of length one
  double curvature_behind = 0.0;    ///< SurfacePoint::bend on the surface, before and after a jump
  double curvature_ahead = 0.0;

  /// Change of SurfacePoint::bend from behind the seam to ahead of it, at a depth.
  [[nodiscard]] double bend_change(double depth) const {
    return curvature_ahead / (1.0 + depth * curvature_ahead) -
           curvature_behind / (1.0 + depth * curvature_behind);
  }
};

/// @brief Surface of a medium. The second derivative of the distance along the normal is zero, and that of
/// `bend` is -bend^2. Immutable, thread safe.
class Surface {
 public:
  virtual ~Surface() = default;
  /// @brief At the point x + u. The depth has the digits of u: that of x counts as zero where it is rounding.
  [[nodiscard]] virtual SurfacePoint at(std::array<double, 2> x, std::array<double, 2> u) const = 0;
  [[nodiscard]] SurfacePoint at(std::array<double, 2> x) const { return at(x, {0.0, 0.0}); }
  [[nodiscard]] const std::vector<SurfaceSeam>& seams() const { return seams_; }

 protected:
  std::vector<SurfaceSeam> seams_;
};

/// @brief Surface of an outline.
/// @param origin, length x = (X - origin) / length for a point X of the model
/// @pre the outline passed check()
[[nodiscard]] std::shared_ptr<const Surface> make_surface(const Outline& outline,
                                                          std::array<double, 2> origin, double length);

}  // namespace snapthrough
