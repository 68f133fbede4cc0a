#include "solver/element/element_contacts.h"

#include <cmath>

#include "solver/numeric/rounding.h"

namespace snapthrough {

void ElementContacts::add_element(double length, const ElementDofs& dofs) {
  elements_.push_back({length, dofs, contacts_.size(), contacts_.size()});
}

void ElementContacts::add_spring(const SupportSpring& support) {
  if (support.law.one_sided) springs_.push_back({all_springs_, support});
  ++all_springs_;
}

void ElementContacts::add_contact(int element, FoundationContact contact, Touch touch) {
  touches_.push_back(touch);
  add_to_layer(contact, element);
  contacts_.push_back(std::move(contact));
  elements_[static_cast<std::size_t>(element)].end = contacts_.size();
}

DisplacementOnGround ElementContacts::displacement(const FoundationContact& contact, const Element& element,
                                                   const double* y) const {
  const ElementDofs& dofs = element.dofs;
  DisplacementOnGround u;
  u.start = {y[dofs.a[0]], y[dofs.a[1]]};
  u.order = order_;
  if (contact.is_rotational()) {
    u.start = {y[dofs.a[2]], 0.0};
    for (int q = 0; q < order_; ++q) u.x[q] = element.length * y[dofs.v + 2 * order_ + q];
    return u;
  }
  for (int q = 0; q < order_; ++q) {
    u.x[q] = element.length * y[dofs.v + q];
    u.y[q] = element.length * y[dofs.v + order_ + q];
  }
  const auto points = static_cast<std::size_t>(order_);
  contact.ground().subtract_from(y, u.start, std::span(u.x).first(points), std::span(u.y).first(points));
  return u;
}

/// Displacement of a spring.
double ElementContacts::value(const SupportSpring& support, const Eigen::VectorXd& y) const {
  const ElementDofs& dofs = elements_[static_cast<std::size_t>(support.element)].dofs;
  double w = support.a[0] * y[dofs.a[0]] + support.a[1] * y[dofs.a[1]] + support.a[2] * y[dofs.a[2]];
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < order_; ++q) w += support.v[q][c] * y[dofs.v + c * order_ + q];
  return w - support.ground.along(support.a, y.data());
}

bool ElementContacts::acts(const SupportSpring& support, const Eigen::VectorXd& y) const {
  const double w = value(support, y) - support.law.gap;
  return support.touch != Touch::none && std::abs(w) <= Rounding::touching ? support.touch == Touch::acts
                                                                           : w > 0.0;
}

void ElementContacts::acting_parts(std::size_t contact, std::array<double, 2> start,
                                   std::span<const double> dx, std::span<const double> dy,
                                   std::vector<ElementPart>& out) const {
  const FoundationContact& part = contacts_[contact];
  const Touch touch = touches_[contact];
  if (touch != Touch::none && part.is_near(start, dx, dy, Rounding::touching))
    out.assign(touch == Touch::acts ? 1 : 0, {part.range()[0], part.range()[1]});
  else
    part.contact_intervals(start, dx, dy, out);
}

void ElementContacts::freeze(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const {
  out.contacts.resize(contacts_.size());
  out.element_springs.assign(all_springs_, 0);
  for (const Element& element : elements_) {
    for (std::size_t i = element.first; i < element.end; ++i) {
      const DisplacementOnGround u = displacement(contacts_[i], element, y.data());
      contacts_[i].contact_intervals(u.start, u.dx(), u.dy(), out.contacts[i], -tolerance);
    }
  }
  for (const OneSidedSpring& spring : springs_)
    out.element_springs[spring.index] = value(spring.support, y) > spring.support.law.gap - tolerance;
  freeze_layers(y, tolerance, out);
}

void ElementContacts::mark_touching(const Eigen::VectorXd& y, const TouchingDistance& near,
                                    TouchingMarks& out) const {
  out.contacts.assign(contacts_.size(), 0);
  out.element_springs.assign(all_springs_, 0);
  for (const Element& element : elements_) {
    for (std::size_t i = element.first; i < element.end; ++i) {
      const DisplacementOnGround u = displacement(contacts_[i], element, y.data());
      out.contacts[i] = contacts_[i].is_near(u.start, u.dx(), u.dy(), near.of(contacts_[i].law().stiffness));
    }
  }
  for (const OneSidedSpring& spring : springs_) {
    const Law& law = spring.support.law;
    out.element_springs[spring.index] =
        std::abs(value(spring.support, y) - law.gap) <= near.of(law.stiffness);
  }
  unmark_pressed_layers(y, near, out);
}

std::vector<TouchingSpring> ElementContacts::touching_springs(const TouchingMarks& marks,
                                                              const FrozenContact* frozen) const {
  std::vector<TouchingSpring> out;
  for (const OneSidedSpring& spring : springs_)
    if (marks.element_springs[spring.index] != 0)
      out.push_back({spring.support.spring, frozen != nullptr && frozen->element_springs[spring.index] != 0});
  return out;
}

void ElementContacts::touching_displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                                             std::vector<double>& out) const {
  for (const OneSidedSpring& spring : springs_)
    if (marks.element_springs[spring.index] != 0) out.push_back(value(spring.support, mode));
}

void ElementContacts::set_touching(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                                   std::span<const char> springs, FrozenContact& out) const {
  auto next = springs.begin();
  for (const OneSidedSpring& spring : springs_)
    if (marks.element_springs[spring.index] != 0) out.element_springs[spring.index] = *next++;
  for (const Element& element : elements_) {
    for (std::size_t i = element.first; i < element.end; ++i) {
      if (marks.contacts[i] == 0) continue;
      const FoundationContact& contact = contacts_[i];
      out.contacts[i].assign(1, {contact.range()[0], contact.range()[1]});
      if (mode.size() == 0) continue;
      const DisplacementOnGround u = displacement(contact, element, mode.data());
      contact.intervals_into(u.start, u.dx(), u.dy(), out.contacts[i]);
    }
  }
  if (mode.size() > 0) set_touching_layers(marks, mode, out);
}

std::vector<TouchingContact> ElementContacts::touching_contacts(const TouchingMarks& marks,
                                                                const FrozenContact* frozen) const {
  std::vector<TouchingContact> out;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    for (std::size_t i = elements_[e].first; i < elements_[e].end; ++i) {
      if (marks.contacts[i] == 0) continue;
      out.push_back({static_cast<int>(e), contacts_[i].foundation(), contacts_[i].range(),
                     frozen != nullptr ? frozen->contacts[i] : std::vector<ElementPart>{}});
    }
  }
  return out;
}

double ElementContacts::share(const FrozenContact& frozen, int element, int foundation) const {
  const Element& at = elements_[static_cast<std::size_t>(element)];
  double share = 0.0;
  for (std::size_t i = at.first; i < at.end; ++i) {
    if (contacts_[i].foundation() != foundation) continue;
    for (const ElementPart& part : frozen.contacts[i]) share += part.to - part.from;
  }
  return share;
}

}  // namespace snapthrough
