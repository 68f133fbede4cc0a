/// Natural frequencies of beams, rings and columns under load.
///
/// Sources: characteristic equations of the slender beam (Timoshenko, Vibration Problems in Engineering, ch.
/// 5); Hoppe's ring, omega^2 = EI n^2 (n^2 - 1)^2 / (m R^4 (n^2 + 1)); omega^2 of a pinned column falls
/// linearly with its load.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/convergence/fitted_slope.h"
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kLength = 2.0;
constexpr double kEI = 3.0;
constexpr double kMass = 0.7;

Model heavy_beam(const std::string& start, const std::string& end, double EA = 1e12) {
  Model model = straight(kLength, kEI, EA, start, end);
  model.sections[0].mass = kMass;
  return model;
}

Analysis vibration(int modes, std::vector<double> factors, double accuracy) {
  Analysis analysis;
  analysis.type = AnalysisType::vibration;
  analysis.modes = modes;
  analysis.load_factors = std::move(factors);
  analysis.discretization.accuracy = accuracy;
  analysis.output.points_per_member = 11;
  return analysis;
}

Result solved(const Model& model, const Analysis& analysis) {
  Result result = solve(model, analysis);
  EXPECT_FALSE(result.failure) << result.failure->code << ": " << result.failure->detail;
  return result;
}

double squared(double wave_number) { return std::pow(wave_number / kLength, 4) * kEI / kMass; }

