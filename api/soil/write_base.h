#pragma once
/// @file
/// Writes the resistance of a pile's base as springs of a model.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "api/soil/layers.h"

namespace snapthrough::api::soil {

/// The lower end of a pile in the model.
struct Base {
  std::string node;
  std::array<double, 2> across{1.0, 0.0};  ///< normal of the pile
  std::array<double, 2> down{0.0, -1.0};   ///< along the pile, out of its lower end
};

/// @brief Returns an array of springs at the lower end of a pile: shear and moment in soil of PISA, and the
/// bearing of a layer with an end bearing, over the area of the full base.
///
/// The array is empty when the layer at the base has none of them, or does not hold the pile.
/// @pre the profile reaches the pile's tip
[[nodiscard]] nlohmann::json write_base(const Profile& profile, const Pile& pile, const Base& base);

}  // namespace snapthrough::api::soil
