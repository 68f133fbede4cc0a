#include "solver/column/column_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "solver/geometry/axes.h"
#include "solver/numeric/rounding.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

/// What counts as zero in the geometry of a line; ratios. Source: rounding of coordinates and angles.
struct LineLimits {
  static constexpr double aligned = 1e-12;    ///< sine of an angle to the line, or to its normal
  static constexpr double one_place = 1e-13;  ///< distance of two places, over the member's length
};

double dot(const Vec2& a, const Vec2& b) { return a[0] * b[0] + a[1] * b[1]; }

enum class Way { along, across, neither };

/// Whether a joint of the member is an elastic hinge.
bool is_semi_rigid(const ResolvedMember& member) {
  return (member.release_start_rotation && !is_hinged_at_start(member)) ||
         (member.release_end_rotation && !is_hinged_at_end(member));
}

/// Reads a model as a column; each step returns false if the model is none.
class LineReader {
 public:
  explicit LineReader(const ResolvedModel& model) : model_(model) {}
  [[nodiscard]] bool read();
  [[nodiscard]] ColumnLine take() { return std::move(line_); }

 private:
  /// Member in the order of the line. `cuts` ascend from its first end in the line, 0 and 1 included.
  struct Link {
    int member = 0;
    bool backwards = false;
    double length = 0.0;
    int first_joint = 0;
    std::vector<double> cuts;
  };
  /// Axial actions and stiffness, for both patterns (proportional, constant).
  struct Axial {
    std::vector<Vec2> forces;                   ///< axial loads at the joints
    std::vector<Vec2> strains;                  ///< initial strains, per span
    std::vector<double> EA;                     ///< axial stiffness of each span
    std::vector<std::pair<int, Vec2>> holders;  ///< fixed joints with their displacements
    int springs = 0;
    double size = 0.0;  ///< sum of the magnitudes of the forces
  };

  [[nodiscard]] bool is_simple() const;
  [[nodiscard]] bool order_members();
  [[nodiscard]] bool add_member(int member, int from, Vec2& direction);
  void cut(Link& link) const;
  void add_spans();
  [[nodiscard]] bool add_supports();
  [[nodiscard]] bool add_support(const ResolvedSupport& support, int joint);
  [[nodiscard]] bool add_springs();
  [[nodiscard]] bool add_foundations();
  [[nodiscard]] bool add_actions();
  [[nodiscard]] bool add(const PointAction& load);
  [[nodiscard]] bool add(const LineAction& load) const {
    return std::ranges::all_of(load.pieces, [](const LinePiece& piece) {
      return piece.from == Vec2{0.0, 0.0} && piece.to == Vec2{0.0, 0.0};
    });
  }
  [[nodiscard]] bool add(const PressureAction& load) const {
    return load.value == 0.0 && load.value_along.empty();
  }
  [[nodiscard]] bool add(const StrainAction& strain);
  [[nodiscard]] bool add_prestress();
  void add_forces_between(std::size_t first, std::size_t second, int pattern);
  [[nodiscard]] bool has_release(int member, bool at_end) const;

  [[nodiscard]] Way way_of(const Vec2& direction) const;
  [[nodiscard]] const Link& link_of(int member) const;
  [[nodiscard]] int joint_at(const Link& link, double fraction) const;
  [[nodiscard]] int joint_at(const ResolvedLocation& at) const;
  /// Rotational restraint of a node; null when no member feels it.
  [[nodiscard]] ColumnSide* side_of_node(int joint);
  [[nodiscard]] ColumnSide& side_at(const ResolvedLocation& at, int joint);

  const ResolvedModel& model_;
  ColumnLine line_;
  Vec2 along_{};
  std::vector<Link> links_;
  std::vector<int> link_of_member_;
  std::vector<int> joint_of_node_;
  std::vector<char> node_rotation_lost_;  ///< joints at which all members are released
  Axial axial_;
};

