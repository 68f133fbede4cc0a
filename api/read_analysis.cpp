/// Reader of the analysis: each function lists the fields of one part.

#include "api/read_parts.h"

namespace snapthrough::api {

// The functions are static, not in an unnamed namespace, so that templates of api/value.h find them.

static void read(const Value& value, AnalysisType& out) { read_named(value, kAnalysisTypes, out); }

static void read(const Value& value, Geometry& out) {
  static constexpr Named<Geometry> kNames[] = {{"nonlinear", Geometry::nonlinear},
                                               {"linear", Geometry::linear}};
  read_named(value, kNames, out);
}

static void read(const Value& value, Unstable& out) {
  static constexpr Named<Unstable> kNames[] = {{"refuse", Unstable::refuse}, {"follow", Unstable::follow}};
  read_named(value, kNames, out);
}

static void read(const Value& value, FoundationRule& out) {
  static constexpr Named<FoundationRule> kNames[] = {{"consistent", FoundationRule::consistent},
                                                     {"lumped", FoundationRule::lumped}};
  read_named(value, kNames, out);
}

static void read(const Value& value, Follow& out) {
  static constexpr Named<Follow> kNames[] = {
      {"primary", Follow::primary}, {"first", Follow::first}, {"all", Follow::all}};
  read_named(value, kNames, out);
}

/// Reads one number for all members, or an object with a number for each member.
static void read_elements(const Value& value, Discretization& out) {
  if (value.is_number()) {
    read(value, out.elements);
  } else if (!value.is_object()) {
    value.report_type("an integer or an object of integers by member id");
  } else {
    for (const std::string& member : value.keys()) {
      read(*value.member(member), out.member_elements.emplace_back(member, 1).second);
    }
    if (value.size() == 0) {
      value.report("empty", "elements must name each member");
    }
  }
}

static void read(const Value& value, Discretization& out) {
  Object in(value);
  const bool has_accuracy = in.optional("accuracy", out.accuracy);
  const bool has_order = in.optional("order", out.order);
  const bool has_rule = in.optional("foundation", out.foundation);
  out.fixed_mesh = has_order || has_rule || in.find("elements");
  if (const auto elements = out.fixed_mesh ? in.find_required("elements") : std::nullopt) {
    read_elements(*elements, out);
  }
  if (has_accuracy && out.fixed_mesh) {
    value.report("ambiguous",
                 "give either an accuracy or a fixed mesh (elements, order, foundation), not both");
  }
  in.finish();
}

static void read(const Value& value, Control& out) {
  static constexpr Named<ControlType> kNames[] = {{"arc_length", ControlType::arc_length},
                                                  {"load", ControlType::load}};
  if (value.is_string()) {
    read_named(value, kNames, out.type);
  } else if (value.is_object()) {
    Object in(value);
    out.type = ControlType::displacement;
    in.required("displacement", out.monitor);
    in.finish();
  } else {
    value.report_type("\"arc_length\", \"load\" or {\"displacement\": monitor id}");
  }
}

static void read(const Value& value, StepOptions& out) {
  Object in(value);
  in.optional("initial", out.initial);
  in.optional("min", out.min);
  in.optional("max", out.max);
  in.optional("direction", out.direction);
  in.finish();
}

static void read_shape(const Value& value, MemberShape& out) {
  Object in(value);
  in.required("s", out.s);
  in.required("u", out.u);
  in.required("v", out.v);
  in.required("rotation", out.rotation);
  in.required("axial_force", out.axial);
  in.required("shear_force", out.shear);
  in.required("bending_moment", out.bend);
  in.finish();
}

static void read(const Value& value, StartState& out) {
  Object in(value);
  in.required("load_factor", out.load_factor);
  const auto members = in.find_required("members");
  if (!members) return;
  if (!members->is_object()) {
    members->report_type("an object of states by member id");
    return;
  }
  for (const std::string& id : members->keys()) {
    MemberShape& shape = out.members.emplace_back();
    shape.id = id;
    read_shape(*members->member(id), shape);
  }
  in.finish();
}

static void read(const Value& value, MonitorRange& out) {
  Object in(value);
  in.required("id", out.id);
  in.required("range", out.range);
  in.finish();
}

static void read(const Value& value, StopRules& out) {
  Object in(value);
  in.optional("limit_points", out.limit_points);
  in.optional("load_factor", out.load_factor);
  in.optional("monitor", out.monitor);
  in.optional("steps", out.steps);
  in.optional("negative_eigenvalues", out.negative_eigenvalues);
  in.finish();
}

static void read(const Value& value, BranchOptions& out) {
  Object in(value);
  in.optional("follow", out.follow);
  in.optional("limit", out.limit);
  in.finish();
}

/// Reads a name, or an object with `every` or `at_load_factors`.
static void read_states(const Value& value, OutputOptions& out) {
  if (value.is_string()) {
    read_named(value, kStateOutputs, out.states);
    return;
  }
  if (!value.is_object()) {
    value.report_type("\"none\", \"critical\", \"all\", {\"every\": n} or {\"at_load_factors\": [...]}");
    return;
  }
  Object in(value);
  const bool has_every = in.optional("every", out.every);
  const bool has_factors = in.optional("at_load_factors", out.at_load_factors);
  out.states = has_every ? StateOutput::every : StateOutput::at_load_factors;
  if (has_every && has_factors) {
    value.report("ambiguous", "give either every or at_load_factors, not both");
  } else if (!has_every && !has_factors) {
    value.report("missing_field", "states needs every or at_load_factors");
  }
  in.finish();
}

static void read(const Value& value, OutputOptions& out) {
  Object in(value);
  if (const auto states = in.find("states")) {
    read_states(*states, out);
  }
  in.optional("points_per_member", out.points_per_member);
  in.optional("path_points", out.path_points);
  in.optional("extremes", out.extremes);
  in.optional("stiffness_at", out.stiffness_at);
  in.optional("frequencies", out.frequencies);
  in.finish();
}

/// Reads only the pointer; read_sensitivities() completes the variation when the model is known.
static void read(const Value& value, Variation& out) { read(value, out.pointer); }

void read(const Value& value, Analysis& analysis) {
  Object in(value);
  in.required("type", analysis.type);
  in.optional("modes", analysis.modes);
  in.optional("reversed", analysis.reversed);
  in.optional("load_factors", analysis.load_factors);
  in.optional("unstable", analysis.unstable);
  in.optional("geometry", analysis.geometry);
  in.optional("discretization", analysis.discretization);
  in.optional("control", analysis.control);
  in.optional("step", analysis.step);
  if (const auto start = in.find("start")) read(*start, analysis.start.emplace());
  in.optional("stop", analysis.stop);
  in.optional("branches", analysis.branches);
  in.optional("output", analysis.output);
  in.optional("sensitivities", analysis.sensitivities);
  in.optional("koiter", analysis.koiter);
  in.finish();
}

}  // namespace snapthrough::api
