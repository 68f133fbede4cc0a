/// Points near lines: against a look at all points.
#include "solver/geometry/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace snapthrough {
namespace {

std::vector<int> near_by_looking_at_all(const std::vector<PlanePoint>& points, const PlanePoint& a,
                                        const PlanePoint& b, double distance) {
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    if (distance_to_line(points[static_cast<std::size_t>(i)], a, b) <= distance) out.push_back(i);
  return out;
}

std::vector<int> near(const PointTree& tree, const PlanePoint& a, const PlanePoint& b, double distance) {
  std::vector<int> out;
  tree.near(a, b, distance, out);
  std::sort(out.begin(), out.end());
  return out;
}

TEST(PointTree, DistancesToALineEndAtItsEnds) {
  EXPECT_DOUBLE_EQ(distance_to_line({1.0, 2.0}, {0.0, 0.0}, {3.0, 0.0}), 2.0);
  EXPECT_DOUBLE_EQ(distance_to_line({-3.0, 4.0}, {0.0, 0.0}, {3.0, 0.0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_line({6.0, 4.0}, {0.0, 0.0}, {3.0, 0.0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_line({3.0, 4.0}, {0.0, 0.0}, {0.0, 0.0}), 5.0);
}

/// Points all over a square, on a line along an axis, in one place, and with one far away.
TEST(PointTree, FindsWhatALookAtAllPointsFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int form = 0; form < 4; ++form) {
    std::vector<PlanePoint> points;
    for (int i = 0; i < 500; ++i) {
      const PlanePoint square{uniform(random), uniform(random)};
      points.push_back(form == 1 ? PlanePoint{square[0], 0.25} : form == 2 ? PlanePoint{0.5, 0.5} : square);
    }
    if (form == 3) points.push_back({1e6, -1e6});
    const PointTree tree(points);
    std::size_t found = 0;
    for (int query = 0; query < 200; ++query) {
      const PlanePoint a{uniform(random), uniform(random)};
      const PlanePoint b = query % 4 == 0   ? a
                           : query % 4 == 1 ? PlanePoint{uniform(random), a[1]}
                                            : PlanePoint{uniform(random), uniform(random)};
      const double distance = 0.2 * uniform(random) * uniform(random);
      const std::vector<int> expected = near_by_looking_at_all(points, a, b, distance);
      ASSERT_EQ(near(tree, a, b, distance), expected) << "form " << form << ", query " << query;
      found += expected.size();
    }
    EXPECT_GT(found, 100u) << form;
  }
  EXPECT_TRUE(near(PointTree({}), {0.0, 0.0}, {1.0, 0.0}, 1.0).empty());
}

}  // namespace
}  // namespace snapthrough
