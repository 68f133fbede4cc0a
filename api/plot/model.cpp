#include "api/plot/model.h"

#include <algorithm>
#include <cmath>

#include "api/list_foundations.h"
#include "api/plot/outline.h"

namespace snapthrough::api::plot {
namespace {

/// Calls `take` for each item of an optional list.
template <class Take>
void for_each(const Field& model, std::string_view key, const Take& take) {
  if (const std::optional<Field> list = model.find(key)) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      take(list->item(i));
    }
  }
}

Point read_point(const Field& field) {
  const std::vector<double> pair = field.numbers(2);
  return {pair[0], pair[1]};
}

Location read_location(const Field& field) {
  if (const std::optional<Field> node = field.find("node")) {
    return {node->text(), "", 0};
  }
  return {"", field.at("member").text(), field.at("fraction").number()};
}

bool is_one_sided(const Field& field) { return text_or(field, "reaction", "bilateral") != "bilateral"; }

bool is_cable(const Field& member) {
  const std::optional<Field> cable = member.find("cable");
  return cable && cable->json() == true;
}
/// Whether a member is a rod: one-sided, or a cable.
bool is_rod(const Field& member) { return is_one_sided(member) || is_cable(member); }

/// Rods are hinged at both ends.
bool has_hinge(const Field& member, std::string_view end) {
  if (is_rod(member)) {
    return true;
  }
  const std::optional<Field> release = member.find("release");
  const std::optional<Field> list = release ? release->find(end) : std::nullopt;
  return list && (list->json().is_object() || list->size() > 0);
}

ModelMember read_member(const Field& field, const Model& model) {
  ModelMember member;
  member.id = field.at("id").text();
  const auto node = [&](const char* key) {
    const Field name = field.at(key);
    const auto found = model.nodes.find(name.text());
    if (found == model.nodes.end()) {
      name.fail("must be the id of a node");
    }
    return *found;
  };
  const auto [start, from] = node("start");
  const auto [end, to] = node("end");
  member.start = start;
  member.end = end;
  member.axis = member_axis(field, field.find("curve"), from, to);
  member.hinge_at_start = has_hinge(field, "start");
  member.hinge_at_end = has_hinge(field, "end");
  member.one_sided = is_rod(field);
  member.hangs = is_cable(field);
  return member;
}

ModelSupport read_support(const Field& field) {
  ModelSupport support{field.at("node").text(), false, false, false, number_or(field, "angle_degrees", 0)};
  const Field fixed = field.at("fixed");
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const std::string component = fixed.item(i).text();
    support.x = support.x || component == "x";
    support.y = support.y || component == "y";
    support.rotation = support.rotation || component == "rotation";
  }
  return support;
}

Point unit_vector(const Field& field) {
  const Point given = read_point(field);
  const double length = std::hypot(given.x, given.y);
  if (!(length > 0)) {
    field.fail("must have a direction");
  }
  return {given.x / length, given.y / length};
}

ModelSpring read_spring(const Field& field) {
  ModelSpring spring;
  spring.id = field.at("id").text();
  spring.at = read_location(field.at("at"));
  if (const auto to = field.find("to")) {
    spring.to = read_location(*to);
  }
  const Field direction = field.at("direction");
  if (!direction.json().is_string()) {
    spring.direction = unit_vector(direction);
  }
  spring.one_sided = is_one_sided(field);
  spring.gap = std::max(0.0, number_or(field, "gap", 0));
  return spring;
}

/// Reads a gap: one for the whole member, or [fraction, gap] pairs.
void read_gap(const Field& field, ModelFoundation& foundation) {
  const std::optional<Field> gap = field.find("gap");
  const std::optional<Field> along = gap && gap->json().is_object() ? gap->find("along") : std::nullopt;
  if (!along) {
    foundation.gap = std::max(0.0, number_or(field, "gap", 0));
    return;
  }
  for (std::size_t i = 0; i < along->size(); ++i) {
    const std::vector<double> pair = along->item(i).numbers(2);
    foundation.gap_along.emplace_back(pair[0], std::max(0.0, pair[1]));
    foundation.gap = std::max(foundation.gap, pair[1]);
  }
}

ModelFoundation read_foundation(const Field& field) {
  ModelFoundation foundation;
  foundation.id = field.at("id").text();
  foundation.member = field.at("member").text();
  foundation.side = text_or(field, "side", "left") == "right" ? -1 : 1;
  if (const std::optional<Field> direction = field.find("direction");
      direction && direction->json().is_array()) {
    foundation.direction = unit_vector(*direction);
  }
  foundation.one_sided = is_one_sided(field);
  foundation.compression_only = text_or(field, "reaction", "bilateral") == "compression_only";
  read_gap(field, foundation);
  if (const std::optional<Field> outline = field.find("outline")) {
    foundation.surface = read_outline(*outline);
    if (const std::optional<Field> points = outline->find("points")) {
      for (std::size_t i = 0; i < points->size(); ++i) {
        foundation.line.push_back(read_point(points->item(i)));
      }
    }
  }
  foundation.range = range_or_all(field);
  return foundation;
}

/// Reads a force per length: one for the whole member, or [fraction, force] pairs.
void read_force(const Field& field, ModelLoad& load) {
  const std::optional<Field> along = field.json().is_object() ? field.find("along") : std::nullopt;
  if (!along) {
    load.force = read_point(field);
    return;
  }
  for (std::size_t i = 0; i < along->size(); ++i) {
    const Field point = along->item(i);
    if (point.size() != 2) {
      point.fail("must be [fraction, force]");
    }
    const Point force = read_point(point.item(1));
    load.force_along.push_back({point.item(0).number(), force.x, force.y});
    if (std::hypot(force.x, force.y) > std::hypot(load.force.x, load.force.y)) {
      load.force = force;
    }
  }
}

