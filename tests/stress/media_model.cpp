#include "tests/stress/media_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/check/check.h"
#include "solver/discrete/mechanism.h"
#include "solver/geometry/axes.h"
#include "solver/resolve/resolved_model.h"
#include "tests/index_of.h"
#include "tests/stress/laws_model.h"
#include "tests/stress/random_numbers.h"

namespace snapthrough::testing {
namespace {

using Vec2 = std::array<double, 2>;

constexpr double kRigid = std::numeric_limits<double>::infinity();

/// Adds to a drawn request.
class Widener {
 public:
  Widener(RandomRequest request, std::uint64_t seed)
      : random_(Random(seed + 0x3ED1A).bits()), out_(std::move(request)) {
    for (const auto& axis : make_axes(resolve(out_.model))) length_ = std::max(length_, axis->length());
  }
  RandomRequest widen();

 private:
  [[nodiscard]] Model& model() { return out_.model; }
  [[nodiscard]] double gap() { return random_.chance(0.3) ? 0.0 : length_ * random_.decades(-4.0, -1.5); }
  [[nodiscard]] AlongMember tapered(const AlongMember& value, bool linear);
  void tapers();
  void rod(int number);
  void foundation(Foundation& base);
  [[nodiscard]] std::optional<Outline> outline(const Foundation& base);
  [[nodiscard]] std::optional<Outline> circle(const std::vector<Vec2>& axis);
  [[nodiscard]] Outline waves(const std::vector<Vec2>& axis);

