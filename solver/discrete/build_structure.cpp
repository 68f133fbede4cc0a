#include "solver/discrete/build_structure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <variant>

#include "solver/discrete/foundation_springs.h"
#include "solver/discrete/stops.h"
#include "solver/discrete/structure_laws.h"
#include "solver/geometry/axes.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/numeric/max_order.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/resolve/member_loads.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {
namespace {

using Vec3 = std::array<double, 3>;

/// Largest magnitude of a value that may vary along a member.
double largest_of(double constant, const Along<double>& along) {
  double largest = along.empty() ? std::abs(constant) : 0.0;
  for (const auto& point : along) largest = std::max(largest, std::abs(point.second));
  return largest;
}

/// Builds a Structure stage by stage; one object per structure.
class Builder {
 public:
  /// @param like null, or a structure with the same mesh, axes and scales, whose parts are taken over where
  /// they do not differ
  Builder(const Structure* like, Structure& out)
      : model_(*out.model), laws_(*out.laws), like_(like), out_(out) {}
  Builder(const Builder&) = delete;

  /// @param known scales of another mesh or model; null: from the model
  void set_scales(const Scales* known);
  void add_unresolved();
  [[nodiscard]] bool is_moved_by_constant_actions() const;
  void number_unknowns();
  void add_elements();
  void add_supports();
  /// @param load_scale scale of another mesh or model; empty: from the loads
  void add_loads(std::optional<double> load_scale);
  void set_metric();
  /// Hands the complete elements over to the structure.
  void finish() { out_.elements = std::move(elements_); }

 private:
  /// Scaled follower pressure of an element, proportional and constant part; needs the load scale.
  struct ElementPressure {
    int element;
    LinePressure proportional;
    LinePressure constant;
  };

  void add_shape(int element);
  /// Supports of an element: indices of foundations of the model, and of foundations and springs of `laws_`.
  struct Here {
    std::vector<int> foundations, laws;
    std::vector<std::size_t> springs;
  };
  void find_supports();
  void add_foundations(const std::vector<ResolvedFoundation>& foundations, std::vector<int> Here::*list);
  void add_element_supports(int element);
  void add_foundation(int element, int index);
  void add_foundation_law(int element, int index);
  void add_contacts(int element, int index);
  [[nodiscard]] Touch touch_of_spring(std::size_t index) const;
  [[nodiscard]] const FoundationContact* known_contact(int element, const FoundationLaw& law,
                                                       std::array<double, 2> range) const;
  [[nodiscard]] FoundationContact make_contact(int element, const FoundationLaw& foundation, int index,
                                               std::array<double, 2> range) const;
  void add_point_spring(int element, std::size_t index);
  void add_point_action(Eigen::VectorXd& load, int element, double xi, Vec3 action) const;
  void add_line_load(const LineLoad& load);
  [[nodiscard]] Eigen::VectorXd& pattern(Pattern p) {
    return p == Pattern::proportional ? out_.proportional_load : out_.constant_load;
  }
  void add_pressure(const ResolvedPressureLoad& load);
  void add_initial_strain(const ResolvedInitialStrain& load);
  void add_dead_load(const ResolvedLoad& load);
  [[nodiscard]] double size_of_loads() const;
  void scale_other_actions();
  void find_follower_ends(double load_scale);
  void add_follower_changes(const ElementPressure& pressure, double load_scale);
  [[nodiscard]] double element_length(int element) const { return length_of_element(out_, element); }

