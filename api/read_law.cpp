#include "api/read_law.h"

#include <limits>

#include "api/read_along.h"

namespace snapthrough::api {

void read(const Value& value, AlongMember& out) { read_along(value, out.constant, out.points, 1); }

static ReactionLaw read_limited(Object& in, ReactionLaw::Type type) {
  ReactionLaw law;
  law.type = type;
  in.required("stiffness", law.stiffness);
  in.required("capacity", law.capacity);
  return law;
}

static ReactionLaw read_tanh(Object& in) { return read_limited(in, ReactionLaw::Type::tanh); }
static ReactionLaw read_hyperbolic(Object& in) { return read_limited(in, ReactionLaw::Type::hyperbolic); }

static ReactionLaw read_power(Object& in) {
  ReactionLaw law = read_limited(in, ReactionLaw::Type::power);
  in.required("reference", law.reference);
  in.required("exponent", law.exponent);
  return law;
}

static void read_interpolation(Object& in, Interpolation& out) {
  if (const auto value = in.find("interpolation")) {
    static constexpr Named<Interpolation> kNames[] = {{"monotone_cubic", Interpolation::monotone_cubic},
                                                      {"linear", Interpolation::linear}};
    read_named(*value, kNames, out);
  }
}

static ReactionLaw read_table(Object& in) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::table;
  in.required("points", law.points);
  in.optional("factor", law.factor);
  read_interpolation(in, law.interpolation);
  return law;
}

void read(const Value& value, ReactionLaw& out) {
  static constexpr Named<ReactionLaw (*)(Object&)> kForms[] = {
      {"tanh", read_tanh}, {"hyperbolic", read_hyperbolic}, {"power", read_power}, {"table", read_table}};
  // a law that is not read stays a table without points, whose findings stand below the unreadable law: those
  // of a linear law would stand at `stiffness` beside it
  out.type = ReactionLaw::Type::table;
  read_tagged(value, kForms, out);
}

static BendingLaw read_ramberg_osgood(Object& in) {
  BendingLaw law;
  law.type = BendingLaw::Type::ramberg_osgood;
  in.required("moment", law.moment);
  in.required("exponent", law.exponent);
  in.optional("coefficient", law.coefficient);
  return law;
}

static BendingLaw read_bending_table(Object& in) {
  BendingLaw law;
  in.required("points", law.points);
  read_interpolation(in, law.interpolation);
  return law;
}

void read(const Value& value, BendingLaw& out) {
  static constexpr Named<BendingLaw (*)(Object&)> kForms[] = {{"ramberg_osgood", read_ramberg_osgood},
                                                              {"table", read_bending_table}};
  read_tagged(value, kForms, out);
}

/// Reads `law` if it is there; reports when neither or both of `law` and `stiffness` are.
static bool read_law_alone(Object& in, std::optional<ReactionLaw>& out) {
  const auto law = in.find("law");
  if (!law) {
    return false;
  }
  if (in.find("stiffness")) {
    law->report("ambiguous", "a law has its own stiffness: give either stiffness or law");
  }
  read(*law, out.emplace());
  return true;
}

bool read_rigid(const Value& value, double& out) {
  if (!value.is_string()) {
    return false;
  }
  static constexpr Named<double> kNames[] = {{"rigid", std::numeric_limits<double>::infinity()}};
  read_named(value, kNames, out);
  return true;
}

void read_law(Object& in, Spring& out) {
  if (read_law_alone(in, out.law)) {
    return;
  }
  set_unread(out.stiffness);
  if (const auto value = in.find_required("stiffness"); value && !read_rigid(*value, out.stiffness)) {
    read(*value, out.stiffness);
  }
}

void read_law(Object& in, Foundation& out) {
  if (read_law_alone(in, out.law)) {
    return;
  }
  set_unread(out.stiffness);
  const auto value = in.find_required("stiffness");
  if (!value || read_rigid(*value, out.stiffness)) {
    return;
  }
  AlongMember stiffness;
  read(*value, stiffness);
  if (stiffness.varies()) {
    out.law.emplace().stiffness = std::move(stiffness);
  } else {
    out.stiffness = stiffness.constant;
  }
}

}  // namespace snapthrough::api