  Random random_;
  RandomRequest out_;
  double length_ = 0.0;  ///< of the longest member
};

/// @param linear the value itself is linear between its places
AlongMember Widener::tapered(const AlongMember& value, bool linear) {
  AlongMember out;
  out.points = {{0.0, value.constant * random_.between(0.2, 1.0)}};
  if (random_.chance(0.4)) out.points.emplace_back(0.4, value.constant * random_.between(0.2, 1.0));
  out.points.emplace_back(random_.chance(0.7) ? 1.0 : 0.8, value.constant * random_.between(0.2, 1.0));
  if (!linear) out.power = 1.0 + random_.below(4);
  return out;
}

void Widener::tapers() {
  for (Section& section : model().sections) {
    if (random_.chance(0.4)) section.EI = tapered(section.EI, false);
    if (random_.chance(0.3)) section.EA = tapered(section.EA, false);
    if (section.GA && random_.chance(0.3)) section.GA = tapered(*section.GA, false);
    if (section.mass && section.mass->constant > 0.0 && random_.chance(0.3))
      section.mass = tapered(*section.mass, true);
  }
}

/// A rod from a node to an anchor of its own or to another node, at any place in the list of members.
void Widener::rod(int number) {
  const std::string id = "rod" + std::to_string(number);
  const auto nodes = static_cast<int>(model().nodes.size());
  const Node from = model().nodes[static_cast<std::size_t>(random_.below(nodes))];
  Node to = model().nodes[static_cast<std::size_t>(random_.below(nodes))];
  if (to.id == from.id || random_.chance(0.6)) {
    const double angle = random_.between(-std::numbers::pi, std::numbers::pi);
    const double reach = length_ * random_.between(0.3, 1.0);
    to = {"anchor" + std::to_string(number), from.x + reach * std::cos(angle),
          from.y + reach * std::sin(angle)};
    model().nodes.push_back(to);
    model().supports.push_back({to.id, true, true, false, random_.between(-90.0, 90.0), {}});
  }
  Section section = model().sections.front();
  section.id = "of " + id;
  section.EA = AlongMember(section.EA.largest() * random_.decades(-4.0, 0.0));
  if (random_.chance(0.3)) section.EA = tapered(section.EA, false);
  if (section.mass) section.mass = AlongMember(section.mass->largest());
  Member member;
  member.id = id;
  member.start = from.id;
  member.end = to.id;
  member.section = section.id;
  member.reaction = random_.chance(0.6) ? Reaction::tension_only : Reaction::compression_only;
  model().sections.push_back(section);
  const auto place = random_.below(static_cast<int>(model().members.size()) + 1);
  model().members.insert(model().members.begin() + place, member);
}

/// A cavity around the axis, or a bar beside it.
std::optional<Outline> Widener::circle(const std::vector<Vec2>& axis) {
  const auto range = [&axis](const Vec2& centre) {
    const auto [least, most] = std::ranges::minmax(
        axis, {}, [&](const Vec2& x) { return std::hypot(x[0] - centre[0], x[1] - centre[1]); });
    return std::array{std::hypot(least[0] - centre[0], least[1] - centre[1]),
                      std::hypot(most[0] - centre[0], most[1] - centre[1])};
  };
  const Vec2 beside = axis[static_cast<std::size_t>(random_.below(static_cast<int>(axis.size())))];
  const double angle = random_.between(-std::numbers::pi, std::numbers::pi);
  const double away = length_ * random_.between(0.1, 1.5);
  CircleOutline out;
  out.centre = {beside[0] + away * std::cos(angle), beside[1] + away * std::sin(angle)};
  out.medium_inside = random_.chance(0.5);
  const auto [least, most] = range(out.centre);
  out.radius = out.medium_inside ? least - gap() : most + gap();
  if (out.radius < 0.05 * length_) return std::nullopt;
  return out;
}

/// A surface of up and down along the member, beyond its axis.
Outline Widener::waves(const std::vector<Vec2>& axis) {
  const Vec2 a = axis.front();
  const double chord = std::hypot(axis.back()[0] - a[0], axis.back()[1] - a[1]);
  const Vec2 t{(axis.back()[0] - a[0]) / chord, (axis.back()[1] - a[1]) / chord};
  const double side = random_.chance(0.5) ? 1.0 : -1.0;
  const Vec2 n{-side * t[1], side * t[0]};
  double height = -std::numeric_limits<double>::infinity();
  for (const Vec2& x : axis) height = std::max(height, n[0] * (x[0] - a[0]) + n[1] * (x[1] - a[1]));
  if (random_.chance(0.3)) {
    const double base = height + gap();
    const double size = random_.decades(-1.0, 1.0);
    return LineOutline{{a[0] + base * n[0], a[1] + base * n[1]}, {size * n[0], size * n[1]}};
  }
  const bool rounded = random_.chance(0.5);
  const double wave = chord * random_.decades(-2.5, -1.0);
  const double base = height + gap() + 1.5 * wave;
  const int count = 4 + random_.below(4);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double along = chord * (-0.3 + 1.6 * i / (count - 1));
    const double up = base + wave * random_.between(-1.0, 1.0);
    points.push_back({a[0] + along * t[0] + up * n[0], a[1] + along * t[1] + up * n[1]});
  }
  const Side medium = side > 0.0 ? Side::left : Side::right;
  if (rounded) return PolylineOutline{points, chord * random_.decades(-2.0, -0.5), medium};
  return SplineOutline{points, medium};
}

std::optional<Outline> Widener::outline(const Foundation& base) {
  constexpr int kSamples = 200;
  const Member& member = model().members[static_cast<std::size_t>(index_of(model().members, base.member))];
  const Node& start = model().nodes[static_cast<std::size_t>(index_of(model().nodes, member.start))];
  const Node& end = model().nodes[static_cast<std::size_t>(index_of(model().nodes, member.end))];
  const AxisCurve curve(member.curve, {start.x, start.y}, {end.x, end.y});
  std::vector<Vec2> axis;
  for (int i = 0; i <= kSamples; ++i) {
    const AxisPoint at = curve.at(curve.length() * i / kSamples);
    axis.push_back({at.x, at.y});
  }
  return random_.chance(0.4) ? circle(axis) : std::optional(waves(axis));
}

void Widener::foundation(Foundation& base) {
  if (base.component != FoundationComponent::normal || base.shear_stiffness > 0.0) return;
  if (random_.chance(0.5)) {
    base.outline = outline(base);
    if (base.outline) {
      base.reaction = Reaction::compression_only;
      base.side = Side::left;
      base.direction.reset();
      base.gap = 0.0;
    }
  }
  if (base.reaction == Reaction::bilateral) return;
  if (!base.outline && random_.chance(0.4)) {
    base.gap = 0.0;
    base.gap_along = {{0.0, gap()}, {0.5, gap()}, {1.0, gap()}};
  }
  if (!random_.chance(0.25)) return;
  base.law.reset();
  base.stiffness = kRigid;
}

RandomRequest Widener::widen() {
  tapers();
  for (Foundation& base : model().foundations) foundation(base);
  for (Spring& spring : model().springs) {
    if (spring.reaction == Reaction::bilateral || !random_.chance(0.4)) continue;
    spring.law.reset();
    spring.stiffness = kRigid;
  }
  for (int i = random_.below(3); i > 0; --i) rod(i);
  return out_;
}

}  // namespace

RandomRequest media_request(std::uint64_t seed) {
  // the rods of a draw may be doubled: then it is drawn again
  constexpr std::uint64_t kAnotherDraw = 0x9e3779b97f4a7c15;
  for (;; seed += kAnotherDraw) {
    RandomRequest request = Widener(laws_request(seed), seed).widen();
    if (check(request.model, request.analysis).empty() && !can_move(resolve(request.model))) return request;
  }
}

}  // namespace snapthrough::testing