  const ResolvedModel& model_;
  const ResolvedModel& laws_;
  const Structure* like_;
  Structure& out_;
  std::vector<Here> here_;                      ///< one per element
  std::vector<FoundationLaw> foundation_laws_;  ///< laws of `laws_`
  std::vector<SpringLaw> spring_laws_;
  std::unique_ptr<ElementSet> elements_;
  std::vector<ElementPressure> pressures_;
  double strain_size_ = 0.0;  ///< magnitude of the forces that the proportional initial strains correspond to
};

void Builder::set_scales(const Scales* known) {
  double length = 0.0;
  double bending = 0.0;
  for (const auto& axis : out_.axes) length = std::max(length, axis->length());
  for (const ResolvedMember& member : model_.members)
    bending = std::max(bending, model_.sections[member.section].EI.largest());
  out_.scales.length = length;
  out_.scales.force = bending / (length * length);
  if (known != nullptr) out_.scales = *known;
  number_nodes(out_);
  add_laws(model_.springs, model_.foundations, out_, out_.spring_laws, out_.foundation_laws);
  add_laws(laws_.springs, laws_.foundations, out_, spring_laws_, foundation_laws_);
  const auto keep = [this](const auto& law) {
    if (law.curve) out_.curves.push_back(law.curve);
  };
  std::for_each(foundation_laws_.begin(), foundation_laws_.end(), keep);
  std::for_each(spring_laws_.begin(), spring_laws_.end(), keep);
}

/// Numbers the forces of stops from a first unknown on. @return their number
int number_stops(int first, std::vector<SpringLaw>& laws) {
  int stops = 0;
  for (SpringLaw& law : laws)
    if (law.give > 0.0) law.force_unknown = first + stops++;
  return stops;
}

/// Unknowns of a node's displacements and rotation.
std::array<int, 3> unknowns_of_node(int node) { return {3 * node, 3 * node + 1, 3 * node + 2}; }

void Builder::number_unknowns() {
  const Mesh& mesh = out_.mesh;
  const int p = mesh.order;
  out_.dofs.reserve(mesh.elements.size());
  int next = 3 * out_.nodes;
  std::vector<std::array<int, 2>> released(model_.members.size(), {-1, -1});
  const auto release = [&](bool is_released, int node, double stiffness, int& end) {
    if (!is_released) return;
    end = next++;
    if (stiffness > 0.0) out_.joints.push_back({3 * node + 2, end, out_.scales.scaled_rotational(stiffness)});
  };
  for (std::size_t m = 0; m < model_.members.size(); ++m) {
    const ResolvedMember& member = model_.members[m];
    release(member.release_start_rotation, member.start, member.release_start_stiffness, released[m][0]);
    release(member.release_end_rotation, member.end, member.release_end_stiffness, released[m][1]);
  }
  out_.releases = next - 3 * out_.nodes;
  out_.stops = number_stops(next, spring_laws_);
  number_stops(next, out_.spring_laws);
  next += out_.stops;
  const auto first_stop = out_.stop_elements.begin();
  auto next_stop = first_stop;
  for (std::size_t m = 0; m < model_.members.size(); ++m) {
    const int start = model_.members[m].start;
    const int end = model_.members[m].end;
    std::array<int, 3> a{3 * start, 3 * start + 1, released[m][0] >= 0 ? released[m][0] : 3 * start + 2};
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      ElementDofs dofs;
      dofs.a = a;
      dofs.v = next;
      dofs.s = next + 3 * p;
      dofs.m = next + 6 * p;
      next += 6 * p + 3;
      dofs.b = {next, next + 1, next + 2};
      if (e + 1 == mesh.first[m + 1])
        dofs.b = {3 * end, 3 * end + 1, released[m][1] >= 0 ? released[m][1] : 3 * end + 2};
      else if (next_stop != out_.stop_elements.end() && *next_stop == e + 1)
        dofs.b = unknowns_of_node(out_.first_stop_node + static_cast<int>(next_stop++ - first_stop));
      else
        next += 3;
      a = dofs.b;
      out_.dofs.push_back(dofs);
    }
  }
  out_.size = next;
  out_.proportional_load = Eigen::VectorXd::Zero(out_.size);
  out_.constant_load = Eigen::VectorXd::Zero(out_.size);
}

/// A contact on the same part of an element that differs by its law alone; null: there is none.
const FoundationContact* contact_in(const std::vector<FoundationPart>& parts, int element,
                                    const FoundationLaw& law, std::array<double, 2> range) {
  const auto before = [](const FoundationPart& part, int e) { return part.element < e; };
  for (auto part = std::lower_bound(parts.begin(), parts.end(), element, before);
       part != parts.end() && part->element == element; ++part)
    if (part->contact && part->contact->is_on(law, range)) return &*part->contact;
  return nullptr;
}

/// A contact that differs by its law alone: that of the same foundation, made for results, or of the
/// neighbour.
const FoundationContact* Builder::known_contact(int element, const FoundationLaw& law,
                                                std::array<double, 2> range) const {
  const FoundationContact* known = contact_in(out_.foundation_parts, element, law, range);
  if (known == nullptr && like_ != nullptr) known = contact_in(like_->foundation_parts, element, law, range);
  return known;
}

