/// Reader of soil documents: each function lists the fields of one object.

#include <cmath>
#include <nlohmann/json.hpp>

#include "api/convert/soil.h"
#include "api/read_soil_layer.h"
#include "api/soil/write_foundations.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

using convert::SoilDocument;
using soil::Layer;
using soil::Pile;

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

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
  layer.soil = read_api_sand(in);
  return layer;
}

static Layer read_clay(Object& in) {
  Layer layer = read_layer(in);
  layer.soil = read_soft_clay(in);
  return layer;
}

static void read(const Value& value, Layer& out) {
  static constexpr Named<Layer (*)(Object&)> kForms[] = {{"sand", read_sand}, {"soft_clay", read_clay}};
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
  for (std::size_t i = 0; i < document.profile.layers.size(); ++i) {
    const Layer& layer = document.profile.layers[i];
    if (layer.from != above) {
      report.add("/layers/" + std::to_string(i) + "/from", "out_of_range",
                 "a layer must begin where the one above it ends, at depth " + checks::text(above) +
                     ", got " + checks::text(layer.from));
    }
    above = layer.to;
  }
  if (document.profile.layers.empty() || document.profile.layers.size() > soil::kMaxLayers) {
    report.add("/layers", "out_of_range",
               "there must be 1 to " + std::to_string(soil::kMaxLayers) + " layers, got " +
                   std::to_string(document.profile.layers.size()));
  } else if (above < document.pile.tip_depth() - kMinRelativeChord * document.pile.length) {
    report.add("/layers/" + std::to_string(document.profile.layers.size() - 1) + "/to", "out_of_range",
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
  in.required("layers", out.profile.layers);
  in.required("loading", out.profile.loading);
  read_accuracy(in, out.profile.accuracy);
  in.finish();
}

SoilDocument convert::read_soil(const nlohmann::json& json, std::vector<Finding>& findings) {
  SoilDocument document;
  Report report;
  read(Value(json, PointerPath(), report), document);
  document.pile.id = document.pile.member;
  for (std::size_t i = 0; i < document.profile.layers.size(); ++i) {
    document.profile.layers[i].number = i;
  }
  if (report.findings().empty()) {
    require_order(document, report);
  }
  findings = report.findings();
  if (findings.empty()) {
    Layer last;
    last.number = soil::kMaxLayers;
    checks::Ids("foundation")
        .add(checks::Place(PointerPath("/pile/member"), findings),
             soil::foundation_id(document.pile, last, "", kMaxFoundations));
  }
  return document;
}

}  // namespace snapthrough::api
