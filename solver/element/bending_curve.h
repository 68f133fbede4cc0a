#pragma once
/// @file
/// Bending laws of sections, scaled.

#include <memory>

#include "solver/model/model.h"
#include "solver/model/scales.h"

namespace snapthrough {

/// @brief Curvature by the bending moment, times the bending stiffness without moment: a moment c(m) with the
/// slope 1 at m = 0. The curve is odd and ascends everywhere.
///
/// The moment is an unknown of the elements, so that they need this inverse of M(k).
class BendingCurve {
 public:
  virtual ~BendingCurve() = default;
  /// c, c', c''.
  struct Values {
    double moment = 0.0;
    double slope = 0.0;
    double second = 0.0;
  };
  [[nodiscard]] virtual Values at(double moment) const = 0;
};

/// @brief Bending stiffness dM / dk of a table without moment; 0 for one without a point beyond the origin,
/// which check() refuses.
/// @pre law.type is table
[[nodiscard]] double initial_slope(const BendingLaw& law);

/// @brief Scaled curve of a section; null for a section without a bending law.
/// @pre the section passed check()
[[nodiscard]] std::shared_ptr<const BendingCurve> bending_curve_of(const Section& section,
                                                                   const Scales& scales);

}  // namespace snapthrough