FoundationContact Builder::make_contact(int element, const FoundationLaw& foundation, int index,
                                        std::array<double, 2> range) const {
  const FoundationLaw law = law_on(out_, foundation, element);
  if (const auto* known = known_contact(element, foundation, range)) return known->with_law(law, index);
  const MeshElement& e = out_.mesh.elements[element];
  const std::shared_ptr<const AxisCurve>& axis = out_.axes[e.member];
  return FoundationContact(out_.mesh.order, law,
                           {axis, e.from * axis->length(), (e.to - e.from) * axis->length(), e.from, e.to,
                            element_length(element)},
                           range, index);
}

/// Adds the part of a foundation on an element, for results.
void Builder::add_foundation(int element, int index) {
  const ResolvedFoundation& foundation = model_.foundations[index];
  const auto range = part_of(out_.mesh.elements[element], foundation.range);
  if (range[1] <= range[0]) return;
  out_.parts_of_foundation[static_cast<std::size_t>(index)].push_back(
      static_cast<int>(out_.foundation_parts.size()));
  out_.foundation_parts.push_back({index, element, range, std::nullopt});
  if (is_one_sided(foundation) || out_.foundation_laws[index].law.curve != nullptr)
    out_.foundation_parts.back().contact = make_contact(element, out_.foundation_laws[index], index, range);
}

/// Adds a foundation on an element to the equations.
void Builder::add_foundation_law(int element, int index) {
  const ResolvedFoundation& foundation = laws_.foundations[index];
  const auto range = part_of(out_.mesh.elements[element], foundation.range);
  if (range[1] <= range[0]) return;
  const FoundationLaw& law = foundation_laws_[static_cast<std::size_t>(index)];
  if (law.shear > 0.0 && !law.law.one_sided)
    for (const SupportSpring& support : shear_layer_springs(out_, law, element, range))
      elements_->add_spring(support);
  if (law.law.stiffness == 0.0) return;
  const bool has_pieces = law.law.one_sided || law.law.curve != nullptr;
  if (has_pieces && out_.mesh.foundation == FoundationRule::consistent)
    add_contacts(element, index);
  else
    for (const SupportSpring& support : winkler_springs(out_, law_on(out_, law, element), element, range))
      elements_->add_spring(support);
}

/// Adds a one-sided foundation on an element, split into ranges with and without a known touching state.
void Builder::add_contacts(int element, int index) {
  const ResolvedFoundation& foundation = laws_.foundations[index];
  const FoundationLaw& law = foundation_laws_[static_cast<std::size_t>(index)];
  const auto add = [&](std::array<double, 2> fractions, Touch touch) {
    const auto range = part_of(out_.mesh.elements[element], fractions);
    if (range[1] > range[0]) elements_->add_contact(element, make_contact(element, law, index, range), touch);
  };
  double from = foundation.range[0];
  for (const TouchingSupports::FoundationRange& part : out_.touching.foundations) {
    if (part.foundation != index) continue;
    add({from, part.range[0]}, Touch::none);
    add(part.range, part.touch);
    from = part.range[1];
  }
  add({from, foundation.range[1]}, Touch::none);
}

Touch Builder::touch_of_spring(std::size_t index) const {
  for (const TouchingSupports::Spring& spring : out_.touching.springs)
    if (spring.spring == static_cast<int>(index)) return spring.touch;
  return Touch::none;
}

void Builder::add_point_spring(int element, std::size_t index) {
  const ResolvedSpring& spring = laws_.springs[index];
  const MeshPlace place = place_of(out_.mesh, out_.mesh.elements[element].member, spring.at.fraction);
  if (initial_stiffness(spring) == 0.0) return;
  const SpringLaw& law = spring_laws_[index];
  SupportSpring support = support_at(out_, element, place.xi, law.row);
  support.law = law.law;
  support.ground.unknown = law.ground;
  support.touch = touch_of_spring(index);
  support.spring = static_cast<int>(index);
  elements_->add_spring(support);
}

/// Adds the indices of foundations to the elements on which they lie.
void Builder::add_foundations(const std::vector<ResolvedFoundation>& foundations,
                              std::vector<int> Here::*list) {
  for (std::size_t i = 0; i < foundations.size(); ++i) {
    const int member = foundations[i].member;
    const int last = place_of(out_.mesh, member, foundations[i].range[1]).element;
    for (int e = place_of(out_.mesh, member, foundations[i].range[0]).element; e <= last; ++e)
      (here_[static_cast<std::size_t>(e)].*list).push_back(static_cast<int>(i));
  }
}

