/// Checks of loads, imperfections and monitors.

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "solver/check/check_parts.h"
#include "solver/check/load_features.h"
#include "solver/model/limits.h"
#include "solver/numeric/number_text.h"
#include "solver/support/law.h"

namespace snapthrough::checks {

namespace {

void check_force(const Place& place, const std::array<double, 2>& force) {
  require_finite(place / 0, force[0]);
  require_finite(place / 1, force[1]);
}

void check_value(const Place& place, double value) { require_finite(place, value); }
void check_value(const Place& place, const std::array<double, 2>& force) { check_force(place, force); }

template <class T>
void check_amounts(const Place& field, const Along<T>& along) {
  check_along(field, along, kMaxCurvePoints,
              [](const Place& place, const T& value) { check_value(place, value); });
}

void check_load(const Place& place, const PointLoad& load, const Names& names) {
  check_location(place / "at", load.at, names);
  check_force(place / "force", load.force);
  require_finite(place / "moment", load.moment);
}

void check_load(const Place& place, const DistributedLoad& load, const Names& names) {
  require_beam(place / "member", load.member, names);
  check_force(place / "force", load.force);
  check_amounts(place / "force", load.force_along);
  require_fractions(place / "range", load.range);
}

void check_load(const Place& place, const PressureLoad& load, const Names& names) {
  require_beam(place / "member", load.member, names);
  require_finite(place / "value", load.value);
  check_amounts(place / "value", load.value_along);
}

void check_load(const Place& place, const InitialStrain& load, const Names& names) {
  require_beam(place / "member", load.member, names);
  require_finite(place / "axial", load.axial);
  require_finite(place / "curvature", load.curvature);
  check_amounts(place / "axial", load.axial_along);
  check_amounts(place / "curvature", load.curvature_along);
}

void check_load(const Place& place, const SelfWeight& load, const Names&) {
  check_force(place / "gravity", load.gravity);
}

// NaN counts as an amount, because another finding reports it.
bool is_amount(double value) { return !(value == 0.0); }
bool is_amount(const std::array<double, 2>& v) { return is_amount(v[0]) || is_amount(v[1]); }
template <class T>
bool is_amount(const Along<T>& along) {
  return std::any_of(along.begin(), along.end(), [](const auto& point) { return is_amount(point.second); });
}

void check_load(const Place& place, const TemperatureLoad& load, const Names& names) {
  names.members.require(place / "member", load.member);
  require_finite(place / "change", load.change);
  require_finite(place / "gradient", load.gradient);
  check_amounts(place / "change", load.change_along);
  check_amounts(place / "gradient", load.gradient_along);
  if (names.rods.contains(load.member) && (is_amount(load.gradient) || is_amount(load.gradient_along)))
    (place / "gradient")
        .report("not_supported", "a gradient bends a member, and member " + in_quotes(load.member) +
                                     " is one-sided: it is straight between its nodes");
}

bool has_amount(const PointLoad& load) { return is_amount(load.force) || is_amount(load.moment); }
bool has_amount(const DistributedLoad& load) { return is_amount(load.force) || is_amount(load.force_along); }
bool has_amount(const PressureLoad& load) { return is_amount(load.value) || is_amount(load.value_along); }
bool has_amount(const InitialStrain& load) {
  return is_amount(load.axial) || is_amount(load.curvature) || is_amount(load.axial_along) ||
         is_amount(load.curvature_along);
}
bool has_amount(const SelfWeight& load) { return is_amount(load.gravity); }
bool has_amount(const TemperatureLoad& load) {
  return is_amount(load.change) || is_amount(load.gradient) || is_amount(load.change_along) ||
         is_amount(load.gradient_along);
}

bool grows(const Load& load) {
  return std::visit([](const auto& l) { return l.pattern == Pattern::proportional && has_amount(l); }, load);
}

bool is_amount(const AlongMember& value) { return is_amount(value.constant) || is_amount(value.points); }
bool has_amount(const PrescribedDisplacement& d) {
  return is_amount(d.x) || is_amount(d.y) || is_amount(d.rotation);
}
bool has_amount(const GroundDisplacement& d) { return is_amount(d.x) || is_amount(d.y); }

/// Whether the prescribed displacement of a support, a spring or a foundation grows.
template <class Supporting>
bool grows(const Supporting& one) {
  const auto& d = one.displacement;
  return d && d->pattern == Pattern::proportional && has_amount(*d);
}

void check_imperfection(const Place& place, const SineImperfection& imperfection, const Names& names) {
  require_beam(place / "member", imperfection.member, names);
  require_between(place / "half_waves", imperfection.half_waves, 1, kMaxHalfWaves);
  require_finite(place / "amplitude", imperfection.amplitude);
}

void check_imperfection(const Place& place, const ModeImperfection& imperfection, const Names&) {
  require_between(place / "number", imperfection.number, 1, kMaxModes);
  require_finite(place / "amplitude", imperfection.amplitude);
}

void check_imperfection(const Place& place, const PointsImperfection& imperfection, const Names& names) {
  require_beam(place / "member", imperfection.member, names);
  const Place offsets = place / "offsets";
  require_count(offsets, imperfection.offsets.size(), kMaxCurvePoints);
  if (imperfection.offsets.size() < 2) {
    offsets.report("empty", "offsets must hold at least two [fraction, offset] pairs");
  }
  double previous = -1.0;
  for (std::size_t i = 0; i < imperfection.offsets.size(); ++i) {
    const double fraction = imperfection.offsets[i][0];
    require_next_fraction(offsets / i / 0, fraction, previous);
    require_finite(offsets / i / 1, imperfection.offsets[i][1]);
    previous = fraction;
  }
}

void check_imperfection(const Place& place, const WorstImperfection& imperfection, const Names&) {
  require_positive(place / "amplitude", imperfection.amplitude);
}

/// Members at a node, with the verb: 'member "a" is', 'members "a", "b" and 7 more are'.
std::string members_at(const Model& model, const std::string& node) {
  std::string text;
  int count = 0;
  for (const Member& member : model.members) {
    if (member.start != node && member.end != node) continue;
    if (++count <= MessageLimits::members_at_node) text += (count > 1 ? ", " : "") + in_quotes(member.id);
  }
  if (count > MessageLimits::members_at_node)
    text += " and " + std::to_string(count - MessageLimits::members_at_node) + " more";
  return count == 1 ? "member " + text + " is" : "members " + text + " are";
}

/// Reports monitors of the rotation of a node at which all members are released: the node has none.
void check_rotations(const Place& monitors, const Model& data) {
  const auto free = nodes_free_to_turn(data);
  for (std::size_t i = 0; i < data.monitors.size(); ++i) {
    const Monitor& monitor = data.monitors[i];
    if (monitor.component != Component::rotation || !free.contains(monitor.at.node)) continue;
    (monitors / i / "component")
        .report("needs_member", "node " + in_quotes(monitor.at.node) +
                                    " has no rotation: " + members_at(data, monitor.at.node) +
                                    " hinged there, and no support or rotational spring turns with it; "
                                    "component rotation needs a location on a member here");
  }
}

/// Places of loads in the request: in the list of loads, or in that of their load case.
class LoadPlaces {
 public:
  LoadPlaces(const Place& model, const Model& data) : model_(model) {
    std::size_t first = data.loads.size();
    for (const LoadCase& one : data.load_cases) first -= one.loads;
    for (const LoadCase& one : data.load_cases) {
      starts_.push_back(first);
      first += one.loads;
    }
  }
  [[nodiscard]] Place of(std::size_t load) const {
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), load);
    if (next == starts_.begin()) return model_ / "loads" / load;
    const auto number = static_cast<std::size_t>(next - starts_.begin()) - 1;
    return model_ / "load_cases" / number / "loads" / (load - starts_[number]);
  }

