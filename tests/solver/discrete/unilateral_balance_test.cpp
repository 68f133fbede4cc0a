/// Whether one-sided supports hold loads, against limits by hand and by dense sampling.
#include "solver/discrete/unilateral_balance.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "solver/numeric/nonnegative_least_squares.h"
#include "solver/report/escape_text.h"
#include "solver/resolve/resolved_model.h"
#include "tests/verification/cases.h"

namespace snapthrough::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Relative distance from a limit at which the answer must be right.
constexpr double kNear = 1e-6;

Spring pad(const std::string& id, Location at, double x, double y,
           Reaction reaction = Reaction::compression_only) {
  Spring spring;
  spring.id = id;
  spring.at = std::move(at);
  spring.direction = std::array{x, y};
  spring.stiffness = 1e3;
  spring.reaction = reaction;
  return spring;
}

PointLoad constant(PointLoad load) {
  load.pattern = Pattern::constant;
  return load;
}

std::optional<Escape> escape_of(const Model& model, double factor = 1.0) {
  const ResolvedModel resolved = resolve(model);
  const FreeMotions motions(resolved);
  EXPECT_FALSE(motions.empty());
  return UnilateralBalance(motions).escape(factor);
}

std::string text_of(const Model& model, double factor = 1.0) {
  const ResolvedModel resolved = resolve(model);
  const FreeMotions motions(resolved);
  const auto escape = UnilateralBalance(motions).escape(factor);
  return escape ? escape_text(resolved, motions, *escape) : "";
}

/// A wall of height h on a footing of half-width 1 whose middle is held along the ground.
Model footing(double h = 6.0) {
  Model model;
  model.nodes = {{"l", -1.0, 0.0}, {"c", 0.0, 0.0}, {"r", 1.0, 0.0}, {"top", 0.0, h}};
  model.sections = {{"s", 1e6, 1e4, {}}};
  model.members = {{"fl", "l", "c", "s", LineCurve{}, false, false},
                   {"fr", "c", "r", "s", LineCurve{}, false, false},
                   {"wall", "c", "top", "s", LineCurve{}, false, false}};
  model.supports = {support("c", "x")};
  model.foundations = {one_sided("fl", 2e4, Side::right), one_sided("fr", 2e4, Side::right)};
  model.foundations[0].id = "soil l";
  model.foundations[1].id = "soil r";
  return model;
}

/// W at the eccentricity e is held where |e| is less than the half-width.
TEST(UnilateralBalance, FootingHoldsLoadsWithinItsWidth) {
  for (const double scale : {1e-6, 1.0, 1e9}) {
    for (const double side : {-1.0, 1.0}) {
      for (const double e : {0.0, 0.5, 1.0 - kNear, 1.0 + kNear, 1.2, 50.0}) {
        Model model = footing();
        model.loads = {force_at(at_node("top"), side * 200.0 * scale * e / 6.0, -200.0 * scale)};
        const auto escape = escape_of(model);
        EXPECT_EQ(escape.has_value(), e > 1.0) << scale << " " << side * e;
        if (!escape) continue;
        EXPECT_TRUE(escape->driven);
        const std::string edge =
            side > 0.0 ? "turn clockwise about node \"r\"" : "turn counter-clockwise about node \"l\"";
        EXPECT_EQ(text_of(model),
                  "all members can " + edge +
                      ": no support resists this, and the point load at node \"top\" drives it");
      }
    }
  }
}

/// A load at the very edge counts as not held, and does no work: its margin is nothing.
TEST(UnilateralBalance, LoadAtTheEdgePressesNothingElse) {
  Model model = footing();
  model.loads = {force_at(at_node("r"), 0.0, -1.0)};
  const auto escape = escape_of(model);
  ASSERT_TRUE(escape);
  EXPECT_FALSE(escape->driven);
  EXPECT_EQ(
      text_of(model),
      "all members can turn clockwise about node \"r\": no support resists this, no load drives it, and "
      "nothing presses all members onto one-sided supports");
}

