#include "solver/discrete/capacity_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/discrete/places_on_axis.h"
#include "solver/discrete/rigid_loads.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/nonnegative_least_squares.h"
#include "solver/numeric/rounding.h"
#include "solver/support/capacity.h"
#include "solver/support/law_numbers.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Numbers of the search for limit loads; ratios without unit. Chosen: far below the accuracy of any load,
/// far above rounding.
struct CapacitySearch {
  static constexpr double residual = 1e-12;  ///< residual over the actions below which they are held
  static constexpr double width = 1e-10;     ///< fall of the upper bound, over it, that counts
  static constexpr double progress = 0.9;    ///< ratio of a residual to the least before that counts
  static constexpr double entered = 1e-10;   ///< displacement into a support, over the motion, that is none
  static constexpr double moved = 1e-6;   ///< displacement of a support, over the largest, that calls it up
  static constexpr double margin = 1e-8;  ///< share of a limit within which a load factor is beyond it
  static constexpr int rounds = 400;      ///< motions that are tried, at most
  static constexpr int idle = 12;         ///< motions in turn without progress after which the search ends
  static constexpr int points = 4;        ///< Gauss points of a smooth part of a support
};

void append(const VectorXd& column, MatrixXd& matrix) {
  matrix.conservativeResize(column.size(), matrix.cols() + 1);
  matrix.rightCols(1) = column.normalized();
}

/// A column (x, last).
VectorXd with(const VectorXd& x, double last) {
  VectorXd out(x.size() + 1);
  out << x, last;
  return out;
}

/// Place in [from, to] at which a function that changes its sign there is zero; by bisection, exact at once
/// where the function is linear.
template <class Function>
double place_of_zero(double from, double to, const Function& value) {
  double low = value(from);
  double high = value(to);
  double at = from;
  for (int i = 0; i < 60; ++i) {
    at = from - low * (to - from) / (high - low);
    const double here = value(at);
    if (std::abs(here) <= CapacitySearch::entered * CapacitySearch::entered) break;
    if ((here > 0.0) == (high > 0.0)) {
      to = at;
      high = here;
      low *= 0.5;
    } else {
      from = at;
      low = here;
      high *= 0.5;
    }
  }
  return at;
}

}  // namespace

CapacityBalance::CapacityBalance(const FreeMotions& motions) : motions_(motions) {
  if (motions.empty()) return;
  for (const ResolvedSpring& spring : motions.joined_model().springs)
    if (initial_stiffness(spring) > 0.0) add(spring);
  for (const ResolvedFoundation& foundation : motions.joined_model().foundations)
    if (initial_stiffness(foundation) > 0.0) add(foundation);
  add_loads();
}

VectorXd CapacityBalance::on_motions(const RigidParts::Row& row) const {
  VectorXd out = VectorXd::Zero(motions_.motions().cols());
  for (const auto& [unknown, weight] : row) out += weight * motions_.motions().row(unknown).transpose();
  return out;
}

void CapacityBalance::add(const ResolvedSpring& spring) {
  const bool capped = has_capacity(spring);
  if (!capped && spring.reaction == Reaction::bilateral) return;  // holds its place: no motion of V moves it
  VectorXd row = sense_of(spring.reaction) * on_motions(motions_.parts().displacement(spring));
  Support out{spring.id, spring.reaction != Reaction::bilateral,         {0.0},
              nullptr,   [row = std::move(row)](double) { return row; }, {}};
  if (capped) {
    const double unit = spring.direction ? 1.0 : 1.0 / motions_.parts().length();
    const double capacity = unit * numbers_of(*spring.law).capacity.at(0.0);
    out.capacity = [capacity](double) { return capacity; };
  }
  (capped ? capped_ : unbounded_).push_back(std::move(out));
}