bool LineReader::is_simple() const {
  for (const ResolvedImperfection& imperfection : model_.imperfections)
    if (const auto* sine = std::get_if<ResolvedSineImperfection>(&imperfection);
        !sine || sine->amplitude != 0.0)
      return false;
  for (const ResolvedMember& member : model_.members) {
    const Section& section = model_.sections[member.section];
    if (!std::holds_alternative<LineCurve>(member.curve) || is_semi_rigid(member) || section.GA ||
        section.bending || section.EA.varies() || section.EI.varies() || std::isinf(section.EA.constant) ||
        std::isinf(section.EI.constant))
      return false;
  }
  for (const ResolvedSpring& spring : model_.springs)
    if (spring.to || spring.law || spring.displacement ||
        (spring.stiffness > 0.0 && spring.reaction != Reaction::bilateral))
      return false;
  for (const ResolvedFoundation& foundation : model_.foundations)
    if (foundation.law || foundation.component != FoundationComponent::normal || foundation.displacement ||
        (foundation.stiffness + foundation.shear_stiffness > 0.0 &&
         foundation.reaction != Reaction::bilateral))
      return false;
  return true;
}

bool LineReader::add_member(int member, int from, Vec2& direction) {
  const ResolvedMember& m = model_.members[member];
  const Node& a = model_.nodes[m.start];
  const Node& b = model_.nodes[m.end];
  Link link;
  link.member = member;
  link.backwards = m.start != from;
  const double sign = link.backwards ? -1.0 : 1.0;
  direction = {sign * (b.x - a.x), sign * (b.y - a.y)};
  link.length = std::hypot(direction[0], direction[1]);
  direction = {direction[0] / link.length, direction[1] / link.length};
  if (links_.empty()) along_ = direction;
  line_.normal = {-along_[1], along_[0]};
  links_.push_back(std::move(link));
  return dot(direction, along_) > 0.0 && std::abs(dot(direction, line_.normal)) <= LineLimits::aligned;
}

bool LineReader::order_members() {
  std::vector<std::vector<int>> at_node(model_.nodes.size());
  std::vector<Vec2> direction(1);
  for (std::size_t m = 0; m < model_.members.size(); ++m)
    for (const int end : {model_.members[m].start, model_.members[m].end})
      at_node[end].push_back(static_cast<int>(m));
  int node = -1;
  for (std::size_t i = 0; i < at_node.size(); ++i) {
    if (at_node[i].empty() || at_node[i].size() > 2) return false;
    if (node < 0 && at_node[i].size() == 1) node = static_cast<int>(i);
  }
  if (node < 0) return false;
  joint_of_node_.assign(model_.nodes.size(), -1);
  link_of_member_.assign(model_.members.size(), -1);
  for (int member = at_node[node][0]; member >= 0;) {
    if (!add_member(member, node, direction[0])) return false;
    link_of_member_[member] = static_cast<int>(links_.size()) - 1;
    joint_of_node_[node] = links_.size() == 1 ? 0 : joint_of_node_[node];
    cut(links_.back());
    Link& link = links_.back();
    if (links_.size() > 1) {
      const Link& before = links_[links_.size() - 2];
      link.first_joint = before.first_joint + static_cast<int>(before.cuts.size()) - 1;
    }
    node = link.backwards ? model_.members[member].start : model_.members[member].end;
    joint_of_node_[node] = link.first_joint + static_cast<int>(link.cuts.size()) - 1;
    int next = -1;
    for (const int other : at_node[node])
      if (other != member) next = other;
    member = next;
  }
  return links_.size() == model_.members.size();
}

void LineReader::cut(Link& link) const {
  std::vector<double>& cuts = link.cuts;
  cuts = {0.0, 1.0};
  const auto add = [&](double fraction) { cuts.push_back(link.backwards ? 1.0 - fraction : fraction); };
  for (const ResolvedSpring& spring : model_.springs)
    if (spring.at.member == link.member && spring.stiffness > 0.0) add(spring.at.fraction);
  for (const ResolvedFoundation& foundation : model_.foundations) {
    if (foundation.member != link.member || foundation.stiffness + foundation.shear_stiffness == 0.0)
      continue;
    add(foundation.range[0]);
    add(foundation.range[1]);
  }
  for (const int action : model_.actions_on_member[static_cast<std::size_t>(link.member)])
    if (const auto* point = std::get_if<PointAction>(&model_.actions[static_cast<std::size_t>(action)].what))
      add(point->at.fraction);
  std::sort(cuts.begin(), cuts.end());
  const auto same = [](double a, double b) { return b - a <= LineLimits::one_place; };
  cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());
  cuts.back() = 1.0;
}

