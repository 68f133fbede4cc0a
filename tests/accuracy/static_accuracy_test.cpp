/// States of static analyses against closed forms: the true error is within the accuracy and the estimate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/solve.h"

namespace snapthrough {
namespace {

constexpr double kAccuracies[] = {1e-2, 1e-3, 1e-6};
/// Strains and squares of slopes in the requests below, which the closed forms leave out.
constexpr double kLinear = 1e-7;

/// A straight member of length 1 and EI = 1 with strains of 1e-8 under the tension.
Model pulled_member(double tension) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  Section section;
  section.id = "s";
  section.EA = 1e8 * std::max(tension, 1.0);
  section.EI = 1.0;
  model.sections = {section};
  Member member;
  member.id = "m";
  member.start = "a";
  member.end = "b";
  member.section = "s";
  model.members = {member};
  Support left;
  left.node = "a";
  left.x = left.y = left.rotation = true;
  Support right;
  right.node = "b";
  right.y = right.rotation = true;
  model.supports = {left, right};
  PointLoad pull;
  pull.at.node = "b";
  pull.force = {tension, 0.0};
  pull.pattern = Pattern::constant;
  DistributedLoad load;
  load.member = "m";
  load.force = {0.0, -1e-4 * std::max(tension, 1.0)};
  model.loads = {pull, load};
  return model;
}

Result solved(const Model& model, double accuracy) {
  Analysis analysis;
  analysis.type = AnalysisType::static_;
  analysis.discretization.accuracy = accuracy;
  analysis.output.states = StateOutput::all;
  return solve(model, analysis);
}

double largest(const std::vector<double>& values) {
  double out = 0.0;
  for (const double value : values) out = std::max(out, std::abs(value));
  return out;
}

/// The error of a largest value is within the accuracy, and within the estimate.
void expect_accurate(const Result& result, double accuracy, double value, double exact,
                     const std::string& what) {
  ASSERT_TRUE(result.summary.error_estimate) << what;
  EXPECT_LE(*result.summary.error_estimate, accuracy) << what;
  EXPECT_EQ(result.discretization.estimated_accuracy, result.summary.error_estimate) << what;
  const double error = std::abs(value - exact) / std::abs(exact);
  EXPECT_LE(error, accuracy) << what;
  EXPECT_LE(error, *result.summary.error_estimate + kLinear) << what;
}

/// EI w'''' - T w'' = q between clamps: with k = sqrt(T / EI) and c = k L / 2 the clamps have the moment
/// q EI / T (c coth c - 1), and the middle the deflection q L / 2 T k (c / 2 - tanh(c / 2)).
TEST(StaticAccuracy, TightWiresHaveTheClosedFormsOfTheirClamps) {
  for (const double kL : {1.0, 10.0, 1e2, 1e3, 1e4, 1e5})
    for (const double accuracy : kAccuracies) {
      const double tension = kL * kL;
      const double q = 1e-4 * std::max(tension, 1.0);
      const double c = 0.5 * kL;
      const Result result = solved(pulled_member(tension), accuracy);
      const std::string what = "kL " + std::to_string(kL) + ", accuracy " + std::to_string(accuracy);
      ASSERT_FALSE(result.failure) << what;
      const MemberState& m = result.states.at(0).members.at(0);
      expect_accurate(result, accuracy, largest(m.bending_moment), q / tension * (c / std::tanh(c) - 1.0),
                      "moment, " + what);
      expect_accurate(result, accuracy, largest(m.v),
                      q / (2.0 * tension * kL) * (0.5 * c - std::tanh(0.5 * c)), "deflection, " + what);
    }
}

/// The state of a path at an asked load factor has the closed form's moments on a mesh of its own.
TEST(StaticAccuracy, StatesOfPathsHaveTheClosedFormsOfTheirClamps) {
  for (const double accuracy : kAccuracies) {
    const double tension = 1e6;
    Analysis analysis;
    analysis.type = AnalysisType::path;
    analysis.discretization.accuracy = accuracy;
    analysis.stop.load_factor = {{-1.0, 1.5}};
    analysis.output.states = StateOutput::at_load_factors;
    analysis.output.at_load_factors = {0.5, 1.0};
    const Result result = solve(pulled_member(tension), analysis);
    ASSERT_FALSE(result.failure);
    ASSERT_EQ(result.states.size(), 2U);
    EXPECT_TRUE(result.warnings.empty());
    for (const State& state : result.states) {
      const double c = 0.5 * std::sqrt(tension);
      const double exact = state.load_factor * 1e-4 * (c / std::tanh(c) - 1.0);
      ASSERT_TRUE(state.error_estimate);
      EXPECT_LE(*state.error_estimate, accuracy);
      EXPECT_LE(std::abs(largest(state.members.at(0).bending_moment) / exact - 1.0),
                *state.error_estimate + kLinear);
    }
  }
}

/// A cantilever that is strained has displacements and no forces: rounding is no error.
TEST(StaticAccuracy, AStrainedCantileverIsAccurate) {
  Model model = pulled_member(1.0);
  model.nodes[1].y = 0.7;
  model.supports.pop_back();
  InitialStrain strain;
  strain.member = "m";
  strain.axial = 1e-3;
  strain.curvature = 0.05;
  model.loads = {strain};
  const Result result = solved(model, 1e-6);
  ASSERT_FALSE(result.failure);
  ASSERT_TRUE(result.summary.error_estimate);
  EXPECT_LE(*result.summary.error_estimate, 1e-6);
}

/// A mesh that the request gives is neither refined nor compared.
TEST(StaticAccuracy, AGivenMeshHasNoEstimate) {
  Analysis analysis;
  analysis.type = AnalysisType::static_;
  analysis.discretization.fixed_mesh = true;
  analysis.discretization.elements = 8;
  analysis.discretization.order = 4;
  const Result result = solve(pulled_member(1e4), analysis);
  ASSERT_FALSE(result.failure);
  EXPECT_FALSE(result.summary.error_estimate);
  EXPECT_FALSE(result.discretization.estimated_accuracy);
  EXPECT_EQ(result.discretization.elements, 8);
}

}  // namespace
}  // namespace snapthrough