void Builder::find_supports() {
  here_.resize(out_.mesh.elements.size());
  out_.parts_of_foundation.resize(model_.foundations.size());
  add_foundations(model_.foundations, &Here::foundations);
  add_foundations(laws_.foundations, &Here::laws);
  for (std::size_t i = 0; i < laws_.springs.size(); ++i) {
    const ResolvedLocation& at = laws_.springs[i].at;
    if (!at.is_on_member() || spring_laws_[i].give > 0.0) continue;
    const MeshPlace place = place_of(out_.mesh, at.member, at.fraction);
    here_[static_cast<std::size_t>(place.element)].springs.push_back(i);
  }
}

void Builder::add_element_supports(int element) {
  const Here& here = here_[static_cast<std::size_t>(element)];
  for (const int i : here.foundations) add_foundation(element, i);
  for (const int i : here.laws) add_foundation_law(element, i);
  for (const std::size_t i : here.springs) add_point_spring(element, i);
}

/// Section of an element.
const Section& section_of(const ResolvedModel& model, const Mesh& mesh, int element) {
  const ResolvedMember& member = model.members[mesh.elements[static_cast<std::size_t>(element)].member];
  return model.sections[member.section];
}

void Builder::add_shape(int element) {
  const ElementDofs& dofs = out_.dofs[element];
  if (like_ != nullptr &&
      section_of(model_, out_.mesh, element) == section_of(*like_->model, out_.mesh, element))
    elements_->add_like(*like_->elements, element, dofs);
  else
    elements_->add(shape_of_element(out_, element), dofs);
}

void Builder::add_elements() {
  elements_ = make_element_set(out_.mesh.order);
  const int count = static_cast<int>(out_.mesh.elements.size());
  elements_->reserve(count);
  find_supports();
  for (int e = 0; e < count; ++e) {
    add_shape(e);
    add_element_supports(e);
  }
  out_.skipped = without_stiffness(model_);
  add_unresolved();
}

/// Adds a message for each foundation whose stiffness was bounded; that of a rigid one always is.
void Builder::add_unresolved() {
  std::vector<double> least;
  least.reserve(out_.foundation_laws.size());
  for (const FoundationLaw& foundation : out_.foundation_laws) least.push_back(foundation.law.stiffness);
  for (const FoundationPart& part : out_.foundation_parts) {
    const FoundationLaw acting = law_on(out_, out_.foundation_laws[part.foundation], part.element);
    least[part.foundation] = std::min(least[part.foundation], acting.law.stiffness);
  }
  for (std::size_t i = 0; i < least.size(); ++i) {
    const double given = out_.foundation_laws[i].law.stiffness;
    if (!(least[i] < given)) continue;
    out_.skipped.push_back("foundation " + model_.foundations[i].id + ": stiffness beyond " +
                           rounded(least[i] / out_.scales.scaled_modulus(1.0)) +
                           ", which the elements do not resolve");
  }
}

void Builder::add_supports() {
  out_.supports.assign(static_cast<std::size_t>(out_.nodes), {});
  const auto prescribe = [this](NodeSupport& node, const PrescribedDisplacement& d) {
    const Vec3 value{out_.scales.scaled_length(d.x), out_.scales.scaled_length(d.y), d.rotation};
    (d.pattern == Pattern::proportional ? node.proportional : node.constant) = value;
  };
  for (const ResolvedSupport& support : model_.supports) {
    NodeSupport& node = out_.supports[support.node];
    node.fixed = {support.x, support.y, support.rotation};
    node.angle = support.angle_degrees * std::numbers::pi / 180.0;
    if (support.displacement) prescribe(node, *support.displacement);
  }
  int ground = out_.first_ground;
  for (const PrescribedDisplacement& displacement : ground_displacements(model_)) {
    NodeSupport& node = out_.supports[static_cast<std::size_t>(ground++)];
    node.fixed = {true, true, true};
    prescribe(node, displacement);
  }
  for (std::size_t i = 0; i < laws_.springs.size(); ++i) {
    const ResolvedSpring& spring = laws_.springs[i];
    const bool stops = spring_laws_[i].give > 0.0;
    if ((!stops && spring.at.is_on_member()) || initial_stiffness(spring) == 0.0) continue;
    const int node = stops ? node_of_stop(out_, spring) : spring.at.node;
    int to = spring.to ? spring.to->node : -1;
    if (spring_laws_[i].ground >= 0) to = spring_laws_[i].ground / 3;
    NodeSpring& js = out_.node_springs.emplace_back(node_spring(spring_laws_[i], node, to));
    js.touch = touch_of_spring(i);
    js.spring = static_cast<int>(i);
  }
}

