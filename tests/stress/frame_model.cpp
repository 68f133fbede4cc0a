#include "tests/stress/frame_model.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "solver/check/check.h"
#include "solver/discrete/mechanism.h"
#include "solver/resolve/resolved_model.h"
#include "tests/stress/random_numbers.h"

namespace snapthrough::testing {
namespace {

Curve frame_curve(Random& random, double chord) {
  switch (random.below(4)) {
    case 0:
      return ArcCurve{random.between(10.0, 200.0) * (random.chance(0.5) ? 1.0 : -1.0)};
    case 1:
      return ParabolaCurve{chord * random.between(-0.4, 0.4)};
    default:
      return LineCurve{};
  }
}

Reaction frame_reaction(Random& random) {
  const int kind = random.below(4);
  return kind < 2 ? Reaction::compression_only : (kind == 2 ? Reaction::tension_only : Reaction::bilateral);
}

std::array<double, 2> any_direction(Random& random) {
  const double angle = random.between(-std::numbers::pi, std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}

Location inside(Random& random, const Model& model) {
  const int member = random.below(static_cast<int>(model.members.size()));
  return {"", model.members[static_cast<std::size_t>(member)].id, random.between(0.1, 0.9)};
}

void add_frame(Random& random, Model& model) {
  const int members = 1 + random.below(3);
  double heading = random.between(-1.0, 1.0);
  model.nodes.push_back({"n0", 0.0, 0.0});
  for (int m = 0; m < members; ++m) {
    const Node last = model.nodes.back();
    const double chord = random.between(0.6, 1.4);
    const std::string number = std::to_string(m);
    model.nodes.push_back({"n" + std::to_string(m + 1), last.x + chord * std::cos(heading),
                           last.y + chord * std::sin(heading)});
    heading += random.between(-1.2, 1.2);
    const double EI = random.between(0.5, 2.0);
    Section section{"s" + number, EI * random.decades(3.0, 9.0), EI, {}};
    if (random.chance(0.25)) section.GA = EI * random.decades(2.0, 5.0);
    model.sections.push_back(section);
    Member member;
    member.id = "m" + number;
    member.start = last.id;
    member.end = model.nodes.back().id;
    member.section = section.id;
    member.curve = frame_curve(random, chord);
    member.release_end_rotation = m + 1 < members && random.chance(0.15);
    model.members.push_back(member);
  }
}

void add_holds(Random& random, Model& model) {
  Support first{"n0", true, true, random.chance(0.4), 0.0, {}};
  Support last{model.nodes.back().id, true, true, random.chance(0.2), 0.0, {}};
  if (random.chance(0.4)) {
    last.x = false;
    if (random.chance(0.6)) last.angle_degrees = random.between(-60.0, 60.0);
  }
  model.supports = {first, last};
  for (const Member& member : model.members) {
    if (!random.chance(0.5)) continue;
    Foundation base;
    base.id = "f" + member.id;
    base.member = member.id;
    base.stiffness = random.decades(0.0, 4.0);
    base.reaction = frame_reaction(random);
    base.side = random.chance(0.5) ? Side::left : Side::right;
    if (random.chance(0.3)) base.range = {random.between(0.0, 0.4), random.between(0.6, 1.0)};
    if (base.reaction != Reaction::bilateral && random.chance(0.3)) base.gap = random.decades(-4.0, -1.5);
    model.foundations.push_back(base);
  }
  if (!random.chance(0.4)) return;
  Spring spring;
  spring.id = "k";
  spring.at = inside(random, model);
  spring.direction = any_direction(random);
  spring.stiffness = random.decades(0.0, 4.0);
  spring.reaction = frame_reaction(random);
  if (spring.reaction != Reaction::bilateral && random.chance(0.6)) spring.gap = random.decades(-4.0, -1.5);
  model.springs.push_back(spring);
}

void add_load(Random& random, Model& model) {
  const auto component = [&random] { return random.between(-1.0, 1.0); };
  PointLoad load{inside(random, model), {component(), component()}, 0.0, Pattern::proportional};
  if (random.chance(0.3)) load.moment = 0.2 * component();
  model.loads.push_back(load);
  if (!random.chance(0.3)) return;
  model.loads.push_back(DistributedLoad{model.members.front().id,
                                        {component(), component()},
                                        {0.0, 1.0},
                                        LoadMeasure::length,
                                        Pattern::proportional});
}

}  // namespace

RandomRequest frame_request(std::uint64_t seed, double accuracy) {
  constexpr std::uint64_t kAnotherDraw = 0x9e3779b97f4a7c15;
  for (;; seed += kAnotherDraw) {
    Random random(Random(seed + 0xF3A3E).bits());
    RandomRequest out;
    add_frame(random, out.model);
    add_holds(random, out.model);
    add_load(random, out.model);
    out.analysis.type = AnalysisType::critical;
    out.analysis.discretization.accuracy = accuracy;
    out.analysis.output.states = StateOutput::none;
    if (check(out.model, out.analysis).empty() && !can_move(resolve(out.model))) return out;
  }
}

}  // namespace snapthrough::testing
