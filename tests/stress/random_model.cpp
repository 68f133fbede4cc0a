#include "tests/stress/random_model.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/stress/random_numbers.h"

namespace snapthrough::testing {
namespace {

struct Scale {
  double length;
  double force;  ///< EI / length^2
};

Curve random_curve(Random& random, double chord) {
  switch (random.below(5)) {
    case 0:
      return ArcCurve{random.between(5.0, 240.0) * (random.chance(0.5) ? 1.0 : -1.0)};
    case 1:
      return ParabolaCurve{chord * random.between(-0.5, 0.5)};
    case 2:
      return SineCurve{chord * random.between(-0.2, 0.2), 1 + random.below(3)};
    default:
      return LineCurve{};
  }
}

void add_members(Random& random, const Scale& scale, Model& model) {
  const int members = 1 + (random.chance(0.5) ? 0 : random.below(4));
  double x = random.between(-3.0, 3.0) * scale.length;
  double y = random.between(-3.0, 3.0) * scale.length;
  double heading = random.between(-std::numbers::pi, std::numbers::pi);
  model.nodes.push_back({"n0", x, y});
  const double slenderness = random.decades(2.0, 12.0);
  const double EI = scale.force * scale.length * scale.length;
  Section section{"s", slenderness * scale.force, EI, {}};
  if (random.chance(0.3)) section.GA = section.EA.constant * random.between(0.1, 0.5);
  model.sections.push_back(section);
  for (int m = 0; m < members; ++m) {
    const double chord = scale.length * random.between(0.3, 1.0);
    x += chord * std::cos(heading);
    y += chord * std::sin(heading);
    heading += random.between(-1.2, 1.2);
    model.nodes.push_back({"n" + std::to_string(m + 1), x, y});
    Member member;
    member.id = "m" + std::to_string(m);
    member.start = "n" + std::to_string(m);
    member.end = "n" + std::to_string(m + 1);
    member.section = "s";
    member.curve = random_curve(random, chord);
    member.release_end_rotation = m + 1 < members && random.chance(0.1);
    model.members.push_back(member);
  }
}

void add_supports(Random& random, Model& model) {
  const std::string last = model.nodes.back().id;
  const bool clamped = random.chance(0.5);
  model.supports.push_back({"n0", true, true, clamped, 0.0, {}});
  if (random.chance(0.6))
    model.supports.push_back({last, true, true, random.chance(0.3), 0.0, {}});
  else if (random.chance(0.5))
    model.supports.push_back({last, false, true, false, random.between(-90.0, 90.0), {}});
  else
    model.supports.front().rotation = true;
}

Reaction random_reaction(Random& random) {
  const int kind = random.below(4);
  return kind < 2 ? Reaction::compression_only : (kind == 2 ? Reaction::bilateral : Reaction::tension_only);
}

void add_bases(Random& random, const Scale& scale, Model& model) {
  for (const Member& member : model.members) {
    if (!random.chance(0.6)) continue;
    Foundation base;
    base.id = "b" + std::to_string(model.foundations.size());
    base.member = member.id;
    base.stiffness = scale.force / (scale.length * scale.length) * scale.length * random.decades(-2.0, 8.0);
    base.reaction = random_reaction(random);
    base.side = random.chance(0.5) ? Side::left : Side::right;
    if (random.chance(0.3)) base.range = {random.between(0.0, 0.4), random.between(0.6, 1.0)};
    if (base.reaction != Reaction::bilateral && random.chance(0.3))
      base.gap = scale.length * random.decades(-4.0, -1.0);
    if (base.reaction == Reaction::bilateral && random.chance(0.3))
      base.shear_stiffness = scale.force * random.decades(-2.0, 2.0);
    model.foundations.push_back(base);
  }
  if (!random.chance(0.4)) return;
  Spring spring;
  spring.id = "spring";
  spring.at = {"", model.members[random.below(static_cast<int>(model.members.size()))].id, random.unit()};
  spring.direction = std::array{std::cos(6.0 * random.unit()), std::sin(6.0 * random.unit()) + 1e-3};
  spring.stiffness = scale.force / scale.length * random.decades(-2.0, 6.0);
  spring.reaction = random_reaction(random);
  if (spring.reaction != Reaction::bilateral && random.chance(0.5))
    spring.gap = scale.length * random.decades(-4.0, -1.0);
  model.springs.push_back(spring);
}

void add_actions(Random& random, const Scale& scale, Model& model) {
  const auto component = [&]() { return scale.force * random.between(-1.0, 1.0); };
  const std::string member = model.members[random.below(static_cast<int>(model.members.size()))].id;
  model.loads.push_back(
      PointLoad{{"", member, random.between(0.1, 0.9)}, {component(), component()}, 0.0, {}});
  if (random.chance(0.4))
    model.loads.push_back(DistributedLoad{member,
                                          {component() / scale.length, component() / scale.length},
                                          {0.0, 1.0},
                                          LoadMeasure::length,
                                          {}});
  if (random.chance(0.4))
    model.imperfections.push_back(
        SineImperfection{member, 1 + random.below(3), scale.length * random.decades(-8.0, -2.0)});
  model.monitors.push_back({"w", {"", member, random.unit()}, Component::normal});
}

}  // namespace

RandomRequest random_request(std::uint64_t seed) {
  Random random(seed);
  RandomRequest out;
  const Scale scale{random.decades(-3.0, 3.0), random.decades(-6.0, 9.0)};
  add_members(random, scale, out.model);
  add_supports(random, out.model);
  add_bases(random, scale, out.model);
  add_actions(random, scale, out.model);
  out.analysis.type = random.chance(0.5) ? AnalysisType::critical : AnalysisType::path;
  out.analysis.stop.limit_points = 1 + random.below(3);
  out.analysis.stop.steps = 150;
  out.analysis.output.states = StateOutput::none;
  return out;
}

}  // namespace snapthrough::testing
