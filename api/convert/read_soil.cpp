/// Reader of soil documents: each function lists the fields of one object.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "api/convert/soil.h"
#include "api/convert/ultimate_resistance.h"
#include "api/value.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"

namespace snapthrough::api::convert {

double Pile::fraction(double depth) const {
  const double from_head = std::clamp((depth - head_depth) / length, 0.0, 1.0);
  return head_is_start ? from_head : 1.0 - from_head;
}

std::string foundation_id(const Pile& pile, std::size_t layer, std::size_t curve) {
  return pile.member + " layer " + std::to_string(layer) +
         (curve > 0 ? " curve " + std::to_string(curve) : std::string());
}

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

/// Reports a number that was read and breaks a rule; `rule` completes "`key` must be".
static void require(Object& in, std::string_view key, double value, bool holds, const std::string& rule) {
  if (!holds && !std::isnan(value)) {
    in.find(key)->report("out_of_range",
                         std::string(key) + " must be " + rule + ", got " + checks::text(value));
  }
}

/// Reads a required number with 0 < number <= kMaxMagnitude.
static void read_positive(Object& in, std::string_view key, double& out) {
  in.required(key, out);
  require(in, key, out, out > 0.0 && out <= kMaxMagnitude, "positive and finite");
}

static void read(const Value& value, Loading& out) {
  static constexpr Named<Loading> kNames[] = {{"static", Loading::static_}, {"cyclic", Loading::cyclic}};
  read_named(value, kNames, out);
}

static void read(const Value& value, Pile& out) {
  static constexpr Named<bool> kEnds[] = {{"start", true}, {"end", false}};
  Object in(value);
  in.required("member", out.member);
  read_positive(in, "diameter", out.diameter);
  read_positive(in, "length", out.length);
  if (const auto head = in.find("head")) {
    read_named(*head, kEnds, out.head_is_start);
  }
  if (in.optional("head_depth", out.head_depth)) {
    require(in, "head_depth", out.head_depth, std::abs(out.head_depth) <= kMaxMagnitude, "finite");
    require(in, "head_depth", out.head_depth, !(out.head_depth <= -out.length),
            "above minus the length of the pile, so that the pile reaches the ground");
  }
  in.finish();
}

/// Reads the fields that every layer has.
static Layer read_layer(Object& in) {
  Layer layer;
  in.required("from", layer.from);
  in.required("to", layer.to);
  require(in, "to", layer.to, layer.to <= kMaxMagnitude && !(layer.to <= layer.from),
          "finite and greater than from");
  read_positive(in, "gamma", layer.gamma);
  return layer;
}

static Layer read_sand(Object& in) {
  Layer layer = read_layer(in);
  Sand sand;
  const bool by_coefficients = in.find("C1") || in.find("C2") || in.find("C3");
  if (in.find("phi")) {
    double phi = 0.0;
    in.required("phi", phi);
    require(in, "phi", phi, phi >= kLeastPhi && phi <= kLargestPhi,
            "from " + checks::text(kLeastPhi) + " to " + checks::text(kLargestPhi) +
                " degrees; outside give C1, C2 and C3");
    const SandCoefficients coefficients = sand_coefficients(phi);
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
  layer.soil = sand;
  return layer;
}

/// Reads the strength: one number, or two for the upper and the lower face.
static void read_strength(Object& in, SoftClay& clay) {
  const auto value = in.find_required("Su");
  if (!value) {
    return;
  }
  std::array<double, 2> faces{};
  if (value->is_array()) {
    read(*value, faces);
  } else if (value->is_number()) {
    read(*value, faces[0]);
    faces[1] = faces[0];
  } else {
    value->report_type("a number, or two numbers for the upper and the lower face");
    return;
  }
  const auto is_strength = [](double Su) { return std::isnan(Su) || (Su >= 0.0 && Su <= kMaxMagnitude); };
  if (!is_strength(faces[0]) || !is_strength(faces[1]) || (faces[0] == 0.0 && faces[1] == 0.0)) {
    value->report("out_of_range", "Su must be finite, not negative, and positive at one face at least");
  }
  clay.Su_top = faces[0];
  clay.Su_bottom = faces[1];
}

static Layer read_soft_clay(Object& in) {
  Layer layer = read_layer(in);
  SoftClay clay;
  read_strength(in, clay);
  in.required("eps50", clay.eps50);
  require(in, "eps50", clay.eps50, clay.eps50 > 0.0 && clay.eps50 < 1.0, "a strain between 0 and 1");
  read_positive(in, "J", clay.J);
  layer.soil = clay;
  return layer;
}

static void read(const Value& value, Layer& out) {
  static constexpr Named<Layer (*)(Object&)> kForms[] = {{"sand", read_sand}, {"soft_clay", read_soft_clay}};
  read_tagged(value, kForms, out);
}

static void read_units(const Value& value, std::map<std::string, std::string>& out) {
  if (!value.is_object()) {
    value.report_type("an object of strings");
    return;
  }
  for (const std::string& key : value.keys()) {
    read(*value.member(key), out[key]);
  }
}

/// Requires that layers follow one another from the surface and reach the tip. @pre all fields are readable
static void require_order(const SoilDocument& document, Report& report) {
  double above = 0.0;
  for (std::size_t i = 0; i < document.layers.size(); ++i) {
    const Layer& layer = document.layers[i];
    if (layer.from != above) {
      report.add("/layers/" + std::to_string(i) + "/from", "out_of_range",
                 "a layer must begin where the one above it ends, at depth " + checks::text(above) +
                     ", got " + checks::text(layer.from));
    }
    above = layer.to;
  }
  if (document.layers.empty() || document.layers.size() > kMaxLayers) {
    report.add("/layers", "out_of_range",
               "there must be 1 to " + std::to_string(kMaxLayers) + " layers, got " +
                   std::to_string(document.layers.size()));
  } else if (above < document.pile.tip_depth() - kMinRelativeChord * document.pile.length) {
    report.add("/layers/" + std::to_string(document.layers.size() - 1) + "/to", "out_of_range",
               "the layers must reach the tip of the pile at depth " +
                   checks::text(document.pile.tip_depth()) + ", got " + checks::text(above));
  }
}

static void read(const Value& value, SoilDocument& out) {
  Object in(value);
  if (const auto units = in.find("units")) {
    read_units(*units, out.units);
  }
  in.required("pile", out.pile);
  in.required("layers", out.layers);
  in.required("loading", out.loading);
  if (in.optional("accuracy", out.accuracy)) {
    require(in, "accuracy", out.accuracy, out.accuracy >= kLeastAccuracy && out.accuracy <= kLargestAccuracy,
            "from " + checks::text(kLeastAccuracy) + " to " + checks::text(kLargestAccuracy));
  }
  in.finish();
}

SoilDocument read_soil(const nlohmann::json& json, std::vector<Finding>& findings) {
  SoilDocument document;
  Report report;
  read(Value(json, PointerPath(), report), document);
  if (report.findings().empty()) {
    require_order(document, report);
  }
  findings = report.findings();
  if (findings.empty()) {
    checks::Ids("foundation")
        .add(checks::Place(PointerPath("/pile/member"), findings),
             foundation_id(document.pile, kMaxLayers, kMaxFoundations));
  }
  return document;
}

}  // namespace snapthrough::api::convert
