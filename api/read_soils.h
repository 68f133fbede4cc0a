#pragma once
/// @file
/// Reader of the soils of a model. Internal to api/.

#include <optional>
#include <string>
#include <vector>

#include "api/soil/layers.h"
#include "api/value.h"

namespace snapthrough::api {

/// Layer of soil as a request describes it: its depths are below the ground's surface, and its unit weight is
/// total if the soil has a water table.
struct GivenLayer {
  soil::Layer layer;
};

/// Depths by which water took soil away.
struct Scour {
  double general = 0.0;  ///< depth to which the whole surface is lowered
  double local = 0.0;    ///< depth below it without resistance around the pile
};

/// Soil as a request describes it.
struct GivenSoil {
  std::string id;
  std::optional<double> water_table;  ///< depth; empty: unit weights are effective
  double water_unit_weight = 0.0;
  Scour scour;
  soil::Loading loading = soil::Loading::static_;
  soil::Layering layering = soil::Layering::none;
  double accuracy = 1e-2;
  std::vector<GivenLayer> layers;

  /// Returns the layers below general scour, by depths below the scoured surface. A layer that the water
  /// table crosses has two parts.
  [[nodiscard]] soil::Profile profile() const;
  [[nodiscard]] double bottom() const { return layers.back().layer.to; }
};

/// Reads `soils` and checks each. A soil with a mistake is unreadable in the report.
[[nodiscard]] std::vector<GivenSoil> read_soils(const Value& soils);

}  // namespace snapthrough::api
