#include "solver/discrete/build_supports.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "solver/discrete/foundation_springs.h"
#include "solver/discrete/stops.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/number_text.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {
namespace {

/// A contact on the same part of an element that differs by its law alone; null: there is none.
const FoundationContact* contact_in(const std::vector<FoundationPart>& parts, int element,
                                    const FoundationLaw& law, std::array<double, 2> range) {
  const auto before = [](const FoundationPart& part, int e) { return part.element < e; };
  for (auto part = std::lower_bound(parts.begin(), parts.end(), element, before);
       part != parts.end() && part->element == element; ++part)
    if (part->contact && part->contact->is_on(law, range)) return &*part->contact;
  return nullptr;
}

/// Section of an element.
const Section& section_of(const ResolvedModel& model, const Mesh& mesh, int element) {
  const ResolvedMember& member = model.members[mesh.elements[static_cast<std::size_t>(element)].member];
  return model.sections[member.section];
}

}  // namespace

/// A contact that differs by its law alone: that of the same foundation, made for results, or of the
/// neighbour.
const FoundationContact* SupportBuilder::known_contact(int element, const FoundationLaw& law,
                                                       std::array<double, 2> range) const {
  const FoundationContact* known = contact_in(out_.foundation_parts, element, law, range);
  if (known == nullptr && like_ != nullptr) known = contact_in(like_->foundation_parts, element, law, range);
  return known;
}

FoundationContact SupportBuilder::make_contact(int element, const FoundationLaw& foundation, int index,
                                               std::array<double, 2> range) const {
  const FoundationLaw law = law_on(out_, foundation, element);
  if (const auto* known = known_contact(element, foundation, range)) return known->with_law(law, index);
  const MeshElement& e = out_.mesh.elements[element];
  const std::shared_ptr<const AxisCurve>& axis = out_.axes[e.member];
  return FoundationContact(out_.mesh.order, law,
                           {axis, e.from * axis->length(), (e.to - e.from) * axis->length(), e.from, e.to,
                            length_of_element(out_, element)},
                           range, index);
}

/// Adds the part of a foundation on an element, for results.
void SupportBuilder::add_foundation(int element, int index) {
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
void SupportBuilder::add_foundation_law(int element, int index) {
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
void SupportBuilder::add_contacts(int element, int index) {
  const ResolvedFoundation& foundation = laws_.foundations[index];
  const FoundationLaw& law = foundation_laws_[static_cast<std::size_t>(index)];
  const auto add = [&](std::array<double, 2> fractions, Touch touch) {
    const auto range = part_of(out_.mesh.elements[element], fractions);
    if (range[1] > range[0])
      elements_->add_foundation(element, make_contact(element, law, index, range), touch);
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

Touch SupportBuilder::touch_of_spring(std::size_t index) const {
  for (const TouchingSupports::Spring& spring : out_.touching.springs)
    if (spring.spring == static_cast<int>(index)) return spring.touch;
  return Touch::none;
}

void SupportBuilder::add_point_spring(int element, std::size_t index) {
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
void SupportBuilder::add_foundations(const std::vector<ResolvedFoundation>& foundations,
                                     std::vector<int> Here::*list) {
  for (std::size_t i = 0; i < foundations.size(); ++i) {
    const int member = foundations[i].member;
    const int last = place_of(out_.mesh, member, foundations[i].range[1]).element;
    for (int e = place_of(out_.mesh, member, foundations[i].range[0]).element; e <= last; ++e)
      (here_[static_cast<std::size_t>(e)].*list).push_back(static_cast<int>(i));
  }
}

void SupportBuilder::find_supports() {
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

void SupportBuilder::add_element_supports(int element) {
  const Here& here = here_[static_cast<std::size_t>(element)];
  for (const int i : here.foundations) add_foundation(element, i);
  for (const int i : here.laws) add_foundation_law(element, i);
  for (const std::size_t i : here.springs) add_point_spring(element, i);
}

void SupportBuilder::add_shape(int element) {
  const ElementDofs& dofs = out_.dofs[element];
  if (like_ != nullptr &&
      section_of(model_, out_.mesh, element) == section_of(*like_->model, out_.mesh, element))
    elements_->add_like(*like_->elements, element, dofs);
  else
    elements_->add(shape_of_element(out_, element), dofs);
}

std::unique_ptr<ElementSet> SupportBuilder::make_elements() {
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
  return std::move(elements_);
}

/// Adds a message for each foundation whose stiffness was bounded; that of a rigid one always is.
void SupportBuilder::add_unresolved() {
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

void SupportBuilder::add_at_nodes() {
  out_.supports.assign(static_cast<std::size_t>(out_.nodes), {});
  const auto scaled = [this](double x, double y, double rotation) {
    return std::array{out_.scales.scaled_length(x), out_.scales.scaled_length(y), rotation};
  };
  for (const ResolvedSupport& support : model_.supports) {
    NodeSupport& node = out_.supports[support.node];
    node.fixed = {support.x, support.y, support.rotation};
    node.angle = support.angle_degrees * std::numbers::pi / 180.0;
    if (const auto& d = support.displacement)
      (d->pattern == Pattern::proportional ? node.proportional : node.constant) =
          scaled(d->x, d->y, d->rotation);
  }
  int ground = out_.first_ground;
  for (const auto& [proportional, constant] : ground_displacements(model_)) {
    NodeSupport& node = out_.supports[static_cast<std::size_t>(ground++)];
    node.fixed = {true, true, true};
    node.proportional = std::apply(scaled, proportional);
    node.constant = std::apply(scaled, constant);
  }
  for (std::size_t i = 0; i < laws_.springs.size(); ++i) {
    const ResolvedSpring& spring = laws_.springs[i];
    const bool stops = spring_laws_[i].give > 0.0;
    if ((!stops && spring.at.is_on_member()) || initial_stiffness(spring) == 0.0) continue;
    const int node = stops ? node_of_stop(out_, spring) : spring.at.node;
    int to = spring.to ? spring.to->node : -1;
    if (spring_laws_[i].ground >= 0) to = DofMap::node(spring_laws_[i].ground);
    NodeSpring& js = out_.node_springs.emplace_back(node_spring(spring_laws_[i], node, to));
    js.touch = touch_of_spring(i);
    js.spring = static_cast<int>(i);
  }
}

}  // namespace snapthrough
