/// Warnings on geometry that only looks joined, in the results of every analysis.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

std::vector<std::string> geometry_codes(const Result& result) {
  std::vector<std::string> out;
  for (const Warning& warning : result.warnings)
    if (warning.code == "tee_unjoined" || warning.code == "stacked_members" || warning.code == "near_nodes")
      out.push_back(warning.code);
  return out;
}

/// A hinged column of EI = 1 pressed with the force 1, drawn once or twice.
Model column(bool twice) {
  Model model = straight(1.0, 1.0, 1e6, "xy", "y");
  model.sections[0].mass = 1.0;
  model.loads = {force_at(at_node("b"), -1.0, 0.0)};
  if (twice) {
    model.members.push_back(model.members[0]);
    model.members[1].id = "again";
  }
  return model;
}

/// Euler: pi^2 EI, twice as much for two columns side by side.
TEST(ApparentJoints, TwoColumnsDrawnOnOneAnotherCarryTwiceTheLoadAndAreTold) {
  for (const bool twice : {false, true}) {
    const Result result = solve_soundly(column(twice), buckling_on(fixed_mesh(4, 4)));
    ASSERT_FALSE(result.buckling->load_factors.empty());
    expect_relative(result.buckling->load_factors[0], (twice ? 2.0 : 1.0) * kPi * kPi, 1e-4, "load");
    EXPECT_EQ(geometry_codes(result),
              twice ? std::vector<std::string>{"stacked_members"} : std::vector<std::string>{});
  }
}

TEST(ApparentJoints, AreToldByEveryAnalysis) {
  Model model = column(true);
  model.nodes.push_back({"c", 0.5, 0.0});
  model.nodes.push_back({"d", 0.5, 1.0});
  model.nodes.push_back({"e", 0.5, 1.0 + 1e-4});
  model.nodes.push_back({"f", 0.5, 2.0});
  model.members.push_back({"post", "c", "d", "s", LineCurve{}, false, false});
  model.members.push_back({"mast", "e", "f", "s", LineCurve{}, false, false});
  model.supports.push_back(support("c", "xyr"));
  model.supports.push_back(support("e", "xyr"));
  const std::vector<std::string> expected = {"tee_unjoined", "stacked_members", "near_nodes"};
  const Discretization mesh = fixed_mesh(2, 3);
  Analysis critical = analysis_of(AnalysisType::critical, mesh);
  Analysis path = path_on(mesh, 1);
  path.stop.steps = 2;
  Analysis vibration = analysis_of(AnalysisType::vibration, mesh);
  vibration.modes = 1;
  vibration.load_factors = {0.0};
  for (const Analysis& analysis :
       {critical, path, vibration, buckling_on(mesh), static_on(mesh, Geometry::linear)})
    EXPECT_EQ(geometry_codes(solve(model, analysis)), expected) << static_cast<int>(analysis.type);
}

}  // namespace
}  // namespace snapthrough
