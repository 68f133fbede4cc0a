#include "tests/stress/broad_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "solver/check/check.h"
#include "solver/discrete/mechanism.h"
#include "solver/mesh/mesh.h"
#include "solver/resolve/resolved_model.h"
#include "tests/index_of.h"
#include "tests/stress/request_drawer.h"

namespace snapthrough::testing {
namespace {

class Drawer : private RequestDrawer {
 public:
  explicit Drawer(std::uint64_t seed) : RequestDrawer(seed + 0xB0AD, {-3.0, 3.0}, {-6.0, 9.0}) {}
  RandomRequest draw();

 private:
  [[nodiscard]] const Node& any_node() {
    return model().nodes[static_cast<std::size_t>(random_.below(static_cast<int>(model().nodes.size())))];
  }
  [[nodiscard]] std::array<double, 2> range() {
    if (random_.chance(0.6)) return {0.0, 1.0};
    const double from = fraction(0, 9);
    return {from, fraction(11, 20)};
  }
  [[nodiscard]] std::array<double, 2> direction() {
    const double angle = random_.between(-std::numbers::pi, std::numbers::pi);
    return {std::cos(angle), std::sin(angle)};
  }
  [[nodiscard]] Pattern pattern() { return random_.chance(0.1) ? Pattern::constant : Pattern::proportional; }
  [[nodiscard]] Reaction reaction() {
    constexpr std::array kKinds{Reaction::compression_only, Reaction::compression_only, Reaction::bilateral,
                                Reaction::tension_only};
    return kKinds[static_cast<std::size_t>(random_.below(4))];
  }
  [[nodiscard]] Curve curve(const Node& a, const Node& b);
  [[nodiscard]] Location place();
  void sections();
  void members();
  void member(int start, int end);
  void supports();
  void bases();
  void springs();
  void loads();
  void other_loads();
  void imperfections();
  void analysis();
  [[nodiscard]] bool resolves_bases(const Discretization& mesh) const;
  void rules();
};

void Drawer::sections() {
  const int count = 1 + random_.below(2);
  for (int i = 0; i < count; ++i) {
    Section section;
    section.id = "s" + std::to_string(i);
    const double EI = force_ * length_ * length_ * (i == 0 ? 1.0 : random_.decades(-2.0, 2.0));
    const double EA = EI / (length_ * length_) * random_.decades(1.0, 13.0);
    section.EI = EI;
    section.EA = EA;
    if (random_.chance(0.3)) section.GA = EA * random_.between(0.1, 0.5);
    model().sections.push_back(section);
  }
}

Curve Drawer::curve(const Node& a, const Node& b) {
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  const std::array t{(b.x - a.x) / chord, (b.y - a.y) / chord};
  switch (random_.below(8)) {
    case 0:
    case 1:
      return ArcCurve{random_.between(2.0, 300.0) * (random_.chance(0.5) ? 1.0 : -1.0)};
    case 2:
      return ParabolaCurve{chord * random_.between(-0.5, 0.5)};
    case 3:
      return SineCurve{chord * random_.between(-0.2, 0.2), 1 + random_.below(3)};
    case 4: {
      PointsCurve curve;
      const int n = 1 + random_.below(3);
      for (int i = 1; i <= n; ++i) {
        const double along = chord * i / (n + 1);
        const double off = chord * random_.between(-0.15, 0.15);
        curve.points.push_back({a.x + along * t[0] - off * t[1], a.y + along * t[1] + off * t[0]});
      }
      return curve;
    }
    default:
      return LineCurve{};
  }
}

void Drawer::member(int start, int end) {
  Member member;
  member.id = "m" + std::to_string(model().members.size());
  member.start = model().nodes[static_cast<std::size_t>(start)].id;
  member.end = model().nodes[static_cast<std::size_t>(end)].id;
  member.section =
      model().sections[static_cast<std::size_t>(random_.below(static_cast<int>(model().sections.size())))].id;
  member.curve =
      curve(model().nodes[static_cast<std::size_t>(start)], model().nodes[static_cast<std::size_t>(end)]);
  model().members.push_back(member);
}

/// A tree of members from the first node, sometimes with one more that closes a ring.
void Drawer::members() {
  const bool far = random_.chance(0.3);
  Node first{"n0", 0.0, 0.0};
  if (far) first = {"n0", random_.between(-3.0, 3.0) * length_, random_.between(-3.0, 3.0) * length_};
  model().nodes.push_back(first);
  const int count = 1 + (random_.chance(0.5) ? 0 : random_.below(4));
  const double heading = random_.between(-std::numbers::pi, std::numbers::pi);
  for (int m = 0; m < count; ++m) {
    const int from = random_.chance(0.75) ? m : random_.below(m + 1);
    const double angle = heading + random_.between(-1.5, 1.5) + (from == m ? 0.0 : 2.0);
    const double chord = length_ * random_.between(0.3, 1.0);
    const Node start = model().nodes[static_cast<std::size_t>(from)];
    model().nodes.push_back(
        {"n" + std::to_string(m + 1), start.x + chord * std::cos(angle), start.y + chord * std::sin(angle)});
    member(from, m + 1);
  }
  if (count >= 2 && random_.chance(0.25)) {
    const Node& end = model().nodes.back();
    if (std::hypot(end.x - first.x, end.y - first.y) > 0.2 * length_) member(count, 0);
  }
  if (model().members.size() > 1 && random_.chance(0.2)) {
    Member& released =
        model().members[static_cast<std::size_t>(random_.below(static_cast<int>(model().members.size())))];
    (random_.chance(0.5) ? released.release_start_rotation : released.release_end_rotation) = true;
  }
}

void Drawer::supports() {
  const bool hinge = std::ranges::any_of(
      model().members, [](const Member& m) { return m.release_start_rotation || m.release_end_rotation; });
  const std::string last = model().nodes.back().id;
  Support first{"n0", true, true, hinge || random_.chance(0.5), 0.0, {}};
  Support second{last, true, true, random_.chance(0.3), random_.between(-90.0, 90.0), {}};
  const double kind = random_.unit();
  if (kind > 0.6 && !hinge) second.x = false;
  if (!first.rotation && !second.x && !second.rotation) first.rotation = true;
  const bool cantilever = kind > 0.85 && !hinge;
  if (cantilever) first.rotation = true;
  if (!cantilever && second.x && random_.chance(0.1))
    second.displacement = PrescribedDisplacement{length_ * random_.between(-0.05, 0.05),
                                                 length_ * random_.between(-0.05, 0.05), 0.0, pattern()};
  model().supports.push_back(first);
  if (!cantilever) model().supports.push_back(second);
}

Location Drawer::place() {
  if (random_.chance(0.3)) return {any_node().id, "", 0.0};
  return {"", any_member().id, fraction(1, 19)};
}

void Drawer::bases() {
  const double unit = force_ / (length_ * length_);
  const std::vector<Member> members = model().members;
  for (const Member& member : members) {
    if (!random_.chance(0.5)) continue;
    Foundation base;
    base.id = "b" + std::to_string(model().foundations.size());
    base.member = member.id;
    base.stiffness = unit * random_.decades(-2.0, 10.0);
    base.reaction = reaction();
    base.side = random_.chance(0.5) ? Side::left : Side::right;
    base.range = range();
    if (random_.chance(0.15)) base.direction = direction();
    if (base.reaction != Reaction::bilateral && random_.chance(0.4))
      base.gap = length_ * random_.decades(-6.0, -1.0);
    if (base.reaction == Reaction::bilateral && random_.chance(0.3))
      base.shear_stiffness = force_ * random_.decades(-2.0, 2.0);
    model().foundations.push_back(base);
  }
}

void Drawer::springs() {
  const int count = random_.chance(0.6) ? 0 : 1 + random_.below(2);
  for (int i = 0; i < count; ++i) {
    Spring spring;
    spring.id = "spring" + std::to_string(i);
    spring.at = place();
    spring.reaction = reaction();
    if (random_.chance(0.8)) spring.direction = direction();
    const double unit = spring.direction ? force_ / length_ : force_ * length_;
    spring.stiffness = unit * random_.decades(-2.0, 8.0);
    if (!spring.direction && !spring.at.node.empty()) spring.at = {"", any_member().id, fraction(1, 19)};
    if (spring.reaction != Reaction::bilateral && random_.chance(0.5))
      spring.gap = (spring.direction ? length_ : 1.0) * random_.decades(-4.0, -1.0);
    model().springs.push_back(spring);
  }
}

void Drawer::other_loads() {
  if (random_.chance(0.12))
    model().loads.push_back(PressureLoad{any_member().id, component() / length_,
                                         random_.chance(0.5) ? Side::left : Side::right, pattern()});
  if (random_.chance(0.08))
    model().loads.push_back(InitialStrain{any_member().id, random_.between(-1.0, 1.0) * 1e-3,
                                          random_.between(-0.5, 0.5) / length_, pattern()});
}

void Drawer::loads() {
  const int count = 1 + random_.below(2);
  for (int i = 0; i < count; ++i) {
    PointLoad load{place(), {component(), component()}, 0.0, i == 0 ? Pattern::proportional : pattern()};
    if (random_.chance(0.2)) load.moment = component() * length_;
    model().loads.push_back(load);
  }
  if (random_.chance(0.4)) {
    constexpr std::array kMeasures{LoadMeasure::length, LoadMeasure::horizontal, LoadMeasure::vertical};
    model().loads.push_back(DistributedLoad{any_member().id,
                                            {component() / length_, component() / length_},
                                            range(),
                                            kMeasures[static_cast<std::size_t>(random_.below(3))],
                                            pattern()});
  }
  other_loads();
}

void Drawer::imperfections() {
  if (random_.chance(0.4))
    model().imperfections.emplace_back(
        SineImperfection{any_member().id, 1 + random_.below(3), length_ * random_.decades(-8.0, -2.0)});
  if (random_.chance(0.15)) {
    PointsImperfection points{any_member().id, {}};
    const int n = 2 + random_.below(3);
    for (int i = 1; i <= n; ++i)
      points.offsets.push_back({static_cast<double>(i) / (n + 1),
                                length_ * random_.decades(-6.0, -2.0) * (i % 2 == 0 ? 1.0 : -1.0)});
    model().imperfections.push_back(points);
  }
  constexpr std::array kComponents{Component::x, Component::y, Component::rotation, Component::normal};
  model().monitors.push_back(
      {"w", {"", any_member().id, fraction(1, 19)}, kComponents[static_cast<std::size_t>(random_.below(4))]});
}

void Drawer::rules() {
  Analysis& a = out_.analysis;
  a.stop.steps = 20 + random_.below(60);
  if (random_.chance(0.5)) a.stop.limit_points = 1 + random_.below(3);
  // always a range: beyond 1e5 of the load's scale the solver gives a path up of itself
  const double size = random_.decades(-1.0, 3.0);
  a.stop.load_factor = {{-size, size}};
  if (random_.chance(0.3)) {
    const double unit = model().monitors.front().component == Component::rotation ? 1.0 : length_;
    const double reach = unit * random_.decades(-3.0, 0.0);
    a.stop.monitor = MonitorRange{"w", {-reach, reach}};
  }
  const double control = random_.unit();
  if (control < 0.15) a.control.type = ControlType::load;
  if (control > 0.85) a.control = {ControlType::displacement, "w"};
  if (random_.chance(0.15)) {
    a.branches.follow = random_.chance(0.5) ? Follow::first : Follow::all;
    a.branches.limit = 1 + random_.below(3);
  }
  if (random_.chance(0.1)) a.step.max = random_.between(0.02, 0.2);
}

void Drawer::analysis() {
  Analysis& a = out_.analysis;
  a.type = random_.chance(0.3) ? AnalysisType::critical : AnalysisType::path;
  if (a.type == AnalysisType::path) rules();
  if (random_.chance(0.25)) return;
  a.discretization.fixed_mesh = true;
  a.discretization.order = 1 + random_.below(kMaxOrder);
  a.discretization.elements = 3 + random_.below(24 / a.discretization.order + 4);
  if (random_.chance(0.15)) a.discretization.foundation = FoundationRule::lumped;
  if (!resolves_bases(a.discretization)) a.discretization = {};
}

/// Whether no element is longer than some decay lengths (4 EI / K)^(1/4) of its base: on a coarser mesh a
/// stiff base is a matter of its interpolation, not of a structure. The default mesh takes its place.
bool Drawer::resolves_bases(const Discretization& mesh) const {
  constexpr double kDecayLengths = 6.0;
  const Model& model = out_.model;
  return std::ranges::all_of(model.foundations, [&](const Foundation& base) {
    if (base.stiffness == 0.0) return true;
    const Member& member = model.members[static_cast<std::size_t>(index_of(model.members, base.member))];
    const double EI =
        model.sections[static_cast<std::size_t>(index_of(model.sections, member.section))].EI.constant;
    const Node& a = model.nodes[static_cast<std::size_t>(index_of(model.nodes, member.start))];
    const Node& b = model.nodes[static_cast<std::size_t>(index_of(model.nodes, member.end))];
    const double element = std::hypot(b.x - a.x, b.y - a.y) / mesh.elements;
    return element <= kDecayLengths * std::pow(4.0 * EI / base.stiffness, 0.25);
  });
}

RandomRequest Drawer::draw() {
  sections();
  members();
  supports();
  bases();
  springs();
  loads();
  imperfections();
  analysis();
  return out_;
}

}  // namespace

RandomRequest broad_request(std::uint64_t seed) {
  // what is drawn may be a mechanism: then it is drawn again
  constexpr std::uint64_t kAnotherDraw = 0x9e3779b97f4a7c15;
  for (;;) {
    RandomRequest request = Drawer(seed).draw();
    if (check(request.model, request.analysis).empty() && !can_move(resolve(request.model))) return request;
    seed += kAnotherDraw;
  }
}

}  // namespace snapthrough::testing
