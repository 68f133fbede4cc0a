#include "api/read_soil_types.h"

#include <array>
#include <cmath>
#include <string>

#include "api/read_soil_layer.h"
#include "api/soil/ultimate_resistance.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

using soil::Faces;
using soil::LayerType;

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

/// Reads a number in [least, largest].
static void read_between(const Value& value, std::string_view key, double least, double largest,
                         double& out) {
  read(value, out);
  if (!std::isnan(out) && !(out >= least && out <= largest)) {
    value.report("out_of_range", std::string(key) + " must be from " + checks::text(least) + " to " +
                                     checks::text(largest) + ", got " + checks::text(out));
  }
}
static void read_required_between(Object& in, std::string_view key, double least, double largest,
                                  double& out) {
  set_unread(out);
  if (const auto value = in.find_required(key)) {
    read_between(*value, key, least, largest, out);
  }
}
static void read_optional_between(Object& in, std::string_view key, double least, double largest,
                                  double& out) {
  if (const auto value = in.find(key)) {
    read_between(*value, key, least, largest, out);
  }
}

/// Reads positive numbers at both faces: one for both, or one for each.
/// @param may_vanish zero is allowed
static void read_at_faces(Object& in, std::string_view key, double& top, double& bottom,
                          bool may_vanish = false) {
  set_unread(top);
  set_unread(bottom);
  const auto faces = read_faces(in, key);
  if (!faces) {
    return;
  }
  for (const double face : *faces) {
    if (!std::isnan(face) && !((may_vanish ? face >= 0.0 : face > 0.0) && face <= kMaxMagnitude)) {
      in.find(key)->report("out_of_range", std::string(key) + (may_vanish ? " must be finite and not negative"
                                                                          : " must be positive and finite"));
      break;
    }
  }
  top = (*faces)[0];
  bottom = (*faces)[1];
}

static void read(const Value& value, soil::SoftClayStart& out) {
  static constexpr Named<soil::SoftClayStart> kNames[] = {{"formula", soil::SoftClayStart::formula},
                                                          {"api_points", soil::SoftClayStart::api_points}};
  read_named(value, kNames, out);
}

static void read_eps50(Object& in, double& out) {
  read_required_between(in, "eps50", soil::kLeastEps50, soil::kLargestEps50, out);
}
static void read_first_point(Object& in, double& out) {
  read_optional_between(in, "first_point", soil::kLeastFirstPoint, soil::kLargestFirstPoint, out);
}

Faces<LayerType> read_soft_clay_matlock(Object& in) {
  soil::SoftClayMatlock top, bottom;
  read_at_faces(in, "Su", top.Su, bottom.Su);
  read_eps50(in, top.eps50);
  read_required_between(in, "J", soil::kLeastJ, soil::kLargestJ, top.J);
  in.optional("start", top.start);
  read_first_point(in, top.first_point);
  return {top, bottom};
}

Faces<LayerType> read_stiff_clay(Object& in) {
  soil::StiffClay top, bottom;
  read_at_faces(in, "Su", top.Su, bottom.Su);
  read_eps50(in, top.eps50);
  read_required_between(in, "J", soil::kLeastJ, soil::kLargestJ, top.J);
  read_optional_between(in, "cycles", soil::kLeastCycles, soil::kLargestCycles, top.cycles);
  read_first_point(in, top.first_point);
  return {top, bottom};
}

Faces<LayerType> read_stiff_clay_free_water(Object& in) {
  soil::StiffClayFreeWater top, bottom;
  read_at_faces(in, "Su", top.Su, bottom.Su);
  read_at_faces(in, "k", top.k, bottom.k);
  read_eps50(in, top.eps50);
  return {top, bottom};
}

Faces<LayerType> read_reese_sand(Object& in) {
  soil::ReeseSand top, bottom;
  read_required_between(in, "phi", soil::kLeastPhi, soil::kLargestPhi, top.phi);
  read_at_faces(in, "k", top.k, bottom.k);
  return {top, bottom};
}

Faces<LayerType> read_pisa_clay(Object& in) {
  soil::PisaClay top, bottom;
  read_at_faces(in, "Su", top.Su, bottom.Su);
  read_at_faces(in, "G0", top.G0, bottom.G0);
  return {top, bottom};
}

Faces<LayerType> read_pisa_sand(Object& in) {
  soil::PisaSand top, bottom;
  read_required_between(in, "relative_density", soil::kLeastRelativeDensity, soil::kLargestRelativeDensity,
                        top.relative_density);
  read_at_faces(in, "G0", top.G0, bottom.G0);
  return {top, bottom};
}

Faces<LayerType> read_weak_rock(Object& in) {
  soil::WeakRock top, bottom;
  read_at_faces(in, "q_u", top.q_u, bottom.q_u);
  read_at_faces(in, "E_ir", top.E_ir, bottom.E_ir);
  read_required_between(in, "RQD", soil::kLeastRqd, soil::kLargestRqd, top.RQD);
  read_required_between(in, "k_rm", soil::kLeastKrm, soil::kLargestKrm, top.k_rm);
  return {top, bottom};
}

Faces<LayerType> read_liquefied_sand(Object& in) {
  soil::LiquefiedSand sand;
  read_positive(in, "metre", sand.metre);
  read_positive(in, "kilonewton", sand.kilonewton);
  return {sand, sand};
}

static soil::Axial read_tz_clay(Object& in) {
  soil::ApiTzClay top, bottom;
  soil::Axial axial;
  axial.friction_by_strength = !in.find("friction");
  if (!axial.friction_by_strength) {
    read_at_faces(in, "friction", top.friction, bottom.friction, true);
  }
  read_required_between(in, "residual", soil::kLeastResidual, soil::kLargestResidual, top.residual);
  axial.type = {top, bottom};
  return axial;
}

static soil::Axial read_tz_sand(Object& in) {
  soil::ApiTzSand top, bottom;
  read_at_faces(in, "friction", top.friction, bottom.friction, true);
  read_positive(in, "peak_displacement", top.peak_displacement);
  return {false, {top, bottom}};
}

soil::Axial read_axial(const Value& value, bool has_strength) {
  static constexpr Named<soil::Axial (*)(Object&)> kForms[] = {{"api_tz_clay", read_tz_clay},
                                                               {"api_tz_sand", read_tz_sand}};
  soil::Axial out;
  read_tagged(value, kForms, out);
  if (out.friction_by_strength && !has_strength) {
    value.report("missing_field", "api_tz_clay needs a friction in soil without Su");
  }
  return out;
}

}  // namespace snapthrough::api