void CapacityBalance::add(const ResolvedFoundation& foundation) {
  const bool capped = has_capacity(foundation);
  if (!capped && foundation.reaction == Reaction::bilateral) return;
  const RigidParts& parts = motions_.parts();
  const int member = foundation.member;
  const AxisCurve& axis = *parts.axes()[static_cast<std::size_t>(member)];
  Support out{foundation.id, foundation.reaction != Reaction::bilateral, {}, nullptr, {}, {}};
  const bool turns = foundation.component == FoundationComponent::rotation;
  out.row = [this, turns, member, law = parts.law(foundation)](double fraction) {
    if (turns) return on_motions(motions_.parts().rotation(member));
    const AxisPoint at = motions_.parts().place(member, fraction);
    return on_motions(motions_.parts().displacement(
        member, {at.x, at.y}, law.initial_direction({{at.x, at.y}, at.angle, fraction})));
  };
  const bool is_linear = axis.straight() && !foundation.outline;
  const auto [from, to] = foundation.range;
  out.places = is_linear ? std::vector{from, to} : places_on(axis, foundation.range);
  out.curve = is_linear ? nullptr : &axis;
  if (capped) {
    const AlongMember capacity = numbers_of(*foundation.law).capacity;
    for (const auto& point : capacity.points)
      if (point.first > from && point.first < to) out.places.push_back(point.first);
    const double unit = turns ? 1.0 / parts.length() : 1.0;
    out.capacity = [capacity, length = unit * axis.length()](double fraction) {
      return length * capacity.at(fraction);
    };
    std::ranges::sort(out.places);
  }
  (capped ? capped_ : unbounded_).push_back(std::move(out));
}

void CapacityBalance::add_loads() {
  constant_ = VectorXd::Zero(motions_.motions().cols());
  proportional_ = constant_;
  double constant = 0.0;
  double proportional = 0.0;
  for (const LoadWork& work : works_of_loads(motions_.parts())) {
    const bool is_constant = work.pattern == Pattern::constant;
    (is_constant ? constant_ : proportional_) += on_motions(work.row);
    (is_constant ? constant : proportional) += work.size;
  }
  // forces that balance each other to rounding do no work
  if (constant_.norm() <= Rounding::motion * constant) constant_.setZero();
  if (proportional_.norm() <= Rounding::motion * proportional) proportional_.setZero();
}

/// Reactions of one support at its capacity against a motion: the integral of c sign(g.v) g, on V.
VectorXd CapacityBalance::reactions_on(const Support& support, const VectorXd& motion) const {
  VectorXd out = VectorXd::Zero(motion.size());
  const auto moved = [&](double fraction) { return support.row(fraction).dot(motion); };
  const auto add = [&](double fraction, double weight) {
    const VectorXd row = support.row(fraction);
    const double entered = row.dot(motion);
    if (entered == 0.0 || (support.one_sided && entered < 0.0)) return;
    out += std::copysign(weight * support.capacity(fraction), entered) * row;
  };
  if (support.places.size() == 1) {
    add(0.0, 1.0);
    return out;
  }
  static const Quadrature gauss = gauss_legendre(CapacitySearch::points);
  const auto add_part = [&](double from, double to) {
    for (std::size_t q = 0; q < gauss.points.size(); ++q)
      add(from + gauss.points[q] * (to - from), gauss.weights[q] * (to - from));
  };
  for (std::size_t i = 0; i + 1 < support.places.size(); ++i) {
    const double from = support.places[i];
    const double to = support.places[i + 1];
    if (!(moved(from) * moved(to) < 0.0)) {
      add_part(from, to);
      continue;
    }
    const double zero = place_of_zero(from, to, moved);
    add_part(from, zero);
    add_part(zero, to);
  }
  return out;
}

VectorXd CapacityBalance::reactions_on(const VectorXd& motion) const {
  VectorXd sum = VectorXd::Zero(motion.size());
  for (const Support& support : capped_) sum += reactions_on(support, motion);
  return sum;
}

/// Adds the places of supports without capacity that a motion enters most to the cone.
/// @return whether there are any
bool CapacityBalance::add_entered(const VectorXd& motion, MatrixXd& cone) const {
  const Index before = cone.cols();
  for (const Support& support : unbounded_) {
    const auto entered = [&](double fraction) {
      const VectorXd row = support.row(fraction);
      const double size = row.norm();
      return size > Rounding::motion ? row.dot(motion) / size : 0.0;
    };
    const std::vector<double> places =
        support.curve == nullptr
            ? support.places
            : places_of_maxima(*support.curve, {support.places.front(), support.places.back()}, entered);
    for (const double place : places)
      if (entered(place) > CapacitySearch::entered) append(with(support.row(place), 0.0), cone);
  }
  return cone.cols() > before;
}

