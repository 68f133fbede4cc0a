/// Reader of loads and load cases.

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "api/read_along.h"
#include "api/read_parts.h"
#include "solver/model/limits.h"

namespace snapthrough::api {

static void read(const Value& value, LoadMeasure& out) {
  static constexpr Named<LoadMeasure> kNames[] = {{"length", LoadMeasure::length},
                                                  {"horizontal", LoadMeasure::horizontal},
                                                  {"vertical", LoadMeasure::vertical}};
  read_named(value, kNames, out);
}

static void read(const Value& value, LoadAxes& out) {
  static constexpr Named<LoadAxes> kNames[] = {{"global", LoadAxes::global}, {"member", LoadAxes::member}};
  read_named(value, kNames, out);
}

template <class T>
static void read_along(Object& in, std::string_view key, T& out, Along<T>& along) {
  if (const auto value = in.find(key)) {
    read_along(*value, out, along, kLeastPoints);
  }
}

static Load read_point_load(Object& in) {
  PointLoad load;
  in.required("at", load.at);
  in.required("force", load.force);
  in.optional("moment", load.moment);
  in.optional("pattern", load.pattern);
  in.optional("follows", load.follows);
  in.optional("fixed_line", load.fixed_line);
  return load;
}

static Load read_distributed_load(Object& in) {
  DistributedLoad load;
  in.required("member", load.member);
  if (const auto force = in.find_required("force")) {
    read_along(*force, load.force, load.force_along, kLeastPoints);
  }
  in.optional("axes", load.axes);
  in.optional("range", load.range);
  in.optional("per", load.per);
  in.optional("pattern", load.pattern);
  return load;
}

static Load read_pressure_load(Object& in) {
  PressureLoad load;
  in.required("member", load.member);
  if (const auto amount = in.find_required("value")) {
    read_along(*amount, load.value, load.value_along, kLeastPoints);
  }
  in.optional("side", load.side);
  in.optional("pattern", load.pattern);
  return load;
}

static Load read_initial_strain(Object& in) {
  InitialStrain load;
  in.required("member", load.member);
  read_along(in, "axial", load.axial, load.axial_along);
  read_along(in, "curvature", load.curvature, load.curvature_along);
  in.optional("pattern", load.pattern);
  return load;
}

static Load read_self_weight(Object& in) {
  SelfWeight load;
  in.required("gravity", load.gravity);
  in.optional("pattern", load.pattern);
  return load;
}

static Load read_temperature(Object& in) {
  TemperatureLoad load;
  in.required("member", load.member);
  read_along(in, "change", load.change, load.change_along);
  read_along(in, "gradient", load.gradient, load.gradient_along);
  in.optional("pattern", load.pattern);
  return load;
}

void read(const Value& value, Load& out) {
  static constexpr Named<Load (*)(Object&)> kForms[] = {
      {"point", read_point_load},        {"distributed", read_distributed_load},
      {"pressure", read_pressure_load},  {"initial_strain", read_initial_strain},
      {"self_weight", read_self_weight}, {"temperature", read_temperature}};
  read_tagged(value, kForms, out);
}

static void scale(double& amount, double factor) { amount *= factor; }
static void scale(std::array<double, 2>& amount, double factor) {
  amount = {amount[0] * factor, amount[1] * factor};
}
template <class T>
static void scale(Along<T>& along, double factor) {
  for (auto& [fraction, amount] : along) {
    scale(amount, factor);
  }
}

namespace {

/// Multiplies all amounts of a load.
struct Scaling {
  double factor;

  template <class... Amounts>
  void all(Amounts&... amounts) const {
    (scale(amounts, factor), ...);
  }
  void operator()(PointLoad& l) const { all(l.force, l.moment); }
  void operator()(DistributedLoad& l) const { all(l.force, l.force_along); }
  void operator()(PressureLoad& l) const { all(l.value, l.value_along); }
  void operator()(InitialStrain& l) const { all(l.axial, l.curvature, l.axial_along, l.curvature_along); }
  void operator()(SelfWeight& l) const { all(l.gravity); }
  void operator()(TemperatureLoad& l) const { all(l.change, l.gradient, l.change_along, l.gradient_along); }
};

}  // namespace

static void read_load_case(const Value& value, Model& model) {
  Object in(value);
  LoadCase out;
  std::vector<Load> loads;
  double factor = 1.0;
  bool grows = false;
  in.required("id", out.id);
  in.required("loads", loads);
  in.optional("factor", factor);
  in.optional("grows", grows);
  if (std::abs(factor) > kMaxMagnitude) {
    in.find("factor")->report("out_of_range", "factor must be finite");
  }
  const auto list = in.find("loads");
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Value item = list->item(i);
    if (const auto pattern = item.is_object() ? item.member("pattern") : std::nullopt) {
      pattern->report("ambiguous", "the load case says by grows whether its loads grow: leave pattern out");
    }
    std::visit(Scaling{factor}, loads[i]);
    std::visit([grows](auto& load) { load.pattern = grows ? Pattern::proportional : Pattern::constant; },
               loads[i]);
  }
  in.finish();
  out.loads = loads.size();
  model.load_cases.push_back(std::move(out));
  model.loads.insert(model.loads.end(), loads.begin(), loads.end());
}

void read_load_cases(const Value& value, Model& model) {
  if (!value.is_array()) {
    value.report_type("an array");
    return;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    read_load_case(value.item(i), model);
  }
}

}  // namespace snapthrough::api
