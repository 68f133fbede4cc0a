#pragma once
/// @file
/// Equivalent depths of layered soil, after M. Georgiadis, Development of p-y curves for layered soils,
/// Proceedings of the Conference on Geotechnical Practice in Offshore Engineering, ASCE, Austin, 1983.

#include <optional>

#include "api/soil/layers.h"

namespace snapthrough::api::soil {

/// @brief Equivalent depths of the upper faces of layers, one after the other from the surface downwards.
///
/// F is the ultimate resistance of the layers above, each integrated over its own equivalent depths. The
/// equivalent depth h of a layer is that at which its soil alone, with the parameters of the layer's upper
/// face and its unit weight gamma from the surface on, has the same resistance: the integral of R from 0 to h
/// is F. R is A Pmax, Pmax, pc or pu of the formulas of its type, with the stress gamma X. The resistance
/// of the layer itself is that from h to h + thickness.
///
/// Weak rock, liquefied sand and the soils of PISA have no equivalent depth, and neither has a layer beneath
/// them.
class EquivalentDepths {
 public:
  /// @param limit depths are at most this, > 0
  EquivalentDepths(double diameter, Loading loading, double limit)
      : diameter_(diameter), loading_(loading), limit_(limit) {}

  /// @brief Returns the equivalent depth of the upper face of the next layer, and adds its resistance to
  /// that of the layers above.
  /// @return nullopt: the layer has its own depth; the limit or more where the soil alone is too weak
  [[nodiscard]] std::optional<double> next(const Layer& layer);

 private:
  double diameter_;
  Loading loading_;
  double limit_;
  double force_ = 0.0;         ///< F
  bool keeps_depths_ = false;  ///< the layers from here on have their own depths
};

/// Returns whether a layer's type has an ultimate resistance by which equivalent depths are found.
[[nodiscard]] bool has_equivalent_depth(const Layer& layer);

}  // namespace snapthrough::api::soil