 private:
  Place model_;
  std::vector<std::size_t> starts_;  ///< first load of each case
};

/// Reports sections without the mass or the expansion that the loads need.
void check_section_data(const Place& model, const Model& data, const Names& names) {
  bool is_weighed = false;
  std::unordered_set<std::string> heated;
  for (const Load& load : data.loads) {
    is_weighed = is_weighed || std::holds_alternative<SelfWeight>(load);
    if (const auto* temperature = std::get_if<TemperatureLoad>(&load)) heated.insert(temperature->member);
  }
  std::unordered_set<std::string> reported;
  for (const Member& member : data.members) {
    if (!names.sections.contains(member.section)) continue;
    const std::size_t index = names.sections.index(member.section);
    const Place place = model / "sections" / index;
    if (is_weighed && !data.sections[index].mass && reported.insert("mass " + member.section).second)
      (place / "mass")
          .report("missing_field",
                  "self_weight needs the mass or the density of section " + in_quotes(member.section));
    if (heated.contains(member.id) && !data.sections[index].expansion &&
        reported.insert("expansion " + member.section).second)
      (place / "expansion")
          .report("missing_field",
                  "a temperature load needs the expansion of section " + in_quotes(member.section));
  }
}

/// Reports moments on nodes whose rotation nothing resists.
void check_moments(const LoadPlaces& places, const Model& data) {
  const auto free = nodes_free_to_turn(data);
  for (std::size_t i = 0; i < data.loads.size(); ++i) {
    const LoadFeatures load = features_of(data.loads[i]);
    if (load.place == nullptr || load.moment == 0.0 || !free.contains(load.place->node)) continue;
    (places.of(i) / "moment")
        .report("mechanism", "the moment turns node \"" + load.place->node +
                                 "\" without deforming anything: all members are released there, and no "
                                 "support or rotational spring holds its rotation");
  }
}