/// Roots of a characteristic equation, in intervals of its argument that hold one each.
double root_between(const std::function<double(double)>& f, double lo, double hi) {
  const bool rises = f(hi) > 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((f(middle) > 0.0) == rises ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

struct BeamEnds {
  const char* start;
  const char* end;
  std::function<double(double)> characteristic;
  double first;  ///< the n-th root is about first + (n - 1) pi
  int rigid;     ///< motions without strain
};

/// The first ten frequencies of beams with all kinds of ends.
TEST(Vibration, OfBeamsIsThatOfTheCharacteristicEquations) {
  const auto clamped_free = [](double x) { return std::cos(x) + 1.0 / std::cosh(x); };
  const auto clamped_clamped = [](double x) { return std::cos(x) - 1.0 / std::cosh(x); };
  const auto clamped_pinned = [](double x) { return std::sin(x) - std::cos(x) * std::tanh(x); };
  const BeamEnds cases[] = {{"xy", "y", [](double x) { return std::sin(x); }, kPi, 0},
                            {"xyr", "", clamped_free, 0.6 * kPi, 0},
                            {"xyr", "yr", clamped_clamped, 1.5 * kPi, 0},
                            {"xyr", "y", clamped_pinned, 1.25 * kPi, 0},
                            {"", "", clamped_clamped, 1.5 * kPi, 3}};
  for (const BeamEnds& ends : cases) {
    const int modes = 10 + ends.rigid;
    const Result result = solved(heavy_beam(ends.start, ends.end), vibration(modes, {0.0}, 1e-8));
    const Vibration& found = result.vibrations->at(0);
    ASSERT_EQ(found.frequencies.squares.size(), static_cast<std::size_t>(modes));
    for (int n = 0; n < modes; ++n) {
      const std::string which = std::string(ends.start) + "-" + ends.end + " " + std::to_string(n);
      const double square = found.frequencies.squares[static_cast<std::size_t>(n)];
      if (n < ends.rigid) {
        EXPECT_NEAR(square, 0.0, 1e-9 * squared(kPi)) << which;
        continue;
      }
      const double about = ends.first + (n - ends.rigid) * kPi;
      const double exact = squared(root_between(ends.characteristic, about - 1.0, about + 1.0));
      EXPECT_NEAR(square / exact, 1.0, 1e-8) << which;
      const double estimate = found.error_estimates[static_cast<std::size_t>(n)].value_or(-1.0);
      EXPECT_LE(std::abs(square - exact), std::max(estimate, 1e-11 * exact)) << which;
    }
  }
}

/// omega_n^2 = (n pi / L)^4 EI / m (1 - P / (n^2 P_1)), also beyond the buckling load.
TEST(Vibration, OfAColumnFallsLinearlyWithItsLoad) {
  Model model = heavy_beam("xy", "y");
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  const double euler = kPi * kPi * kEI / (kLength * kLength);
  const std::vector<double> factors{-euler, 0.0, 0.25 * euler, 0.5 * euler, 0.99 * euler, 1.5 * euler};
  const Result result = solved(model, vibration(3, factors, 1e-8));
  ASSERT_EQ(result.vibrations->size(), factors.size());
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (int n = 1; n <= 3; ++n)
      EXPECT_NEAR(result.vibrations->at(i).frequencies.squares[static_cast<std::size_t>(n - 1)],
                  squared(n * kPi) * (1.0 - factors[i] / (n * n * euler)), 1e-8 * squared(n * kPi))
          << factors[i] << " " << n;
}

/// Four frequencies of arches: with and without a Winkler base, unloaded and at states of large
/// displacements.
///
/// Source: tests/verification/data/arch_frequencies.py (Chebyshev collocation of the geometrically exact
/// arch), radius and stiffness 1.
TEST(Vibration, OfArchesUnderLoadIsThatOfCollocation) {
  struct Row {
    double degrees, EA, base, load;
    bool clamped;
    double squares[4];
  };
  const Row rows[] = {{120.0, 1e4, 0.0, 0.0, false, {47.93100219, 304.4188364, 1138.061812, 2808.951676}},
                      {120.0, 1e4, 100.0, 0.0, false, {122.6516646, 396.1009464, 1231.564151, 2905.860387}},
                      {215.0, 1e6, 0.0, 0.0, true, {3.758326251, 28.85911161, 112.6966244, 292.9355986}},
                      {215.0, 1e6, 0.0, 3.0, true, {2.165607071, 19.74703744, 86.01042965, 256.0685351}},
                      {215.0, 1e6, 0.0, 6.0, true, {1.903527356, 15.98066775, 41.79191705, 189.7991131}},
                      {215.0, 1e6, 0.0, 8.5, true, {1.667718617, 15.73245704, 21.74934, 155.1835781}}};
  for (const Row& row : rows) {
    constexpr double kRadius = 100.0;
    Model model = arch(row.degrees, row.EA / (kRadius * kRadius), 1.0, row.clamped);
    model.sections[0].mass = 1.0;
    if (row.base > 0.0) model.foundations = {winkler("arch", row.base / std::pow(kRadius, 4))};
    const Result result = solved(model, vibration(4, {row.load}, 1e-8));
    const Vibration& found = result.vibrations->at(0);
    ASSERT_EQ(found.frequencies.squares.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(found.frequencies.squares[i] * std::pow(kRadius, 4) / row.squares[i], 1.0, 2e-8)
          << row.degrees << " " << row.load << " " << i;
    }
  }
}

/// Four quarters of a circle with EA R^2 / EI = 1e9.
Model free_ring() {
  Model model;
  const char* const ids[] = {"e", "n", "w", "s"};
  for (int i = 0; i < 4; ++i)
    model.nodes.push_back({ids[i], std::cos(0.5 * kPi * i), std::sin(0.5 * kPi * i)});
  model.sections = {{"s", 1e9, 1.0, {}}};
  model.sections[0].mass = 1.0;
  for (int i = 0; i < 4; ++i)
    model.members.push_back(
        {"m" + std::to_string(i), ids[i], ids[(i + 1) % 4], "s", ArcCurve{90.0}, false, false});
  // a model needs a support; this one has no force
  Spring none{"none", at_node("e"), std::array{1.0, 0.0}};
  model.springs = {none};
  return model;
}

/// A ring, free or on a Winkler base K: radial amplitude w and tangential amplitude w / n of the waves n, so
/// that omega^2 = n^2 / (n^2 + 1) (EI (n^2 - 1)^2 / R^4 + K) / m; the rotation is without strain.
/// EA R^2 / EI = 1e9 leaves 1e-9 of extension.
TEST(Vibration, OfARingIsHoppes) {
  Model model = free_ring();
  for (const double base : {0.0, 10.0}) {
    for (const Member& member : model.members) {
      if (base == 0.0) break;
      model.foundations.push_back(winkler(member.id, base));
      model.foundations.back().id = member.id;
    }
    const Result result = solved(model, vibration(17, {0.0}, 1e-7));
    const std::vector<double>& squares = result.vibrations->at(0).frequencies.squares;
    ASSERT_EQ(squares.size(), 17U);
    EXPECT_NEAR(squares[0], 0.0, 1e-9);
    for (int n = 1; n <= 8; ++n) {
      const double exact = n * n / (n * n + 1.0) * (std::pow(n * n - 1.0, 2) + base);
      for (const int of_pair : {0, 1})
        EXPECT_NEAR(squares[static_cast<std::size_t>(2 * n - 1 + of_pair)], exact, 1e-9 + 2e-8 * exact)
            << base << " " << n;
    }
  }
}

/// The number of frequencies that is asked for may take one of a pair of equal ones and leave the other.
TEST(Vibration, OfARingMayEndWithinAPair) {
  const std::vector<double> all =
      solved(free_ring(), vibration(13, {0.0}, 1e-6)).vibrations->at(0).frequencies.squares;
  for (int count = 4; count <= 12; ++count) {
    const Result result = solved(free_ring(), vibration(count, {0.0}, 1e-6));
    const std::vector<double>& squares = result.vibrations->at(0).frequencies.squares;
    ASSERT_EQ(squares.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 3; i < squares.size(); ++i)
      EXPECT_NEAR(squares[i] / all[i], 1.0, 1e-6) << count << " " << i;
  }
}

/// Frequencies at the points of a path, which no inertia count confirms, are those of a vibration analysis,
/// which has such a count.
TEST(Vibration, AtThePointsOfAPathIsConfirmed) {
  Model model = arch(88.0, 0.2, 1.0, true);
  model.sections[0].mass = 1.8;
  model.masses = {{at_member("arch", 0.4), 190.0, 0.0}};
  for (const int count : {5, 6, 9, 14}) {
    Analysis along = analysis_of(AnalysisType::path, fixed_mesh(8, 3));
    along.stop.load_factor = {{0.0, 8.0}};
    along.output.frequencies = count;
    const Result path = solved(model, along);
    const Branch& branch = path.branches.at(0);
    std::vector<double> loads;
    for (const int row : branch.computed) loads.push_back(branch.load_factor[static_cast<std::size_t>(row)]);
    Analysis at = vibration(count, loads, 1e-6);
    at.discretization = fixed_mesh(8, 3);
    const Result confirmed = solved(model, at);
    ASSERT_GE(confirmed.vibrations->size(), 3U);
    for (std::size_t i = 0; i < confirmed.vibrations->size(); ++i) {
      const std::vector<double>& exact = confirmed.vibrations->at(i).frequencies.squares;
      const auto row = static_cast<std::size_t>(branch.computed[i]);
      const std::vector<double>& found = branch.frequencies.at(row).value().squares;
      ASSERT_EQ(found.size(), exact.size());
      for (std::size_t n = 0; n < exact.size(); ++n)
        EXPECT_NEAR(found[n], exact[n], 1e-7 * std::abs(exact[n])) << count << " " << i << " " << n;
    }
  }
}

/// A cantilever without mass of its own that carries two point masses has five natural motions, and no more
/// where more are asked for. The flexibility of the three across is that of a beam under a force and a moment
/// at a, and a force at its end.
TEST(Vibration, OfFewMassesHasNoOtherMotions) {
  constexpr double a = 0.4;
  constexpr double EA = 1e6;
  Eigen::Matrix3d flexibility;
  flexibility << a * a * a / 3.0, a * a / 2.0, a * a * (3.0 - a) / 6.0, a * a / 2.0, a, a - a * a / 2.0,
      a * a * (3.0 - a) / 6.0, a - a * a / 2.0, 1.0 / 3.0;
  const Eigen::Vector3d roots = Eigen::Vector3d(0.5, 0.01, 1.0).cwiseSqrt();
  const Eigen::Vector3d across =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(roots.asDiagonal() * flexibility * roots.asDiagonal())
          .eigenvalues();
  for (const bool follows : {false, true}) {
    for (int count = 1; count <= 8; ++count) {
      Model model = straight(1.0, 1.0, EA, "xyr", "");
      model.masses = {{at_node("b"), 1.0, 0.0}, {at_member("m", a), 0.5, 0.01}};
      PointLoad load = force_at(at_node("b"), -1.0, 0.01);
      load.follows = follows;
      model.loads = {load};
      Analysis along = analysis_of(AnalysisType::path, accurate(1e-3));
      along.stop.load_factor = {{0.0, 2.0}};
      along.output.frequencies = count;
      const Result result = solved(model, along);
      for (const int computed : result.branches.at(0).computed) {
        const auto& row = result.branches[0].frequencies.at(static_cast<std::size_t>(computed));
        ASSERT_TRUE(row) << count;
        ASSERT_EQ(row->squares.size(), static_cast<std::size_t>(std::min(count, 5)));
        EXPECT_GT(row->squares[0], 0.0) << count;
      }
      for (std::size_t i = 0; i < static_cast<std::size_t>(std::min(count, 3)); ++i)
        EXPECT_NEAR(result.branches[0].frequencies[0]->squares[i] * across[2 - static_cast<Eigen::Index>(i)],
                    1.0, 1e-5)
            << count << " " << i;
    }
  }
}

/// The search at a load factor takes its scale from the squares found at the one before. Those of rigid
/// motions are zero but for rounding and give none.
TEST(Vibration, OfRigidMotionsAtSeveralLoadsIsConfirmed) {
  Model model = free_ring();
  for (const Member& member : model.members)
    model.loads.emplace_back(PressureLoad{member.id, 1.0, Side::right});
  const Result result = solved(model, vibration(3, {0.0, 0.2, 1.0}, 1e-3));
  ASSERT_EQ(result.vibrations->size(), 3U);
  for (const Vibration& at : *result.vibrations)
    for (const double square : at.frequencies.squares) EXPECT_NEAR(square, 0.0, 1e-9);
}

/// The inertia count that confirms the frequencies of a vibration analysis agrees with them for stiff beams
/// too, EA L^2 / EI from 1e4 to 1e13.
TEST(Vibration, OfAStiffFreeBeamIsConfirmed) {
  for (int power = 4; power <= 13; ++power) {
    const Result result = solved(heavy_beam("", "", std::pow(10.0, power)), vibration(13, {0.0}, 1e-8));
    ASSERT_EQ(result.vibrations->size(), 1U) << power;
    const double exact = squared(4.730040744862704);
    EXPECT_NEAR(result.vibrations->at(0).frequencies.squares.at(3) / exact, 1.0, 1e-8) << power;
  }
}

/// Rotary inertia j of a pinned beam: omega^2 = (n pi / L)^4 EI / (m + j (n pi / L)^2).
TEST(Vibration, CountsTheRotaryInertiaOfSections) {
  Model model = heavy_beam("xy", "y");
  model.sections[0].rotary_inertia = 0.02;
  const Result result = solved(model, vibration(3, {0.0}, 1e-8));
  for (int n = 1; n <= 3; ++n) {
    const double k = n * kPi / kLength;
    EXPECT_NEAR(result.vibrations->at(0).frequencies.squares[static_cast<std::size_t>(n - 1)],
                std::pow(k, 4) * kEI / (kMass + 0.02 * k * k), 1e-8 * squared(n * kPi));
  }
}

/// A mass at the tip of a cantilever without mass: omega^2 = 3 EI / (M L^3).
TEST(Vibration, OfAPointMassIsThatOfASpring) {
  Model model = straight(kLength, kEI, 1e12, "xyr", "");
  model.masses = {{at_node("b"), 5.0, 0.0}};
  const Result result = solved(model, vibration(1, {0.0}, 1e-8));
  EXPECT_NEAR(result.vibrations->at(0).frequencies.squares[0], 3.0 * kEI / (5.0 * std::pow(kLength, 3)),
              1e-10);
}

/// One-sided supports that touch without pressure have no linear vibration; pressed ones have.
TEST(Vibration, DoesNotExistWhereSupportsTouchWithoutPressure) {
  Model model = heavy_beam("xyr", "yr", 1e6);
  model.foundations = {one_sided("m", 50.0, Side::right)};
  model.loads = {DistributedLoad{"m", {0.0, -1e-3}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
  const Result result = solve(model, vibration(1, {0.0, 1.0}, 1e-6));
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "no_linear_vibration");
  ASSERT_EQ(result.vibrations->size(), 1U);
  EXPECT_EQ(result.vibrations->at(0).load_factor, 1.0);
  // pressed everywhere, the base acts as a bilateral one: omega^2 = (4.730 / L)^4 EI / m + K / m
  EXPECT_NEAR(result.vibrations->at(0).frequencies.squares[0], squared(4.730040744862704) + 50.0 / kMass,
              1e-2);
}

/// The lowest frequency along the path of a heated clamped beam is zero at the bifurcation, and rises again
/// on the branch.
TEST(Vibration, AlongAHeatedBeamVanishesWhereItBuckles) {
  Model model = straight(1.0, 1.0, 1e6, "xyr", "xyr");
  model.sections[0].mass = 1.0;
  model.sections[0].expansion = 1e-5;
  model.loads = {TemperatureLoad{"m", 1.0}};
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.stop.load_factor = {{0.0, 8.0}};
  analysis.branches.follow = Follow::first;
  analysis.output.frequencies = 2;
  const Result result = solved(model, analysis);
  const double critical = result.summary.critical_load_factor.value_or(0.0);
  const double free = result.branches.at(0).frequencies.at(0)->squares[0];
  ASSERT_GE(result.branches.size(), 2U);
  for (const int row : result.branches[0].computed) {
    const auto i = static_cast<std::size_t>(row);
    const double square = result.branches[0].frequencies[i]->squares[0];
    if (std::abs(square) < 1e-6 * free) continue;  // the critical point has a row of its own
    EXPECT_EQ(square > 0.0, result.branches[0].negative_eigenvalues[i] == 0);
  }
  EXPECT_NEAR(result.branches[1].frequencies.at(0)->squares[0], 0.0, 1e-6 * free);
  double before = -1.0;
  for (const int row : result.branches[1].computed) {
    const double square = result.branches[1].frequencies[static_cast<std::size_t>(row)]->squares[0];
    EXPECT_GT(square, before);
    before = square;
  }
  const Result at = solved(model, vibration(1, {critical}, 1e-6));
  EXPECT_NEAR(at.vibrations->at(0).frequencies.squares[0], 0.0, 1e-6 * free);
}

/// Frequencies converge with h^2p, as nodal values and loads do.
TEST(Vibration, ConvergesWithTwiceTheOrderOfTheElements) {
  const double exact =
      squared(root_between([](double x) { return std::cos(x) - 1.0 / std::cosh(x); }, 7.0, 8.5));
  struct {
    int order;
    std::vector<int> elements;
  } const cases[] = {{1, {16, 32, 64}}, {2, {8, 16, 32}}, {3, {4, 8, 16}}, {4, {3, 4, 6}}};
  for (const auto& c : cases) {
    std::vector<double> error;
    for (const int n : c.elements) {
      Analysis analysis = vibration(2, {0.0}, 1e-3);
      analysis.discretization = fixed_mesh(n, c.order);
      const Result result = solved(heavy_beam("xyr", "yr"), analysis);
      error.push_back(result.vibrations->at(0).frequencies.squares[1] / exact - 1.0);
    }
    EXPECT_NEAR(fitted_order(c.elements, error), 2.0 * c.order, 0.4) << c.order;
  }
}

}  // namespace
}  // namespace snapthrough