/// Whatever does no work on the free motions, or nothing at all, leaves the footing free to be lifted.
TEST(UnilateralBalance, LoadThatDoesNotPressIsNotHeld) {
  Model model = footing();
  model.loads = {force_at(at_node("c"), 5.0, 0.0)};
  const auto escape = escape_of(model);
  ASSERT_TRUE(escape);
  EXPECT_FALSE(escape->driven);
  EXPECT_FALSE(escape_of(model, 0.0)) << "unloaded it is at rest";
  model.loads = {force_at(at_node("c"), 0.0, 5.0)};
  EXPECT_NE(text_of(model).find("shift in direction (0, 1)"), std::string::npos) << text_of(model);
  model.foundations[0].reaction = model.foundations[1].reaction = Reaction::tension_only;
  EXPECT_FALSE(escape_of(model)) << "an anchor that only pulls: into its medium, but held there";
}

TEST(UnilateralBalance, GapsDoNotMatterAndZeroStiffnessIsAbsent) {
  Model model = footing();
  model.loads = {force_at(at_node("top"), 0.0, -1.0)};
  for (Foundation& soil : model.foundations) soil.gap = 0.3;
  EXPECT_FALSE(escape_of(model));
  model.foundations[1].stiffness = 0.0;
  const auto escape = escape_of(model);
  ASSERT_TRUE(escape) << "the left half alone: the load is at its edge";
  EXPECT_FALSE(escape->driven);
  model.foundations[0].range = {0.0, 0.9};
  EXPECT_TRUE(escape_of(model)->driven);
}

/// The load grows from a constant weight W: H = W b / h is the limit.
TEST(UnilateralBalance, LargestFactorOfAGrowingLoad) {
  Model model = footing();
  model.loads = {constant(force_at(at_node("top"), 0.0, -200.0)), force_at(at_node("top"), 1.0, 0.0)};
  const ResolvedModel resolved = resolve(model);
  const FreeMotions motions(resolved);
  const UnilateralBalance balance(motions);
  EXPECT_FALSE(balance.escape_at_start(1.0));
  EXPECT_FALSE(balance.escape_at_start(-1.0));
  constexpr double kLimit = 200.0 / 6.0;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(balance.escape(side * kLimit * (1.0 - kNear)));
    EXPECT_TRUE(balance.escape(side * kLimit * (1.0 + kNear)));
    EXPECT_NEAR(side * balance.largest_held(0.0, side * 1e4), kLimit, 1e-10 * kLimit);
  }
}

/// Where constant actions load another part only, the proportional ones decide about this one.
TEST(UnilateralBalance, EachPartIsJudgedByItsOwnLoads) {
  Model model = footing();
  for (const Node& node : footing().nodes) model.nodes.push_back({node.id + "2", node.x + 10.0, node.y});
  for (Member member : footing().members) {
    for (std::string* id : {&member.id, &member.start, &member.end}) *id += "2";
    model.members.push_back(member);
  }
  model.supports.push_back(support("c2", "x"));
  for (Foundation soil : footing().foundations) {
    soil.id += "2";
    soil.member += "2";
    model.foundations.push_back(soil);
  }
  for (const double e : {1.0 - kNear, 1.0 + kNear}) {
    model.loads = {constant(force_at(at_node("top"), 0.0, -1e9)), force_at(at_node("top2"), e / 6.0, -1.0)};
    const ResolvedModel resolved = resolve(model);
    const FreeMotions motions(resolved);
    ASSERT_EQ(motions.motions().cols(), 4);
    const UnilateralBalance balance(motions);
    EXPECT_EQ(balance.escape(1.0).has_value(), e > 1.0);
    EXPECT_EQ(balance.escape_at_start(1.0).has_value(), e > 1.0);
    EXPECT_TRUE(balance.escape_at_start(-1.0)) << "lifts the second footing";
    EXPECT_FALSE(balance.escape(0.0));
    if (e < 1.0) continue;
    EXPECT_EQ(
        text_of(model),
        "members \"fl2\", \"fr2\" and \"wall2\" can turn clockwise about node \"r2\": no support resists "
        "this, and the point load at node \"top2\" drives it");
  }
}

/// A load through the vertex of a bed whose two sides rise at an angle a: held within that angle of the
/// vertical.
TEST(UnilateralBalance, BedOfTwoSidesHoldsWithinItsInclination) {
  for (const double a : {5.0, 30.0, 60.0}) {
    const double rise = a * kPi / 180.0;
    Model model;
    model.nodes = {
        {"v", 0.0, 0.0}, {"r", std::cos(rise), std::sin(rise)}, {"l", -std::cos(rise), std::sin(rise)}};
    model.sections = {{"s", 1e6, 1e3, {}}};
    model.members = {{"right", "v", "r", "s", LineCurve{}, false, false},
                     {"left", "l", "v", "s", LineCurve{}, false, false}};
    model.foundations = {one_sided("right", 1e3, Side::right), one_sided("left", 1e3, Side::right)};
    for (const double turn : {-1.0 - kNear, -1.0 + kNear, 0.0, 0.7, 1.0 - kNear, 1.0 + kNear}) {
      model.loads = {force_at(at_node("v"), std::sin(turn * rise), -std::cos(turn * rise))};
      EXPECT_EQ(escape_of(model).has_value(), std::abs(turn) > 1.0) << a << " " << turn;
    }
  }
}