void Builder::add_point_action(Eigen::VectorXd& load, int element, double xi, Vec3 action) const {
  const SupportSpring support = support_at(out_, element, xi, action);
  const ElementDofs& dofs = out_.dofs[element];
  const int p = out_.mesh.order;
  for (int c = 0; c < 3; ++c) {
    load[dofs.a[c]] += support.a[c];
    for (int q = 0; q < p; ++q) load[dofs.v + c * p + q] += support.v[q][c];
  }
}

void Builder::add_line_load(const LineLoad& load) {
  const int member = load.member;
  const AxisCurve& axis = *out_.axes[member];
  const Quadrature gauss = gauss_legendre(out_.mesh.order + 1);
  for (const LinePiece& piece : load.pieces) {
    for (int e = out_.mesh.first[member]; e < out_.mesh.first[member + 1]; ++e) {
      const MeshElement& cell = out_.mesh.elements[e];
      const auto range = part_of(cell, piece.range);
      if (range[1] <= range[0]) continue;
      const double width = range[1] - range[0];
      for (std::size_t i = 0; i < gauss.points.size(); ++i) {
        const double xi = range[0] + width * gauss.points[i];
        const double fraction = cell.from + xi * (cell.to - cell.from);
        const double angle = axis.at(axis.length() * fraction).angle;
        const double w = element_length(e) * width * out_.scales.scaled_line_load(gauss.weights[i]) *
                         measure_of(load.per, angle);
        const auto force = global_force(load.axes, piece.at(fraction), angle);
        add_point_action(pattern(load.pattern), e, xi, {w * force[0], w * force[1], 0.0});
      }
    }
  }
}

void Builder::add_dead_load(const ResolvedLoad& load) {
  const Scales& scales = out_.scales;
  if (const auto* point = std::get_if<ResolvedPointLoad>(&load)) {
    const Vec3 action{scales.scaled_force(point->force[0]), scales.scaled_force(point->force[1]),
                      scales.scaled_moment(point->moment)};
    if (point->at.is_on_member()) {
      const MeshPlace place = place_of(out_.mesh, point->at.member, point->at.fraction);
      add_point_action(pattern(point->pattern), place.element, place.xi, action);
    } else {
      const int node = point->at.node;
      for (int c = 0; c < 3; ++c) pattern(point->pattern)[3 * node + c] += action[c];
    }
  } else if (const auto* distributed = std::get_if<ResolvedDistributedLoad>(&load)) {
    add_line_load(line_load(*distributed));
  } else if (const auto* strain = std::get_if<ResolvedInitialStrain>(&load)) {
    add_initial_strain(*strain);
  } else if (const auto* weight = std::get_if<SelfWeight>(&load)) {
    for (std::size_t m = 0; m < model_.members.size(); ++m)
      add_line_load(weight_of(model_, static_cast<int>(m), *weight));
  } else if (const auto* temperature = std::get_if<ResolvedTemperatureLoad>(&load)) {
    add_initial_strain(strain_of(model_, *temperature));
  }
}

/// Whether the load vector of a model is that of another with the same mesh.
bool has_same_loads(const ResolvedModel& a, const ResolvedModel& b) {
  const auto follows_sections = [](const ResolvedLoad& load) {
    return std::holds_alternative<SelfWeight>(load) || std::holds_alternative<ResolvedTemperatureLoad>(load);
  };
  return a.loads == b.loads &&
         (a.sections == b.sections || std::none_of(a.loads.begin(), a.loads.end(), follows_sections));
}

void Builder::add_loads(std::optional<double> load_scale) {
  for (const ResolvedLoad& load : model_.loads)
    if (const auto* pressure = std::get_if<ResolvedPressureLoad>(&load)) add_pressure(*pressure);
  const bool known = like_ != nullptr && has_same_loads(model_, *like_->model);
  if (known) {
    out_.proportional_load = like_->proportional_load;
    out_.constant_load = like_->constant_load;
  } else {
    for (const ResolvedLoad& load : model_.loads) add_dead_load(load);
  }
  out_.scales.load = load_scale ? *load_scale : size_of_loads();
  if (!known) out_.proportional_load /= out_.scales.load;
  scale_other_actions();
}

