/// What diagnostics.skipped says, and that it was so.
#include <gmock/gmock.h>

#include <limits>

#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Analysis analysis_of(AnalysisType type, StateOutput states) {
  Analysis analysis;
  analysis.type = type;
  analysis.stop.limit_points = 1;
  analysis.output.states = states;
  return analysis;
}

TEST(Skipped, OfACriticalLoadAloneThePathItsStatesAndTheirPolish) {
  const Result result =
      solve(testing::arch(20.0, 420.0, 1.4), analysis_of(AnalysisType::critical, StateOutput::none));
  EXPECT_THAT(result.diagnostics.skipped,
              ElementsAre("path: points and contact changes, only the critical load was asked for",
                          "states: none were asked for",
                          "path points: correction to rounding, their states were not asked for"));
  EXPECT_TRUE(result.branches.empty());
  EXPECT_TRUE(result.states.empty());
}

TEST(Skipped, NothingOfAPathWithAllStates) {
  Model model = testing::arch(20.0, 420.0, 1.4);
  testing::add_soil(model, 1e6);
  const Result all = solve(model, analysis_of(AnalysisType::path, StateOutput::all));
  EXPECT_TRUE(all.diagnostics.skipped.empty());
  const Result none = solve(model, analysis_of(AnalysisType::path, StateOutput::none));
  EXPECT_THAT(none.diagnostics.skipped, Contains(HasSubstr("states")));
  EXPECT_LT(none.diagnostics.iterations, all.diagnostics.iterations) << "points were not polished";
}

TEST(Skipped, ContactSearchWhereBothSidesHold) {
  const Result result = solve(testing::column(1.0, 1.0, 1e8, 100.0),
                              analysis_of(AnalysisType::critical, StateOutput::critical));
  EXPECT_THAT(result.diagnostics.skipped, Contains("foundation soil: contact search, bilateral"));
  EXPECT_TRUE(result.contact_events.empty());
  Model arch = testing::arch(20.0, 420.0, 1.4);
  testing::add_soil(arch, 1e6);
  EXPECT_THAT(solve(arch, analysis_of(AnalysisType::critical, StateOutput::none)).diagnostics.skipped,
              Not(Contains(HasSubstr("contact search"))));
}

TEST(Skipped, OutputsThatAnAnalysisDoesNotHave) {
  Analysis analysis = analysis_of(AnalysisType::buckling, StateOutput::critical);
  analysis.output.extremes = true;
  analysis.output.path_points = 10;
  analysis.sensitivities.emplace_back();
  analysis.koiter = true;
  const Result result = solve(testing::arch(20.0, 420.0, 1.4), analysis);
  EXPECT_THAT(result.diagnostics.skipped,
              ElementsAre("extremes: linearised buckling reaches no states",
                          "path_points: only the branches of a path have points",
                          "sensitivities: only critical points on a path have them",
                          "koiter: only bifurcations of a path have Koiter's coefficients"));
  EXPECT_FALSE(result.extremes.has_value());
}

TEST(Skipped, BasesWithoutStiffness) {
  Model model = testing::arch(20.0, 420.0, 1.4);
  testing::add_soil(model, 0.0);
  const Result result = solve(model, analysis_of(AnalysisType::path, StateOutput::all));
  EXPECT_THAT(result.diagnostics.skipped, ElementsAre("foundation soil: stiffness 0"));
}

/// A rigid foundation acts with the stiffness that the elements resolve, and is named.
TEST(Skipped, WhatElementsDoNotResolveOfARigidBase) {
  Model model = testing::arch(20.0, 420.0, 1.4);
  testing::add_soil(model, 1.0);
  model.foundations[0].stiffness = std::numeric_limits<double>::infinity();
  const Result result = solve(model, analysis_of(AnalysisType::critical, StateOutput::none));
  EXPECT_THAT(result.diagnostics.skipped, Contains(HasSubstr("foundation soil: stiffness beyond")));
}

}  // namespace
}  // namespace snapthrough
