#include "solver/report/apparent_joints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "solver/check/check_place.h"
#include "solver/geometry/axes.h"
#include "solver/geometry/point_tree.h"
#include "solver/numeric/number_text.h"

namespace snapthrough {
namespace {

using checks::in_quotes;

constexpr double kNear = 1e-3;  ///< tolerance, in lengths of the shortest member

struct SearchLimits {
  static constexpr std::size_t named = 3;         ///< places that a warning names
  static constexpr std::size_t candidates = 100;  ///< pairs to compare, for each node and member
  static constexpr double piece = 0.25;           ///< rad by which a piece of a curved axis turns
  static constexpr double same_axis = 1e-9;       ///< distance of two axes, in lengths
  static constexpr int newton_steps = 8;          ///< steps towards the nearest point of a curve
};

/// Places of one kind: the first ones by name, and how many there are.
class Places {
 public:
  void add(std::string what) {
    if (count_++ < SearchLimits::named) text_ += (text_.empty() ? "" : ", ") + std::move(what);
  }
  /// Adds a warning if there is a place. @param about what the places are, @param remedy what to do about
  /// them
  void warn(std::string code, const std::string& about, const std::string& remedy,
            std::vector<Warning>& out) const {
    if (count_ == 0) return;
    const std::size_t more = count_ - std::min(count_, SearchLimits::named);
    out.push_back(
        {std::move(code),
         about + ": " + text_ + (more > 0 ? " and " + std::to_string(more) + " more" : "") + "; " + remedy});
  }

 private:
  std::size_t count_ = 0;
  std::string text_;
};

/// Distance from the straight line between its ends that a curve keeps within; empty: not known beforehand.
std::optional<double> reach_of(const Curve& curve, double chord) {
  return std::visit(
      [&](const auto& one) -> std::optional<double> {
        using T = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<T, LineCurve>) {
          return 0.0;
        } else if constexpr (std::is_same_v<T, ArcCurve>) {
          const double sweep = std::abs(one.sweep_degrees) * std::numbers::pi / 180.0;
          if (sweep > std::numbers::pi) return std::nullopt;
          return 0.5 * chord * std::tan(0.25 * sweep);
        } else if constexpr (std::is_same_v<T, PointsCurve>) {
          return std::nullopt;
        } else {
          return std::abs(one.rise);
        }
      },
      curve);
}

/// Arc length of the point of an axis nearest to a point, between two arc lengths.
double nearest_on(const AxisCurve& axis, const PlanePoint& point, double from, double to) {
  double s = 0.5 * (from + to);
  for (int step = 0; step < SearchLimits::newton_steps; ++step) {
    // (r - p) . t = 0, whose derivative is 1 + curvature (r - p) . n
    const AxisPoint at = axis.at(s);
    const double c = std::cos(at.angle), sn = std::sin(at.angle);
    const double dx = at.x - point[0], dy = at.y - point[1];
    const double slope = 1.0 + at.curvature * (dy * c - dx * sn);
    s = std::clamp(s - (dx * c + dy * sn) / (slope > 0.5 ? slope : 1.0), from, to);
  }
  return s;
}

class Search {
 public:
  explicit Search(const ResolvedModel& model);

  [[nodiscard]] std::vector<Warning> run();

 private:
  using Pair = std::pair<int, int>;
  static Pair ordered(int i, int j) { return std::minmax(i, j); }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] std::string node(int i) const { return "node " + in_quotes(model_.nodes[at(i)].id); }
  [[nodiscard]] std::string member(int m) const { return "member " + in_quotes(model_.members[at(m)].id); }
  /// Node at a place; -1: within a member.
  [[nodiscard]] int node_at(const ResolvedLocation& place) const;
  /// Notes that two places are joined by a spring.
  void join(const ResolvedLocation& one, const ResolvedLocation& other);
  /// Whether the search still compares pairs.
  bool may_compare() { return budget_ > 0 && budget_-- > 0; }

  void find_near_nodes();
  void find_stacked_members();
  [[nodiscard]] bool have_one_axis(int m, int other) const;
  void find_tees();
  void find_tees_on(int m);
  /// Looks at the nodes near a member with a curved axis.
  void find_tees_on_curve(int m, const AxisCurve& axis);
  /// Notes a node whose nearest point of a member is at an arc length, if it is near and not joined.
  void consider(int m, int i, double s, double distance);

