/// Supports with laws that are not linear, against closed forms and collocation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;
using Type = ReactionLaw::Type;

ReactionLaw law_with(Type type, double stiffness, double capacity) {
  ReactionLaw law;
  law.type = type;
  law.stiffness.constant = stiffness;
  law.capacity.constant = capacity;
  law.reference = 0.8;
  law.exponent = 1.0 / 3.0;
  return law;
}

/// Largest value of f on [from, to], which has one maximum there, by golden sections.
double largest(const std::function<double(double)>& f, double from, double to) {
  const double share = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 200; ++i) {
    const double a = to - share * (to - from);
    const double b = from + share * (to - from);
    (f(a) < f(b) ? from : to) = f(a) < f(b) ? a : b;
  }
  return f(0.5 * (from + to));
}

/// Moments about the foot: M(t) = P (sin t + h cos t) with the load P down and h P sideways. The limit point
/// is the maximum of P.
TEST(Law, LimitPointOfABarOnASpring) {
  constexpr double k = 10.0;
  constexpr double C = 1.0;
  constexpr double h = 0.05;
  struct Case {
    Type type;
    std::function<double(double)> moment;
  };
  const Case cases[] = {
      {Type::tanh, [](double t) { return C * std::tanh(k * t / C); }},
      {Type::hyperbolic, [](double t) { return t / (1.0 / k + t / C); }},
      {Type::power,
       [](double t) {
         return std::min({k * t, C * std::cbrt(t / 0.8), C});
       }},
  };
  for (const Case& one : cases) {
    Model model = bar_on_spring(law_with(one.type, k, C));
    model.loads = {force_at(at_node("head"), h, -1.0)};
    Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-9));
    const Result result = solve_soundly(model, analysis);
    const double expected =
        largest([&](double t) { return one.moment(t) / (std::sin(t) + h * std::cos(t)); }, 0.0, 1.0);
    ASSERT_TRUE(result.summary.critical_load_factor);
    EXPECT_EQ(result.summary.critical_type, CriticalType::limit_max);
    // bending of the bar: P / EI = 5e-11
    expect_relative(*result.summary.critical_load_factor, expected, 1e-9, "limit point");
  }
}

/// A moment M turns the bar to M = C tanh(k t / C), where the spring has the stiffness c = k (1 - M^2 / C^2).
/// A bar of bending stiffness EI on that spring buckles at P = EI b^2 with b tan b = c / EI.
TEST(Law, BucklingTakesTheTangentAtTheReferenceState) {
  constexpr double k = 10.0;
  constexpr double EI = 1e3;
  for (const double M : {0.0, 0.3, 0.8}) {
    Model model = bar_on_spring(law_with(Type::tanh, k, 1.0));
    model.sections = {{"s", 1e9, EI, {}}};
    PointLoad moment = force_at(at_node("foot"), 0.0, 0.0, M);
    moment.pattern = Pattern::constant;
    model.loads = {force_at(at_node("head"), 0.0, -1.0)};
    if (M > 0.0) model.loads.push_back(moment);
    const Result result = solve_soundly(model, buckling_on(accurate(1e-9)));
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 100; ++i) {
      const double b = 0.5 * (low + high);
      (b * std::tan(b) < k * (1.0 - M * M) / EI ? low : high) = b;
    }
    ASSERT_TRUE(result.summary.critical_load_factor);
    expect_relative(*result.summary.critical_load_factor, EI * low * low, 1e-9, "buckling load");
  }
}

/// A lateral load h P of the moment h exceeds the capacity of the spring at the load factor C / h: linearised
/// buckling has no state to take a tangent at.
TEST(Law, BucklingNeedsAReferenceLoadThatLawsCarry) {
  constexpr double C = 1.0;
  for (const Type type : {Type::tanh, Type::hyperbolic, Type::power}) {
    for (const double h : {0.5, 2.0, 4.0}) {
      Model model = bar_on_spring(law_with(type, 10.0, C));
      model.loads = {force_at(at_node("head"), h, -1.0)};
      const Result result = solve(model, buckling_on(fixed_mesh(1, 2)));
      ASSERT_EQ(result.failure.has_value(), h > C) << h;
      EXPECT_EQ(result.summary.critical_load_factor.has_value(), h < C);
      if (!result.failure) continue;
      EXPECT_EQ(result.failure->code, "not_held");
      const std::string& text = result.failure->detail;
      EXPECT_NEAR(std::stod(text.substr(text.rfind(' ') + 1)), C / h, 2e-3) << text;
    }
  }
}

/// The column of Koiter.OfAColumnOnABaseIsTheClosedForm on p = C tanh(K w / C) = K w - K^3 w^3 / (3 C^2) +
/// ..: the energy of half a wave has - K^3 s^4 / (8 C^2) more, and b is less by K^3 / (4 C^2 k^2 P).
TEST(Law, SofteningFoundationLowersThePostBucklingLoad) {
  constexpr double L = 3.0;
  constexpr double EI = 5.0;
  constexpr double K = 1.0;
  constexpr double k = kPi / L;
  for (const double capacity : {0.3, 0.6, 10.0}) {
    Model model = straight(L, EI, 1e13, "xy", "y");
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    model.foundations = {winkler("m", 0.0)};
    model.foundations[0].law = law_with(Type::tanh, K, capacity);
    Analysis analysis = analysis_of(AnalysisType::critical, accurate(1e-10));
    analysis.output.states = StateOutput::critical;
    analysis.koiter = true;
    const Result result = solve_soundly(model, analysis);
    ASSERT_FALSE(result.critical_points.empty());
    const CriticalPoint& point = result.critical_points.front();
    const double load = EI * k * k + K / (k * k);
    expect_relative(point.load_factor, load, 1e-8, "bifurcation");
    const double expected =
        k * k * (0.5 * EI * k * k / load - 0.375) - K * K * K / (4.0 * capacity * capacity * k * k * load);
    ASSERT_TRUE(point.koiter && point.koiter->b);
    EXPECT_NEAR(*point.koiter->b, expected, 1e-5 * std::abs(expected)) << capacity;
  }
}

