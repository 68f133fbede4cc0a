/// Reader of sections.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "api/read_along.h"
#include "api/read_law.h"
#include "api/read_parts.h"
#include "solver/check/check_place.h"
#include "solver/element/bending_curve.h"
#include "solver/model/limits.h"
#include "solver/model/profiles.h"
#include "solver/model/section_shape.h"

namespace snapthrough::api {

namespace {

/// Cross section with the factor of Young's modulus: 1 / (1 - nu^2) in plane strain.
struct Shape {
  SectionGeometry geometry;
  double stiffening = 1.0;
};

/// Reads a required positive number; NaN when it is invalid.
void read_positive(Object& in, std::string_view key, double& out) {
  in.required(key, out);
  if (!(out > 0.0 && out <= kMaxMagnitude) && out == out) {
    in.find(key)->report("out_of_range", std::string(key) + " must be positive and finite");
    set_unread(out);
  }
}

/// Reads a required Poisson's ratio; NaN when it is invalid.
double read_nu(Object& in) {
  double nu = 0.0;
  in.required("nu", nu);
  if (nu <= -1.0 || nu > 0.5) {
    in.find("nu")->report("out_of_range", "nu must be above -1 and at most 0.5");
    set_unread(nu);
  }
  return nu;
}

/// Reports a dimension that does not go with the others, and makes it NaN.
void require(bool holds, Object& in, std::string_view key, std::string rule, double& out) {
  if (holds || out != out) {
    return;
  }
  in.find(key)->report("out_of_range", std::string(key) + " must be " + std::move(rule));
  set_unread(out);
}

Shape read_rectangle(Object& in) {
  double width = 0.0, depth = 0.0;
  read_positive(in, "width", width);
  read_positive(in, "depth", depth);
  return {rectangle(width, depth)};
}

Shape read_tube(Object& in) {
  double diameter = 0.0, thickness = 0.0;
  read_positive(in, "diameter", diameter);
  read_positive(in, "thickness", thickness);
  require(!(thickness > 0.5 * diameter), in, "thickness", "at most half of the diameter", thickness);
  return {tube(diameter, thickness)};
}

Shape read_i_section(Object& in) {
  FlangedSection out;
  read_positive(in, "depth", out.depth);
  read_positive(in, "width", out.width);
  read_positive(in, "web", out.web);
  read_positive(in, "flange", out.flange);
  require(!(out.web > out.width), in, "web", "at most the width", out.web);
  require(!(2.0 * out.flange >= out.depth), in, "flange", "less than half of the depth", out.flange);
  if (in.optional("root_radius", out.root_radius)) {
    const double most = std::min(0.5 * (out.width - out.web), 0.5 * out.depth - out.flange);
    require(!(out.root_radius < 0.0 || out.root_radius > most), in, "root_radius",
            "from 0 to where the fillet meets the edge of the flange or the other fillet", out.root_radius);
  }
  return {flanged_section(out)};
}

/// Wall of width 1 across the plane.
Shape read_wall(Object& in) {
  double thickness = 0.0;
  bool plane_strain = false;
  read_positive(in, "thickness", thickness);
  const bool has_field = in.optional("plane_strain", plane_strain);
  Shape out{rectangle(1.0, thickness)};
  if (has_field || in.find("nu")) {
    const double nu = read_nu(in);
    out.stiffening = plane_strain ? 1.0 / (1.0 - nu * nu) : 1.0;
  }
  return out;
}

void read(const Value& value, Shape& out) {
  static constexpr Named<Shape (*)(Object&)> kForms[] = {
      {"rectangle", read_rectangle}, {"tube", read_tube}, {"i_section", read_i_section}, {"wall", read_wall}};
  set_unread(out.geometry.area);
  read_tagged(value, kForms, out);
}

/// Returns ' or ' between the last two of some names in quotes, ', ' between the others.
std::string choice_of(std::span<const std::string_view> names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + checks::in_quotes(names[i]);
  }
  return all;
}

/// Reads the name of a rolled profile; an unknown one is reported with those of its series that are near.
std::optional<RolledProfile> read_profile_name(const Value& value) {
  if (!value.is_string()) {
    value.report_type("the name of a rolled profile");
    return std::nullopt;
  }
  const auto& written = value.json().get_ref<const std::string&>();
  auto found = find_profile(written);
  if (!found) {
    const auto near = profiles_near(written);
    std::string series;
    for (const ProfileSeries& one : profile_series()) {
      series += (series.empty() ? "" : ", ") + std::string(one.name);
    }
    value.report("unknown_value",
                 checks::in_quotes(written) + " is not a rolled profile that is known here; " +
                     (near.empty() ? "the series are " + series : "did you mean " + choice_of(near) + "?"));
  }
  return found;
}

/// Reads the name of a profile and the model's unit of length.
Shape read_profile(Object& in) {
  static constexpr Named<double> kUnits[] = {{"m", 1e-3}, {"cm", 0.1}, {"mm", 1.0}};
  Shape out;
  set_unread(out.geometry.area);
  double factor = 0.0;
  if (const auto unit = in.find_required("unit")) {
    read_named(*unit, kUnits, factor);
  }
  const auto profile = read_profile_name(*in.find("profile"));
  if (profile && factor > 0.0) {
    out.geometry = geometry_of(*profile, factor);
  }
  return out;
}

/// Reads a number that may taper.
void read_number(const Value& value, AlongMember& out) {
  read_along(value, out.constant, out.points, kLeastPoints, &out.power);
}

/// Reads a stiffness, which may taper or be "rigid".
void read_stiffness(const Value& value, AlongMember& out) {
  if (!read_rigid(value, out.constant)) {
    read_number(value, out);
  }
}

void read_required_stiffness(Object& in, std::string_view key, AlongMember& out) {
  set_unread(out.constant);
  if (const auto value = in.find_required(key)) {
    read_stiffness(*value, out);
  }
}

/// Reads the shear stiffness; a section that is rigid against shear is one without it.
void read_shear_stiffness(Object& in, std::optional<AlongMember>& out) {
  if (const auto value = in.find("GA")) {
    read_stiffness(*value, out.emplace());
    if (std::isinf(out->constant)) {
      out.reset();
    }
  }
}

void read_optional_number(Object& in, std::string_view key, std::optional<AlongMember>& out) {
  if (const auto value = in.find(key)) {
    read_number(*value, out.emplace());
  }
}

/// Sets mass, rotary inertia and expansion. @param shape null: the section is given by its stiffness
void read_mass(Object& in, const SectionGeometry* shape, Section& out) {
  in.optional("expansion", out.expansion);
  read_optional_number(in, "mass", out.mass);
  read_optional_number(in, "rotary_inertia", out.rotary_inertia);
  if (shape == nullptr || !in.find("density")) {
    return;
  }
  double density = 0.0;
  read_positive(in, "density", density);
  out.mass = density * shape->area;
  if (!out.rotary_inertia) {
    out.rotary_inertia = density * shape->second_moment;
  }
  if (in.find("mass")) {
    in.find("density")->report("ambiguous", "give mass or density, not both");
  }
}

/// Strength of a material: a number, or one for tension and one for compression.
struct MaterialStrength {
  double tension = 0.0;
  double compression = 0.0;
};

void read(const Value& value, MaterialStrength& out) {
  if (!value.is_object()) {
    read(value, out.tension);
    if (!(out.tension > 0.0 && out.tension <= kMaxMagnitude) && out.tension == out.tension) {
      value.report("out_of_range", "strength must be positive and finite");
      set_unread(out.tension);
    }
    out.compression = out.tension;
    return;
  }
  Object in(value);
  read_positive(in, "tension", out.tension);
  read_positive(in, "compression", out.compression);
  in.finish();
}

/// Reads the strength of the material, if there is one: axial force f A and bending moment f W.
/// @param modulus section modulus W
void read_material_strength(Object& in, double area, double modulus, Section& out) {
  MaterialStrength material;
  if (!in.optional("strength", material)) {
    return;
  }
  const double axial_force = material.tension * area;
  const double bending_moment = material.tension * modulus;
  const double ratio = material.compression / material.tension;
  if (std::isnan(axial_force + bending_moment + ratio)) {
    return;  // a number that is not read was reported
  }
  const auto is_usable = [](double v) { return v > 0.0 && v <= kMaxMagnitude; };
  if (!is_usable(axial_force) || !is_usable(bending_moment) || !is_usable(ratio)) {
    in.find("strength")
        ->report("out_of_range",
                 "strength times area, strength times section modulus, and the ratio of the "
                 "strengths must be positive and finite");
    return;
  }
  out.strength = {axial_force, bending_moment, ratio};
}

/// Reads the strength of a section that is given by its stiffness, if there is one.
void read_section_strength(Object& in, Section& out) {
  const auto value = in.find("strength");
  if (!value) {
    return;
  }
  Object strength(*value);
  Strength& read_into = out.strength.emplace();
  for (const auto& [key, number] :
       {std::pair{"axial_force", &read_into.axial_force}, {"bending_moment", &read_into.bending_moment}}) {
    set_unread(number->constant);
    if (const auto given = strength.find_required(key)) {
      read_number(*given, *number);
    }
  }
  strength.finish();
}

/// Sets the stiffness of a material and a shape.
void set_stiffness(Object& in, double E, double G, const Shape& shape, Section& out) {
  const double EA = E * shape.stiffening * shape.geometry.area;
  const double EI = E * shape.stiffening * shape.geometry.second_moment;
  const double GA = G * shape.geometry.shear_area;
  out.EA = EA;
  out.EI = EI;
  if (G != 0.0) {
    out.GA = GA;
  }
  read_mass(in, &shape.geometry, out);
  const double mass = std::max(out.mass.value_or(0.0).largest(), out.rotary_inertia.value_or(0.0).largest());
  const auto is_usable = [](double v) { return v > 0.0 && v <= kMaxMagnitude; };
  const auto is_nan = [](double v) { return v != v; };
  if (is_nan(EA) || is_nan(EI) || is_nan(GA) || is_nan(mass)) {
    in.value().document_report().mark_unreadable(in.value().pointer());
  } else if (!is_usable(EA) || !is_usable(EI) || !(G == 0.0 || is_usable(GA)) || !(mass <= kMaxMagnitude)) {
    in.value().report(
        "out_of_range",
        "the products E A, E I, G shear_area, density A and density I must be positive and finite");
  }
}

/// Reads a section by material and area: EA = E A, EI = E I, GA = shear_area E / (2 (1 + nu)).
void read_material_section(Object& in, Section& out) {
  double E = 0.0, nu = 0.0;
  Shape shape;
  read_positive(in, "E", E);
  read_positive(in, "A", shape.geometry.area);
  read_positive(in, "I", shape.geometry.second_moment);
  const bool has_shear = in.find("shear_area").has_value();
  if (in.find("nu") || has_shear) {
    nu = read_nu(in);
  }
  if (has_shear) {
    read_positive(in, "shear_area", shape.geometry.shear_area);
  }
  set_stiffness(in, E, has_shear ? E / (2.0 * (1.0 + nu)) : 0.0, shape, out);
  double modulus = 0.0;
  if (in.find("strength")) {
    read_positive(in, "W", modulus);
  } else if (const auto given = in.find("W")) {
    given->report("ambiguous", "a section modulus W goes with a strength");
  }
  read_material_strength(in, shape.geometry.area, modulus, out);
}

/// Reads a section by material and shape or profile. It shears if nu or G is given.
void read_shaped_section(Object& in, Section& out) {
  double E = 0.0, G = 0.0;
  Shape shape;
  read_positive(in, "E", E);
  if (const auto given = in.find("shape")) {
    read(*given, shape);
  } else {
    shape = read_profile(in);
  }
  if (in.find("G")) {
    read_positive(in, "G", G);
  }
  if (const auto nu = in.find("nu")) {
    if (in.find("G")) {
      nu->report("ambiguous", "give nu or G, not both: G = E / (2 (1 + nu))");
    }
    G = E / (2.0 * (1.0 + read_nu(in)));
  }
  set_stiffness(in, E, G, shape, out);
  const SectionGeometry& geometry = shape.geometry;
  read_material_strength(in, geometry.area, 2.0 * geometry.second_moment / geometry.depth, out);
}

/// Reads a bending law if there is one. Returns whether it is a table, whose slope is the section's EI.
bool read_bending(Object& in, Section& out) {
  const auto value = in.find("bending");
  if (!value) {
    return false;
  }
  Object bending(*value);
  bending.required("law", out.bending.emplace());
  bending.finish();
  return out.bending->type == BendingLaw::Type::table;
}

/// Reads EI, which a table of bending moments has by itself; it may be absent beside a law that is not read.
void read_bending_stiffness(Object& in, bool has_table, Section& out) {
  if (!has_table) {
    read_required_stiffness(in, "EI", out.EI);
  } else if (const auto value = in.find("EI"); value && !out.bending->points.empty()) {
    value->report("ambiguous", "a table of bending moments has its own EI, its slope at the origin");
  }
}

}  // namespace

