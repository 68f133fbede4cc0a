#include "tests/stress/laws_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "solver/check/check.h"
#include "solver/discrete/mechanism.h"
#include "solver/resolve/resolved_model.h"
#include "tests/stress/request_drawer.h"

namespace snapthrough::testing {
namespace {

class LawsDrawer : private RequestDrawer {
 public:
  explicit LawsDrawer(std::uint64_t seed) : RequestDrawer(seed + 0x1A35, {-1.0, 2.0}, {-2.0, 5.0}) {}
  RandomRequest draw();

 private:
  [[nodiscard]] std::array<double, 2> range() {
    if (random_.chance(0.7)) return {0.0, 1.0};
    const double from = fraction(0, 8);
    return {from, fraction(12, 20)};
  }
  [[nodiscard]] std::array<double, 2> direction(double from, double to) {
    const double angle = random_.between(from, to);
    return {std::cos(angle), std::sin(angle)};
  }
  [[nodiscard]] Pattern pattern() { return random_.chance(0.2) ? Pattern::constant : Pattern::proportional; }
  [[nodiscard]] Reaction reaction() {
    constexpr std::array kKinds{Reaction::bilateral, Reaction::bilateral, Reaction::compression_only,
                                Reaction::tension_only};
    return kKinds[static_cast<std::size_t>(random_.below(4))];
  }
  /// Two to four ascending fractions for numbers along a member.
  [[nodiscard]] std::vector<double> fractions();
  /// A number along the member that is drawn anew at each place.
  template <class Draw>
  [[nodiscard]] auto drawn_along(const Draw& draw) {
    Along<std::decay_t<decltype(draw())>> out;
    for (const double at : fractions()) out.emplace_back(at, draw());
    return out;
  }
  [[nodiscard]] AlongMember number(double value, const std::vector<double>& at);
  [[nodiscard]] ReactionLaw law(double stiffness, double yield, bool varies);
  [[nodiscard]] Curve curve(const Node& a, const Node& b);
  [[nodiscard]] double joint() {
    return random_.chance(0.3) ? 0.0 : force_ * length_ * random_.decades(-1.0, 2.0);
  }
  void sections();
  void members();
  void supports();
  void foundation(const Member& member, bool tangential);
  void springs();
  [[nodiscard]] Load load(int kind);
  [[nodiscard]] Load point_load();
  void loads();
  void load_cases();
  void rest();
  void path_rules();
  void mesh();