bool LineReader::has_release(int member, bool at_end) const {
  const ResolvedMember& m = model_.members[member];
  return at_end ? m.release_end_rotation : m.release_start_rotation;
}

void LineReader::add_spans() {
  for (const Link& link : links_) {
    line_.length = std::max(line_.length, link.length);
    const ResolvedMember& member = model_.members[link.member];
    line_.stiffness = std::max(line_.stiffness, model_.sections[member.section].EI.constant);
  }
  for (const Link& link : links_) {
    const Section& section = model_.sections[model_.members[link.member].section];
    for (std::size_t i = 0; i + 1 < link.cuts.size(); ++i) {
      ColumnSpan span;
      span.length = link.length * (link.cuts[i + 1] - link.cuts[i]) / line_.length;
      span.EI = section.EI.constant / line_.stiffness;
      span.member = link.member;
      span.fractions = {link.cuts[i], link.cuts[i + 1]};
      if (link.backwards) span.fractions = {1.0 - link.cuts[i], 1.0 - link.cuts[i + 1]};
      line_.spans.push_back(span);
      axial_.EA.push_back(section.EA.constant * line_.length * line_.length / line_.stiffness);
    }
  }
  line_.joints.resize(line_.spans.size() + 1);
  node_rotation_lost_.assign(line_.joints.size(), 0);
  axial_.forces.assign(line_.joints.size(), {0.0, 0.0});
  axial_.strains.assign(line_.spans.size(), {0.0, 0.0});
  for (std::size_t l = 0; l <= links_.size(); ++l) {
    const Link* before = l > 0 ? &links_[l - 1] : nullptr;
    const Link* after = l < links_.size() ? &links_[l] : nullptr;
    const bool left = before && has_release(before->member, !before->backwards);
    const bool right = after && has_release(after->member, after->backwards);
    const auto joint =
        static_cast<std::size_t>(after ? after->first_joint : static_cast<int>(line_.spans.size()));
    line_.joints[joint].hinge = before && after && (left || right);
    node_rotation_lost_[joint] = (!before || left) && (!after || right) ? 1 : 0;
  }
}

Way LineReader::way_of(const Vec2& direction) const {
  const double size = std::hypot(direction[0], direction[1]);
  if (std::abs(dot(direction, line_.normal)) <= LineLimits::aligned * size) return Way::along;
  return std::abs(dot(direction, along_)) <= LineLimits::aligned * size ? Way::across : Way::neither;
}

const LineReader::Link& LineReader::link_of(int member) const { return links_[link_of_member_[member]]; }

int LineReader::joint_at(const Link& link, double fraction) const {
  const double cut = link.backwards ? 1.0 - fraction : fraction;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < link.cuts.size(); ++i)
    if (std::abs(link.cuts[i] - cut) < std::abs(link.cuts[nearest] - cut)) nearest = i;
  return link.first_joint + static_cast<int>(nearest);
}

int LineReader::joint_at(const ResolvedLocation& at) const {
  return at.is_on_member() ? joint_at(link_of(at.member), at.fraction) : joint_of_node_[at.node];
}

ColumnSide* LineReader::side_of_node(int joint) {
  if (node_rotation_lost_[joint]) return nullptr;
  ColumnJoint& at = line_.joints[joint];
  if (joint == 0) return &at.right;
  if (joint + 1 == static_cast<int>(line_.joints.size())) return &at.left;
  if (!at.hinge) return &at.right;
  for (const Link& link : links_)
    if (link.first_joint == joint) return has_release(link.member, link.backwards) ? &at.left : &at.right;
  return &at.right;
}

