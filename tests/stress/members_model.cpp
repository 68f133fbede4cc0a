#include "tests/stress/members_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/check/check.h"
#include "solver/discrete/mechanism.h"
#include "solver/geometry/axes.h"
#include "solver/resolve/resolved_model.h"
#include "tests/index_of.h"
#include "tests/stress/broad_model.h"
#include "tests/stress/laws_model.h"
#include "tests/stress/random_numbers.h"
#include "tests/stress/rod_law.h"

namespace snapthrough::testing {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

/// Adds to a drawn request. Moments and forces come in units of the stiffest section and the longest member.
class MembersDrawer {
 public:
  MembersDrawer(RandomRequest request, std::uint64_t seed)
      : random_(Random(seed + 0x3E3BE55).bits()),
        hanging_(Random(seed + 0xCAB1E5).bits()),
        out_(std::move(request)) {
    for (const auto& axis : make_axes(resolve(out_.model))) length_ = std::max(length_, axis->length());
    for (const Section& section : out_.model.sections) force_ = std::max(force_, section.EI.largest());
    force_ /= length_ * length_;
  }
  RandomRequest draw();

 private:
  /// Two places of a line, with their distance.
  struct Line {
    Node from, to;
    double length = 0.0;
  };

  [[nodiscard]] Model& model() { return out_.model; }
  [[nodiscard]] Section& section_of(const Member& member) {
    return model().sections[static_cast<std::size_t>(index_of(model().sections, member.section))];
  }
  [[nodiscard]] bool is_supported(const std::string& node) {
    return std::ranges::any_of(model().supports, [&node](const Support& s) { return s.node == node; });
  }
  [[nodiscard]] bool shows_rotation(const std::string& node);
  [[nodiscard]] AlongMember number(double value, bool varies);
  [[nodiscard]] ReactionLaw table(double stiffness, double yield, bool may_fall);
  [[nodiscard]] ReactionLaw law(double stiffness, double yield, bool varies, bool may_fall);
  [[nodiscard]] Line line(const std::string& id);
  [[nodiscard]] Pretension pretension(double length, double stiffness);
  [[nodiscard]] Member tie(const std::string& id, double bending);
  void turning_foundation(const Member& member);
  void rigid_members();
  void pretensioned_members();
  void joints();
  void joint_laws();
  void drop_moments();
  void brace(int number);
  void node_spring(int number);
  [[nodiscard]] BendingLaw bending_table(double EI, double moment);
  [[nodiscard]] bool may_yield(const Section& section);
  void bending_laws();
  void strengths();
  void heat_rods();
  void cables();
  void weigh();