/// Motion that enters no support without capacity and on which a force does most work; empty: those supports
/// hold the force, however large it is.
std::optional<VectorXd> CapacityBalance::unbounded_escape(const VectorXd& force) const {
  const VectorXd wanted = with(force.normalized(), 0.0);
  MatrixXd cone = with(VectorXd::Zero(force.size()), 1.0);
  for (int round = 0; round < CapacitySearch::rounds; ++round) {
    const VectorXd motion = nonnegative_least_squares(cone, wanted).residual.head(force.size());
    if (!(motion.norm() > CapacitySearch::residual)) return std::nullopt;
    if (!add_entered(motion.normalized(), cone)) return motion.normalized();
  }
  return std::nullopt;
}

/// Least factor at which constant plus growing forces exceed the capacities; empty: none does.
std::optional<CapacityEnd> CapacityBalance::end_of(const VectorXd& constant, const VectorXd& growing) const {
  if (growing.isZero(0.0)) return std::nullopt;
  const auto first = unbounded_escape(growing);
  if (!first) return std::nullopt;
  VectorXd motion = *first;
  VectorXd reactions = reactions_on(motion);
  const auto bound = [&] { return (reactions - constant).dot(motion) / growing.dot(motion); };
  CapacityEnd out{bound(), motion, {}};
  const double size = std::max(reactions.norm(), growing.norm());
  MatrixXd cone = with(VectorXd::Zero(growing.size()), 1.0);
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0, idle = 0; round < CapacitySearch::rounds && idle < CapacitySearch::idle; ++round) {
    append(with(reactions / size, 1.0), cone);
    const VectorXd wanted = with((constant + out.factor * growing) / size, 1.0);
    const VectorXd left = nonnegative_least_squares(cone, wanted).residual.head(growing.size());
    if (!(left.norm() > CapacitySearch::residual)) break;
    motion = left.normalized();
    const bool enters = add_entered(motion, cone);
    reactions = reactions_on(motion);
    ++idle;
    if (left.norm() < CapacitySearch::progress * least) idle = 0;
    least = std::min(least, left.norm());
    if (enters || !(growing.dot(motion) > 0.0) || !(bound() < out.factor)) continue;
    if (bound() < out.factor - CapacitySearch::width * std::abs(out.factor)) idle = 0;
    out.factor = bound();
    out.motion = motion;
  }
  out.supports = resisting(out.motion);
  out.motion = motions_.motions() * out.motion;
  return out;
}

std::optional<CapacityEnd> CapacityBalance::end_of_constant() const {
  if (motions_.empty() || constant_.isZero(0.0)) return std::nullopt;
  auto out = end_of(VectorXd::Zero(constant_.size()), constant_);
  if (out && out->factor >= 1.0) return std::nullopt;
  return out;
}

std::optional<CapacityEnd> CapacityBalance::end(double direction) const {
  if (motions_.empty()) return std::nullopt;
  auto out = end_of(constant_, direction * proportional_);
  if (out) out->factor *= direction;
  return out;
}

bool CapacityEnds::is_beyond(double factor) const {
  const std::optional<CapacityEnd>& limit = of(factor);
  return limit && std::abs(factor) >= (1.0 - CapacitySearch::margin) * std::abs(limit->factor);
}

std::shared_ptr<const CapacityEnds> capacity_ends(const ResolvedModel& model) {
  if (!has_supports_with_capacity(model) || has_falling_laws(model) || has_joint_laws(model)) return nullptr;
  auto out =
      std::make_shared<CapacityEnds>(CapacityEnds{FreeMotions(model, HeldBy::without_capacity), {}, {}, {}});
  const CapacityBalance balance(out->motions);
  out->constant = balance.end_of_constant();
  if (!out->constant) {
    out->growing = balance.end(1.0);
    out->falling = balance.end(-1.0);
  }
  return out->constant || out->growing || out->falling ? out : nullptr;
}

std::vector<std::string> CapacityBalance::resisting(const VectorXd& motion) const {
  std::vector<double> moved;
  for (const Support& support : capped_) {
    double most = 0.0;
    for (const double place : support.places) {
      const double entered = support.row(place).dot(motion);
      most = std::max(most, support.one_sided ? entered : std::abs(entered));
    }
    moved.push_back(most);
  }
  const double largest = moved.empty() ? 0.0 : *std::ranges::max_element(moved);
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i] > CapacitySearch::moved * largest) ids.push_back(capped_[i].id);
  return ids;
}

}  // namespace snapthrough
