#include "api/soil/buried_pipe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <type_traits>

namespace snapthrough::api::soil {

namespace {

using nlohmann::json;
using std::numbers::pi;

constexpr double kRadians = pi / 180.0;

/// Coefficients of N_qh at one friction angle.
struct LateralFactors {
  double phi = 0.0;
  std::array<double, 5> c{};  ///< factors of 1, x, x^2, x^3, x^4
};

constexpr LateralFactors kLateralFactors[] = {{20.0, {2.399, 0.439, -0.030, 1.059e-3, -1.754e-5}},
                                              {25.0, {3.332, 0.839, -0.090, 5.606e-3, -1.319e-4}},
                                              {30.0, {4.565, 1.234, -0.089, 4.275e-3, -9.159e-5}},
                                              {35.0, {6.816, 2.019, -0.146, 7.651e-3, -1.683e-4}},
                                              {40.0, {10.959, 1.783, 0.045, -5.425e-3, -1.153e-4}},
                                              {45.0, {17.658, 3.309, 0.048, -6.443e-3, -1.299e-4}}};

double lateral_factor(const LateralFactors& row, double x) {
  const auto& c = row.c;
  return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
}

double lateral_factor(double phi, double x) {
  const LateralFactors* below = std::ranges::upper_bound(kLateralFactors, phi, {}, &LateralFactors::phi);
  if (below == std::end(kLateralFactors)) {
    return lateral_factor(*std::prev(below), x);
  }
  const LateralFactors& above = *std::prev(below);
  const double t = (phi - above.phi) / (below->phi - above.phi);
  return std::lerp(lateral_factor(above, x), lateral_factor(*below, x), t);
}

double bearing_factor(double phi) {
  return std::exp(pi * std::tan(phi * kRadians)) * std::pow(std::tan((45.0 + 0.5 * phi) * kRadians), 2);
}
double weight_factor(double phi) { return std::exp(0.18 * phi - 2.5); }

/// A pipe with its soil of one type.
template <class Soil>
struct In {
  const BuriedPipe& pipe;
  const Soil& soil;
  double D = pipe.diameter;
  double H = pipe.depth;
  double pressure = pipe.unit_weight * pipe.depth * pipe.diameter;  ///< gamma H D
};

double axial(const In<PipeSand>& in) {
  return pi * in.pressure * 0.5 * (1.0 + in.soil.K0) *
         std::tan(in.soil.coating_factor * in.soil.phi * kRadians);
}
double axial(const In<PipeClay>& in) { return pi * in.D * in.soil.adhesion * in.soil.Su; }

double lateral(const In<PipeSand>& in) { return lateral_factor(in.soil.phi, in.H / in.D) * in.pressure; }
double lateral(const In<PipeClay>& in) {
  const double x = in.H / in.D;
  const double factor = 6.752 + 0.065 * x - 11.063 / std::pow(x + 1.0, 2) + 7.119 / std::pow(x + 1.0, 3);
  return std::min(factor, 9.0) * in.soil.Su * in.D;
}

PipeReaction uplift(const In<PipeSand>& in) {
  const double factor = std::min(in.soil.phi / 44.0 * in.H / in.D, bearing_factor(in.soil.phi));
  return {factor * in.pressure, std::min((in.soil.is_dense ? 0.01 : 0.02) * in.H, 0.1 * in.D)};
}
PipeReaction uplift(const In<PipeClay>& in) {
  const double factor = std::min(2.0 * in.H / in.D, 10.0);
  return {factor * in.soil.Su * in.D, std::min((in.soil.is_stiff ? 0.1 : 0.2) * in.H, 0.2 * in.D)};
}

/// Returns the share of the bearing force that the weight of the soil beneath the axis gives.
double weight_beneath(const BuriedPipe& pipe, double phi) {
  return weight_factor(phi) * pipe.total_unit_weight * pipe.diameter * pipe.diameter * 0.5;
}
PipeReaction bearing(const In<PipeSand>& in) {
  return {bearing_factor(in.soil.phi) * in.pressure + weight_beneath(in.pipe, in.soil.phi), 0.1 * in.D};
}
PipeReaction bearing(const In<PipeClay>& in) {
  return {(2.0 + pi) * in.soil.Su * in.D + in.pressure + weight_beneath(in.pipe, 0.0), 0.2 * in.D};
}

template <class Reaction>
auto of(const BuriedPipe& pipe, const Reaction& reaction) {
  return std::visit(
      [&](const auto& soil) {
        return reaction(In<std::decay_t<decltype(soil)>>{pipe, soil});
      },
      pipe.soil);
}

json foundation(const BuriedPipe& pipe, const char* name, const PipeReaction& reaction) {
  const std::array<std::array<double, 2>, 2> points{{{0.0, 0.0}, {reaction.displacement, reaction.force}}};
  return {{"id", pipe.id + " " + name},
          {"member", pipe.member},
          {"law", {{"type", "table"}, {"points", points}, {"interpolation", "linear"}}}};
}

json axial_foundation(const BuriedPipe& pipe) {
  json out = foundation(pipe, "axial", axial_reaction(pipe));
  out["component"] = "tangent";
  return out;
}

json one_sided(const BuriedPipe& pipe, const char* name, const PipeReaction& reaction, bool is_left) {
  json out = foundation(pipe, name, reaction);
  out["reaction"] = "compression_only";
  out["side"] = is_left ? "left" : "right";
  return out;
}

}  // namespace

PipeReaction axial_reaction(const BuriedPipe& pipe) {
  return {of(pipe, [](const auto& in) { return axial(in); }), pipe.displacements.axial};
}

PipeReaction lateral_reaction(const BuriedPipe& pipe) {
  const double D = pipe.diameter;
  return {of(pipe, [](const auto& in) { return lateral(in); }),
          pipe.displacements.lateral.value_or(std::min(0.04 * (pipe.depth + 0.5 * D), 0.1 * D))};
}

PipeReaction uplift_reaction(const BuriedPipe& pipe) {
  PipeReaction out = of(pipe, [](const auto& in) { return uplift(in); });
  out.displacement = pipe.displacements.uplift.value_or(out.displacement);
  return out;
}

PipeReaction bearing_reaction(const BuriedPipe& pipe) {
  PipeReaction out = of(pipe, [](const auto& in) { return bearing(in); });
  out.displacement = pipe.displacements.bearing.value_or(out.displacement);
  return out;
}

json write_pipe_in_plan(const BuriedPipe& pipe) {
  return json::array({axial_foundation(pipe), foundation(pipe, "lateral", lateral_reaction(pipe))});
}

json write_pipe_in_elevation(const BuriedPipe& pipe, bool up_is_left) {
  return json::array({axial_foundation(pipe), one_sided(pipe, "uplift", uplift_reaction(pipe), up_is_left),
                      one_sided(pipe, "bearing", bearing_reaction(pipe), !up_is_left)});
}

}  // namespace snapthrough::api::soil