void Builder::add_pressure(const ResolvedPressureLoad& load) {
  const int member = load.member;
  // a medium on the left pushes along the right normal
  const double sense = load.side == Side::left ? 1.0 : -1.0;
  const bool proportional = load.pattern == Pattern::proportional;
  const auto at = [&](double fraction) {
    return sense * out_.scales.scaled_line_load(value_at(load.value, load.value_along, fraction));
  };
  for (int e = out_.mesh.first[member]; e < out_.mesh.first[member + 1]; ++e) {
    const double from = at(out_.mesh.elements[e].from);
    const double to = load.value_along.empty() ? from : at(out_.mesh.elements[e].to);
    const LinePressure pressure{load.value_along.empty() ? from : 0.5 * (from + to), to - from};
    pressures_.push_back(
        {e, proportional ? pressure : LinePressure{}, proportional ? LinePressure{} : pressure});
  }
}

void Builder::add_initial_strain(const ResolvedInitialStrain& load) {
  const int member = load.member;
  const int p = out_.mesh.order;
  const Section& section = model_.sections[model_.members[member].section];
  if (load.pattern == Pattern::proportional)
    strain_size_ +=
        out_.scales.scaled_force(largest_of(load.axial, load.axial_along) * section.EA.largest()) +
        out_.scales.scaled_moment(largest_of(load.curvature, load.curvature_along) * section.EI.largest());
  for (int e = out_.mesh.first[member]; e < out_.mesh.first[member + 1]; ++e) {
    const CollocationRule& rule = CollocationRule::of(p);
    const ElementShape shape = shape_of_element(out_, e);
    for (int q = 0; q < p; ++q) {
      const MeshElement& cell = out_.mesh.elements[e];
      const double fraction = cell.from + rule.point(q) * (cell.to - cell.from);
      const double length = shape.length * rule.weight(q) * std::hypot(shape.t[q][0], shape.t[q][1]);
      const double curvature = value_at(load.curvature, load.curvature_along, fraction);
      pattern(load.pattern)[out_.dofs[e].s + q] += length * value_at(load.axial, load.axial_along, fraction);
      pattern(load.pattern)[out_.dofs[e].s + 2 * p + q] += length * out_.scales.scaled_curvature(curvature);
    }
  }
}

/// Sum of the magnitudes of all actions at load factor one, by which the load factor is scaled.
double Builder::size_of_loads() const {
  double total = strain_size_;
  for (int j = 0; j < 3 * out_.nodes + out_.releases; ++j) total += std::abs(out_.proportional_load[j]);
  for (const ElementDofs& dofs : out_.dofs)
    if (dofs.a[0] >= 3 * out_.nodes)
      for (const int i : dofs.a) total += std::abs(out_.proportional_load[i]);
  for (const NodeSupport& support : out_.supports)
    for (const double value : support.proportional) total += std::abs(value);
  for (const ElementPressure& p : pressures_)
    total += std::max(std::abs(p.proportional.at(0.0)), std::abs(p.proportional.at(1.0))) *
             element_length(p.element);
  return total == 0.0 ? 1.0 : total;
}

/// Scales prescribed displacements and pressures.
void Builder::scale_other_actions() {
  const double total = out_.scales.load;
  for (NodeSupport& support : out_.supports)
    for (double& value : support.proportional) value /= total;
  for (const ElementPressure& p : pressures_)
    elements_->set_pressure(p.element, p.proportional.times(1.0 / total), p.constant);
  find_follower_ends(total);
  out_.follower_forces = follower_forces_of(out_);
}

/// Whether constant actions cause displacements, and not only reactions of rigid supports.
bool Builder::is_moved_by_constant_actions() const {
  for (const ElementPressure& p : pressures_)
    if (p.constant.acts()) return true;
  Eigen::VectorXd free = out_.constant_load;
  for (int node = 0; node < out_.nodes; ++node) {
    const NodeSupport& support = out_.supports[static_cast<std::size_t>(node)];
    if (support.constant != Vec3{}) return true;
    Eigen::Vector2d along = Eigen::Rotation2Dd(-support.angle) * Eigen::Vector2d(free.segment<2>(3 * node));
    for (int c = 0; c < 2; ++c)
      if (support.fixed[c]) along[c] = 0.0;
    free.segment<2>(3 * node) = along;
    if (support.fixed[2]) free[3 * node + 2] = 0.0;
  }
  return free.lpNorm<Eigen::Infinity>() >
         Rounding::last_places * out_.constant_load.lpNorm<Eigen::Infinity>();
}