/// Reports forces that are not dead and whose place has no rotation, or that both turn and keep their line.
void check_following(const LoadPlaces& places, const Model& data) {
  const auto free = nodes_free_to_turn(data);
  for (std::size_t i = 0; i < data.loads.size(); ++i) {
    const auto* load = std::get_if<PointLoad>(&data.loads[i]);
    if (load == nullptr || is_dead(*load)) continue;
    const Place field = places.of(i) / (load->fixed_line ? "fixed_line" : "follows");
    if (load->follows && load->fixed_line)
      field.report("not_supported",
                   "a force that follows its place does not stay on one line: give one of the two");
    if (!free.contains(load->at.node)) continue;
    field.report("needs_member",
                 "node " + in_quotes(load->at.node) + " has no rotation that the force could " +
                     (load->fixed_line ? "act on" : "follow") + ": " + members_at(data, load->at.node) +
                     " hinged there; it needs a location on a member here");
  }
}

}  // namespace

void check_loads(const Place& model, const Model& data, const Names& names) {
  const LoadPlaces places(model, data);
  require_count(model / "loads", data.loads.size(), kMaxLoads);
  require_count(model / "load_cases", data.load_cases.size(), kMaxLoads);
  Ids cases("load case");
  for (std::size_t i = 0; i < data.load_cases.size(); ++i) {
    cases.add(model / "load_cases" / i / "id", data.load_cases[i].id);
  }
  for (std::size_t i = 0; i < data.loads.size(); ++i) {
    std::visit([&, place = places.of(i)](const auto& load) { check_load(place, load, names); },
               data.loads[i]);
  }
  check_moments(places, data);
  check_following(places, data);
  check_section_data(model, data, names);
}

void check_something_proportional(const Place& model, const Model& data, const Analysis& analysis) {
  const auto some_grow = [](const auto& list) {
    return std::any_of(list.begin(), list.end(), [](const auto& one) { return grows(one); });
  };
  const bool something = some_grow(data.loads) || some_grow(data.supports) || some_grow(data.springs) ||
                         some_grow(data.foundations);
  if (!something && !analysis.traits().has_rows) {
    (model / "loads")
        .report("no_load",
                "nothing grows with the load factor: at least one proportional load or "
                "prescribed displacement must not be zero");
  }
}

void check_imperfections(const Place& model, const Model& data, const Names& names) {
  const Place imperfections = model / "imperfections";
  require_count(imperfections, data.imperfections.size(), kMaxImperfections);
  for (std::size_t i = 0; i < data.imperfections.size(); ++i) {
    std::visit([&, place = imperfections / i](const auto& item) { check_imperfection(place, item, names); },
               data.imperfections[i]);
  }
}

void check_masses(const Place& model, const Model& data, const Names& names) {
  const Place masses = model / "masses";
  require_count(masses, data.masses.size(), kMaxMasses);
  require_not_negative(model / "damping" / "mass", data.damping.mass);
  require_not_negative(model / "damping" / "stiffness", data.damping.stiffness);
  for (std::size_t i = 0; i < data.masses.size(); ++i) {
    const Place place = masses / i;
    const PointMass& point = data.masses[i];
    check_location(place / "at", point.at, names);
    require_not_negative(place / "mass", point.mass);
    require_not_negative(place / "inertia", point.inertia);
    if (point.inertia == 0.0 || point.at.node.empty()) continue;
    const bool turns = std::any_of(data.members.begin(), data.members.end(), [&](const Member& member) {
      return (member.start == point.at.node && !is_rod(member) && !member.release_start_rotation) ||
             (member.end == point.at.node && !is_rod(member) && !member.release_end_rotation);
    });
    if (!turns)
      (place / "inertia")
          .report("needs_member", "no member turns with node " + in_quotes(point.at.node) +
                                      ": an inertia needs a location on a member here");
  }
}

void check_monitors(const Place& model, const Model& data, Names& names) {
  const Place monitors = model / "monitors";
  require_count(monitors, data.monitors.size(), kMaxMonitors);
  for (std::size_t i = 0; i < data.monitors.size(); ++i) {
    const Place place = monitors / i;
    const Monitor& monitor = data.monitors[i];
    names.monitors.add(place / "id", monitor.id);
    check_location(place / "at", monitor.at, names);
    if (monitor.component == Component::normal && !monitor.at.node.empty()) {
      (place / "component").report("needs_member", "component normal needs a location on a member");
    }
  }
  check_rotations(monitors, data);
}

}  // namespace snapthrough::checks
