/// Piles with a lateral force at the head in sand and in soft clay, against collocation.
///
/// Sand: p = A Pmax tanh(k X y / (A Pmax)), A = max(0.9, 3 - 0.8 X / D), Pmax = min(C1 X + C2 D, C3 D) gamma
/// X (API RP 2GEO). Clay: p = 0.5 Pmax (y / y50)^(1/3) up to 8 y50, y50 = 2.5 eps50 D, Pmax = min((3 Su + s')
/// D + J Su X, 9 Su D) (Matlock 1970), at most 2.32 Pmax y / y50, the line to the first point of API's table.
/// Values: data/soil_piles.py.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kDiameter = 0.6;
constexpr int kPoints = 81;

/// Values of a function of depth at fractions that are close to one another near the head.
Along<double> by_depth(double length, const std::function<double(double)>& value) {
  Along<double> out;
  for (int i = 0; i < kPoints; ++i) {
    const double fraction = std::pow(static_cast<double>(i) / (kPoints - 1), 2);
    out.emplace_back(fraction, value(length * fraction));
  }
  return out;
}

double head_of_pile(double length, double force, const ReactionLaw& law, int order) {
  Model model = straight(length, 1.2e5, 1e9, "", "x");
  model.loads = {force_at(at_node("a"), 0.0, force)};
  model.foundations = {winkler("m", 0.0)};
  model.foundations[0].law = law;
  const Result result = solve_soundly(model, static_on(fixed_mesh(160, order), Geometry::linear));
  return member_of(result.states.front(), "m").v.front();
}

TEST(SoilPiles, InSand) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::tanh;
  law.stiffness.points = {{0.0, 0.0}, {1.0, 22000.0 * 15.0}};
  law.capacity.points = by_depth(15.0, [](double X) {
    const double Pmax = 9.0 * X * std::min(2.46 * X + 3.25 * kDiameter, 43.0 * kDiameter);
    return std::max(0.9, 3.0 - 0.8 * X / kDiameter) * Pmax;
  });
  expect_relative(head_of_pile(15.0, 400.0, law, 5), 0.100242358969, 1e-8, "head");
}

TEST(SoilPiles, InSoftClay) {
  const double y50 = 2.5 * 0.01 * kDiameter;
  const auto Pmax = [](double X) {
    const double Su = 15.0 + 1.5 * X;
    return std::min((3.0 * Su + 6.0 * X) * kDiameter + 0.5 * Su * X, 9.0 * Su * kDiameter);
  };
  ReactionLaw law;
  law.type = ReactionLaw::Type::power;
  law.stiffness.points = by_depth(20.0, [&](double X) { return 0.5 * std::cbrt(0.1) / 0.1 * Pmax(X) / y50; });
  law.capacity.points = by_depth(20.0, Pmax);
  law.reference = 8.0 * y50;
  law.exponent = 1.0 / 3.0;
  expect_relative(head_of_pile(20.0, 150.0, law, 5), 0.064806245779, 1e-8, "head");
}

}  // namespace
}  // namespace snapthrough