ColumnSide& LineReader::side_at(const ResolvedLocation& at, int joint) {
  const Link& link = link_of(at.member);
  const bool last = joint == link.first_joint + static_cast<int>(link.cuts.size()) - 1;
  return last ? line_.joints[joint].left : line_.joints[joint].right;
}

bool LineReader::add_support(const ResolvedSupport& support, int joint) {
  const double angle = support.angle_degrees * std::numbers::pi / 180.0;
  const Vec2 axes[2] = {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
  const PrescribedDisplacement d = support.displacement.value_or(PrescribedDisplacement{});
  const Vec2 moved{d.x * axes[0][0] + d.y * axes[1][0], d.x * axes[0][1] + d.y * axes[1][1]};
  if (d.rotation != 0.0) return false;
  if (std::abs(dot(moved, line_.normal)) > LineLimits::aligned * std::hypot(moved[0], moved[1])) return false;
  bool along = support.x && support.y;
  bool across = along;
  if (!along && (support.x || support.y)) {
    const Way way = way_of(axes[support.x ? 0 : 1]);
    if (way == Way::neither) return false;
    (way == Way::along ? along : across) = true;
  }
  if (along) {
    const double u = dot(moved, along_) / line_.length;
    const bool proportional = d.pattern == Pattern::proportional;
    axial_.holders.emplace_back(joint, proportional ? Vec2{u, 0.0} : Vec2{0.0, u});
  }
  line_.joints[joint].held = line_.joints[joint].held || across;
  ColumnSide* side = support.rotation ? side_of_node(joint) : nullptr;
  if (side != nullptr) side->held = true;
  return true;
}

bool LineReader::add_supports() {
  for (const ResolvedSupport& support : model_.supports)
    if (!add_support(support, joint_of_node_[support.node])) return false;
  return true;
}

bool LineReader::add_springs() {
  const double unit = line_.stiffness / line_.length;  // unit of a rotational spring
  for (const ResolvedSpring& spring : model_.springs) {
    if (spring.stiffness == 0.0) continue;
    const int joint = joint_at(spring.at);
    if (!spring.direction) {
      ColumnSide* side = spring.at.is_on_member() ? &side_at(spring.at, joint) : side_of_node(joint);
      if (side != nullptr) side->spring += spring.stiffness / unit;
      continue;
    }
    const Way way = way_of(*spring.direction);
    if (way == Way::neither) return false;
    if (way == Way::across) {
      line_.joints[joint].spring += spring.stiffness * line_.length * line_.length / unit;
    } else {
      axial_.holders.push_back({joint, {0.0, 0.0}});
      ++axial_.springs;
    }
  }
  return true;
}

bool LineReader::add_foundations() {
  const double unit = line_.stiffness / (line_.length * line_.length);
  for (const ResolvedFoundation& foundation : model_.foundations) {
    if (foundation.stiffness + foundation.shear_stiffness == 0.0) continue;
    if (foundation.direction && way_of(*foundation.direction) != Way::across) return false;
    const Link& link = link_of(foundation.member);
    const int one = joint_at(link, foundation.range[0]);
    const int other = joint_at(link, foundation.range[1]);
    for (int i = std::min(one, other); i < std::max(one, other); ++i) {
      line_.spans[i].foundation += foundation.stiffness * line_.length * line_.length / unit;
      line_.spans[i].layer += foundation.shear_stiffness / unit;
    }
  }
  return true;
}

bool LineReader::add(const PointAction& load) {
  if (load.moment != 0.0 || !is_dead(load)) return false;
  if (load.force == Vec2{0.0, 0.0}) return true;
  if (way_of(load.force) != Way::along) return false;
  axial_.forces[joint_at(load.at)][load.pattern == Pattern::proportional ? 0 : 1] +=
      dot(load.force, along_) * line_.length * line_.length / line_.stiffness;
  return true;
}

bool LineReader::add(const StrainAction& strain) {
  if (strain.curvature != 0.0 || !strain.axial_along.empty() || !strain.curvature_along.empty()) return false;
  const Link& link = link_of(strain.member);
  for (std::size_t i = 0; i + 1 < link.cuts.size(); ++i)
    axial_.strains[link.first_joint + i][strain.pattern == Pattern::proportional ? 0 : 1] += strain.axial;
  return true;
}

bool LineReader::add_actions() {
  return std::ranges::all_of(model_.actions, [this](const Action& action) {
    return std::visit([this](const auto& one) { return add(one); }, action.what);
  });
}

/// Axial forces between two fixed joints, from the compatibility of the spans' lengths.
void LineReader::add_forces_between(std::size_t first, std::size_t second, int pattern) {
  const auto begin = static_cast<std::size_t>(axial_.holders[first].first);
  const auto end = static_cast<std::size_t>(axial_.holders[second].first);
  double flexibility = 0.0;
  double gap = axial_.holders[second].second[pattern] - axial_.holders[first].second[pattern];
  double terms = std::abs(gap);
  double force = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    if (i > begin) force -= axial_.forces[i][pattern];
    flexibility += line_.spans[i].length / axial_.EA[i];
    const double lengthening = line_.spans[i].length * (force / axial_.EA[i] + axial_.strains[i][pattern]);
    gap -= lengthening;
    terms += std::abs(lengthening);
  }
  force = gap / flexibility;
  axial_.size = std::max(axial_.size, terms / flexibility);
  for (std::size_t i = begin; i < end; ++i) {
    if (i > begin) force -= axial_.forces[i][pattern];
    (pattern == 0 ? line_.spans[i].proportional : line_.spans[i].constant) = -force;
  }
}

