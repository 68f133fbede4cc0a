#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/element/element_contacts.h"

namespace snapthrough {
namespace {

/// What counts as zero beside zones of contact. Source: docs/decisions/0016.
struct ZoneTolerances {
  /// Pressure over the largest: below it, gaps of decaying boundary layers alternate in sign by rounding.
  static constexpr double pressed = 1e-6;
  static constexpr double joined = 1e-9;  ///< distance between two zones that are one, in element lengths
};

/// Appends a zone, or extends the last one if both meet at an element boundary.
void append(const MovingZone& zone, double rounding, std::vector<MovingZone>& list) {
  if (list.empty() || zone.from - list.back().to > rounding) {
    list.push_back(zone);
    return;
  }
  list.back().to = zone.to;
  list.back().to_rate = zone.to_rate;
}

/// Calls take(part) for each part that is in exactly one of two lists.
template <class Take>
void for_each_difference(const std::vector<ElementPart>& a, const std::vector<ElementPart>& b,
                         const Take& take) {
  const auto same = [](const ElementPart& p, const ElementPart& q) {
    return p.from == q.from && p.to == q.to;
  };
  if (std::equal(a.begin(), a.end(), b.begin(), b.end(), same)) return;  // the usual case
  std::vector<double> ends;
  for (const auto* list : {&a, &b})
    for (const ElementPart& part : *list) ends.insert(ends.end(), {part.from, part.to});
  std::sort(ends.begin(), ends.end());
  const auto covers = [](const std::vector<ElementPart>& list, double xi) {
    return std::any_of(list.begin(), list.end(),
                       [xi](const ElementPart& part) { return part.from < xi && xi < part.to; });
  };
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    if (covers(a, middle) != covers(b, middle)) take(ElementPart{ends[i], ends[i + 1]});
  }
}

}  // namespace

double ElementContacts::missed(const FrozenContact& frozen, const Eigen::VectorXd& y) const {
  struct Missed {
    double length, pressure;
  };
  std::vector<Missed> missed;
  std::vector<ElementPart> parts;
  LayerParts on_layers = parts_on_layers(y.data());
  double largest = 0.0;
  for (const Element& element : elements_) {
    for (std::size_t i = element.first; i < element.end; ++i) {
      const FoundationContact& contact = contacts_[i];
      const DisplacementOnGround u = displacement(contact, element, y.data());
      const auto pressure = [&](const ElementPart& part) {
        return contact.law().stiffness / element.length *
               std::abs(contact.penetration(0.5 * (part.from + part.to), u.start, u.dx(), u.dy()));
      };
      if (contact.has_layer())
        parts = std::move(on_layers[i]);
      else
        acting_parts(i, u.start, u.dx(), u.dy(), parts);
      for (const ElementPart& part : parts) largest = std::max(largest, pressure(part));
      for_each_difference(parts, frozen.contacts[i], [&](const ElementPart& part) {
        missed.push_back({part.to - part.from, pressure(part)});
      });
    }
  }
  double sum = 0.0;
  for (const Missed& one : missed)
    if (one.pressure > ZoneTolerances::pressed * largest) sum += one.length;
  return sum;
}

MovingZones ElementContacts::moving_zones(const Eigen::VectorXd& y, const Eigen::VectorXd& rate) const {
  MovingZones out;
  std::vector<ElementPart> parts;
  double start = 0.0;
  for (const Element& element : elements_) {
    const double h = element.length;
    for (std::size_t i = element.first; i < element.end; ++i) {
      const FoundationContact& contact = contacts_[i];
      if (contact.has_layer()) continue;
      const DisplacementOnGround u = displacement(contact, element, y.data());
      const DisplacementOnGround v = displacement(contact, element, rate.data());
      const auto moves = [&](double xi, double end) {
        if (xi == end) return 0.0;
        const auto into = contact.penetration_at(xi, contact.displacement(xi, u.start, u.dx(), u.dy())).into;
        const auto motion = contact.displacement(xi, v.start, v.dx(), v.dy());
        const double change = into[0] * motion[0] + into[1] * motion[1];
        const double moved = -h * change / contact.penetration_slope(xi, u.start, u.dx(), u.dy());
        return std::isfinite(moved) ? moved : 0.0;
      };
      const auto index = static_cast<std::size_t>(contact.foundation());
      if (out.size() <= index) out.resize(index + 1);
      acting_parts(i, u.start, u.dx(), u.dy(), parts);
      for (const ElementPart& part : parts)
        append({start + h * part.from, start + h * part.to, moves(part.from, contact.range()[0]),
                moves(part.to, contact.range()[1])},
               ZoneTolerances::joined * h, out[index]);
    }
    start += h;
  }
  add_moving_layers(y, rate, out);
  return out;
}

void ElementContacts::freeze(const MovingZones& zones, const Eigen::VectorXd& y, FrozenContact& out) const {
  out.contacts.assign(contacts_.size(), {});
  out.element_springs.assign(all_springs_, 0);
  double start = 0.0;
  for (const Element& element : elements_) {
    for (std::size_t i = element.first; i < element.end; ++i) {
      const auto [first, last] = contacts_[i].range();
      for (const MovingZone& zone : zones[static_cast<std::size_t>(contacts_[i].foundation())]) {
        const double from = std::max(first, (zone.from - start) / element.length);
        const double to = std::min(last, (zone.to - start) / element.length);
        const double point = std::min(from, last);
        if (to > from)
          out.contacts[i].push_back({from, to});
        else if (zone.from == zone.to && from - to <= ZoneTolerances::joined)  // a layer touches at one point
          out.contacts[i].push_back({point, point});
      }
    }
    start += element.length;
  }
  for (const OneSidedSpring& spring : springs_) out.element_springs[spring.index] = acts(spring.support, y);
}

}  // namespace snapthrough
