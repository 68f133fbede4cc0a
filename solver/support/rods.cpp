#include "solver/support/rods.h"

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "solver/model/id_index.h"
#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

/// Adds half the weight of a rod at each of its nodes.
void add_weight(const Member& rod, double mass, const SelfWeight& weight, std::vector<Load>& out) {
  for (const std::string& node : {rod.start, rod.end})
    out.emplace_back(PointLoad{{node, "", 0.0},
                               {0.5 * mass * weight.gravity[0], 0.5 * mass * weight.gravity[1]},
                               0.0,
                               weight.pattern});
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

Spring spring_of(const Model& model, std::size_t index) {
  const Member& rod = model.members[index];
  const Node& a = model.nodes[index_of(model.nodes, rod.start)];
  const Node& b = model.nodes[index_of(model.nodes, rod.end)];
  const AlongMember& given = model.sections[index_of(model.sections, rod.section)].EA;
  const double EA =
      given.varies() ? 1.0 / mean_of(given, [](double value) { return 1.0 / value; }) : given.constant;
  Spring out;
  out.id = rod.id;
  out.at.node = rod.start;
  out.to = Location{rod.end, "", 0.0};
  out.direction = std::array{b.x - a.x, b.y - a.y};
  out.stiffness = EA / std::hypot(b.x - a.x, b.y - a.y);
  out.reaction = rod.reaction;
  out.rod = index;
  return out;
}

}  // namespace

std::optional<Model> with_rods_as_springs(const Model& model) {
  if (std::none_of(model.members.begin(), model.members.end(), is_rod)) return std::nullopt;
  Model out = model;
  std::vector<Load> weights;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    if (!is_rod(model.members[m])) continue;
    const Spring& spring = out.springs.emplace_back(spring_of(model, m));
    const double length = std::hypot((*spring.direction)[0], (*spring.direction)[1]);
    const Section& section = model.sections[index_of(model.sections, model.members[m].section)];
    const double mass = mean_of(section.mass.value_or(0.0), [](double value) { return value; });
    for (const Load& load : model.loads)
      if (const auto* weight = std::get_if<SelfWeight>(&load))
        add_weight(model.members[m], mass * length, *weight, weights);
  }
  std::erase_if(out.members, is_rod);
  // the loads of load cases stand last
  out.loads.insert(out.loads.begin(), weights.begin(), weights.end());
  return out;
}

}  // namespace snapthrough
