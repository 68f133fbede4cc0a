#include "solver/geometry/point_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace snapthrough {

namespace {

constexpr std::size_t kLeaf = 8;  ///< points that are not divided further

}  // namespace

double distance_to_line(const PlanePoint& point, const PlanePoint& a, const PlanePoint& b) {
  const double dx = b[0] - a[0];
  const double dy = b[1] - a[1];
  const double square = dx * dx + dy * dy;
  const double along = (point[0] - a[0]) * dx + (point[1] - a[1]) * dy;
  const double t = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  return std::hypot(point[0] - a[0] - t * dx, point[1] - a[1] - t * dy);
}

PointTree::PointTree(std::vector<PlanePoint> points) : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (points_.empty()) return;
  box_ = {points_.front(), points_.front()};
  for (const PlanePoint& point : points_) {
    for (const std::size_t side : {0, 1}) {
      box_.low[side] = std::min(box_.low[side], point[side]);
      box_.high[side] = std::max(box_.high[side], point[side]);
    }
  }
  sort(0, order_.size(), box_);
}

void PointTree::sort(std::size_t begin, std::size_t end, const Box& box) {
  if (end - begin <= kLeaf) return;
  const std::size_t side = box.longer_side();
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return std::next(order_.begin(), static_cast<std::ptrdiff_t>(i)); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](int i, int j) { return (*this)[i][side] < (*this)[j][side]; });
  Box below = box;
  Box above = box;
  below.high[side] = above.low[side] = (*this)[order_[middle]][side];
  sort(begin, middle, below);
  sort(middle + 1, end, above);
}

bool PointTree::Query::is_near(const PlanePoint& point) const {
  return distance_to_line(point, a, b) <= distance;
}

/// Whether a part of the line lies in the box that is larger by the distance on each side.
bool PointTree::Query::meets(const Box& box) const {
  double from = 0.0;
  double to = 1.0;
  for (const std::size_t side : {0, 1}) {
    const double low = box.low[side] - distance - a[side];
    const double high = box.high[side] + distance - a[side];
    const double d = b[side] - a[side];
    if (d == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    from = std::max(from, std::min(low / d, high / d));
    to = std::min(to, std::max(low / d, high / d));
  }
  return from <= to;
}

void PointTree::collect(const Query& query, std::size_t begin, std::size_t end, const Box& box,
                        std::vector<int>& out) const {
  if (!query.meets(box)) return;
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i)
      if (query.is_near((*this)[order_[i]])) out.push_back(order_[i]);
    return;
  }
  const std::size_t side = box.longer_side();
  const std::size_t middle = begin + (end - begin) / 2;
  Box below = box;
  Box above = box;
  below.high[side] = above.low[side] = (*this)[order_[middle]][side];
  if (query.is_near((*this)[order_[middle]])) out.push_back(order_[middle]);
  collect(query, begin, middle, below, out);
  collect(query, middle + 1, end, above, out);
}

void PointTree::near(const PlanePoint& a, const PlanePoint& b, double distance, std::vector<int>& out) const {
  collect({a, b, distance}, 0, order_.size(), box_, out);
}

}  // namespace snapthrough