bool LineReader::add_prestress() {
  auto& holders = axial_.holders;
  if (holders.empty() || (axial_.springs > 0 && holders.size() > 1)) return false;
  std::sort(holders.begin(), holders.end(), [](const auto& l, const auto& r) { return l.first < r.first; });
  const auto n = static_cast<int>(line_.spans.size());
  for (int pattern = 0; pattern < 2; ++pattern) {
    axial_.size = 0.0;
    const auto compression = [&](int i) -> double& {
      return pattern == 0 ? line_.spans[i].proportional : line_.spans[i].constant;
    };
    double sum = 0.0;
    for (int i = 0; i < holders.front().first; ++i) compression(i) = sum += axial_.forces[i][pattern];
    sum = 0.0;
    for (int i = n - 1; i >= holders.back().first; --i) compression(i) = sum -= axial_.forces[i + 1][pattern];
    for (std::size_t h = 0; h + 1 < holders.size(); ++h) add_forces_between(h, h + 1, pattern);
    for (const Vec2& force : axial_.forces) axial_.size += std::abs(force[pattern]);
    for (int i = 0; i < n; ++i)
      if (std::abs(compression(i)) <= Rounding::cancelled_sum * axial_.size) compression(i) = 0.0;
  }
  return true;
}

bool LineReader::read() {
  if (model_.members.empty() || !is_simple()) return false;
  line_.length = 0.0;
  line_.stiffness = 0.0;
  if (!order_members()) return false;
  add_spans();
  return add_supports() && add_springs() && add_foundations() && add_actions() && add_prestress();
}

}  // namespace

std::optional<ColumnLine> column_line(const ResolvedModel& model) {
  const std::optional<ResolvedModel> joined = with_joined_supports(model);
  LineReader reader(joined ? *joined : model);
  if (!reader.read()) return std::nullopt;
  return reader.take();
}

ColumnLine reversed(const ColumnLine& line) {
  ColumnLine out = line;
  std::reverse(out.spans.begin(), out.spans.end());
  std::reverse(out.joints.begin(), out.joints.end());
  for (ColumnJoint& joint : out.joints) std::swap(joint.left, joint.right);
  for (ColumnSpan& span : out.spans) std::swap(span.fractions[0], span.fractions[1]);
  return out;
}

}  // namespace snapthrough
