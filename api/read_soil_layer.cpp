#include "api/read_soil_layer.h"

#include <array>
#include <cmath>

#include "api/soil/ultimate_resistance.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

void require(Object& in, std::string_view key, double value, bool holds, const std::string& rule) {
  if (!holds && !std::isnan(value)) {
    in.find(key)->report("out_of_range",
                         std::string(key) + " must be " + rule + ", got " + checks::text(value));
  }
}

void read_positive(Object& in, std::string_view key, double& out) {
  in.required(key, out);
  require(in, key, out, out > 0.0 && out <= kMaxMagnitude, "positive and finite");
}

void read(const Value& value, soil::Loading& out) {
  static constexpr Named<soil::Loading> kNames[] = {{"static", soil::Loading::static_},
                                                    {"cyclic", soil::Loading::cyclic}};
  read_named(value, kNames, out);
}

void read_accuracy(Object& in, double& out) {
  if (in.optional("accuracy", out)) {
    require(in, "accuracy", out, out >= soil::kLeastAccuracy && out <= soil::kLargestAccuracy,
            "from " + checks::text(soil::kLeastAccuracy) + " to " + checks::text(soil::kLargestAccuracy));
  }
}

soil::Sand read_api_sand(Object& in) {
  soil::Sand sand;
  const bool by_coefficients = in.find("C1") || in.find("C2") || in.find("C3");
  if (in.find("phi")) {
    double phi = 0.0;
    in.required("phi", phi);
    require(in, "phi", phi, phi >= soil::kLeastPhi && phi <= soil::kLargestPhi,
            "from " + checks::text(soil::kLeastPhi) + " to " + checks::text(soil::kLargestPhi) +
                " degrees; outside give C1, C2 and C3");
    const soil::SandCoefficients coefficients = soil::sand_coefficients(phi);
    sand.C1 = coefficients.C1;
    sand.C2 = coefficients.C2;
    sand.C3 = coefficients.C3;
    if (by_coefficients) {
      in.value().report("ambiguous", "sand is given by phi or by C1, C2 and C3, not by both");
    }
  } else if (by_coefficients) {
    read_positive(in, "C1", sand.C1);
    read_positive(in, "C2", sand.C2);
    read_positive(in, "C3", sand.C3);
  } else if (in.is_readable()) {
    in.value().report("missing_field", "sand needs phi, or C1, C2 and C3");
  }
  read_positive(in, "k", sand.k);
  return sand;
}

std::optional<std::array<double, 2>> read_faces(Object& in, std::string_view key) {
  const auto value = in.find_required(key);
  if (!value) {
    return std::nullopt;
  }
  std::array<double, 2> faces{};
  if (value->is_array()) {
    read(*value, faces);
  } else if (value->is_number()) {
    read(*value, faces[0]);
    faces[1] = faces[0];
  } else {
    value->report_type("a number, or two numbers for the upper and the lower face");
    return std::nullopt;
  }
  return faces;
}

/// Reads the strength, which may vanish at one face.
static void read_strength(Object& in, soil::SoftClay& clay) {
  const auto given = read_faces(in, "Su");
  if (!given) {
    return;
  }
  const std::array<double, 2>& faces = *given;
  const auto is_strength = [](double Su) { return std::isnan(Su) || (Su >= 0.0 && Su <= kMaxMagnitude); };
  if (!is_strength(faces[0]) || !is_strength(faces[1]) || (faces[0] == 0.0 && faces[1] == 0.0)) {
    in.find("Su")->report("out_of_range",
                          "Su must be finite, not negative, and positive at one face at least");
  }
  clay.Su_top = faces[0];
  clay.Su_bottom = faces[1];
}

soil::SoftClay read_soft_clay(Object& in) {
  soil::SoftClay clay;
  read_strength(in, clay);
  in.required("eps50", clay.eps50);
  require(in, "eps50", clay.eps50, clay.eps50 > 0.0 && clay.eps50 < 1.0, "a strain between 0 and 1");
  read_positive(in, "J", clay.J);
  return clay;
}

}  // namespace snapthrough::api
