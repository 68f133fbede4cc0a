#include "solver/resolve/rods.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/id_index.h"
#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

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

double mean_of(const AlongMember& number) {
  return mean_of(number, [](double value) { return value; });
}

/// A one-sided member with its spring.
class Rod {
 public:
  /// @param index of the member in the model
  Rod(const Member& member, std::size_t index, const Node& a, const Node& b, const Section& section)
      : member_(member), section_(section) {
    spring_.id = member.id;
    spring_.at.node = member.start;
    spring_.to = Location{member.end, "", 0.0};
    spring_.direction = std::array{b.x - a.x, b.y - a.y};
    const double drawn = std::hypot(b.x - a.x, b.y - a.y);
    length_ = member.pretension ? member.pretension->unstressed_length.value_or(drawn) : drawn;
    const AlongMember& given = section.EA;
    const double EA =
        given.varies() ? 1.0 / mean_of(given, [](double value) { return 1.0 / value; }) : given.constant;
    spring_.stiffness = EA / length_;
    spring_.reaction = member.reaction;
    spring_.pretension = member.pretension;
    spring_.rod = index;
    mass_ = mean_of(section.mass.value_or(0.0));
    if (section.strength)
      spring_.strength =
          section.strength->axial_force.least() *
          (member.reaction == Reaction::compression_only ? section.strength->compression : 1.0);
  }

  /// Adds half the weight at each node. @param gravity zero: there is none
  void add_weight(const std::array<double, 2>& gravity, Pattern pattern, std::vector<Load>& out) const {
    if (gravity == std::array{0.0, 0.0}) return;
    const double half = 0.5 * length_ * mass_;
    for (const std::string& node : {member_.start, member_.end})
      out.emplace_back(PointLoad{{node, "", 0.0}, {half * gravity[0], half * gravity[1]}, 0.0, pattern});
  }
  void lengthen(const TemperatureLoad& load) {
    const AlongMember change = load.change_along.empty() ? load.change : AlongMember(load.change_along);
    spring_.lengthening[load.pattern == Pattern::proportional ? 1 : 0] +=
        section_.expansion.value_or(0.0) * mean_of(change) * length_;
  }
  /// @param gravity constant acceleration
  void hang(const std::array<double, 2>& gravity) {
    if (!member_.cable) return;
    spring_.cable = Cable{section_.EA.constant, length_, {mass_ * gravity[0], mass_ * gravity[1]}};
    spring_.reaction = Reaction::bilateral;
    spring_.pretension = std::nullopt;
  }
  [[nodiscard]] const Spring& spring() const { return spring_; }

 private:
  const Member& member_;
  const Section& section_;
  Spring spring_;
  double length_ = 0.0;  ///< without force
  double mass_ = 0.0;    ///< per length without force
};

/// Temperature loads on one-sided members, by member. A point load without force, at the member's start,
/// takes the place of each in `loads`.
std::map<std::string, std::vector<const TemperatureLoad*>> take_temperatures(const Model& model,
                                                                             std::vector<Load>& loads) {
  std::map<std::string, std::string> start_of_rod;
  for (const Member& member : model.members)
    if (is_rod(member)) start_of_rod[member.id] = member.start;
  std::map<std::string, std::vector<const TemperatureLoad*>> out;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto* load = std::get_if<TemperatureLoad>(&model.loads[i]);
    if (load == nullptr) continue;
    const auto start = start_of_rod.find(load->member);
    if (start == start_of_rod.end()) continue;
    out[load->member].push_back(load);
    loads[i] = PointLoad{{start->second, "", 0.0}, {0.0, 0.0}, 0.0, load->pattern};
  }
  return out;
}

}  // namespace

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
  std::map<std::string, std::vector<const TemperatureLoad*>> temperatures =
      take_temperatures(model, out.loads);
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Member& member = model.members[m];
    if (!is_rod(member)) continue;
    const Section& section = model.sections[static_cast<std::size_t>(sections.of(member.section))];
    Rod rod(member, m, node(member.start), node(member.end), section);
    for (const TemperatureLoad* load : temperatures[member.id]) rod.lengthen(*load);
    rod.hang(constant);
    rod.add_weight(constant, Pattern::constant, weights);
    rod.add_weight(proportional, Pattern::proportional, weights);
    out.springs.push_back(rod.spring());
  }
  std::erase_if(out.members, is_rod);
  // the loads of load cases stand last
  out.loads.insert(out.loads.begin(), weights.begin(), weights.end());
  return out;
}

}  // namespace snapthrough