  Random random_;
  Random hanging_;  ///< of cables and temperatures of rods, so that they change nothing else
  RandomRequest out_;
  double length_ = 0.0;  ///< of the longest member
  double force_ = 0.0;   ///< largest EI / length^2
};

/// Whether the rotation of a node is that of a support or of a member's end.
bool MembersDrawer::shows_rotation(const std::string& node) {
  const auto fixes = [&node](const Support& s) { return s.node == node && s.rotation; };
  const auto turns = [&node](const Member& m) {
    if (is_rod(m)) return false;
    return (m.start == node && !m.release_start_rotation) || (m.end == node && !m.release_end_rotation);
  };
  return std::ranges::any_of(model().supports, fixes) || std::ranges::any_of(model().members, turns);
}

AlongMember MembersDrawer::number(double value, bool varies) {
  if (!varies) return value;
  AlongMember out;
  out.points = {{0.0, value * random_.between(0.2, 1.0)}};
  if (random_.chance(0.4)) out.points.emplace_back(0.4, value * random_.between(0.2, 1.0));
  out.points.emplace_back(random_.chance(0.7) ? 1.0 : 0.8, value * random_.between(0.2, 1.0));
  return out;
}

/// Table that rises in one to three parts, and in half of the cases falls in as many.
/// @param stiffness force by displacement up to about `yield`
ReactionLaw MembersDrawer::table(double stiffness, double yield, bool may_fall) {
  ReactionLaw out;
  out.type = ReactionLaw::Type::table;
  out.interpolation =
      random_.chance(0.5) ? ReactionLaw::Interpolation::linear : ReactionLaw::Interpolation::monotone_cubic;
  double w = 0.0;
  double p = 0.0;
  for (int parts = 1 + random_.below(3); parts > 0; --parts) {
    const double step = yield * random_.between(0.3, 1.5);
    w += step;
    p += stiffness * step * random_.between(0.1, 1.0);
    out.points.push_back({w, p});
  }
  if (!may_fall || random_.chance(0.5)) return out;
  for (int parts = 1 + random_.below(3); parts > 0; --parts) {
    w += yield * random_.decades(-1.0, 1.0);
    p *= random_.between(0.3, 1.0);
    out.points.push_back({w, p});
  }
  return out;
}

ReactionLaw MembersDrawer::law(double stiffness, double yield, bool varies, bool may_fall) {
  if (random_.chance(0.5)) {
    ReactionLaw out = table(stiffness, yield, may_fall);
    out.factor = number(1.0, varies);
    return out;
  }
  ReactionLaw out;
  out.type = random_.chance(0.6) ? ReactionLaw::Type::tanh : ReactionLaw::Type::hyperbolic;
  out.stiffness = number(stiffness, varies);
  out.capacity = number(stiffness * yield, varies && random_.chance(0.7));
  return out;
}

void MembersDrawer::turning_foundation(const Member& member) {
  Foundation base;
  base.id = "turn " + member.id;
  base.member = member.id;
  base.component = FoundationComponent::rotation;
  if (random_.chance(0.3)) base.range = {0.05 * random_.below(9), 0.05 * (12 + random_.below(9))};
  const double modulus = force_ * random_.decades(-1.0, 2.0);
  const bool varies = random_.chance(0.4);
  if (random_.chance(0.7)) {
    base.law = law(modulus, random_.decades(-2.5, -0.5), varies, true);
  } else if (varies) {
    base.law = ReactionLaw{};
    base.law->stiffness = number(modulus, true);
  } else {
    base.stiffness = modulus;
  }
  model().foundations.push_back(base);
}

/// Makes up to two members rigid, each of which has a node of its own that no support holds: rigid members
/// between held places would have forces that nothing determines.
void MembersDrawer::rigid_members() {
  constexpr std::size_t kMost = 2;
  std::set<std::string> claimed;
  for (Member& member : model().members) {
    if (claimed.size() == kMost || !random_.chance(0.25)) continue;
    const auto is_free = [&](const std::string& node) {
      return !is_supported(node) && !claimed.contains(node);
    };
    if (is_free(member.end))
      claimed.insert(member.end);
    else if (is_free(member.start))
      claimed.insert(member.start);
    else
      continue;
    Section section = section_of(member);
    section.id = "rigid " + member.id;
    const double kind = random_.unit();
    if (kind < 0.75) section.EA = kRigid;
    if (kind > 0.25) section.EI = kRigid;
    member.section = section.id;
    model().sections.push_back(section);
  }
}

/// A line from a node to another one, or to a support of its own.
MembersDrawer::Line MembersDrawer::line(const std::string& id) {
  const auto nodes = static_cast<int>(model().nodes.size());
  const auto any = [&] { return model().nodes[static_cast<std::size_t>(random_.below(nodes))]; };
  Line out{any(), any()};
  if (out.from.id == out.to.id || random_.chance(0.4)) {
    const double angle = random_.between(-std::numbers::pi, std::numbers::pi);
    const double reach = length_ * random_.between(0.3, 1.0);
    out.to = {"anchor of " + id, out.from.x + reach * std::cos(angle), out.from.y + reach * std::sin(angle)};
    model().nodes.push_back(out.to);
    model().supports.push_back({out.to.id, true, true, false, random_.between(-90.0, 90.0), {}});
  }
  out.length = std::hypot(out.to.x - out.from.x, out.to.y - out.from.y);
  return out;
}

/// Pretension of a line of a length, four of five of them tensions, that strains it by a fiftieth at most.
/// @param stiffness force of a lengthening of one
Pretension MembersDrawer::pretension(double length, double stiffness) {
  constexpr double kMostStrain = 0.02;
  const double size = std::min(force_ * random_.decades(-2.0, 1.0), kMostStrain * stiffness * length);
  const double force = random_.chance(0.8) ? size : -size;
  Pretension out;
  if (random_.chance(0.5))
    out.force = force;
  else
    out.unstressed_length = length - force / stiffness;
  return out;
}

/// A straight member along a line, hinged at both ends, with a section of its own.
Member MembersDrawer::tie(const std::string& id, double bending) {
  const Line at = line(id);
  Section section = model().sections.front();
  section.id = "of " + id;
  section.EA = force_ * random_.decades(2.0, 6.0);
  section.EI = bending;
  section.GA.reset();
  Member out;
  out.id = id;
  out.start = at.from.id;
  out.end = at.to.id;
  out.section = section.id;
  if (random_.chance(0.85)) out.pretension = pretension(at.length, section.EA.constant / at.length);
  model().sections.push_back(section);
  return out;
}

/// A rod, four of five of which pull, or a tie that bends little; at any place in the list of members.
void MembersDrawer::brace(int number) {
  const bool is_beam = random_.chance(0.35);
  const double bending = force_ * length_ * length_ * random_.decades(-2.0, 0.0);
  Member member = tie((is_beam ? "tie" : "rod") + std::to_string(number), bending);
  if (is_beam)
    member.release_start_rotation = member.release_end_rotation = true;
  else
    member.reaction = random_.chance(0.8) ? Reaction::tension_only : Reaction::compression_only;
  const auto place = random_.below(static_cast<int>(model().members.size()) + 1);
  model().members.insert(model().members.begin() + place, member);
}

void MembersDrawer::pretensioned_members() {
  constexpr double kStrainOfRigid = 1e-4;
  for (Member& member : model().members) {
    if (!std::holds_alternative<LineCurve>(member.curve) || !random_.chance(0.25)) continue;
    const Node& a = model().nodes[static_cast<std::size_t>(index_of(model().nodes, member.start))];
    const Node& b = model().nodes[static_cast<std::size_t>(index_of(model().nodes, member.end))];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double EA = section_of(member).EA.constant;
    if (std::isfinite(EA))
      member.pretension = pretension(length, EA / length);
    else
      member.pretension = Pretension{{}, length * (1.0 + kStrainOfRigid * random_.between(-1.0, 1.0))};
  }
}

/// Releases ends of members, whose laws joint_laws() draws.
void MembersDrawer::joints() {
  constexpr double kShare = 0.3;
  for (Member& member : model().members) {
    if (random_.chance(kShare)) {
      member.release_start_rotation = true;
      member.release_start_stiffness = 0.0;
      member.release_start_law = ReactionLaw{};
    }
    if (random_.chance(kShare)) {
      member.release_end_rotation = true;
      member.release_end_stiffness = 0.0;
      member.release_end_law = ReactionLaw{};
    }
  }
}

/// Draws the laws of joints. Where all members of a node are released their laws do not fall: the rotation of
/// the node, which results do not have, would not follow from the moments.
void MembersDrawer::joint_laws() {
  const auto draw = [this](const std::string& node) {
    const double stiffness = force_ * length_ * random_.decades(-1.0, 1.5);
    return law(stiffness, random_.decades(-2.5, -0.3), false, shows_rotation(node));
  };
  for (Member& member : model().members) {
    if (member.release_start_law) member.release_start_law = draw(member.start);
    if (member.release_end_law) member.release_end_law = draw(member.end);
  }
}

/// Drops moments of loads on nodes that joints alone hold, since they end at the joints' capacity.
void MembersDrawer::drop_moments() {
  for (Load& load : model().loads)
    if (auto* point = std::get_if<PointLoad>(&load);
        point != nullptr && !point->at.node.empty() && !shows_rotation(point->at.node))
      point->moment = 0.0;
}

void MembersDrawer::node_spring(int number) {
  constexpr std::array kKinds{Reaction::bilateral, Reaction::bilateral, Reaction::compression_only,
                              Reaction::tension_only};
  Spring spring;
  spring.id = "link" + std::to_string(number);
  const Line at = line(spring.id);
  spring.at = {at.from.id, "", 0.0};
  spring.to = Location{at.to.id, "", 0.0};
  spring.reaction = kKinds[static_cast<std::size_t>(random_.below(4))];
  const double sense = random_.decades(-1.0, 1.0) * (random_.chance(0.5) ? 1.0 : -1.0);
  spring.direction = {sense * (at.to.x - at.from.x), sense * (at.to.y - at.from.y)};
  const double stiffness = force_ / length_ * random_.decades(-1.0, 3.0);
  const bool is_pretensioned = random_.chance(0.75);
  if (random_.chance(0.4)) {
    const double yield = length_ * random_.decades(-3.0, -1.0);
    spring.law = law(stiffness, yield, false, true);
    if (is_pretensioned)
      spring.pretension =
          Pretension{{}, at.length - std::min(yield, 0.3 * at.length) * random_.between(-1.5, 1.5)};
  } else {
    spring.stiffness = stiffness;
    if (is_pretensioned) spring.pretension = pretension(at.length, stiffness);
  }
  if (!is_pretensioned && random_.chance(0.5)) {
    const double angle = random_.between(-std::numbers::pi, std::numbers::pi);
    spring.direction = {std::cos(angle), std::sin(angle)};
  }
  if (spring.reaction != Reaction::bilateral && random_.chance(0.3))
    spring.gap = length_ * random_.decades(-4.0, -1.5);
  model().springs.push_back(spring);
}

/// Table of one to four points that softens in most of its parts.
/// @param EI slope of its first part
/// @param moment size of the moment at its first point
BendingLaw MembersDrawer::bending_table(double EI, double moment) {
  constexpr double kLeastSlope = 1e-4;
  constexpr double kPlateau = 1e-6;
  BendingLaw out;
  out.interpolation = random_.chance(0.5) ? Interpolation::linear : Interpolation::monotone_cubic;
  if (random_.chance(0.3)) out.points.push_back({0.0, 0.0});
  double k = moment / EI;
  double M = moment;
  double slope = EI;
  out.points.push_back({k, M});
  for (int parts = random_.below(4); parts > 0; --parts) {
    const bool rises = random_.chance(0.2);
    slope = rises ? std::min(slope * random_.decades(0.0, 0.7), 2.0 * EI)
                  : std::max(slope * random_.decades(-1.5, -0.1), kLeastSlope * EI);
    if (!rises && random_.chance(0.05)) slope = kPlateau * EI;
    const double step = moment / EI * random_.decades(-0.5, 1.0);
    k += step;
    M += slope * step;
    out.points.push_back({k, M});
  }
  return out;
}

/// Whether members, none of which is a rod, have this section, and its EI is one that a law may have.
bool MembersDrawer::may_yield(const Section& section) {
  const auto has_section = [&section](const Member& m) { return m.section == section.id; };
  const auto is_rod_of = [&](const Member& m) { return has_section(m) && is_rod(m); };
  return !section.EI.varies() && std::isfinite(section.EI.constant) &&
         std::ranges::any_of(model().members, has_section) &&
         std::ranges::none_of(model().members, is_rod_of);
}

/// Gives sections bending laws that soften from moments of 0.001 to 1 EI / L on, L the longest member.
void MembersDrawer::bending_laws() {
  constexpr double kRequests = 0.35;
  constexpr double kSections = 0.7;
  if (!random_.chance(kRequests)) return;
  for (Section& section : model().sections) {
    if (!may_yield(section) || !random_.chance(kSections)) continue;
    const double moment = section.EI.constant / length_ * random_.decades(-3.0, 0.0);
    if (random_.chance(0.5)) {
      section.bending = bending_table(section.EI.constant, moment);
      section.EI = bending_stiffness_of(*section.bending);
      continue;
    }
    BendingLaw law;
    law.type = BendingLaw::Type::ramberg_osgood;
    law.moment = moment;
    law.exponent = random_.chance(0.5) ? random_.between(2.0, 15.0) : 2.0 + random_.below(14);
    law.coefficient = random_.decades(-1.3, 0.3);
    section.bending = law;
  }
}

/// Gives sections strengths: forces of 0.01 to 10 EI / L^2, and moments of 0.001 to 1 EI / L.
void MembersDrawer::strengths() {
  constexpr double kRequests = 0.4;
  constexpr double kSections = 0.7;
  if (!random_.chance(kRequests)) return;
  for (Section& section : model().sections) {
    if (section.bending || !random_.chance(kSections)) continue;
    const double bending = force_ * length_ * length_;
    Strength strength;
    strength.axial_force = number(force_ * random_.decades(-2.0, 1.0), random_.chance(0.2));
    strength.bending_moment = number(bending / length_ * random_.decades(-3.0, 0.0), random_.chance(0.2));
    section.strength = std::move(strength);
  }
}

void MembersDrawer::heat_rods() {
  for (const Member& member : model().members) {
    if (!is_rod(member) || !hanging_.chance(0.25)) continue;
    section_of(member).expansion = hanging_.decades(-5.0, -4.0);
    TemperatureLoad heat{member.id, 50.0 * hanging_.between(-1.0, 1.0)};
    // at a large load factor, cold that grows leaves a cable no length
    heat.pattern = member.reaction == Reaction::tension_only || hanging_.chance(0.5) ? Pattern::constant
                                                                                     : Pattern::proportional;
    model().loads.insert(model().loads.begin(), heat);  // those of load cases stand last
  }
}

/// Makes cables of rods that pull, tight or slack.
void MembersDrawer::cables() {
  bool some = false;
  for (Member& member : model().members) {
    if (member.reaction != Reaction::tension_only || !hanging_.chance(0.4)) continue;
    const Node& a = model().nodes[static_cast<std::size_t>(index_of(model().nodes, member.start))];
    const Node& b = model().nodes[static_cast<std::size_t>(index_of(model().nodes, member.end))];
    member.cable = some = true;
    member.pretension.reset();
    if (hanging_.chance(0.8))
      member.pretension =
          Pretension{{}, std::hypot(b.x - a.x, b.y - a.y) * (1.0 + 0.1 * hanging_.between(-0.1, 1.0))};
    section_of(member).EA = section_of(member).EA.constant;
    section_of(member).mass = force_ / length_ * hanging_.decades(-3.0, 0.0);
  }
  if (some) weigh();
}

/// Gives the model a constant weight in place of one that grows.
void MembersDrawer::weigh() {
  for (Section& section : model().sections)
    if (!section.mass) section.mass = 0.0;
  bool weighs = false;
  for (Load& load : model().loads)
    if (auto* weight = std::get_if<SelfWeight>(&load)) {
      weight->pattern = Pattern::constant;
      weighs = true;
    }
  if (!weighs) model().loads.insert(model().loads.begin(), SelfWeight{{0.0, -1.0}, Pattern::constant});
}

RandomRequest MembersDrawer::draw() {
  rigid_members();
  pretensioned_members();
  joints();
  const std::vector<Member> beams = model().members;
  for (const Member& member : beams)
    if (random_.chance(0.4)) turning_foundation(member);
  for (int i = random_.below(3); i > 0; --i) brace(i);
  for (int i = random_.below(3); i > 0; --i) node_spring(i);
  joint_laws();
  drop_moments();
  bending_laws();
  strengths();
  heat_rods();
  cables();
  return out_;
}

}  // namespace

RandomRequest members_request(std::uint64_t seed) {
  // what is drawn may be a mechanism or have rods twice: then it is drawn again
  constexpr std::uint64_t kAnotherDraw = 0x9e3779b97f4a7c15;
  for (;; seed += kAnotherDraw) {
    const bool is_broad = Random(seed ^ 0x3E3BULL).chance(0.4);
    RandomRequest request = MembersDrawer(is_broad ? broad_request(seed) : laws_request(seed), seed).draw();
    if (check(request.model, request.analysis).empty() && !can_move(resolve(request.model))) return request;
  }
}

}  // namespace snapthrough::testing
