#include "solver/resolve/rods.h"

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "solver/model/id_index.h"
#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

/// Accelerations of all self weights of a pattern together; zero: none.
std::array<double, 2> gravity_of(const Model& model, Pattern pattern) {
  std::array<double, 2> sum{0.0, 0.0};
  for (const Load& load : model.loads) {
    const auto* weight = std::get_if<SelfWeight>(&load);
    if (weight == nullptr || weight->pattern != pattern) continue;
    sum[0] += weight->gravity[0];
    sum[1] += weight->gravity[1];
  }
  return sum;
}

/// Adds half the weight of a rod at each of its nodes.
void add_weight(const Member& rod, double mass, const std::array<double, 2>& gravity, Pattern pattern,
                std::vector<Load>& out) {
  if (gravity == std::array{0.0, 0.0}) return;
  for (const std::string& node : {rod.start, rod.end})
    out.emplace_back(
        PointLoad{{node, "", 0.0}, {0.5 * mass * gravity[0], 0.5 * mass * gravity[1]}, 0.0, pattern});
}

/// Mean of a function of a number along a member, to rounding for sections that taper to a tenth.
template <class Function>
double mean_of(const AlongMember& number, const Function& function) {
  constexpr int kPoints = 20;
  std::vector<double> ends{0.0};
  for (const auto& point : number.points)
    if (point.first > ends.back()) ends.push_back(point.first);
  if (ends.back() < 1.0) ends.push_back(1.0);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double width = ends[i + 1] - ends[i];
    const Quadrature rule = gauss_legendre(kPoints);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      sum += width * rule.weights[q] * function(number.at(ends[i] + width * rule.points[q]));
  }
  return sum;
}

/// Spring that acts as a rod, which is number `index` of the model's members.
Spring spring_of(const Member& rod, std::size_t index, const Node& a, const Node& b, const Section& section) {
  const AlongMember& given = section.EA;
  const double EA =
      given.varies() ? 1.0 / mean_of(given, [](double value) { return 1.0 / value; }) : given.constant;
  Spring out;
  out.id = rod.id;
  out.at.node = rod.start;
  out.to = Location{rod.end, "", 0.0};
  out.direction = std::array{b.x - a.x, b.y - a.y};
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const bool has_length = rod.pretension && rod.pretension->unstressed_length;
  out.stiffness = EA / (has_length ? *rod.pretension->unstressed_length : length);
  out.reaction = rod.reaction;
  out.pretension = rod.pretension;
  out.rod = index;
  if (section.strength)
    out.strength = section.strength->axial_force.least() *
                   (rod.reaction == Reaction::compression_only ? section.strength->compression : 1.0);
  return out;
}

}  // namespace

double longest_rod(const std::vector<ResolvedSpring>& springs) {
  double out = 0.0;
  for (const ResolvedSpring& spring : springs)
    if (spring.rod) out = std::max(out, std::hypot((*spring.direction)[0], (*spring.direction)[1]));
  return out;
}

std::optional<Model> with_rods_as_springs(const Model& model) {
  if (std::none_of(model.members.begin(), model.members.end(), is_rod)) return std::nullopt;
  Model out = model;
  std::vector<Load> weights;
  const IdIndex nodes(model.nodes);
  const IdIndex sections(model.sections);
  const auto node = [&](const std::string& id) -> const Node& {
    return model.nodes[static_cast<std::size_t>(nodes.of(id))];
  };
  const std::array constant = gravity_of(model, Pattern::constant);
  const std::array proportional = gravity_of(model, Pattern::proportional);
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Member& rod = model.members[m];
    if (!is_rod(rod)) continue;
    const Section& section = model.sections[static_cast<std::size_t>(sections.of(rod.section))];
    const Spring& spring =
        out.springs.emplace_back(spring_of(rod, m, node(rod.start), node(rod.end), section));
    const double drawn = std::hypot((*spring.direction)[0], (*spring.direction)[1]);
    const double length = rod.pretension ? rod.pretension->unstressed_length.value_or(drawn) : drawn;
    const double mass = length * mean_of(section.mass.value_or(0.0), [](double value) { return value; });
    add_weight(rod, mass, constant, Pattern::constant, weights);
    add_weight(rod, mass, proportional, Pattern::proportional, weights);
  }
  std::erase_if(out.members, is_rod);
  // the loads of load cases stand last
  out.loads.insert(out.loads.begin(), weights.begin(), weights.end());
  return out;
}

}  // namespace snapthrough
