/// Worst imperfections: closed forms, the first-order law, and random offsets of the same norm.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "solver/analysis/worst_offset.h"
#include "solver/sensitivity/offset_space.h"
#include "tests/solver/analysis/worst_structures.h"

namespace snapthrough {
namespace {

using namespace testing;

constexpr double kPi = std::numbers::pi;

Result solve_worst(Model model, OffsetNorm norm, double amplitude, double accuracy = 1e-5) {
  model.imperfections.emplace_back(WorstImperfection{norm, amplitude});
  return solve(model, critical_load(accuracy));
}

class RandomOffsetsBeatNone : public ::testing::TestWithParam<int> {};

/// bench/worst_offset.cpp has 200 offsets of each kind (docs/verification.md).
TEST_P(RandomOffsetsBeatNone, OfTheSameNorm) {
  const WorstCase one = worst_cases()[static_cast<std::size_t>(GetParam())];
  for (const OffsetNorm norm : {OffsetNorm::rms, OffsetNorm::max}) {
    const Result worst = solve_worst(one.model, norm, one.amplitude);
    ASSERT_TRUE(worst.worst_imperfection && worst.worst_imperfection->load_factor) << worst.summary.message;
    const WorstOffset& found = *worst.worst_imperfection;
    EXPECT_LT(*found.load_factor, found.perfect_load_factor);
    EXPECT_EQ(worst.summary.critical_load_factor, found.load_factor);
    const Offsets best = offsets_of(one.model, found, OffsetSpace::kPoints);
    RandomOffsets random(one.model, OffsetSpace::kPoints, 7U);
    EXPECT_NEAR(random.norm(norm, best), one.amplitude, 1e-3 * one.amplitude);
    const Duel any = duel(one.model, critical_load(1e-5), worst, 8, [&](int i) {
      return random.scaled(norm, i % 2 == 0 ? random.rough() : random.smooth(), one.amplitude);
    });
    const Duel near = duel(one.model, critical_load(1e-5), worst, 8,
                           [&](int) { return random.beside(norm, best, 1.0 / 3.0); });
    EXPECT_EQ(any.beaten_by, 0) << one.name << " " << any.lowest;
    EXPECT_EQ(near.beaten_by, 0) << one.name << " " << near.lowest;
    EXPECT_LT(any.without + near.without, 16) << one.name;
  }
}

INSTANTIATE_TEST_SUITE_P(WorstOffset, RandomOffsetsBeatNone, ::testing::Range(0, 7));

/// A limit load changes linearly with small offsets, and the rest with their square.
TEST(WorstOffset, OfALimitPointFollowsTheFirstOrderLaw) {
  const auto missing = [](OffsetNorm norm, double amplitude) {
    const Result result = solve_worst(lee_frame(4.32e9), norm, amplitude, 1e-9);
    const WorstOffset& found = *result.worst_imperfection;
    EXPECT_TRUE(is_limit(found.perfect_type));
    const double fall = found.perfect_load_factor - *found.first_order_load_factor;
    EXPECT_GT(fall, 0.0);
    return (found.perfect_load_factor - *found.load_factor) / fall - 1.0;
  };
  for (const OffsetNorm norm : {OffsetNorm::rms, OffsetNorm::max}) {
    const double large = missing(norm, 0.02);
    const double small = missing(norm, 0.002);
    EXPECT_LT(std::abs(large), 0.01);
    EXPECT_NEAR(small / large, 0.1, 0.03);
  }
}

/// Pinned column on a base, one half wave: (1 - r)^(3/2) = 3/2 sqrt(-3 b) e r for an offset e sin(pi x / L),
/// r the load over the critical load 1 + b s^2 (Koiter 1945; b as in koiter_test). The next terms of the law
/// and of the shape are of the order of 1 - r.
TEST(WorstOffset, OfAColumnOnABaseIsAHalfWaveByKoitersLaw) {
  constexpr double kBase = 100.0;
  constexpr double k2 = kPi * kPi;
  constexpr double kLoad = k2 + kBase / k2;
  constexpr double b = k2 * (0.5 * k2 / kLoad - 0.375);
  for (const double rms : {1e-4, 1e-3}) {
    const Result result = solve_worst(column(1.0, 1.0, 1e9, kBase), OffsetNorm::rms, rms, 1e-8);
    ASSERT_TRUE(result.worst_imperfection) << result.summary.message;
    const WorstOffset& found = *result.worst_imperfection;
    EXPECT_EQ(found.perfect_type, CriticalType::bifurcation);
    EXPECT_FALSE(found.first_order_load_factor);
    const double e = std::sqrt(2.0) * rms;
    ASSERT_TRUE(found.load_factor);
    const double r = *found.load_factor / kLoad;
    ASSERT_EQ(found.imperfections.size(), 1U);
    const double sign = std::copysign(1.0, found.imperfections[0].offsets[8][1]);
    for (const auto& [fraction, offset] : found.imperfections[0].offsets)
      EXPECT_NEAR(offset, sign * e * std::sin(kPi * fraction), (1.0 - r) * e) << fraction;
    EXPECT_NEAR(std::pow(1.0 - r, 1.5) / (1.5 * std::sqrt(-3.0 * b) * e * r), 1.0, 1.0 - r) << rms;
  }
}

/// States beyond Euler's load are stable: no offset makes the column lose stability below it.
TEST(WorstOffset, OfAColumnThatStaysStableWarns) {
  const Result result = solve_worst(column(1.0, 1.0, 1e9, 0.0), OffsetNorm::max, 1e-3);
  ASSERT_TRUE(result.worst_imperfection) << result.summary.message;
  const WorstOffset& found = *result.worst_imperfection;
  EXPECT_NEAR(found.perfect_load_factor, kPi * kPi, 1e-4);
  EXPECT_GT(found.load_factor.value_or(HUGE_VAL), found.perfect_load_factor);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings.back().code, "worst_imperfection");
}

TEST(WorstOffset, OfAStructureWithoutCriticalPointFails) {
  Model model = column(1.0, 1.0, 1e9, 0.0);
  model.loads = {PointLoad{{"b", "", 0.0}, {1.0, 0.0}, 0.0, Pattern::proportional}};
  const Result result = solve_worst(model, OffsetNorm::rms, 1e-3);
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->code, "no_worst_imperfection");
  EXPECT_FALSE(result.worst_imperfection);
}

