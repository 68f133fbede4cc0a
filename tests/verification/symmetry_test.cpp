/// What must not change a result: mirror images, rotations, translations, reversed members, split members,
/// units.
///
/// One structure with everything whose sign or direction could be mixed up: an unsymmetric two-member frame
/// (arc and line) with a one-sided base on one member, a bonded base along a fixed direction, a spring, an
/// inclined support, a follower pressure, point and distributed loads. Its first limit load must come out the
/// same within 1e-8.
///
/// What limits each: rounding of the sums is 1e-16 of forces EA * strain, about 1e-12 of the load here. A
/// translation by 1e6 lengths leaves 10 of the 16 digits of the nodes' coordinates, so the structure itself
/// is different by 1e-10. Splitting a member moves the element ends, so it compares two discretisation errors
/// (1e-10 on this mesh). The critical point's own tolerance is 1e-9.
#include <functional>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

using Vec2 = std::array<double, 2>;

constexpr double kSize = 10.0;

Model frame() {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 6.0, 2.5}, {"c", 10.0, 1.5}};
  model.sections = {{"s", 5e4, 80.0, 4e3}};
  model.members = {{"left", "a", "b", "s", ArcCurve{-35.0}, false, false},
                   {"right", "b", "c", "s", LineCurve{}, false, false}};
  model.supports = {support("a", "xy"), support("c", "y", 100.0)};
  model.supports[1].x = true;
  model.springs = {{"k", at_member("left", 0.4), Vec2{0.3, -1.0}, 2.0, Reaction::bilateral, 0.0}};
  Foundation soil = one_sided("left", 2.0, Side::left);
  Foundation bilateral = winkler("right", 1.0);
  bilateral.id = "bilateral";
  bilateral.direction = Vec2{0.4, -1.0};
  model.foundations = {soil, bilateral};
  model.loads = {
      force_at(at_member("left", 0.55), 0.1, -1.0, 0.2), force_at(at_node("b"), 0.05, -0.3, -0.1),
      DistributedLoad{"left", {0.02, -0.05}, {0.1, 0.9}, LoadMeasure::length, Pattern::proportional},
      PressureLoad{"right", 0.1, Side::left, Pattern::proportional}};
  model.monitors = {{"d", at_member("left", 0.55), Component::y}};
  return model;
}

/// Applies a similarity x -> c + T x to every place and direction of a model; `mirror` also swaps sides and
/// turns.
Model moved(Model model, const std::function<Vec2(Vec2)>& turn, Vec2 shift, bool mirror) {
  const double hand = mirror ? -1.0 : 1.0;
  const auto swap = [mirror](Side& side) {
    if (mirror) side = side == Side::left ? Side::right : Side::left;
  };
  for (Node& node : model.nodes) {
    const Vec2 x = turn({node.x, node.y});
    node.x = x[0] + shift[0];
    node.y = x[1] + shift[1];
  }
  for (Member& member : model.members)
    if (auto* arc = std::get_if<ArcCurve>(&member.curve)) arc->sweep_degrees *= hand;
  for (Support& s : model.supports) {
    const double angle = s.angle_degrees * kPi / 180.0;
    const Vec2 axis = turn({std::cos(angle), std::sin(angle)});
    s.angle_degrees = std::atan2(axis[1], axis[0]) * 180.0 / kPi;
  }
  for (Spring& spring : model.springs)
    if (spring.direction) spring.direction = turn(*spring.direction);
  for (Foundation& base : model.foundations) {
    if (base.direction) base.direction = turn(*base.direction);
    swap(base.side);
  }
  for (Load& load : model.loads) {
    if (auto* point = std::get_if<PointLoad>(&load)) {
      point->force = turn(point->force);
      point->moment *= hand;
    }
    if (auto* spread = std::get_if<DistributedLoad>(&load)) spread->force = turn(spread->force);
    if (auto* pressure = std::get_if<PressureLoad>(&load)) swap(pressure->side);
  }
  return model;
}

double limit_load(const Model& model, const Discretization& mesh) {
  const Result result = solve_soundly(model, path_on(mesh, 1));
  const auto limits = limits_of(result);
  EXPECT_EQ(limits.size(), 1u);
  return limits.empty() ? 0.0 : limits[0].load_factor;
}

double reference_load() { return limit_load(frame(), fixed_mesh(24, 6)); }

TEST(Invariance, TheStructureHasContactAndALimitPoint) {
  Analysis analysis = path_on(fixed_mesh(24, 6), 1);
  analysis.output.states = StateOutput::critical;
  const Result result = solve_soundly(frame(), analysis);
  ASSERT_FALSE(result.states.empty());
  const auto& contact = result.states.back().foundations[0].contact;
  ASSERT_FALSE(contact.empty()) << "the one-sided base must take part";
  EXPECT_LT(contact[0][1] - contact[0][0], 0.95 * result.states.back().members[0].s.back());
}

TEST(Invariance, UnderMirroring) {
  const Model mirrored = moved(
      frame(),
      [](Vec2 x) {
        return Vec2{-x[0], x[1]};
      },
      {0.0, 0.0}, true);
  expect_relative(limit_load(mirrored, fixed_mesh(24, 6)), reference_load(), 1e-8, "mirror");
}

