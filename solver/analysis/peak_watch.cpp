#include "solver/analysis/peak_watch.h"

#include <algorithm>
#include <cmath>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/foundation_springs.h"
#include "solver/numeric/number_text.h"

namespace snapthrough {
namespace {

/// Limits of the watch; shares of the penetration at the peak.
struct PeakLimits {
  /// Way back that counts as unloading: above the error of states, below what measured peaks are known to.
  static constexpr double back = 1e-3;
};

}  // namespace

PeakWatch::PeakWatch(const Structure& structure) : structure_(structure) {
  add_springs();
  add_joints();
  add_foundations();
}

void PeakWatch::add_springs() {
  for (std::size_t i = 0; i < structure_.spring_laws.size(); ++i) {
    const double peak = structure_.spring_laws[i].law.peak();
    if (std::isfinite(peak)) places_.push_back({Place::Kind::spring, i, 0.0, peak, 0.0});
  }
}

void PeakWatch::add_joints() {
  for (std::size_t i = 0; i < structure_.joints.size(); ++i) {
    const double peak = structure_.joints[i].law.peak();
    if (std::isfinite(peak)) places_.push_back({Place::Kind::joint, i, 0.0, peak, 0.0});
  }
}

void PeakWatch::add_foundations() {
  const CollocationRule& rule = CollocationRule::of(structure_.mesh.order);
  for (std::size_t k = 0; k < structure_.foundation_parts.size(); ++k) {
    const FoundationPart& part = structure_.foundation_parts[k];
    const FoundationLaw& given = structure_.foundation_laws[part.foundation];
    if (!std::isfinite(given.law.peak())) continue;
    const FoundationLaw law = law_on(structure_, given, part.element);
    for (int q = 0; q < rule.order(); ++q) {
      const double xi = part.range[0] + rule.point(q) * (part.range[1] - part.range[0]);
      const double peak = law.at(place_on_axis(structure_, part.element, xi).fraction).peak();
      if (std::isfinite(peak)) places_.push_back({Place::Kind::foundation, k, xi, peak, 0.0});
    }
  }
}

void PeakWatch::start() {
  for (Place& place : places_) place.most = 0.0;
}

double PeakWatch::depth_in(const FoundationPart& part, double xi, const Eigen::VectorXd& y) const {
  const FoundationLaw& law = structure_.foundation_laws[part.foundation];
  const auto u = ElementReader(structure_, y, part.element, law).displacement(xi);
  const double depth = law.penetration(place_on_axis(structure_, part.element, xi), {u[0], u[1]}).depth;
  return law.law.one_sided ? std::max(depth, 0.0) : std::abs(depth);
}

double PeakWatch::penetration(const Place& place, const Eigen::VectorXd& y) const {
  switch (place.kind) {
    case Place::Kind::spring: {
      const Law& law = structure_.spring_laws[place.index].law;
      return std::abs(law.penetration(reading_of(structure_, place.index, y).displacement));
    }
    case Place::Kind::joint:
      return std::abs(structure_.joints[place.index].rotation(y));
    case Place::Kind::foundation:
      return depth_in(structure_.foundation_parts[place.index], place.xi, y);
  }
  return 0.0;
}

std::string PeakWatch::name_of(const Place& place) const {
  const ResolvedModel& model = *structure_.model;
  switch (place.kind) {
    case Place::Kind::spring:
      return "\"" + model.springs[place.index].id + "\"";
    case Place::Kind::joint: {
      const JointSpring& joint = structure_.joints[place.index];
      return std::string("the joint at the ") + (joint.at_end ? "end" : "start") + " of \"" +
             model.members[joint.member].id + "\"";
    }
    case Place::Kind::foundation:
      return "\"" + model.foundations[structure_.foundation_parts[place.index].foundation].id + "\"";
  }
  return {};
}

void PeakWatch::note(const Eigen::VectorXd& y, double load_factor) {
  for (Place& place : places_) {
    const double now = penetration(place, y);
    const bool is_back = place.most > place.peak && now < place.most - PeakLimits::back * place.peak;
    place.most = std::max(place.most, now);
    if (!is_back) continue;
    const std::string name = name_of(place);
    if (std::ranges::find(told_, name) != told_.end()) continue;
    told_.push_back(name);
    text_ += (text_.empty() ? "" : ", ") + name + " at load factor " + number(load_factor);
  }
}

}  // namespace snapthrough
