#include "api/read_soils.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "api/read_soil_layer.h"
#include "api/read_soil_types.h"
#include "api/soil/faces.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

soil::Profile GivenSoil::profile() const {
  soil::Profile out{{}, loading, layering, accuracy};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const soil::Layer& layer = layers[i].layer;
    const double from = std::max(layer.from, scour.general);
    if (layer.to <= from) {
      continue;
    }
    const double water = water_table.value_or(0.0);
    const bool crossed = water_table && water > from && water < layer.to;
    std::vector<double> faces{from, layer.to};
    if (crossed) {
      faces.insert(faces.begin() + 1, water);
    }
    for (std::size_t j = 1; j < faces.size(); ++j) {
      const double thickness = layer.to - layer.from;
      soil::Layer part =
          soil::part_of(layer, (faces[j - 1] - layer.from) / thickness, (faces[j] - layer.from) / thickness);
      const bool is_wet = water_table && faces[j - 1] >= water;
      part.gamma = layer.gamma - (is_wet ? water_unit_weight : 0.0);
      part.from = faces[j - 1] - scour.general;
      part.to = faces[j] - scour.general;
      part.top = from - scour.general;
      part.number = i;
      part.part = crossed ? j : 0;
      out.layers.push_back(std::move(part));
    }
  }
  return out;
}

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

/// Reads the fields that every layer has.
static soil::Layer read_given_layer(Object& in) {
  soil::Layer layer;
  in.required("top", layer.from);
  in.required("bottom", layer.to);
  require(in, "bottom", layer.to, layer.to <= kMaxMagnitude && !(layer.to <= layer.from),
          "finite and greater than top");
  read_positive(in, "unit_weight", layer.gamma);
  if (in.find("end_bearing")) {
    read_positive(in, "end_bearing", layer.end_bearing.emplace());
  }
  return layer;
}

/// Reads a layer of the soil that a function reads.
template <auto read_type>
static GivenLayer read_layer_of(Object& in) {
  soil::Layer layer = read_given_layer(in);
  layer.soil = read_type(in);
  if (const auto axial = in.find("axial")) {
    layer.axial = read_axial(*axial, soil::strength_at(layer, 0.0).has_value());
  }
  return {std::move(layer)};
}

static void read(const Value& value, GivenLayer& out) {
  static constexpr Named<GivenLayer (*)(Object&)> kForms[] = {
      {"api_sand", read_layer_of<read_api_sand>},
      {"soft_clay", read_layer_of<read_soft_clay>},
      {"soft_clay_matlock", read_layer_of<read_soft_clay_matlock>},
      {"stiff_clay", read_layer_of<read_stiff_clay>},
      {"stiff_clay_free_water", read_layer_of<read_stiff_clay_free_water>},
      {"reese_sand", read_layer_of<read_reese_sand>},
      {"pisa_clay", read_layer_of<read_pisa_clay>},
      {"pisa_sand", read_layer_of<read_pisa_sand>},
      {"weak_rock", read_layer_of<read_weak_rock>},
      {"liquefied_sand", read_layer_of<read_liquefied_sand>}};
  read_tagged(value, kForms, out);
}

/// Reads a depth that may be left out: finite and not negative.
static void read_depth(Object& in, std::string_view key, double& out) {
  if (in.optional(key, out)) {
    require(in, key, out, out >= 0.0 && out <= kMaxMagnitude, "finite and not negative");
  }
}

static void read(const Value& value, Scour& out) {
  Object in(value);
  read_depth(in, "general", out.general);
  read_depth(in, "local", out.local);
  in.finish();
}

static void read(const Value& value, soil::Layering& out) {
  static constexpr Named<soil::Layering> kNames[] = {{"none", soil::Layering::none},
                                                     {"georgiadis", soil::Layering::georgiadis}};
  read_named(value, kNames, out);
}

