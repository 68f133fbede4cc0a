/// One-sided members as springs: their weights.
#include "solver/resolve/rods.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <variant>
#include <vector>

#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

/// A column beside a tie of mass 3 per length and length 2, and weights of gravity 1, 2, ... downwards.
Model tied_column(int weights) {
  Model model = testing::column(10.0, 1.0, 1e6, 0.0);
  model.nodes.push_back({"top", 10.0, 2.0});
  model.sections.push_back({"tie", 5.0, 1.0, {}});
  model.sections.back().mass = 3.0;
  Member tie;
  tie.id = "tie";
  tie.start = "b";
  tie.end = "top";
  tie.section = "tie";
  tie.reaction = Reaction::tension_only;
  model.members.push_back(tie);
  model.loads.clear();
  for (int i = 1; i <= weights; ++i)
    model.loads.push_back(
        SelfWeight{{0.0, -1.0 * i}, i % 2 == 0 ? Pattern::constant : Pattern::proportional});
  return model;
}

TEST(Rods, HaveOneWeightForEachNodeAndPatternHoweverManyLoadsMakeIt) {
  const auto changed = with_rods_as_springs(tied_column(100));
  ASSERT_TRUE(changed.has_value());
  std::vector<PointLoad> points;
  for (const Load& load : changed->loads)
    if (const auto* point = std::get_if<PointLoad>(&load)) points.push_back(*point);
  ASSERT_EQ(points.size(), 4U);
  for (const PointLoad& point : points) {
    const double gravity =
        point.pattern == Pattern::constant ? 2550.0 : 2500.0;  // 2 + 4 + ... + 100, 1 + ... + 99
    EXPECT_DOUBLE_EQ(point.force[1], -0.5 * 3.0 * 2.0 * gravity);
    EXPECT_DOUBLE_EQ(point.force[0], 0.0);
  }
  EXPECT_EQ(changed->loads.size(), 104U) << "the weights of the other members stay";
}

TEST(Rods, HaveNoLoadOfWeightsThatCancel) {
  Model model = tied_column(0);
  model.loads = {SelfWeight{{0.0, -1.0}, Pattern::constant}, SelfWeight{{0.0, 1.0}, Pattern::constant}};
  EXPECT_EQ(with_rods_as_springs(model)->loads.size(), 2U);
}

}  // namespace
}  // namespace snapthrough