/// A pile of length 1 and bending stiffness 1 with a force 6 at its head and a free tip.
double head_of_pile(const ReactionLaw& law, int elements, int order) {
  Model model = straight(1.0, 1.0, 1e4, "", "x");
  model.loads = {force_at(at_node("a"), 0.0, 6.0)};
  model.foundations = {winkler("m", 0.0)};
  model.foundations[0].law = law;
  const Result result = solve_soundly(model, static_on(fixed_mesh(elements, order), Geometry::linear));
  return member_of(result.states.front(), "m").v.front();
}

/// Values of tests/verification/data/piles.py, and the order of convergence of linear foundations.
TEST(Law, PilesAreThoseOfCollocation) {
  ReactionLaw deeper = law_with(Type::tanh, 0.0, 0.0);
  deeper.stiffness.points = {{0.0, 200.0}, {1.0, 5000.0}};
  deeper.capacity.points = {{0.0, 5.0}, {1.0, 40.0}};
  ReactionLaw growing;
  growing.stiffness.points = {{0.0, 100.0}, {1.0, 9100.0}};
  struct Case {
    ReactionLaw law;
    double head;
  };
  for (const Case& one :
       {Case{deeper, 0.417260651084}, Case{law_with(Type::hyperbolic, 3000.0, 20.0), 0.160736229467},
        Case{growing, 0.056672312644}}) {
    expect_relative(head_of_pile(one.law, 32, 4), one.head, 2e-11, "head");
    const double coarse = std::abs(head_of_pile(one.law, 16, 2) / one.head - 1.0);
    const double fine = std::abs(head_of_pile(one.law, 32, 2) / one.head - 1.0);
    EXPECT_GT(std::log2(coarse / fine), 3.7)
        << "order 2 converges with the fourth power of the element length";
  }
}

/// A long pile in soil whose stiffness grows from zero as n s: head displacement 2.435 H T^3 / EI with T =
/// (EI / n)^(1/5) (Reese and Matlock 1956).
TEST(Law, LongPileInSoilThatStiffensWithDepth) {
  ReactionLaw growing;
  growing.stiffness.points = {{0.0, 0.0}, {1.0, 1e5}};
  const double T = std::pow(1e-5, 0.2);
  EXPECT_NEAR(head_of_pile(growing, 32, 4) / (6.0 * T * T * T), 2.42917872, 2e-8);
}

/// Friction t = k u along a bar, free at its far end: u(0) = F / (sqrt(k EA) tanh(L sqrt(k / EA))); with t =
/// C tanh(k u / C) the first integral EA u'^2 / 2 = C^2 / k log cosh(k u / C) + constant holds.
TEST(Law, FrictionAlongABar) {
  constexpr double EA = 50.0;
  constexpr double k = 200.0;
  constexpr double F = 3.0;
  Model model = straight(1.0, 1.0, EA, "y", "y");
  model.loads = {force_at(at_node("a"), F, 0.0)};
  model.foundations = {winkler("m", k)};
  model.foundations[0].component = FoundationComponent::tangent;
  const auto ends = [&model] {
    const Result result = solve_soundly(model, static_on(fixed_mesh(16, 4), Geometry::linear));
    const MemberState& state = member_of(result.states.front(), "m");
    return std::array{state.u.front(), state.u.back()};
  };
  expect_relative(ends()[0], F / (std::sqrt(k * EA) * std::tanh(std::sqrt(k / EA))), 1e-10,
                  "linear friction");
  constexpr double C = 3.5;
  model.foundations[0].law = law_with(Type::tanh, k, C);
  const auto [near, far] = ends();
  const auto energy = [](double u) { return C * C / k * std::log(std::cosh(k * u / C)); };
  expect_relative(energy(near) - energy(far), F * F / (2.0 * EA), 1e-9, "first integral");
}

/// A beam sinks into soil whose table rises twentyfold within 1e-10, at 0.01. Nothing can sink farther than
/// the table's last point where its load stays below the last reaction, and a beam alone would sink by 5 q
/// L^4 / 384 EI = 0.028. Soil that reacts in both senses acts as soil that pushes where the beam only sinks.
TEST(Law, OfATableWithANearlyVerticalPartIsFollowed) {
  Model model = straight(6.0, 3000.0, 2e6, "xy", "y");
  Foundation soil = one_sided("m", 0.0, Side::right);
  soil.law = ReactionLaw{};
  soil.law->type = Type::table;
  soil.law->points = {{0.002, 1.0}, {0.01, 1.5}, {0.0100000001, 30.0}};
  model.loads = {DistributedLoad{"m", {0.0, -5.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const auto middle = [&model](const Foundation& foundation) {
    model.foundations = {foundation};
    const Result result = solve_soundly(model, static_on(fixed_mesh(16, 4), Geometry::nonlinear));
    if (result.states.empty()) return 0.0;
    const std::vector<double>& v = member_of(result.states.front(), "m").v;
    return v[v.size() / 2];
  };
  const double pushed = middle(soil);
  soil.reaction = Reaction::bilateral;
  const double held = middle(soil);
  EXPECT_LT(held, -0.01);
  EXPECT_GT(held, -0.0105);
  expect_relative(held, pushed, 1e-7, "deflection");
}

}  // namespace
}  // namespace snapthrough
