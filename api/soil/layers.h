#pragma once
/// @file
/// A pile in layered soil: what the laws of its foundations follow from.

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "api/soil/curves.h"
#include "api/soil/profile.h"

namespace snapthrough::api::soil {

/// Parameters at both faces of a layer, linear between. @pre both have the same type
template <class Type>
struct Faces {
  Type top, bottom;
};

/// Axial resistance of a layer.
struct Axial {
  /// The friction of clay follows from strength and stress.
  bool friction_by_strength = false;
  Faces<AxialType> type;
};

/// Layer of soil with one unit weight.
struct Layer {
  double from = 0.0, to = 0.0;  ///< depths of its faces, from < to
  double gamma = 0.0;           ///< effective unit weight
  std::variant<Sand, SoftClay, Faces<LayerType>> soil;
  std::size_t number = 0;  ///< index of the layer of the document that it is, or is a part of
  std::size_t part = 0;    ///< number from 1 of that part; 0: the whole layer
  double top = 0.0;        ///< depth of the upper face of the whole layer
  std::optional<Axial> axial = std::nullopt;  ///< empty: the layer has no axial resistance
  /// Unit end bearing of a tip in the layer, force/length^2; empty: none.
  std::optional<double> end_bearing = std::nullopt;
};

/// Soil under a surface. Depths are below that surface, at which layers begin and the stress is zero.
struct Profile {
  std::vector<Layer> layers;  ///< each begins where the one above it ends
  Loading loading = Loading::static_;
  Layering layering = Layering::none;
  /// Largest relative error of a reaction that interpolation by depth causes.
  double accuracy = 1e-2;
};

/// Straight member in soil. Depths are below the surface of its Profile.
struct Pile {
  std::string id;      ///< begins the ids of its foundations
  std::string member;  ///< id of the member
  double diameter = 0.0;
  double length = 0.0;               ///< difference of the depths of its ends, > 0
  bool head_is_start = true;         ///< false: the member runs from tip to head
  double head_depth = 0.0;           ///< depth of its upper end; negative above the surface
  double embedded_depth = 0.0;       ///< depth of the tip of the pile of which the member is a part
  double held_from = 0.0;            ///< depth above which soil gives no resistance
  double force_factor = 1.0;         ///< multiplies the forces of the lateral curves
  double displacement_factor = 1.0;  ///< multiplies their displacements

  [[nodiscard]] double tip_depth() const { return head_depth + length; }
  /// Returns the fraction of the member at a depth, in [0, 1].
  [[nodiscard]] double fraction(double depth) const;
};

}  // namespace snapthrough::api::soil