void read(const Value& value, Section& out) {
  Object in(value);
  in.required("id", out.id);
  const bool has_table = read_bending(in, out);
  const auto has_any = [&in](std::initializer_list<std::string_view> keys) {
    return std::any_of(keys.begin(), keys.end(),
                       [&in](std::string_view key) { return in.is_readable() && in.value().member(key); });
  };
  const bool by_stiffness = has_any({"EA", "EI", "GA"});
  const bool by_shape = has_any({"shape", "profile"});
  const bool by_area = has_any({"A", "I", "shear_area", "W"});
  const bool by_material = by_shape || by_area || has_any({"E", "nu"});
  if ((by_stiffness && by_material) || (by_shape && by_area) ||
      (has_any({"shape"}) && has_any({"profile"}))) {
    value.report(
        "ambiguous",
        "a section is given by EA, EI, GA, or by E with A, I, shear_area, or by E with a shape, or by E "
        "with a profile, not by several of them");
    return;
  }
  if (by_stiffness || !by_material) {
    read_required_stiffness(in, "EA", out.EA);
    read_bending_stiffness(in, has_table, out);
    read_shear_stiffness(in, out.GA);
    read_section_strength(in, out);
    read_mass(in, nullptr, out);
  }
  if (by_shape) {
    read_shaped_section(in, out);
  } else if (by_material) {
    read_material_section(in, out);
  }
  if (has_table) {
    out.EI = initial_slope(*out.bending);
  }
  in.finish();
}

}  // namespace snapthrough::api
