/// Structures that a look at their supports shows to be held, against the check that factorises them.
#include <gtest/gtest.h>

#include "solver/discrete/mechanism.h"
#include "solver/resolve/resolved_model.h"
#include "tests/verification/cases.h"
#include "tests/verification/random_column.h"

namespace snapthrough {
namespace {

using namespace testing;

TEST(PlainlyHeld, IsNeverSaidOfAMechanism) {
  int plain = 0;
  int mechanisms = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const Model model = random_column(seed);
    const bool held = !can_move(resolve(model));
    mechanisms += held ? 0 : 1;
    plain += is_plainly_held(resolve(model)) ? 1 : 0;
    EXPECT_TRUE(held || !is_plainly_held(resolve(model))) << "seed " << seed;
  }
  EXPECT_GT(plain, 500);
  EXPECT_GT(mechanisms, 100);
}

TEST(PlainlyHeld, IsSaidOfColumnsArchesAndFrames) {
  EXPECT_TRUE(is_plainly_held(resolve(straight(1.0, 1.0, 1e12, "xy", "y"))));
  EXPECT_TRUE(is_plainly_held(resolve(straight(1.0, 1.0, 1e12, "xyr", ""))));
  EXPECT_TRUE(is_plainly_held(resolve(arch(215.0, 1e8, 1e6))));
  Model frame = straight(1.0, 1.0, 1e6, "xy", "");
  frame.nodes.push_back({"c", 1.0, 1.0});
  frame.members.push_back({"n", "c", "b", "s", LineCurve{}, false, false});
  frame.supports.push_back(support("c", "y"));
  EXPECT_TRUE(is_plainly_held(resolve(frame)));
  // rollers whose lines of action meet in one point hold nothing against turning about it
  frame.supports = {support("a", "y"), support("b", "x"), support("c", "x", 45.0)};
  EXPECT_FALSE(is_plainly_held(resolve(frame)));
}

TEST(PlainlyHeld, IsNotSaidWhereItTakesAFactorisation) {
  const Model column = straight(1.0, 1.0, 1e12, "xy", "y");
  Model other = column;
  other.members[0].release_end_rotation = true;
  EXPECT_FALSE(is_plainly_held(resolve(other))) << "release";
  other = column;
  other.supports.pop_back();
  EXPECT_FALSE(is_plainly_held(resolve(other))) << "turns about its end";
  other = column;
  other.supports = {support("a", "y"), support("b", "y")};
  EXPECT_FALSE(is_plainly_held(resolve(other))) << "moves along itself";
  other = column;
  other.nodes.push_back({"c", 5.0, 0.0});
  other.nodes.push_back({"d", 6.0, 0.0});
  other.members.push_back({"n", "c", "d", "s", LineCurve{}, false, false});
  EXPECT_FALSE(is_plainly_held(resolve(other))) << "a part that nothing holds";
  other = column;
  other.sections[0].EA = 1e-9;
  EXPECT_FALSE(is_plainly_held(resolve(other))) << "soft";
}

}  // namespace
}  // namespace snapthrough
