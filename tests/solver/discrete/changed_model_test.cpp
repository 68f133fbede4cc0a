/// Structures of changed models, which take over what the change leaves, against the same structures built
/// without anything to take over.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/discrete/structure.h"
#include "solver/numeric/pseudo_random.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// An arch with every kind of support, load and imperfection that a structure reads.
Model arch_with_everything() {
  Model model = testing::arch(60.0, 4e4, 900.0);
  testing::add_soil(model, 30.0);
  testing::add_soil(model, 20.0, Side::right);
  model.foundations[1].gap = 0.1;
  Foundation bilateral = model.foundations[0];
  bilateral.id = "layer";
  bilateral.reaction = Reaction::bilateral;
  bilateral.shear_stiffness = 3.0;
  bilateral.range = {0.25, 0.5};
  model.foundations.push_back(bilateral);
  model.springs = {
      {"inside", {"", "arch", 0.75}, std::array{0.0, -1.0}, 2.0, Reaction::compression_only, 0.0},
      {"end", {"b", "", 0.0}, std::nullopt, 5.0, Reaction::bilateral, 0.0}};
  model.loads.push_back(DistributedLoad{"arch", {0.0, -1e-3}, {0.0, 1.0}, LoadMeasure::horizontal});
  model.loads.push_back(PressureLoad{"arch", 1e-4, Side::left, Pattern::proportional});
  model.loads.push_back(InitialStrain{"arch", 1e-6, 1e-7, Pattern::constant});
  model.imperfections = {SineImperfection{"arch", 2, 0.01}};
  return model;
}

struct Change {
  std::string name;
  std::function<void(Model&)> apply;
};

/// Changes of one part of a model each.
std::vector<Change> changes() {
  return {{"nothing", [](Model&) {}},
          {"stiffness", [](Model& m) { m.foundations[0].stiffness *= 1.7; }},
          {"no stiffness", [](Model& m) { m.foundations[0].stiffness = 0.0; }},
          {"gap", [](Model& m) { m.foundations[1].gap = 0.3; }},
          {"reaction", [](Model& m) { m.foundations[1].reaction = Reaction::tension_only; }},
          {"range",
           [](Model& m) {
             m.foundations[0].range = {0.0, 0.6};
           }},
          {"shear layer", [](Model& m) { m.foundations[2].shear_stiffness = 4.0; }},
          {"spring", [](Model& m) { m.springs[0].stiffness = 1.0; }},
          {"place of a spring", [](Model& m) { m.springs[0].at.fraction = 0.8; }},
          {"section", [](Model& m) { m.sections[0].EI *= 0.9; }},
          {"shear", [](Model& m) { m.sections[0].GA = 1e4; }},
          {"load",
           [](Model& m) {
             std::get<PointLoad>(m.loads[0]).force = {0.1, -0.2};
           }},
          {"pressure", [](Model& m) { std::get<PressureLoad>(m.loads[2]).value = 2e-4; }},
          {"strain", [](Model& m) { std::get<InitialStrain>(m.loads[3]).axial = 2e-6; }},
          {"imperfection", [](Model& m) { std::get<SineImperfection>(m.imperfections[0]).amplitude = 0.02; }},
          {"support", [](Model& m) { m.supports[0].angle_degrees = 30.0; }},
          {"displacement",
           [](Model& m) {
             m.supports[0].displacement = {0.0, 0.1, 0.0, Pattern::constant};
           }},
          {"node", [](Model& m) { m.nodes[1].x += 0.5; }},
          {"curve", [](Model& m) { m.members[0].curve = ArcCurve{-70.0}; }}};
}

/// Everything that the equations have at one state, one column each.
MatrixXd equations_of(const Structure& structure) {
  StructuralProblem problem(structure);
  const VectorXd y = 1e-3 * pseudo_random(structure.size, 1U);
  const MatrixXd motions = pseudo_random(structure.size, 2U);
  MatrixXd out(structure.size, 4);
  VectorXd column;
  problem.residual(y, 0.7, column);
  out.col(0) = column;
  out.col(1) = problem.tangent_products(y, 0.7, motions);
  problem.load(y, 0.7, column);
  out.col(2) = column;
  out.col(3) = structure.metric;
  return out;
}

class ChangedModel : public ::testing::TestWithParam<FoundationRule> {
 protected:
  [[nodiscard]] Structure reference(const Model& model) const {
    Discretization mesh;
    mesh.fixed_mesh = true;
    mesh.elements = 6;
    mesh.order = 4;
    mesh.foundation = GetParam();
    return make_structure(resolve(model), mesh, Geometry::nonlinear);
  }
};

TEST_P(ChangedModel, HasTheEquationsOfOneThatTakesNothingOver) {
  const Model model = arch_with_everything();
  const Structure structure = reference(model);
  // another shape of the axis, from which no part can be taken over; its scales are those of the reference
  Model other = model;
  other.members[0].curve = ArcCurve{-50.0};
  const Structure of_other = with_changed_model(structure, resolve(other), {});
  for (const Change& change : changes()) {
    SCOPED_TRACE(change.name);
    Model changed = model;
    change.apply(changed);
    const Structure taken = with_changed_model(structure, resolve(changed), {});
    const Structure anew = with_changed_model(of_other, resolve(changed), {});
    EXPECT_EQ(equations_of(taken), equations_of(anew));
    EXPECT_EQ(taken.skipped, anew.skipped);
    EXPECT_EQ(taken.has_constant, anew.has_constant);
    EXPECT_EQ(taken.foundation_parts.size(), anew.foundation_parts.size());
  }
}

TEST_P(ChangedModel, TakesOverAxesWhereNodesMembersAndImperfectionsAreTheSame) {
  const Model model = arch_with_everything();
  const Structure structure = reference(model);
  Model changed = model;
  changed.foundations[0].stiffness *= 2.0;
  EXPECT_EQ(with_changed_model(structure, resolve(changed), {}).axes, structure.axes);
  changed.imperfections.clear();
  EXPECT_NE(with_changed_model(structure, resolve(changed), {}).stress_free, structure.stress_free);
}

INSTANTIATE_TEST_SUITE_P(Rules, ChangedModel,
                         ::testing::Values(FoundationRule::consistent, FoundationRule::lumped));

}  // namespace
}  // namespace snapthrough