/// Adds the Gauss points of an element whose pressure changes.
void Builder::add_follower_changes(const ElementPressure& pressure, double load_scale) {
  if (pressure.proportional.change == 0.0 && pressure.constant.change == 0.0) return;
  const ElementDofs& dofs = out_.dofs[pressure.element];
  const CollocationRule& rule = CollocationRule::of(out_.mesh.order);
  const int p = rule.order();
  for (int q = 0; q < p; ++q) {
    FollowerEnd& point = out_.follower_ends.emplace_back();
    point.terms.push_back({dofs.a[0], dofs.a[1]});
    for (int r = 0; r < p; ++r)
      point.terms.push_back(
          {dofs.v + r, dofs.v + p + r, element_length(pressure.element) * rule.integral(q, r)});
    const double weight = -0.5 * rule.weight(q);
    point.proportional = weight * pressure.proportional.change / load_scale;
    point.constant = weight * pressure.constant.change;
  }
}

/// Finds movable nodes where the pressures of the adjacent lines do not cancel.
void Builder::find_follower_ends(double load_scale) {
  std::vector<FollowerEnd> sums(static_cast<std::size_t>(out_.nodes));
  for (const ElementPressure& p : pressures_) {
    const ElementDofs& dofs = out_.dofs[p.element];
    for (const auto& [node, half] : {std::pair{dofs.a, -0.5}, std::pair{dofs.b, 0.5}}) {
      if (node[0] >= 3 * out_.first_stop_node) continue;
      FollowerEnd& end = sums[node[0] / 3];
      end.proportional += half * p.proportional.at(0.5 + half) / load_scale;
      end.constant += half * p.constant.at(0.5 + half);
    }
    if (out_.geometry == Geometry::nonlinear) add_follower_changes(p, load_scale);
  }
  for (int j = 0; j < out_.nodes && out_.geometry == Geometry::nonlinear; ++j) {
    const NodeSupport& support = out_.supports[j];
    sums[j].terms = {{3 * j, 3 * j + 1}};
    if (!support.fixed[0] && !support.fixed[1] && (sums[j].proportional != 0.0 || sums[j].constant != 0.0))
      out_.follower_ends.push_back(sums[j]);
  }
}

void Builder::set_metric() {
  out_.metric = Eigen::VectorXd::Zero(out_.size);
  const CollocationRule& rule = CollocationRule::of(out_.mesh.order);
  const int p = rule.order();
  double total = 0.0;
  for (std::size_t e = 0; e < out_.dofs.size(); ++e) total += element_length(static_cast<int>(e));
  for (const NodeSpring& spring : out_.node_springs) total += spring.length;
  for (const NodeSpring& spring : out_.node_springs)
    for (int c = 0; spring.is_rod() && c < 2; ++c)
      for (const int node : {spring.node, spring.to})
        out_.metric[3 * node + c] += 0.5 * spring.length / total;
  for (std::size_t e = 0; e < out_.dofs.size(); ++e) {
    const ElementDofs& dofs = out_.dofs[e];
    const double part = element_length(static_cast<int>(e)) / total;
    for (int c = 0; c < 2; ++c) {
      out_.metric[dofs.a[c]] += 0.5 * part;
      out_.metric[dofs.b[c]] += 0.5 * part;
      for (int q = 0; q < p; ++q) out_.metric[dofs.v + c * p + q] = part * rule.weight(q);
    }
  }
}

/// Fills all data that follow from the model, the axes, the geometry and the mesh, which are already set.
/// @param scales null: computed from the model
/// @param like see Builder
void fill(const Scales* scales, const Structure* like, Structure& out) {
  const ResolvedModel& model = *out.model;
  std::optional<ResolvedModel> joined = with_joined_supports(model);
  out.laws = joined ? std::make_shared<const ResolvedModel>(*std::move(joined)) : out.model;
  const ResolvedModel& laws = *out.laws;
  Builder builder(like, out);
  builder.set_scales(scales);
  bound_stiffness(out);
  builder.number_unknowns();
  builder.add_elements();
  builder.add_supports();
  builder.add_loads(scales != nullptr ? std::optional(scales->load) : std::nullopt);
  builder.set_metric();
  out.monitors = monitor_rows(out);
  builder.finish();
  const auto one_sided = [](const auto& support) { return is_one_sided(support); };
  out.one_sided = std::any_of(laws.foundations.begin(), laws.foundations.end(), one_sided) ||
                  std::any_of(laws.springs.begin(), laws.springs.end(), one_sided);
  out.has_constant = builder.is_moved_by_constant_actions();
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const AlongMember& EI = model.sections[model.members[m].section].EI;
    const double length = out.axes[m]->length();
    out.euler_loads.push_back(std::numbers::pi * std::numbers::pi * EI.least() /
                              (length * length * out.scales.force));
    double foundation_load = 0.0;
    for (const ResolvedFoundation& foundation : model.foundations) {
      if (foundation.member != static_cast<int>(m)) continue;
      foundation_load += 2.0 * std::sqrt(stiffness_on(out, foundation, static_cast<int>(m)) * EI.largest()) +
                         foundation.shear_stiffness;
    }
    out.foundation_loads.push_back(foundation_load / out.scales.force);
  }
  const int p = out.mesh.order;
  out.free_displacements = 3 * out.nodes + out.releases;
  for (const NodeSupport& support : out.supports)
    for (const bool fixed : support.fixed) out.free_displacements -= fixed ? 1 : 0;
  // add the nodes between elements, and the P - 1 interior nodes of each element of order P
  for (std::size_t m = 0; m + 1 < out.mesh.first.size(); ++m) {
    const int n = out.mesh.first[m + 1] - out.mesh.first[m];
    out.free_displacements += 3 * (n - 1) + 3 * (p - 1) * n;
  }
}