/// Reads a pressure: one for the whole member, or [fraction, pressure] pairs.
void read_pressure(const Field& field, ModelLoad& load) {
  const std::optional<Field> along = field.json().is_object() ? field.find("along") : std::nullopt;
  if (!along) {
    load.value = field.number();
    return;
  }
  for (std::size_t i = 0; i < along->size(); ++i) {
    const std::vector<double> point = along->item(i).numbers(2);
    load.force_along.push_back({point[0], point[1], 0});
    if (std::abs(point[1]) > std::abs(load.value)) {
      load.value = point[1];
    }
  }
}

/// Returns a number, NaN for one that varies along the member.
double amount_or_zero(const Field& field, std::string_view key) {
  const std::optional<Field> value = field.find(key);
  return value && value->json().is_object() ? kNone : number_or(field, key, 0);
}

ModelLoad read_load(const Field& field) {
  ModelLoad load;
  const std::string type = field.at("type").text();
  load.constant = text_or(field, "pattern", "proportional") == "constant";
  if (type == "point") {
    load.at = read_location(field.at("at"));
    const std::optional<Field> force = field.find("force");
    load.force = force ? read_point(*force) : Point();
    load.moment = number_or(field, "moment", 0);
    const std::optional<Field> follows = field.find("follows");
    load.follows = follows && follows->flag();
    const std::optional<Field> fixed_line = field.find("fixed_line");
    load.fixed_line = fixed_line && fixed_line->flag();
    return load;
  }
  if (type == "self_weight") {
    load.type = ModelLoad::Type::self_weight;
    return load;
  }
  load.at.member = field.at("member").text();
  load.range = range_or_all(field);
  if (type == "distributed") {
    load.type = ModelLoad::Type::distributed;
    read_force(field.at("force"), load);
    load.per = text_or(field, "per", "length");
    load.member_axes = text_or(field, "axes", "global") == "member";
  } else if (type == "pressure") {
    load.type = ModelLoad::Type::pressure;
    read_pressure(field.at("value"), load);
    load.side = text_or(field, "side", "left") == "right" ? -1 : 1;
  } else if (type == "initial_strain") {
    load.type = ModelLoad::Type::initial_strain;
    load.axial = amount_or_zero(field, "axial");
    load.curvature = amount_or_zero(field, "curvature");
  } else if (type == "temperature") {
    load.type = ModelLoad::Type::temperature;
    load.axial = amount_or_zero(field, "change");
    load.curvature = amount_or_zero(field, "gradient");
  } else {
    field.at("type").fail("is a type of load that no figure knows");
  }
  return load;
}

/// Appends the loads of a load case, with its factor.
void read_load_case(const Field& field, Model& model) {
  const double factor = number_or(field, "factor", 1);
  const std::optional<Field> grows = field.find("grows");
  const bool constant = !(grows && grows->flag());
  for_each(field, "loads", [&](const Field& one) {
    ModelLoad& load = model.loads.emplace_back(read_load(one));
    load.constant = constant;
    for (double* amount :
         {&load.force.x, &load.force.y, &load.moment, &load.value, &load.axial, &load.curvature}) {
      *amount *= factor;
    }
    for (auto& point : load.force_along) {
      point[1] *= factor;
      point[2] *= factor;
    }
  });
}

}  // namespace

const ModelMonitor* Model::monitor(const std::string& id) const {
  const auto found =
      std::find_if(monitors.begin(), monitors.end(), [&](const ModelMonitor& one) { return one.id == id; });
  return found == monitors.end() ? nullptr : &*found;
}

std::string sense_of(const ModelMonitor& monitor, bool negative) {
  if (monitor.component == "x") {
    return negative ? "to the left" : "to the right";
  }
  if (monitor.component == "y") {
    return negative ? "down" : "up";
  }
  if (monitor.component == "rotation") {
    return negative ? "clockwise" : "counter-clockwise";
  }
  return negative ? "to the member's right" : "to the member's left";
}

Model read_model(const Field& field) {
  if (has_soil(field.json())) {
    const nlohmann::json made = with_laws_of_soil(field.json());
    return read_model(Field(made, PointerPath(field.pointer())));
  }
  Model model;
  const Field nodes = field.at("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Field node = nodes.item(i);
    model.nodes.emplace(node.at("id").text(), Point{node.at("x").number(), node.at("y").number()});
  }
  const Field members = field.at("members");
  for (std::size_t i = 0; i < members.size(); ++i) {
    model.members.push_back(read_member(members.item(i), model));
  }
  for_each(field, "supports", [&](const Field& one) { model.supports.push_back(read_support(one)); });
  for_each(field, "springs", [&](const Field& one) { model.springs.push_back(read_spring(one)); });
  for_each(field, "foundations", [&](const Field& one) {
    if (text_or(one, "component", "normal") == "normal") {  // others have no ground beside the member
      model.foundations.push_back(read_foundation(one));
    }
  });
  for_each(field, "loads", [&](const Field& one) { model.loads.push_back(read_load(one)); });
  for_each(field, "load_cases", [&](const Field& one) { read_load_case(one, model); });
  for_each(field, "monitors", [&](const Field& one) {
    model.monitors.push_back({one.at("id").text(), read_location(one.at("at")), one.at("component").text()});
  });
  return model;
}

}  // namespace snapthrough::api::plot
