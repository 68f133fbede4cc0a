#include "solver/report/escape_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "solver/discrete/rigid_loads.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;
using Point = RigidParts::Point;

/// What a message on an escape leaves out; ratios, chosen for three printed digits.
struct EscapeTextLimits {
  /// Difference, over the structure's extent or the largest displacement, that counts as zero.
  static constexpr double same = 1e-6;
  /// Distance of the centre of rotation, over the structure's extent, above which a shift is reported.
  static constexpr double far = 1e3;
};

double value_of(const RigidParts::Row& row, const VectorXd& motion) {
  double sum = 0.0;
  for (const auto& [unknown, weight] : row) sum += weight * motion[unknown];
  return sum;
}

/// Small motion of a rigid body: displacement of a point, and rotation.
struct BodyMotion {
  Point at{};
  Point displacement{};
  double rotation = 0.0;

  [[nodiscard]] Point displacement_of(Point point) const {
    return {displacement[0] - rotation * (point[1] - at[1]), displacement[1] + rotation * (point[0] - at[0])};
  }
};

double distance(Point a, Point b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The members that move most in an escape; lengths over the longest member's, relative to the first node.
class MovingPart {
 public:
  MovingPart(const ResolvedModel& model, const RigidParts& parts, const VectorXd& motion);

  /// Ids of the moving members.
  [[nodiscard]] std::string members() const;
  /// "turn clockwise about ..." or "shift in direction ...".
  [[nodiscard]] std::string motion() const;

 private:
  [[nodiscard]] Point end(std::size_t member, bool start) const {
    const ResolvedMember& m = model_.members[member];
    return parts_.place(start ? m.start : m.end);
  }
  [[nodiscard]] double size_of(std::size_t member, const BodyMotion& motion) const;
  [[nodiscard]] bool moves_with(std::size_t member, const BodyMotion& motion) const;
  [[nodiscard]] std::string place_text(Point point) const;

  const ResolvedModel& model_;
  const RigidParts& parts_;
  double extent_ = 0.0;
  std::vector<BodyMotion> motions_;  ///< one per member
  BodyMotion largest_;
  double size_ = 0.0;  ///< largest displacement of a member end
  std::vector<std::size_t> members_;
};

MovingPart::MovingPart(const ResolvedModel& model, const RigidParts& parts, const VectorXd& motion)
    : model_(model), parts_(parts) {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-low[0], -low[1]};
  for (std::size_t j = 0; j < model.nodes.size(); ++j)
    for (std::size_t c = 0; c < 2; ++c) {
      low[c] = std::min(low[c], parts.place(static_cast<int>(j))[c]);
      high[c] = std::max(high[c], parts.place(static_cast<int>(j))[c]);
    }
  extent_ = distance(low, high);
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const auto member = static_cast<int>(m);
    const Point at = end(m, true);
    motions_.push_back({at,
                        {value_of(parts.displacement(member, at, {1.0, 0.0}), motion),
                         value_of(parts.displacement(member, at, {0.0, 1.0}), motion)},
                        value_of(parts.rotation(member), motion)});
    const double size = size_of(m, motions_.back());
    if (size <= Rounding::first_of_equal * size_) continue;
    largest_ = motions_.back();
    size_ = size;
  }
  for (std::size_t m = 0; m < model.members.size(); ++m)
    if (moves_with(m, largest_)) members_.push_back(m);
}

double MovingPart::size_of(std::size_t member, const BodyMotion& motion) const {
  double size = 0.0;
  for (const bool start : {true, false}) {
    const Point moved = motion.displacement_of(end(member, start));
    size = std::max(size, std::hypot(moved[0], moved[1]));
  }
  return size;
}

bool MovingPart::moves_with(std::size_t member, const BodyMotion& motion) const {
  for (const bool start : {true, false}) {
    const Point at = end(member, start);
    if (distance(motions_[member].displacement_of(at), motion.displacement_of(at)) >
        EscapeTextLimits::same * size_)
      return false;
  }
  return true;
}

std::string MovingPart::members() const {
  if (members_.size() == model_.members.size()) return members_.size() == 1 ? "the member" : "all members";
  const auto id = [this](std::size_t i) { return "\"" + model_.members[members_[i]].id + "\""; };
  if (members_.size() == 1) return "member " + id(0);
  constexpr std::size_t most = MessageLimits::items;
  const std::size_t named = members_.size() > most + 1 ? most : members_.size();
  std::string text = "members " + id(0);
  for (std::size_t i = 1; i < named; ++i) text += (i + 1 == members_.size() ? " and " : ", ") + id(i);
  if (named < members_.size()) text += " and " + std::to_string(members_.size() - named) + " more";
  return text;
}

std::string MovingPart::place_text(Point point) const {
  for (std::size_t j = 0; j < model_.nodes.size(); ++j)
    if (distance(point, parts_.place(static_cast<int>(j))) <= EscapeTextLimits::same * extent_)
      return "node \"" + model_.nodes[j].id + "\"";
  const Node& origin = model_.nodes.front();
  const std::array coordinates{origin.x + parts_.length() * point[0], origin.y + parts_.length() * point[1]};
  const auto cleaned = [this](double value) {
    return std::abs(value) <= EscapeTextLimits::same * parts_.length() * extent_ ? 0.0 : value;
  };
  return "(" + rounded(cleaned(coordinates[0])) + ", " + rounded(cleaned(coordinates[1])) + ")";
}

std::string MovingPart::motion() const {
  if (std::abs(largest_.rotation) * EscapeTextLimits::far * extent_ > size_) {
    const Point centre{largest_.at[0] - largest_.displacement[1] / largest_.rotation,
                       largest_.at[1] + largest_.displacement[0] / largest_.rotation};
    return std::string("turn ") + (largest_.rotation > 0.0 ? "counter-clockwise" : "clockwise") + " about " +
           place_text(centre);
  }
  const auto cleaned = [this](double value) {
    return std::abs(value) <= EscapeTextLimits::same * size_ ? 0.0 : value / size_;
  };
  return "shift in direction (" + rounded(cleaned(largest_.displacement[0])) + ", " +
         rounded(cleaned(largest_.displacement[1])) + ")";
}

/// Name of the load that does most work on the motion.
std::string driver(const RigidParts& parts, const Escape& escape) {
  double most = 0.0;
  std::string name = "the loads";
  for (const LoadWork& load : works_of_loads(parts)) {
    const double factor =
        load.pattern == Pattern::constant ? escape.actions.constant : escape.actions.proportional;
    const double work = factor * value_of(load.row, escape.motion);
    if (work <= most) continue;
    most = work;
    name = load.name;
  }
  return name;
}

}  // namespace

std::string motion_of_escape(const ResolvedModel& model, const FreeMotions& motions, const Escape& escape) {
  const MovingPart part(model, motions.parts(), escape.motion);
  return part.members() + " can " + part.motion();
}

std::string driver_of_escape(const FreeMotions& motions, const Escape& escape) {
  return driver(motions.parts(), escape);
}

std::string escape_text(const ResolvedModel& model, const FreeMotions& motions, const Escape& escape) {
  const MovingPart part(model, motions.parts(), escape.motion);
  const std::string motion = part.members() + " can " + part.motion() + ": no support resists this, ";
  if (escape.driven) return motion + "and " + driver(motions.parts(), escape) + " drives it";
  return motion + "no load drives it, and nothing presses " + part.members() + " onto one-sided supports";
}

}  // namespace snapthrough