  const ResolvedModel& model_;
  PointTree nodes_;                  ///< relative to the first node, as axes are
  std::vector<double> chords_;       ///< lengths of the chords of the members
  std::vector<double> shortest_;     ///< length of the shortest member at each node; infinite: none
  std::vector<char> held_;           ///< nodes that are supported in x and y
  std::set<Pair> joined_nodes_;      ///< by a member or a spring
  std::set<Pair> joined_to_member_;  ///< by a spring: node and member
  std::size_t budget_ = 0;           ///< pairs that the search may still compare
  std::set<Pair> tees_;              ///< node and member that were noted
  Places unjoined_;
  Places near_;
  Places stacked_;
};

std::vector<PlanePoint> points_of(const ResolvedModel& model) {
  std::vector<PlanePoint> out;
  out.reserve(model.nodes.size());
  for (const Node& node : model.nodes)
    out.push_back({node.x - model.nodes.front().x, node.y - model.nodes.front().y});
  return out;
}

Search::Search(const ResolvedModel& model)
    : model_(model),
      nodes_(points_of(model)),
      shortest_(model.nodes.size(), std::numeric_limits<double>::infinity()),
      held_(model.nodes.size(), 0) {
  for (const ResolvedMember& member : model.members) {
    const PlanePoint& a = nodes_[member.start];
    const PlanePoint& b = nodes_[member.end];
    chords_.push_back(std::hypot(b[0] - a[0], b[1] - a[1]));
    for (const int end : {member.start, member.end})
      shortest_[at(end)] = std::min(shortest_[at(end)], chords_.back());
    joined_nodes_.insert(ordered(member.start, member.end));
  }
  for (const ResolvedSupport& support : model.supports)
    if (support.x && support.y) held_[at(support.node)] = 1;
  for (const ResolvedSpring& spring : model.springs)
    if (spring.to) join(spring.at, *spring.to);
}

int Search::node_at(const ResolvedLocation& place) const {
  if (!place.is_on_member()) return place.node;
  const ResolvedMember& member = model_.members[at(place.member)];
  return place.fraction <= kOnePlace ? member.start : place.fraction >= 1.0 - kOnePlace ? member.end : -1;
}

void Search::join(const ResolvedLocation& one, const ResolvedLocation& other) {
  const int i = node_at(one);
  const int j = node_at(other);
  if (i >= 0 && j >= 0) joined_nodes_.insert(ordered(i, j));
  if (i >= 0 && other.is_on_member()) joined_to_member_.insert({i, other.member});
  if (j >= 0 && one.is_on_member()) joined_to_member_.insert({j, one.member});
}

std::vector<Warning> Search::run() {
  const std::size_t budget = SearchLimits::candidates * (model_.nodes.size() + model_.members.size());
  for (const auto find : {&Search::find_tees, &Search::find_stacked_members, &Search::find_near_nodes}) {
    budget_ = budget;
    (this->*find)();
  }
  std::vector<Warning> out;
  unjoined_.warn("tee_unjoined", "nodes lie on members that they are not joined to",
                 "to join them, divide the member at the node", out);
  stacked_.warn("stacked_members", "members lie on one another",
                "they act side by side, each with its section", out);
  near_.warn("near_nodes", "nodes lie in almost one place and are not joined",
             "to join members, let them end at one node", out);
  return out;
}

void Search::find_near_nodes() {
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(model_.nodes.size()); ++i) {
    if (shortest_[at(i)] == std::numeric_limits<double>::infinity()) continue;
    found.clear();
    nodes_.near(nodes_[i], nodes_[i], kNear * shortest_[at(i)], found);
    std::sort(found.begin(), found.end());
    for (const int j : found) {
      if (!may_compare()) return;
      const double distance = std::hypot(nodes_[i][0] - nodes_[j][0], nodes_[i][1] - nodes_[j][1]);
      const bool seen_from_other = j < i && distance <= kNear * shortest_[at(j)] &&
                                   shortest_[at(j)] != std::numeric_limits<double>::infinity();
      const bool both_held = held_[at(i)] != 0 && held_[at(j)] != 0;
      if (i == j || seen_from_other || both_held || joined_nodes_.contains(ordered(i, j)) ||
          distance > kNear * shortest_[at(j)])
        continue;
      near_.add(node(i) + " and " + node(j) + " at a distance of " + rounded(distance));
    }
  }
}

