#pragma once
/// @file
/// Points of the plane, sorted so that those near a line are found.

#include <array>
#include <cstddef>
#include <vector>

namespace snapthrough {

using PlanePoint = std::array<double, 2>;

/// @brief Tree of points (Bentley, Comm. ACM 18, 1975): halves of the points lie on both sides of the middle
/// of the longer side of their box, and so on. Immutable, thread-safe; built in n log n operations.
class PointTree {
 public:
  explicit PointTree(std::vector<PlanePoint> points);

  /// @brief Adds the numbers of all points within a distance of the straight line from `a` to `b`, ends
  /// included, in no order. A point may be both ends. Visits the parts of the tree that the line comes near
  /// to.
  void near(const PlanePoint& a, const PlanePoint& b, double distance, std::vector<int>& out) const;

  [[nodiscard]] const PlanePoint& operator[](int point) const {
    return points_[static_cast<std::size_t>(point)];
  }

 private:
  /// Corners of a rectangle along the axes.
  struct Box {
    PlanePoint low{};
    PlanePoint high{};
    [[nodiscard]] std::size_t longer_side() const { return high[0] - low[0] >= high[1] - low[1] ? 0 : 1; }
  };
  /// Line with a distance, for near().
  struct Query {
    PlanePoint a;
    PlanePoint b;
    double distance;
    [[nodiscard]] bool meets(const Box& box) const;
    [[nodiscard]] bool is_near(const PlanePoint& point) const;
  };
  void sort(std::size_t begin, std::size_t end, const Box& box);
  void collect(const Query& query, std::size_t begin, std::size_t end, const Box& box,
               std::vector<int>& out) const;

  std::vector<PlanePoint> points_;
  std::vector<int> order_;  ///< the middle one of each part divides it and stays there
  Box box_;
};

/// Distance of a point from the straight line between two points, ends included.
[[nodiscard]] double distance_to_line(const PlanePoint& point, const PlanePoint& a, const PlanePoint& b);

}  // namespace snapthrough
