/// Observed orders of convergence of foundations with laws, on fixed meshes: the displacement of a beam's
/// end.
///
/// Where the law is smooth at all displacements that occur the order is 2p. Contact ends and kinks of the law
/// lie inside elements. At a jump of the law's slope EI w'''' has a kink: no polynomial comes nearer to w''
/// than h^3. The slope of the law is the stiffness in the equation of the error, whose solution no polynomial
/// approaches nearer than h^2 there. Their product and the element's share h make the order min(2p, 6) of
/// displacements; that of critical loads is min(2p, 7), see order_test.cpp. Where a kink lies in its element
/// changes the error from mesh to mesh: the slope is that of the largest error of a mesh and all finer ones.
///
/// The finest mesh is the reference for the errors. The values of piles are also those of
/// tests/verification/data/piles.py (collocation).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/convergence/fitted_slope.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Type = ReactionLaw::Type;

/// Laws of about one stiffness. The kinks of the power are at w = 0.035 and 0.8, those of the table at its
/// points.
ReactionLaw law_of(Type type) {
  ReactionLaw law;
  law.type = type;
  law.stiffness.constant = 300.0;
  law.capacity.constant = 30.0;
  law.reference = 0.8;
  law.exponent = 1.0 / 3.0;
  law.points = {{0.02, 5.0}, {0.05, 10.0}, {0.2, 18.0}, {0.6, 20.0}};
  return law;
}

/// A beam of length 1 with a free end "a" at which `force` acts across the beam.
Model beam_on(const ReactionLaw& law, Reaction reaction, const std::string& end, double force) {
  Model model = straight(1.0, 0.1, 1e4, "", end);
  model.loads = {force_at(at_node("a"), 0.0, force)};
  model.foundations = {winkler("m", 0.0)};
  model.foundations[0].law = law;
  model.foundations[0].reaction = reaction;
  return model;
}

double end_of(const Model& model, int elements, int order) {
  const Result result = solve_soundly(model, static_on(fixed_mesh(elements, order), Geometry::linear));
  return result.states.empty() ? std::nan("") : member_of(result.states.front(), "m").v.front();
}

/// Slope of the largest error of a mesh and all finer ones, down to the rounding of the reference.
struct Slope {
  double value = 0.0;
  std::size_t meshes = 0;
  double range = 0.0;  ///< elements of the finest mesh over those of the coarsest
  bool reached_rounding = false;
};
Slope slope_of(const Model& model, int order, double exact) {
  constexpr double kRounding = 1e-12;
  std::vector<int> n{8, 9, 10, 11, 12, 14, 16, 20, 24, 28, 32, 40, 48, 64};
  if (order > 3) n.insert(n.begin(), {4, 5, 6, 7});
  std::vector<double> error;
  for (const int elements : n) error.push_back(std::abs(end_of(model, elements, order) / exact - 1.0));
  for (std::size_t i = n.size() - 1; i-- > 0;) error[i] = std::max(error[i], error[i + 1]);
  while (!error.empty() && error.back() < kRounding) error.pop_back();
  const bool reached_rounding = error.size() < n.size();
  n.resize(error.size());
  if (n.size() < 2) return {0.0, n.size(), 1.0, reached_rounding};
  return {fitted_order(n, error), n.size(), static_cast<double>(n.back()) / n.front(), reached_rounding};
}

class LawOrder : public ::testing::TestWithParam<std::tuple<Type, Reaction>> {
 protected:
  [[nodiscard]] ReactionLaw law() const { return law_of(std::get<0>(GetParam())); }
  [[nodiscard]] Reaction reaction() const { return std::get<1>(GetParam()); }
  /// Expects the order of theory at each order of elements, where the errors leave the rounding over enough
  /// meshes.
  /// @param most order that kinks allow
  /// @param range least ratio of the numbers of elements of the finest and the coarsest mesh of a fit
  static void expect_orders(const Model& model, double most, double range) {
    constexpr std::size_t kLeastMeshes = 4;
    const double exact = end_of(model, 150, 8);
    for (int p = 1; p <= 8; ++p) {
      const Slope slope = slope_of(model, p, exact);
      if (slope.meshes < kLeastMeshes || slope.range < range) {
        EXPECT_GT(p, 3);
        EXPECT_TRUE(slope.reached_rounding) << "order " << p;
        continue;
      }
      EXPECT_GT(slope.value, std::min(2.0 * p, most) - (p <= 2 ? 0.4 : 1.0)) << "order " << p;
    }
  }
};

/// An even load and a small force at one end press the beam in everywhere, between the kinks of its law.
TEST_P(LawOrder, WhereTheLawIsSmooth) {
  Model model = beam_on(law(), reaction(), "x", 0.3);
  model.loads.emplace_back(DistributedLoad{"m", {0.0, 12.0}});
  expect_orders(model, 16.0, 2.0);
}

/// The far part of a pile whose tip is hinged moves to the other side.
TEST_P(LawOrder, AcrossKinksOfTheLawAndEndsOfContact) {
  expect_orders(beam_on(law(), reaction(), "xy", 2.5), 6.0, 8.0);
}

TEST(LawOrderReference, IsCollocation) {
  struct Case {
    Type type;
    double both, one;  ///< data/piles.py
  };
  for (const Case& of :
       {Case{Type::linear, 0.087217815027, 0.097342044650}, Case{Type::tanh, 0.097713261865, 0.111518978100},
        Case{Type::hyperbolic, 0.144808641577, 0.164101312666},
        Case{Type::power, 0.137782102333, 0.161291338206}}) {
    SCOPED_TRACE(static_cast<int>(of.type));
    for (const auto& [reaction, value] :
         {std::pair{Reaction::bilateral, of.both}, std::pair{Reaction::compression_only, of.one}})
      expect_relative(end_of(beam_on(law_of(of.type), reaction, "xy", 2.5), 150, 8), value, 1e-11, "end");
  }
}

INSTANTIATE_TEST_SUITE_P(AllLaws, LawOrder,
                         ::testing::Combine(::testing::Values(Type::linear, Type::tanh, Type::hyperbolic,
                                                              Type::power, Type::table),
                                            ::testing::Values(Reaction::bilateral,
                                                              Reaction::compression_only)));

}  // namespace
}  // namespace snapthrough