/// A portal on pads turns over one foot where H h > W b / 2.
TEST(UnilateralBalance, PortalOnPadsTurnsOverItsFoot) {
  constexpr double kLimit = 100.0 * 3.0 / 2.0 / 6.0;
  for (const double H : {kLimit * (1.0 - kNear), kLimit * (1.0 + kNear), -kLimit * (1.0 + kNear)}) {
    Model model;
    model.nodes = {{"A", 0.0, 0.0}, {"B", 0.0, 6.0}, {"C", 3.0, 6.0}, {"D", 3.0, 0.0}};
    model.sections = {{"s", 1e6, 1e3, {}}};
    model.members = {{"1", "A", "B", "s", LineCurve{}, false, false},
                     {"2", "B", "C", "s", LineCurve{}, false, false},
                     {"3", "C", "D", "s", LineCurve{}, false, false}};
    model.supports = {support("A", "x"), support("D", "x")};
    model.springs = {pad("pa", at_node("A"), 0.0, -1.0), pad("pd", at_node("D"), 0.0, -1.0)};
    model.loads = {force_at(at_node("B"), H, -50.0), force_at(at_node("C"), 0.0, -50.0)};
    EXPECT_EQ(escape_of(model).has_value(), std::abs(H) > kLimit) << H;
    if (H > kLimit) {
      EXPECT_NE(text_of(model).find("turn clockwise about node \"D\""), std::string::npos);
    }
  }
}

/// An arc in a round bed over +-a: forces through its centre are held within a of the vertical; its turn
/// about the centre is nobody's.
TEST(UnilateralBalance, ArcInARoundBed) {
  for (const double a : {10.0, 60.0, 85.0}) {
    const double half = a * kPi / 180.0;
    Model model;
    model.nodes = {{"a", -2.0 * std::sin(half), -2.0 * std::cos(half)},
                   {"b", 2.0 * std::sin(half), -2.0 * std::cos(half)}};
    model.sections = {{"s", 1e6, 1e3, {}}};
    model.members = {{"m", "a", "b", "s", ArcCurve{2.0 * a}, false, false}};
    model.foundations = {one_sided("m", 1e3, Side::right)};
    for (const double turn : {-1.0 - kNear, -1.0 + kNear, 0.0, 1.0 - kNear, 1.0 + kNear}) {
      const double x = std::sin(turn * half);
      model.loads = {force_at(at_member("m", 0.5), x, -std::cos(turn * half), -2.0 * x)};
      ASSERT_TRUE(check(model, static_on({}, Geometry::linear)).empty());
      EXPECT_EQ(escape_of(model).has_value(), std::abs(turn) > 1.0) << a << " " << turn;
    }
    model.foundations[0].range = {0.0, 0.5};
    model.loads = {force_at(at_member("m", 0.25), std::sin(-0.5 * half), -std::cos(-0.5 * half))};
    EXPECT_FALSE(escape_of(model)) << "half the bed holds what goes through it";
  }
}

/// A closed ring presses on its hole all round: it is held with any resultant, and without.
TEST(UnilateralBalance, RingInAHole) {
  Model model;
  model.nodes = {{"bottom", 0.0, -1.0}, {"top", 0.0, 1.0}};
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.members = {{"right", "bottom", "top", "s", ArcCurve{180.0}, false, false},
                   {"left", "top", "bottom", "s", ArcCurve{180.0}, false, false}};
  model.foundations = {one_sided("right", 1e3, Side::right), one_sided("left", 1e3, Side::right)};
  model.loads = {PressureLoad{"right", 1.0, Side::right, Pattern::proportional},
                 PressureLoad{"left", 1.0, Side::right, Pattern::proportional}};
  EXPECT_FALSE(escape_of(model));
  model.loads.push_back(force_at(at_node("top"), 0.0, 3.0));
  EXPECT_FALSE(escape_of(model));
  model.foundations.pop_back();
  EXPECT_TRUE(escape_of(model)) << "half the hole: the force is along its edge";
}

