#pragma once
/// @file
/// A pile in layered soil, as a soil document describes it.

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/finding.h"

namespace snapthrough::api::convert {

/// Largest number of layers of a soil document.
inline constexpr std::size_t kMaxLayers = 1'000;

/// Largest number of depths of a layer between which its curves are linear.
inline constexpr std::size_t kMaxBreakPoints = 1'000;
/// Largest number of stiffnesses and capacities by depth that all layers together are given, which bounds the
/// text of a conversion to some megabytes: each takes about 90 bytes.
inline constexpr std::size_t kMaxNumbersByDepth = 50'000;
/// Least and largest value of a soil document's `accuracy`.
inline constexpr double kLeastAccuracy = 1e-4;
inline constexpr double kLargestAccuracy = 0.1;

enum class Loading { static_, cyclic };

/// Vertical pile. Depths are below the ground's surface.
struct Pile {
  std::string member;  ///< id of the pile's member
  double diameter = 0.0;
  double length = 0.0;
  bool head_is_start = true;  ///< false: the member runs from tip to head
  double head_depth = 0.0;    ///< depth of the head; negative above ground

  [[nodiscard]] double tip_depth() const { return head_depth + length; }
  /// Returns the fraction of the member at a depth, in [0, 1].
  [[nodiscard]] double fraction(double depth) const;
};

/// Sand of API RP 2GEO.
struct Sand {
  double C1 = 0.0, C2 = 0.0, C3 = 0.0;  ///< dimensionless coefficients of the ultimate resistance
  double k = 0.0;                       ///< initial modulus of subgrade reaction, force/length^3
};

/// Soft clay of Matlock (1970) and API RP 2GEO.
struct SoftClay {
  double Su_top = 0.0, Su_bottom = 0.0;  ///< undrained shear strength at both faces, linear between
  double eps50 = 0.0;                    ///< strain at half the strength in an undrained compression test
  double J = 0.0;                        ///< dimensionless constant of the shallow resistance
};

struct Layer {
  double from = 0.0, to = 0.0;  ///< depths of its faces, from < to
  double gamma = 0.0;           ///< effective unit weight
  std::variant<Sand, SoftClay> soil;
};

/// A valid soil document. Layers follow one another from the surface and reach the pile's tip.
struct SoilDocument {
  std::map<std::string, std::string> units;  ///< carried over, never interpreted
  Pile pile;
  std::vector<Layer> layers;
  Loading loading = Loading::static_;
  double accuracy = 1e-2;  ///< largest relative error of a reaction that interpolation by depth causes
};

/// Returns the id of a foundation: the member's, and the numbers of its layer and curve, which count from 1.
/// @param curve 0: the only one of its layer
[[nodiscard]] std::string foundation_id(const Pile& pile, std::size_t layer, std::size_t curve);

/// Returns the document; its value has no meaning when `findings` gets entries.
[[nodiscard]] SoilDocument read_soil(const nlohmann::json& json, std::vector<Finding>& findings);

}  // namespace snapthrough::api::convert