bool Search::have_one_axis(int m, int other) const {
  const AxisCurve one = axis_of(model_, model_.members[at(m)]);
  const AxisCurve two = axis_of(model_, model_.members[at(other)]);
  const double near = SearchLimits::same_axis * one.length();
  if (std::abs(one.length() - two.length()) > near) return false;
  const bool reversed = model_.members[at(m)].start != model_.members[at(other)].start;
  for (const double fraction : {0.125, 0.25, 0.5, 0.75, 0.875}) {
    const AxisPoint a = one.at(fraction * one.length());
    const AxisPoint b = two.at((reversed ? 1.0 - fraction : fraction) * two.length());
    if (std::hypot(a.x - b.x, a.y - b.y) > near) return false;
  }
  return true;
}

void Search::find_stacked_members() {
  std::map<Pair, std::vector<int>> between;  // members whose axes differ, by their nodes
  for (int m = 0; m < static_cast<int>(model_.members.size()); ++m) {
    const ResolvedMember& own = model_.members[at(m)];
    std::vector<int>& others = between[ordered(own.start, own.end)];
    const auto same = std::find_if(others.begin(), others.end(),
                                   [&](int other) { return may_compare() && have_one_axis(m, other); });
    if (same == others.end())
      others.push_back(m);
    else
      stacked_.add(member(m) + " on " + member(*same));
  }
}

void Search::find_tees() {
  for (int m = 0; m < static_cast<int>(model_.members.size()); ++m) find_tees_on(m);
}

void Search::find_tees_on(int m) {
  const ResolvedMember& own = model_.members[at(m)];
  const PlanePoint& a = nodes_[own.start];
  const PlanePoint& b = nodes_[own.end];
  const double chord = chords_[at(m)];
  const std::optional<double> reach = reach_of(own.curve, chord);
  if (!reach) return find_tees_on_curve(m, axis_of(model_, own));
  std::vector<int> found;
  nodes_.near(a, b, *reach + kNear * chord, found);
  std::erase_if(found, [&](int i) { return i == own.start || i == own.end; });
  if (found.empty()) return;
  if (*reach > 0.0) return find_tees_on_curve(m, axis_of(model_, own));
  std::sort(found.begin(), found.end());
  for (const int i : found) {
    const PlanePoint& p = nodes_[i];
    const double s = ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / chord;
    consider(m, i, s / chord, distance_to_line(p, a, b));
  }
}

void Search::find_tees_on_curve(int m, const AxisCurve& axis) {
  const double length = axis.length();
  const auto pieces = static_cast<int>(std::ceil(axis.turning(0.0, length) / SearchLimits::piece)) + 1;
  std::vector<int> found;
  for (int k = 0; k < pieces; ++k) {
    const double from = length * k / pieces;
    const double to = length * (k + 1) / pieces;
    const AxisPoint a = axis.at(from);
    const AxisPoint b = axis.at(to);
    // a curve of length l that turns by less than w departs from its chord by less than l min(w, 1) / 2
    const double departs = 0.5 * (to - from) * std::min(axis.turning(from, to), 1.0);
    found.clear();
    nodes_.near({a.x, a.y}, {b.x, b.y}, departs + kNear * chords_[at(m)], found);
    std::sort(found.begin(), found.end());
    for (const int i : found) {
      const double s = nearest_on(axis, nodes_[i], from, to);
      const AxisPoint foot = axis.at(s);
      consider(m, i, s / length, std::hypot(foot.x - nodes_[i][0], foot.y - nodes_[i][1]));
    }
  }
}

void Search::consider(int m, int i, double fraction, double distance) {
  const ResolvedMember& own = model_.members[at(m)];
  if (i == own.start || i == own.end || !may_compare()) return;
  const double tolerance = kNear * std::min(chords_[at(m)], shortest_[at(i)]);
  if (distance > tolerance || joined_to_member_.contains({i, m})) return;
  for (const int end : {own.start, own.end})
    if (std::hypot(nodes_[i][0] - nodes_[end][0], nodes_[i][1] - nodes_[end][1]) <= tolerance) return;
  if (!tees_.insert({i, m}).second) return;
  unjoined_.add(node(i) + " on " + member(m) + " at " + rounded(fraction) + " of its length");
}

}  // namespace

std::vector<Warning> apparent_joints(const ResolvedModel& model) {
  return model.nodes.empty() ? std::vector<Warning>() : Search(model).run();
}

}  // namespace snapthrough