/// Rows of a curved support at many places, for a rigid body with all three motions free.
MatrixXd dense_rows(const Model& model, Side side, std::array<double, 2> range, int places) {
  const ResolvedModel resolved = resolve(model);
  const RigidParts parts(resolved);
  MatrixXd rows(3, places + 1);
  const double sign = side == Side::left ? 1.0 : -1.0;
  for (int i = 0; i <= places; ++i) {
    const AxisPoint at = parts.place(0, range[0] + (range[1] - range[0]) * i / places);
    const double x = -sign * std::sin(at.angle);
    const double y = sign * std::cos(at.angle);
    rows.col(i) << x, y, at.x * y - at.y * x;
  }
  return rows.colwise().normalized();
}

/// A parabola and a wavy member on their beds, with forces of all directions: as a cone of 4 000 rows says;
/// what escapes enters none of them.
TEST(UnilateralBalance, CurvedBedsAreAsDenseRowsSay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int held = 0;
  int refused = 0;
  for (int trial = 0; trial < 120; ++trial) {
    Model model = straight(2.0, 1.0, 1e6, "", "");
    if (trial % 2 == 0)
      model.members[0].curve = ParabolaCurve{0.8 * unit(random)};
    else
      model.members[0].curve = SineCurve{0.1 * unit(random), 1 + trial % 5};
    const Side side = trial % 3 == 0 ? Side::left : Side::right;
    model.foundations = {one_sided("m", 1e3, side)};
    model.foundations[0].range = {0.1, 0.1 + 0.9 * std::abs(unit(random))};
    const MatrixXd rows = dense_rows(model, side, model.foundations[0].range, 4000);
    const double length = RigidParts(resolve(model)).length();
    Vector3d force(unit(random), unit(random), unit(random));
    if (trial % 4 < 2) {  // what some places press with
      force.setZero();
      for (int i = 0; i < 6; ++i) force += (0.1 + std::abs(unit(random))) * rows.col(800 * i);
    }
    model.loads = {force_at(at_node("a"), force[0], force[1], force[2] * length)};
    const ResolvedModel resolved = resolve(model);
    const FreeMotions motions(resolved);
    ASSERT_EQ(motions.motions().cols(), 3);
    const double outside = nonnegative_least_squares(rows, force.normalized()).residual.norm();
    const auto escape = UnilateralBalance(motions).escape(1.0);
    if (outside < 1e-13)
      ++held;
    else if (outside > 1e-5)  // what 4 000 places leave of a curve
      ++refused;
    else
      continue;
    ASSERT_EQ(escape.has_value(), outside > 1e-5) << trial << " " << outside;
    if (!escape) continue;
    const RigidParts& parts = motions.parts();
    for (int i = 0; i <= 100; ++i) {
      const Foundation& bed = model.foundations[0];
      const AxisPoint at = parts.place(0, bed.range[0] + (bed.range[1] - bed.range[0]) * i / 100.0);
      double into = 0.0;
      for (const auto& [unknown, weight] :
           parts.displacement(0, {at.x, at.y}, direction_of(bed).at(at.angle)))
        into += weight * escape->motion[unknown];
      EXPECT_LT(into, 1e-7) << trial;
    }
  }
  EXPECT_GT(held, 10);
  EXPECT_GT(refused, 30);
}

/// A beam that hangs on two props that only pull.
TEST(UnilateralBalance, PropsThatOnlyPull) {
  for (const double x : {-0.5, 0.0 + kNear, 1.0, 2.0 - kNear, 2.0 + kNear}) {
    Model model = straight(2.0, 1e3, 1e6, "x", "");
    model.springs = {pad("pa", at_node("a"), 0.0, 1.0, Reaction::tension_only),
                     pad("pb", at_node("b"), 0.0, 1.0, Reaction::tension_only)};
    model.springs[0].direction = std::array{0.0, 1.0};
    PointLoad load = force_at(at_node("a"), 0.0, -3.0, -3.0 * x);
    model.loads = {load};
    EXPECT_EQ(escape_of(model).has_value(), x < 0.0 || x > 2.0) << x;
    load.force[1] = 3.0;
    load.moment = 3.0;
    model.loads = {load};
    EXPECT_TRUE(escape_of(model)) << "pushed up";
  }
}