TEST(Invariance, UnderRotation) {
  for (const double degrees : {37.3, 90.0, -161.0}) {
    const double c = std::cos(degrees * kPi / 180.0);
    const double s = std::sin(degrees * kPi / 180.0);
    const Model turned = moved(
        frame(),
        [c, s](Vec2 x) {
          return Vec2{c * x[0] - s * x[1], s * x[0] + c * x[1]};
        },
        {0.0, 0.0}, false);
    expect_relative(limit_load(turned, fixed_mesh(24, 6)), reference_load(), 1e-8, "rotation");
  }
}

TEST(Invariance, UnderTranslation) {
  const Model far = moved(
      frame(), [](Vec2 x) { return x; }, {1e6 * kSize, -0.7e6 * kSize}, false);
  expect_relative(limit_load(far, fixed_mesh(24, 6)), reference_load(), 1e-8, "translation");
}

/// Deformed positions are those of the nodes where nothing moves, wherever the structure stands.
TEST(Invariance, SupportedEndsStayWhereTheirNodesAre) {
  for (const Vec2 shift : {Vec2{0.0, 0.0}, Vec2{5.0, -3.0}}) {
    const Model model = moved(
        frame(), [](Vec2 x) { return x; }, shift, false);
    Analysis analysis = path_on(fixed_mesh(8, 4), 1);
    analysis.output.states = StateOutput::critical;
    const Result result = solve_soundly(model, analysis);
    ASSERT_FALSE(result.states.empty());
    EXPECT_NEAR(result.states[0].members[0].x.front(), shift[0], 1e-9);
    EXPECT_NEAR(result.states[0].members[0].y.front(), shift[1], 1e-9);
    EXPECT_NEAR(result.states[0].members[1].x.back(), 10.0 + shift[0], 1e-9);
    EXPECT_NEAR(result.states[0].members[1].y.back(), 1.5 + shift[1], 1e-9);
  }
}

/// Both members run the other way: fractions, sweeps, sides and the roles of the ends change.
TEST(Invariance, UnderReversalOfMembers) {
  Model model = frame();
  const auto other = [](Side side) { return side == Side::left ? Side::right : Side::left; };
  for (Member& member : model.members) {
    std::swap(member.start, member.end);
    if (auto* arc = std::get_if<ArcCurve>(&member.curve)) arc->sweep_degrees *= -1.0;
  }
  model.springs[0].at.fraction = 1.0 - model.springs[0].at.fraction;
  for (Foundation& base : model.foundations) base.side = other(base.side);
  std::get<PointLoad>(model.loads[0]).at.fraction = 0.45;
  std::get<PressureLoad>(model.loads[3]).side = Side::right;
  model.monitors[0].at.fraction = 0.45;
  expect_relative(limit_load(model, fixed_mesh(24, 6)), reference_load(), 1e-8, "reversal");
}

TEST(Invariance, UnderSplittingOfAMember) {
  Model model = frame();
  // the straight member in two unequal parts; loads and bases on both
  model.nodes.push_back({"m", 6.0 + 0.3 * 4.0, 2.5 - 0.3 * 1.0});
  model.members[1].end = "m";
  model.members.push_back({"rest", "m", "c", "s", LineCurve{}, false, false});
  Foundation bilateral = model.foundations[1];
  bilateral.id = "bilateral rest";
  bilateral.member = "rest";
  model.foundations.push_back(bilateral);
  model.loads.push_back(PressureLoad{"rest", 0.1, Side::left, Pattern::proportional});
  expect_relative(limit_load(model, fixed_mesh(24, 6)), reference_load(), 1e-8, "split");
}

/// Lengths by a, forces by b: EA by b, EI by b a^2, K by b / a^2, distributed loads by b / a.
TEST(Invariance, UnderUnits) {
  for (const auto& [a, b] : {std::pair{1e6, 1.0}, std::pair{1.0, 1e-6}, std::pair{1e-6, 1e6}}) {
    const double length = a;
    const double force = b;
    Model model = moved(
        frame(),
        [length](Vec2 x) {
          return Vec2{length * x[0], length * x[1]};
        },
        {0.0, 0.0}, false);
    model.sections[0].EA *= force;
    *model.sections[0].GA *= force;
    model.sections[0].EI *= force * length * length;
    model.springs[0].stiffness *= force / length;
    for (Foundation& base : model.foundations) base.stiffness *= force / (length * length);
    for (Load& load : model.loads) {
      if (auto* point = std::get_if<PointLoad>(&load)) {
        for (double& f : point->force) f *= force / length;  // moved() has scaled them by the length
        point->moment *= force * length;
      }
      if (auto* spread = std::get_if<DistributedLoad>(&load))
        for (double& f : spread->force) f *= force / (length * length);
      if (auto* pressure = std::get_if<PressureLoad>(&load)) pressure->value *= force / length;
    }
    expect_relative(limit_load(model, fixed_mesh(24, 6)), reference_load(), 1e-8, "units");
  }
}

}  // namespace
}  // namespace snapthrough