  double stiffest_ = 0.0;  ///< largest modulus of a foundation
};

std::vector<double> LawsDrawer::fractions() {
  std::vector<double> out{random_.chance(0.7) ? 0.0 : fraction(1, 5)};
  for (int i = random_.below(3); i > 0; --i) out.push_back(out.back() + fraction(2, 5));
  out.push_back(random_.chance(0.7) ? 1.0 : fraction(17, 19));
  return out;
}

/// Constant without places; at one of them soil may have no strength, as at its surface.
AlongMember LawsDrawer::number(double value, const std::vector<double>& at) {
  AlongMember out(value);
  if (at.empty()) return out;
  out.constant = 0.0;
  for (const double fraction : at) out.points.emplace_back(fraction, value * random_.between(0.2, 1.0));
  if (random_.chance(0.3)) (random_.chance(0.5) ? out.points.front() : out.points.back()).second = 0.0;
  return out;
}

/// @param stiffness force by displacement up to about `yield`
ReactionLaw LawsDrawer::law(double stiffness, double yield, bool varies) {
  constexpr std::array kTypes{ReactionLaw::Type::linear, ReactionLaw::Type::tanh,
                              ReactionLaw::Type::hyperbolic, ReactionLaw::Type::power,
                              ReactionLaw::Type::table};
  // a law of type linear stands for a plain stiffness that varies
  const int first = varies ? 0 : 1;
  ReactionLaw out;
  out.type = kTypes[static_cast<std::size_t>(first + random_.below(5 - first))];
  const std::vector<double> at = varies ? fractions() : std::vector<double>{};
  if (out.type == ReactionLaw::Type::table) {
    double w = 0.0;
    double p = 0.0;
    for (int i = 1 + random_.below(5); i > 0; --i) {
      const double step = yield * random_.between(0.3, 1.5);
      w += step;
      p += p > 0.0 && random_.chance(0.2) ? 0.0 : stiffness * step * random_.between(0.1, 1.0);
      out.points.push_back({w, p});
    }
    if (random_.chance(0.5)) out.points.insert(out.points.begin(), {0.0, 0.0});
    out.factor = number(1.0, at);
    return out;
  }
  const bool is_power = out.type == ReactionLaw::Type::power;
  out.stiffness = number(stiffness * (is_power ? random_.decades(0.0, 2.0) : 1.0), at);
  if (out.type == ReactionLaw::Type::linear) return out;
  out.capacity = number(stiffness * yield, random_.chance(0.7) ? at : std::vector<double>{});
  if (!is_power) return out;
  out.reference = yield;
  out.exponent = random_.between(0.2, 0.8);
  return out;
}

void LawsDrawer::sections() {
  const int count = 1 + random_.below(2);
  for (int i = 0; i < count; ++i) {
    Section section;
    section.id = "s" + std::to_string(i);
    section.EI = force_ * length_ * length_ * (i == 0 ? 1.0 : random_.decades(-1.0, 1.0));
    section.EA = section.EI.constant / (length_ * length_) * random_.decades(2.0, 8.0);
    if (random_.chance(0.25)) section.GA = section.EA.constant * random_.between(0.1, 0.5);
    section.mass = force_ / length_ * random_.between(0.0, 1.0);
    section.expansion = random_.between(0.5, 2.0) * 1e-5;
    model().sections.push_back(section);
  }
}

Curve LawsDrawer::curve(const Node& a, const Node& b) {
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  const double left = std::atan2(b.x - a.x, a.y - b.y);  // angle of the left normal
  switch (random_.below(8)) {
    case 0:
      return ArcCurve{random_.between(10.0, 180.0) * (random_.chance(0.5) ? 1.0 : -1.0)};
    case 1:
      return ParabolaCurve{chord * random_.between(-0.4, 0.4)};
    case 2:
    case 3:
      return ParabolaCurve{chord * random_.between(0.05, 0.4), direction(left - 1.0, left + 1.0)};
    case 4:
      return SineCurve{chord * random_.between(-0.15, 0.15), 1 + random_.below(3)};
    default:
      return LineCurve{};
  }
}

void LawsDrawer::members() {
  const int count = 1 + random_.below(3);
  double heading = random_.between(-std::numbers::pi, std::numbers::pi);
  model().nodes.push_back({"n0", 0.0, 0.0});
  for (int m = 0; m < count; ++m) {
    const Node start = model().nodes.back();
    const double chord = length_ * random_.between(0.5, 1.0);
    const std::string end = "n" + std::to_string(m + 1);
    model().nodes.push_back({end, start.x + chord * std::cos(heading), start.y + chord * std::sin(heading)});
    heading += random_.between(-1.2, 1.2);
    Member member;
    member.id = "m" + std::to_string(m);
    member.start = start.id;
    member.end = end;
    const int section = random_.below(static_cast<int>(model().sections.size()));
    member.section = model().sections[static_cast<std::size_t>(section)].id;
    member.curve = curve(start, model().nodes.back());
    if (random_.chance(0.2)) {
      member.release_start_rotation = true;
      member.release_start_stiffness = joint();
    }
    if (random_.chance(0.2)) {
      member.release_end_rotation = true;
      member.release_end_stiffness = joint();
    }
    model().members.push_back(member);
  }
}

/// A member may also be held by its foundations alone, as a pile by soil.
void LawsDrawer::supports() {
  if (random_.chance(0.85)) model().supports.push_back({"n0", true, true, random_.chance(0.5), 0.0, {}});
  if (random_.chance(0.25) && !model().supports.empty()) return;
  Support last{model().nodes.back().id, true, true, random_.chance(0.2), random_.between(-90.0, 90.0), {}};
  last.x = random_.chance(0.5);
  if (last.x && random_.chance(0.15))
    last.displacement = PrescribedDisplacement{length_ * random_.between(-0.02, 0.02),
                                               length_ * random_.between(-0.02, 0.02), 0.0, pattern()};
  model().supports.push_back(last);
}

void LawsDrawer::foundation(const Member& member, bool tangential) {
  Foundation base;
  base.id = (tangential ? "friction " : "soil ") + member.id;
  base.member = member.id;
  base.component = tangential ? FoundationComponent::tangent : FoundationComponent::normal;
  base.range = range();
  base.reaction = tangential ? Reaction::bilateral : reaction();
  const double modulus = force_ / (length_ * length_) * random_.decades(0.0, 5.0);
  stiffest_ = std::max(stiffest_, tangential ? 0.0 : modulus);
  if (random_.chance(0.8))
    base.law = law(modulus, length_ * random_.decades(-4.0, -1.0), random_.chance(0.5));
  else
    base.stiffness = modulus;
  if (!tangential) {
    base.side = random_.chance(0.5) ? Side::left : Side::right;
    if (random_.chance(0.15)) base.direction = direction(-std::numbers::pi, std::numbers::pi);
    if (base.reaction == Reaction::bilateral && random_.chance(0.15))
      base.shear_stiffness = force_ * random_.decades(-1.0, 1.0);
    if (base.reaction != Reaction::bilateral && random_.chance(0.3))
      base.gap = length_ * random_.decades(-5.0, -1.5);
  }
  model().foundations.push_back(base);
}

void LawsDrawer::springs() {
  for (int i = random_.below(3); i > 0; --i) {
    Spring spring;
    spring.id = "spring" + std::to_string(i);
    spring.reaction = reaction();
    const bool turns = random_.chance(0.2);
    if (!turns) spring.direction = direction(-std::numbers::pi, std::numbers::pi);
    if (!turns && random_.chance(0.4))
      spring.at = {model().nodes.back().id, "", 0.0};
    else
      spring.at = {"", any_member().id, fraction(1, 19)};
    const double unit = turns ? 1.0 : length_;
    const double stiffness = force_ * length_ / (unit * unit) * random_.decades(-1.0, 4.0);
    if (random_.chance(0.8))
      spring.law = law(stiffness, unit * random_.decades(-4.0, -1.0), false);
    else
      spring.stiffness = stiffness;
    if (spring.reaction != Reaction::bilateral && random_.chance(0.4))
      spring.gap = unit * random_.decades(-4.0, -1.5);
    model().springs.push_back(spring);
  }
}

Load LawsDrawer::point_load() {
  PointLoad load;
  load.at = {"", any_member().id, fraction(1, 19)};
  if (random_.chance(0.5)) load.at = {model().nodes.back().id, "", 0.0};
  load.force = {component(), component()};
  if (random_.chance(0.2)) load.moment = component() * length_;
  load.pattern = pattern();
  return load;
}

Load LawsDrawer::load(int kind) {
  constexpr double kWarming = 30.0;
  const std::string member = any_member().id;
  const bool varies = random_.chance(0.5);
  const auto line = [this] { return component() / length_; };
  const auto scaled = [this](double size) {
    return [this, size] { return size * random_.between(-1.0, 1.0); };
  };
  if (kind == 0) {
    DistributedLoad out{member, {line(), line()}, range(), LoadMeasure::length, pattern()};
    constexpr std::array kMeasures{LoadMeasure::length, LoadMeasure::horizontal, LoadMeasure::vertical};
    out.per = kMeasures[static_cast<std::size_t>(random_.below(3))];
    out.axes = random_.chance(0.5) ? LoadAxes::member : LoadAxes::global;
    if (varies) out.force_along = drawn_along([&] { return std::array{line(), line()}; });
    return out;
  }
  if (kind == 1) {
    PressureLoad out{member, line(), random_.chance(0.5) ? Side::left : Side::right, pattern()};
    if (varies) out.value_along = drawn_along(line);
    return out;
  }
  if (kind == 2) {
    const auto axial = scaled(1e-3);
    const auto curvature = scaled(0.3 / length_);
    InitialStrain out{member, axial(), curvature(), pattern()};
    if (varies) out.axial_along = drawn_along(axial);
    if (random_.chance(0.5)) out.curvature_along = drawn_along(curvature);
    return out;
  }
  if (kind == 3) {
    const auto change = scaled(kWarming);
    const auto gradient = scaled(10.0 * kWarming / length_);
    TemperatureLoad out{member, change(), gradient(), pattern()};
    if (varies) out.change_along = drawn_along(change);
    if (random_.chance(0.5)) out.gradient_along = drawn_along(gradient);
    return out;
  }
  return SelfWeight{{random_.between(-1.0, 1.0), random_.between(-1.0, 1.0)}, pattern()};
}

void LawsDrawer::loads() {
  constexpr int kKinds = 5;
  if (random_.chance(0.7)) model().loads.push_back(point_load());
  for (int kind = 0; kind < kKinds; ++kind)
    if (random_.chance(kind == 0 ? 0.4 : 0.2)) model().loads.push_back(load(kind));
}

void LawsDrawer::load_cases() {
  if (!random_.chance(0.3)) return;
  const int count = 1 + random_.below(2);
  for (int i = 0; i < count; ++i) {
    const Pattern pattern = random_.chance(0.5) ? Pattern::proportional : Pattern::constant;
    LoadCase group{"case" + std::to_string(i), static_cast<std::size_t>(1 + random_.below(2))};
    for (std::size_t k = 0; k < group.loads; ++k) {
      Load added = random_.chance(0.4) ? point_load() : load(random_.below(5));
      std::visit([pattern](auto& of_case) { of_case.pattern = pattern; }, added);
      model().loads.push_back(added);
    }
    model().load_cases.push_back(group);
  }
}

void LawsDrawer::path_rules() {
  Analysis& a = out_.analysis;
  a.stop.steps = 20 + random_.below(40);
  const double size = random_.decades(0.0, 2.0);
  a.stop.load_factor = {{-size, size}};
  if (random_.chance(0.4)) a.stop.limit_points = 1 + random_.below(2);
  if (random_.chance(0.3)) {
    const double unit = model().monitors.front().component == Component::rotation ? 1.0 : length_;
    const double reach = unit * random_.decades(-2.0, 0.0);
    a.stop.monitor = MonitorRange{"w", {-reach, reach}};
  }
  const double control = random_.unit();
  if (control < 0.1) a.control.type = ControlType::load;
  if (control > 0.9) a.control = {ControlType::displacement, "w"};
  if (random_.chance(0.1)) a.branches = {Follow::first, 1};
}

/// A fixed mesh, unless it would need many elements to resolve the foundations.
void LawsDrawer::mesh() {
  constexpr double kDecayLengths = 3.0;
  constexpr int kMostElements = 30;
  if (random_.chance(0.5)) return;
  Discretization mesh;
  mesh.fixed_mesh = true;
  mesh.order = 1 + random_.below(6);
  const double softest = std::ranges::min_element(model().sections, {}, [](const Section& s) {
                           return s.EI.constant;
                         })->EI.constant;
  const double decay = stiffest_ > 0.0 ? std::pow(4.0 * softest / stiffest_, 0.25) : length_;
  mesh.elements = std::max(6 + random_.below(10), static_cast<int>(length_ / (kDecayLengths * decay)) + 1);
  if (random_.chance(0.15)) mesh.foundation = FoundationRule::lumped;
  if (mesh.elements <= kMostElements) out_.analysis.discretization = mesh;
}

void LawsDrawer::rest() {
  if (random_.chance(0.4))
    model().imperfections.emplace_back(
        SineImperfection{any_member().id, 1 + random_.below(3), length_ * random_.decades(-5.0, -2.0)});
  constexpr std::array kComponents{Component::x, Component::y, Component::rotation, Component::normal};
  model().monitors.push_back(
      {"w", {"", any_member().id, fraction(1, 19)}, kComponents[static_cast<std::size_t>(random_.below(4))]});
  out_.analysis.type = random_.chance(0.35) ? AnalysisType::critical : AnalysisType::path;
  if (out_.analysis.type == AnalysisType::path) path_rules();
  mesh();
}

RandomRequest LawsDrawer::draw() {
  sections();
  members();
  supports();
  const std::vector<Member> drawn = model().members;
  for (const Member& member : drawn) {
    if (random_.chance(0.7)) foundation(member, false);
    if (random_.chance(0.2)) foundation(member, true);
  }
  springs();
  loads();
  load_cases();
  rest();
  return out_;
}

}  // namespace

RandomRequest laws_request(std::uint64_t seed) {
  // what is drawn may be a mechanism or have no load that grows: then it is drawn again
  constexpr std::uint64_t kAnotherDraw = 0x9e3779b97f4a7c15;
  for (;; seed += kAnotherDraw) {
    RandomRequest request = LawsDrawer(seed).draw();
    if (check(request.model, request.analysis).empty() && !can_move(resolve(request.model))) return request;
  }
}

}  // namespace snapthrough::testing