/// Two beams joined by a hinge on three pads: each node needs its own pressure.
TEST(UnilateralBalance, BeamsJoinedByAHinge) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}, {"c", 2.0, 0.0}};
  model.sections = {{"s", 1e6, 1e3, {}}};
  model.members = {{"one", "a", "b", "s", LineCurve{}, false, false},
                   {"two", "b", "c", "s", LineCurve{}, true, false}};
  model.supports = {support("a", "x")};
  for (const char* node : {"a", "b", "c"})
    model.springs.push_back(pad(std::string("pad ") + node, at_node(node), 0.0, -1.0));
  const auto load_on = [&model](std::vector<Load> loads) { model.loads = std::move(loads); };
  load_on({force_at(at_member("one", 0.5), 0.0, -1.0), force_at(at_member("two", 0.5), 0.0, -1.0)});
  EXPECT_FALSE(escape_of(model));
  load_on({force_at(at_member("one", 0.5), 0.0, -1.0)});
  ASSERT_TRUE(escape_of(model));
  EXPECT_FALSE(escape_of(model)->driven);
  EXPECT_NE(text_of(model).find("member \"two\""), std::string::npos) << text_of(model);
  EXPECT_NE(text_of(model).find("turn counter-clockwise about node \"b\""), std::string::npos)
      << text_of(model);
  load_on({force_at(at_member("one", 0.5), 0.0, -1.0), force_at(at_node("b"), 0.0, -5.0),
           force_at(at_node("c"), 0.0, 1e-3)});
  ASSERT_TRUE(escape_of(model));
  EXPECT_TRUE(escape_of(model)->driven);
  EXPECT_NE(text_of(model).find("the point load at node \"c\""), std::string::npos) << text_of(model);
}

/// A bar on a pin with a one-sided rotation spring.
TEST(UnilateralBalance, RotationSpringOfOneSide) {
  for (const Reaction reaction : {Reaction::compression_only, Reaction::tension_only}) {
    const double sense = reaction == Reaction::compression_only ? 1.0 : -1.0;
    for (const bool at_member_end : {false, true}) {
      Model model = straight(1.0, 1.0, 1e6, "xy", "");
      Spring spring = pad("stop", at_member_end ? at_member("m", 0.0) : at_node("a"), 0.0, 0.0, reaction);
      spring.direction.reset();
      model.springs = {spring};
      model.loads = {force_at(at_node("b"), 0.0, sense)};
      EXPECT_FALSE(escape_of(model)) << "counter-clockwise, into the spring";
      model.loads = {force_at(at_node("b"), 0.0, -sense)};
      EXPECT_TRUE(escape_of(model));
      model.loads = {force_at(at_node("b"), 1.0, 0.0)};
      EXPECT_FALSE(escape_of(model)->driven);
    }
  }
}

/// Pressure acts on the undeformed geometry: from above it presses, from below it lifts.
TEST(UnilateralBalance, PressureOnABeamOnItsBed) {
  Model model = straight(2.0, 1e3, 1e6, "x", "");
  model.foundations = {one_sided("m", 1e3, Side::right)};
  model.loads = {PressureLoad{"m", 4.0, Side::left, Pattern::proportional}};
  EXPECT_FALSE(escape_of(model));
  EXPECT_EQ(text_of(model, -1.0),
            "the member can shift in direction (0, 1): no support resists this, and the pressure on member "
            "\"m\" drives it");
}

/// A fixed direction of a bed that is not normal to its member.
TEST(UnilateralBalance, BedInAFixedDirection) {
  Model model = straight(2.0, 1e3, 1e6, "", "");
  model.foundations = {one_sided("m", 1e3, Side::right)};
  model.foundations[0].direction = std::array{1.0, -1.0};
  model.loads = {force_at(at_member("m", 0.5), 3.0, -3.0)};
  EXPECT_FALSE(escape_of(model));
  EXPECT_TRUE(escape_of(model, -1.0));
}

/// A model whose supports of both sides hold it has no free motions, and nothing is asked.
TEST(UnilateralBalance, NothingIsAskedWithoutFreeMotions) {
  Model model = straight(1.0, 1.0, 1e6, "xy", "y");
  model.foundations = {one_sided("m", 10.0, Side::left)};
  model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
  const ResolvedModel resolved = resolve(model);
  const FreeMotions motions(resolved);
  EXPECT_TRUE(motions.empty());
  EXPECT_FALSE(UnilateralBalance(motions).escape(1.0));
}

}  // namespace
}  // namespace snapthrough::testing
