/// Limit loads of supports with a capacity, against limits by hand.
#include "solver/discrete/capacity_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "solver/resolve/resolved_model.h"
#include "tests/verification/cases.h"

namespace snapthrough::testing {
namespace {

/// The search stops where the residual of least squares is rounding, about 1e-8 of all capacities, of which
/// the least load here calls up a twentieth; the motion is then exact to the square root, the limit to 2e-6.
constexpr double kNear = 2e-6;

ReactionLaw law_with(ReactionLaw::Type type, double stiffness, double capacity) {
  ReactionLaw law;
  law.type = type;
  law.stiffness.constant = stiffness;
  law.capacity.constant = capacity;
  law.reference = 0.1;
  law.points = {{{capacity / stiffness, capacity}}};
  return law;
}

/// A member of a length, upright, on a soil with a law, pushed at its head.
Model pile(double length, const ReactionLaw& law) {
  Model model = straight(length, 1e4, 1e7, "", "");
  model.nodes = {{"a", 0, 0}, {"b", 0, -length}};
  model.supports = {support("b", "y")};
  model.foundations = {winkler("m", 0.0)};
  model.foundations[0].law = law;
  model.loads = {force_at(at_node("a"), 1.0, 0.0)};
  return model;
}

double limit_of(const Model& model, double direction = 1.0) {
  const auto ends = capacity_ends(resolve(model));
  if (!ends) return std::numeric_limits<double>::infinity();
  const auto& end = ends->of(direction);
  return end ? end->factor : std::numeric_limits<double>::infinity();
}

/// Soil of the strength p turns its sense at the depth z: equilibrium of forces and moments about the head
/// gives H = p (2 z - L) and 2 z^2 = L^2, hence H = (sqrt 2 - 1) p L.
TEST(CapacityBalance, ShortPileTurnsAboutAPoint) {
  for (const auto type : {ReactionLaw::Type::tanh, ReactionLaw::Type::hyperbolic, ReactionLaw::Type::power,
                          ReactionLaw::Type::table}) {
    const Model model = pile(4.0, law_with(type, 5000.0, 50.0));
    expect_relative(limit_of(model), (std::sqrt(2.0) - 1.0) * 50.0 * 4.0, kNear, "limit");
    expect_relative(limit_of(model, -1.0), -(std::sqrt(2.0) - 1.0) * 50.0 * 4.0, kNear, "other sense");
    const auto ends = capacity_ends(resolve(model));
    EXPECT_EQ(ends->growing->supports, std::vector<std::string>{"soil"});
  }
}

/// A strength that grows from zero at the head as p z / L: H = p (2 z^2 - L^2) / (2 L) and 2 z^3 = L^3.
TEST(CapacityBalance, StrengthMayGrowWithDepth) {
  Model model = pile(4.0, law_with(ReactionLaw::Type::tanh, 5000.0, 50.0));
  model.foundations[0].law->capacity = AlongMember({{0.0, 0.0}, {1.0, 50.0}});
  const double z = 4.0 / std::cbrt(2.0);
  expect_relative(limit_of(model), 50.0 * (2.0 * z * z - 16.0) / 8.0, kNear, "limit");
}

/// One-sided soil of the strength c under a width 2 b holds a force at the distance e from the middle up to
/// 2 c (b - e): it presses on the width 2 (b - e) about the force.
TEST(CapacityBalance, FootingUnderAnEccentricForce) {
  for (const double e : {0.0, 0.3, 0.9}) {
    Model model = straight(2.0, 1e4, 1e7, "x", "");
    model.foundations = {one_sided("m", 0.0, Side::right)};
    model.foundations[0].law = law_with(ReactionLaw::Type::table, 1e4, 40.0);
    model.loads = {force_at(at_member("m", 0.5 * (1.0 + e)), 0.0, -1.0)};
    expect_relative(limit_of(model), 2.0 * 40.0 * (1.0 - e), kNear, "limit");
  }
}

/// A weight W at the middle of a block of the width 2 b on linear one-sided soil, which has no capacity, and
/// a horizontal force at the height h: it slides at the capacity C of the spring, or turns over at W b / h.
TEST(CapacityBalance, WhatSlidesOrTurnsOverFirst) {
  for (const double h : {0.5, 4.0}) {
    Model model;
    model.nodes = {{"l", -1.5, 0}, {"c", 0, 0}, {"r", 1.5, 0}, {"t", 0, h}};
    model.sections = {{"s", 1e9, 1e9, {}}};
    model.members = {{"lc", "l", "c", "s", LineCurve{}, false, false},
                     {"cr", "c", "r", "s", LineCurve{}, false, false},
                     {"ct", "c", "t", "s", LineCurve{}, false, false}};
    model.foundations = {one_sided("lc", 3e4, Side::right), one_sided("cr", 3e4, Side::right)};
    Spring slide;
    slide.id = "slide";
    slide.at = at_node("c");
    slide.direction = {1.0, 0.0};
    slide.law = law_with(ReactionLaw::Type::tanh, 4e4, 400.0);
    model.springs = {slide};
    PointLoad weight = force_at(at_node("t"), 0.0, -600.0);
    weight.pattern = Pattern::constant;
    model.loads = {weight, force_at(at_node("t"), 1.0, 0.0)};
    expect_relative(limit_of(model), std::min(400.0, 600.0 * 1.5 / h), kNear, "limit");
  }
}

/// Constant friction is used up by a constant load before anything grows; what other supports hold has no
/// limit.
TEST(CapacityBalance, ConstantActionsAndOtherSupports) {
  Model model = pile(4.0, law_with(ReactionLaw::Type::tanh, 5000.0, 50.0));
  PointLoad constant = force_at(at_node("a"), 100.0, 0.0);
  constant.pattern = Pattern::constant;
  model.loads.push_back(constant);
  const auto ends = capacity_ends(resolve(model));
  ASSERT_TRUE(ends && ends->constant);
  expect_relative(ends->constant->factor, (std::sqrt(2.0) - 1.0) * 2.0, kNear, "share of the constant load");
  model.supports.push_back(support("a", "xr"));
  EXPECT_EQ(capacity_ends(resolve(model)), nullptr);
}

}  // namespace
}  // namespace snapthrough::testing