void set_axes(const ModeOffsets& modes, Structure& out) {
  const ResolvedModel& model = *out.model;
  out.axes = make_axes(model);
  out.origin = {model.nodes.front().x, model.nodes.front().y};
  for (std::size_t m = 0; m < model.members.size(); ++m)
    out.stress_free.push_back(std::make_shared<const StressFreeAxis>(
        model, static_cast<int>(m), out.axes[m], modes.empty() ? std::vector<CubicSpline>{} : modes[m]));
}

}  // namespace

Structure make_structure(ResolvedModel model, const Discretization& discretization, Geometry geometry,
                         const ModeOffsets& modes, MeshUse use) {
  Structure out;
  out.model = std::make_shared<const ResolvedModel>(std::move(model));
  out.geometry = geometry;
  set_axes(modes, out);
  out.mesh = make_mesh(*out.model, discretization, out.axes, use);
  fill(nullptr, nullptr, out);
  return out;
}

namespace {

/// Structure of a model on a mesh, with axes and scales of another one.
Structure built_anew(const Structure& structure, std::shared_ptr<const ResolvedModel> model, Mesh mesh,
                     TouchingSupports touching, const Structure* like) {
  Structure out;
  out.model = std::move(model);
  out.geometry = structure.geometry;
  out.axes = structure.axes;
  out.origin = structure.origin;
  out.stress_free = structure.stress_free;
  out.mesh = std::move(mesh);
  out.touching = std::move(touching);
  fill(&structure.scales, like, out);
  out.free_motions = structure.free_motions;
  out.stop = structure.stop;
  return out;
}

/// Whether both models have the same axes, perfect and stress-free. @param modes see with_changed_model()
bool has_same_axes(const ResolvedModel& a, const ResolvedModel& b, const ModeOffsets& modes) {
  return modes.empty() && a.nodes == b.nodes && a.members == b.members && a.imperfections == b.imperfections;
}

}  // namespace

Structure on_mesh(const Structure& structure, Mesh mesh) {
  return built_anew(structure, structure.model, std::move(mesh), structure.touching, nullptr);
}

Structure with_touching(const Structure& structure, TouchingSupports touching) {
  return built_anew(structure, structure.model, structure.mesh, std::move(touching), &structure);
}

Structure with_changed_model(const Structure& structure, ResolvedModel changed, const ModeOffsets& modes) {
  const ResolvedModel& model = *structure.model;
  if (has_same_axes(model, changed, modes)) {
    Mesh mesh = moved_mesh(structure.mesh, model, structure.axes, changed, structure.axes);
    const bool same = mesh.elements == structure.mesh.elements;
    return built_anew(structure, std::make_shared<const ResolvedModel>(std::move(changed)), std::move(mesh),
                      structure.touching, same ? &structure : nullptr);
  }
  Structure out;
  out.model = std::make_shared<const ResolvedModel>(std::move(changed));
  out.geometry = structure.geometry;
  set_axes(modes, out);
  out.mesh = moved_mesh(structure.mesh, model, structure.axes, *out.model, out.axes);
  out.touching = structure.touching;
  fill(&structure.scales, nullptr, out);
  out.free_motions = structure.free_motions;
  out.stop = structure.stop;
  return out;
}

}  // namespace snapthrough