/// Reads the water table with the unit weight of water, which go together.
static void read_water(Object& in, GivenSoil& out) {
  const auto weight = in.find("water_unit_weight");
  if (const auto table = in.find("water_table")) {
    read(*table, out.water_table);
    require(in, "water_table", *out.water_table, std::abs(*out.water_table) <= kMaxMagnitude, "finite");
    read_positive(in, "water_unit_weight", out.water_unit_weight);
  } else if (weight) {
    weight->report("missing_field",
                   "water_unit_weight needs a water_table: without it unit weights are effective");
  }
}

static void read(const Value& value, GivenSoil& out) {
  Object in(value);
  in.required("id", out.id);
  read_water(in, out);
  in.optional("scour", out.scour);
  in.required("loading", out.loading);
  in.optional("layering", out.layering);
  read_accuracy(in, out.accuracy);
  in.required("layers", out.layers);
  in.finish();
}

/// Requires layers that follow one another from the surface. @pre all fields of the soil are readable
static void require_layers(const Value& layers, const GivenSoil& soil) {
  if (soil.layers.empty() || soil.layers.size() > soil::kMaxLayers) {
    layers.report("out_of_range", "there must be 1 to " + std::to_string(soil::kMaxLayers) + " layers, got " +
                                      std::to_string(soil.layers.size()));
    return;
  }
  double above = 0.0;
  for (std::size_t i = 0; i < soil.layers.size(); ++i) {
    const soil::Layer& layer = soil.layers[i].layer;
    if (layer.from != above) {
      layers.item(i).member("top")->report(
          "out_of_range", "a layer must begin where the one above it ends, at depth " + checks::text(above) +
                              ", got " + checks::text(layer.from));
    }
    if (soil.water_table && layer.to > *soil.water_table && !(layer.gamma > soil.water_unit_weight)) {
      layers.item(i)
          .member("unit_weight")
          ->report("out_of_range",
                   "below the water table unit_weight is total and must be greater than that of water, " +
                       checks::text(soil.water_unit_weight) + ", got " + checks::text(layer.gamma));
    }
    above = layer.to;
  }
}

/// Refuses layers of PISA in a soil with equivalent depths, for which their curves are not made.
static void refuse_layering(const Value& layers, const GivenSoil& soil) {
  for (std::size_t i = 0; soil.layering == soil::Layering::georgiadis && i < soil.layers.size(); ++i) {
    const auto* faces = std::get_if<soil::Faces<soil::LayerType>>(&soil.layers[i].layer.soil);
    if (faces != nullptr && (std::holds_alternative<soil::PisaClay>(faces->top) ||
                             std::holds_alternative<soil::PisaSand>(faces->top))) {
      layers.item(i).member("type")->report(
          "not_supported",
          "the curves of PISA are made for the depths of layers themselves: layering must be "
          "none");
    }
  }
}

std::vector<GivenSoil> read_soils(const Value& soils) {
  std::vector<GivenSoil> out;
  read(soils, out);
  std::vector<Finding> findings;
  checks::require_count(checks::Place(PointerPath(soils.pointer()), findings), out.size(), soil::kMaxSoils);
  checks::Ids ids("soil");
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Value soil = soils.item(i);
    Report& report = soils.document_report();
    if (report.covers(soil.pointer())) {
      continue;
    }
    require_layers(*soil.member("layers"), out[i]);
    refuse_layering(*soil.member("layers"), out[i]);
    if (!report.covers(soil.pointer()) && out[i].scour.general >= out[i].bottom()) {
      soil.member("scour")->member("general")->report(
          "out_of_range",
          "general scour must leave soil: the lowest layer ends at depth " + checks::text(out[i].bottom()));
    }
    ids.add(checks::Place(PointerPath(soil.pointer() + "/id"), findings), out[i].id);
  }
  for (Finding& finding : findings) {
    soils.document_report().add(finding.pointer, finding.code, std::move(finding.detail));
  }
  return out;
}

}  // namespace snapthrough::api
