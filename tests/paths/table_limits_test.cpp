/// Limit points of structures on laws of type table: as many as the exact structure has, whatever the points
/// of the table and the mesh.
///
/// Tables have 3 to 300 points of a curve that does not fall: tanh, a power, or random steps. More tables:
/// --gtest_random_seed=N draws others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/solve.h"
#include "tests/stress/random_numbers.h"
#include "tests/stress/rod_law.h"
#include "tests/verification/cases.h"

namespace snapthrough::testing {
namespace {

/// Points of a curve that rises to the force 1 at the displacement `reach`.
ReactionLaw drawn_table(Random& random, double reach) {
  ReactionLaw law;
  law.type = ReactionLaw::Type::table;
  const auto count = static_cast<int>(std::lround(random.decades(std::log10(3.0), std::log10(300.0))));
  const int kind = random.below(3);
  const double exponent = random.between(0.2, 0.8);
  const double steepness = random.between(1.0, 6.0);
  double force = 0.0;
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    if (kind == 0) force = std::tanh(steepness * share) / std::tanh(steepness);
    if (kind == 1) force = std::pow(share, exponent);
    if (kind == 2 && (i == 1 || !random.chance(0.1))) force += random.between(0.0, 2.0) / count;
    law.points.push_back({reach * share, force});
  }
  return law;
}

Discretization drawn_mesh(Random& random, int least, int most) {
  return fixed_mesh(least + random.below(most - least + 1), 1 + random.below(8));
}

/// Load factors of the limit points of a path until the monitor leaves a range.
std::vector<double> limits_on(const Model& model, const Discretization& mesh,
                              const std::array<double, 2>& range) {
  Analysis analysis = analysis_of(AnalysisType::path, mesh);
  analysis.stop.monitor = MonitorRange{"w", range};
  analysis.stop.steps = 2000;
  const Result result = solve(model, analysis);
  EXPECT_EQ(result.summary.termination, "monitor") << result.summary.message;
  std::vector<double> out;
  for (const CriticalPoint& point : limits_of(result)) out.push_back(point.load_factor);
  return out;
}

constexpr int kTables = 40;
/// First seed of a run.
std::uint64_t first_seed() { return kTables * static_cast<std::uint64_t>(GTEST_FLAG_GET(random_seed)); }

/// A lateral force at the head of a pile, the tip of which is hinged, grows with the displacement of the
/// head: more displacement makes no support softer than nothing.
TEST(TableLimits, PilesUnderALateralForceHaveNone) {
  for (std::uint64_t seed = first_seed(); seed < first_seed() + kTables; ++seed) {
    Random random(seed);
    Model model = straight(1.0, random.decades(-3.0, 0.0), 1e4, "", "xy");
    model.foundations = {winkler("m", 0.0)};
    model.foundations[0].law = drawn_table(random, 0.05);
    if (random.chance(0.5)) model.foundations[0].reaction = Reaction::compression_only;
    model.loads = {force_at(at_node("a"), 0.0, 0.1)};
    model.monitors = {{"w", at_node("a"), Component::y}};
    EXPECT_TRUE(limits_on(model, drawn_mesh(random, 2, 24), {-0.1, 0.1}).empty()) << "seed " << seed;
  }
}

/// Extrema of f on (0, to], by values at close places and golden sections beside them.
template <class Function>
std::vector<double> extrema_of(const Function& f, double to) {
  constexpr int kPlaces = 200000;
  const double share = 0.5 * (std::sqrt(5.0) - 1.0);
  std::vector<double> out;
  double rise = 1.0;
  for (int i = 2; i <= kPlaces; ++i) {
    const double step = to / kPlaces;
    const double change = f(step * i) - f(step * (i - 1));
    if (change == 0.0 || (change > 0.0) == (rise > 0.0)) continue;
    double low = step * (i - 2);
    double high = step * i;
    for (int n = 0; n < 60; ++n) {
      const double left = high - share * (high - low);
      const double right = low + share * (high - low);
      const bool is_left = rise > 0.0 ? f(left) > f(right) : f(left) < f(right);
      (is_left ? high : low) = is_left ? right : left;
    }
    out.push_back(f(0.5 * (low + high)));
    rise = change;
  }
  return out;
}

/// A rigid bar of length 1 on a spring in rotation, with the load P down and h P sideways at its head: P =
/// M(t) / (sin t + h cos t) has the limit points, by the checker's table.
TEST(TableLimits, OfARigidBarAreThoseOfTheClosedForm) {
  constexpr double kTo = 1.2;
  constexpr double kBeyond =
      1.5;  // a limit point beyond the range of the monitor, on the last step, is listed too
  constexpr double kLocated = 1e-8;  // of the load, between the kinks of a table
  for (std::uint64_t seed = first_seed(); seed < first_seed() + kTables; ++seed) {
    Random random(seed);
    const ReactionLaw law = drawn_table(random, random.between(0.2, 1.5));
    const double h = random.decades(-2.0, 0.0);
    Model model = bar_on_spring(law);
    model.loads = {force_at(at_node("head"), h, -1.0)};
    model.monitors = {{"w", at_node("head"), Component::rotation}};
    const RodLaw moment = LawAlong(law).at(0.0);
    const std::vector<double> exact =
        extrema_of([&](double t) { return moment.force(t) / (std::sin(t) + h * std::cos(t)); }, kBeyond);
    const std::vector<double> found = limits_on(model, drawn_mesh(random, 1, 4), {-kTo, kTo});
    for (const double load : found) {
      const auto near = [load](double of) { return std::abs(load / of - 1.0) < kLocated; };
      EXPECT_TRUE(std::ranges::any_of(exact, near)) << "seed " << seed << ", load factor " << load;
    }
    EXPECT_LE(found.size(), exact.size()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace snapthrough::testing