/// The offsets of a result, given back in a request, have the same critical load.
TEST(WorstOffset, GivenBackHasTheSameLoad) {
  const Model model = lee_frame(4.32e9);
  const Result result = solve_worst(model, OffsetNorm::max, 0.2);
  const Model back = with_offsets(model, result.worst_imperfection->imperfections);
  EXPECT_EQ(solve(back, critical_load(1e-5)).summary.critical_load_factor,
            result.worst_imperfection->load_factor);
}

/// The worst imperfection is the shape, whatever is asked of the structure with it.
TEST(WorstOffset, OfAPathAndOfAStaticAnalysisIsTheSame) {
  Model model = lee_frame(4.32e9);
  model.imperfections = {WorstImperfection{OffsetNorm::rms, 0.2}};
  Analysis analysis = critical_load(1e-5);
  const auto offsets = [&] { return solve(model, analysis).worst_imperfection->imperfections[1].offsets; };
  const auto critical = offsets();
  analysis.type = AnalysisType::path;
  analysis.stop.limit_points = 1;
  EXPECT_EQ(offsets(), critical);
  analysis.type = AnalysisType::static_;
  EXPECT_EQ(offsets(), critical);
}

/// The derivative of the worst load by the amplitude, with the shape held: differences of whole searches.
TEST(WorstOffset, HasASensitivityToItsAmplitude) {
  Model model = lee_frame(4.32e9);
  model.imperfections = {WorstImperfection{OffsetNorm::rms, 0.2}};
  Analysis analysis = critical_load(1e-8);
  const auto model_at = [&model](double amplitude) {
    Model other = model;
    std::get<WorstImperfection>(other.imperfections[0]).amplitude = amplitude;
    return std::optional(other);
  };
  analysis.sensitivities = {{"/model/imperfections/0/amplitude", 0.2, 0.2, model_at}};
  const Result result = solve(model, analysis);
  ASSERT_FALSE(result.critical_points.empty());
  const auto derivative = result.critical_points.front().sensitivities.at(0).derivative;
  ASSERT_TRUE(derivative);
  const auto load = [&](double amplitude) {
    return *solve_worst(lee_frame(4.32e9), OffsetNorm::rms, amplitude, 1e-8).worst_imperfection->load_factor;
  };
  const double difference = (load(0.21) - load(0.19)) / 0.02;
  EXPECT_NEAR(*derivative, difference, 1e-3 * std::abs(difference));
}

/// No random offsets within the norm have a larger product with the gradient.
TEST(OffsetSpace, SteepestOffsetsAreSteeperThanRandomOnes) {
  const OffsetSpace space({2.0, 5.0});
  std::mt19937 random(3U);
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    Eigen::VectorXd out(space.size());
    for (double& value : out) value = normal(random);
    return out;
  };
  for (const OffsetNorm norm : {OffsetNorm::rms, OffsetNorm::max})
    for (int i = 0; i < 10; ++i) {
      const Eigen::VectorXd gradient = draw();
      const Eigen::VectorXd best = space.steepest(norm, gradient);
      EXPECT_NEAR(space.norm(norm, best), 1.0, 1e-12);
      for (int j = 0; j < 100; ++j) {
        Eigen::VectorXd other = best + (j % 2 == 0 ? 0.1 : 10.0) * draw();
        other /= space.norm(norm, other);
        EXPECT_LT(gradient.dot(other), gradient.dot(best) * (1.0 + 1e-12));
      }
    }
}

/// The norms of a half wave of a sine.
TEST(OffsetSpace, NormsAreThoseOfTheCurve) {
  const OffsetSpace space({1.0});
  Eigen::VectorXd sine(space.size());
  for (Eigen::Index i = 0; i < sine.size(); ++i)
    sine[i] = std::sin(kPi * static_cast<double>(i + 1) / (OffsetSpace::kPoints + 1));
  // errors of the spline: h^4 / 384 times the fourth derivative, and as much again at its ends
  EXPECT_NEAR(space.norm(OffsetNorm::max, sine), 1.0, 1e-4);
  EXPECT_NEAR(space.norm(OffsetNorm::rms, sine), std::sqrt(0.5), 1e-4);
}

}  // namespace
}  // namespace snapthrough
