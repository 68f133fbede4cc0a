#include "api/read_pipe.h"

#include <cmath>
#include <numbers>
#include <string>

#include "api/read_soil_layer.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

/// Soil around a pipe with its unit weights.
struct GivenPipeSoil {
  double unit_weight = 0.0;
  double total_unit_weight = 0.0;
  soil::PipeSoil type;
};

static void read_optional_positive(Object& in, std::string_view key, std::optional<double>& out) {
  if (in.find(key)) {
    read_positive(in, key, out.emplace());
  }
}

/// Reads what soils of all types have.
static GivenPipeSoil read_weights(Object& in) {
  GivenPipeSoil out;
  read_positive(in, "unit_weight", out.unit_weight);
  std::optional<double> total;
  read_optional_positive(in, "total_unit_weight", total);
  out.total_unit_weight = total.value_or(out.unit_weight);
  require(in, total ? "total_unit_weight" : "unit_weight", out.total_unit_weight,
          !(out.total_unit_weight < out.unit_weight), "at least unit_weight, which is effective");
  return out;
}

static GivenPipeSoil read_sand(Object& in) {
  static constexpr Named<bool> kDensities[] = {{"dense", true}, {"loose", false}};
  GivenPipeSoil out = read_weights(in);
  soil::PipeSand sand;
  in.required("phi", sand.phi);
  require(in, "phi", sand.phi, sand.phi >= soil::kLeastPipePhi && sand.phi <= soil::kLargestPipePhi,
          "from " + checks::text(soil::kLeastPipePhi) + " to " + checks::text(soil::kLargestPipePhi) +
              " degrees");
  in.required("coating_factor", sand.coating_factor);
  require(in, "coating_factor", sand.coating_factor, sand.coating_factor > 0.0 && sand.coating_factor <= 1.0,
          "positive and at most 1");
  std::optional<double> K0;
  read_optional_positive(in, "K0", K0);
  sand.K0 = K0.value_or(1.0 - std::sin(sand.phi * std::numbers::pi / 180.0));
  if (const auto density = in.find_required("density")) {
    read_named(*density, kDensities, sand.is_dense);
  }
  out.type = sand;
  return out;
}

static GivenPipeSoil read_clay(Object& in) {
  static constexpr Named<bool> kConsistencies[] = {{"stiff", true}, {"soft", false}};
  GivenPipeSoil out = read_weights(in);
  soil::PipeClay clay;
  read_positive(in, "Su", clay.Su);
  read_positive(in, "adhesion", clay.adhesion);
  if (const auto consistency = in.find_required("consistency")) {
    read_named(*consistency, kConsistencies, clay.is_stiff);
  }
  out.type = clay;
  return out;
}

static void read(const Value& value, GivenPipeSoil& out) {
  static constexpr Named<GivenPipeSoil (*)(Object&)> kForms[] = {{"sand", read_sand}, {"clay", read_clay}};
  read_tagged(value, kForms, out);
}

static void read(const Value& value, soil::PipeDisplacements& out) {
  Object in(value);
  read_positive(in, "axial", out.axial);
  read_optional_positive(in, "lateral", out.lateral);
  read_optional_positive(in, "uplift", out.uplift);
  read_optional_positive(in, "bearing", out.bearing);
  in.finish();
}

/// Reads the object `pipe` of an entry.
static void read(const Value& value, PipeEntry& out) {
  static constexpr Named<PipePlane> kPlanes[] = {{"vertical", PipePlane::vertical},
                                                 {"horizontal", PipePlane::horizontal}};
  Object in(value);
  if (const auto plane = in.find_required("plane")) {
    read_named(*plane, kPlanes, out.plane);
  }
  read_positive(in, "depth", out.pipe.depth);
  read_optional_positive(in, "diameter", out.diameter);
  GivenPipeSoil soil;
  in.required("soil", soil);
  in.required("displacements", out.pipe.displacements);
  in.finish();
  out.pipe.unit_weight = soil.unit_weight;
  out.pipe.total_unit_weight = soil.total_unit_weight;
  out.pipe.soil = soil.type;
}

PipeEntry read_pipe(const Value& value) {
  PipeEntry out;
  Object in(value);
  in.required("id", out.pipe.id);
  in.required("member", out.pipe.member);
  in.required("pipe", out);
  for (const char* own : {"stiffness", "law"}) {
    if (const auto field = in.find(own)) {
      field->report(
          "ambiguous",
          "the soil around a pipe gives the laws of its foundation: give either pipe or " + std::string(own));
    }
  }
  (void)in.find("displacement");  // read with each foundation that the soil gives
  in.finish();
  return out;
}

}  // namespace snapthrough::api
