#include "server/jobs/path_batch.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace snapthrough::server {
namespace {

constexpr std::size_t kMostNumbers = 2000;
constexpr std::size_t kMostMonitors = 100;

}  // namespace

void PathBatch::add(const TracedPoint& point) {
  if (numbers_ >= kMostNumbers) {
    return;
  }
  points_.push_back(point);
  std::vector<NamedValue>& monitors = points_.back().monitors;
  monitors.resize(std::min(monitors.size(), kMostMonitors));
  numbers_ += 5 + monitors.size();
}

void PathBatch::clear() {
  points_.clear();
  numbers_ = 0;
}

std::string path_points_document(const std::vector<TracedPoint>& points) {
  using nlohmann::ordered_json;
  const auto column = [&](auto TracedPoint::*field) {
    ordered_json values = ordered_json::array();
    for (const TracedPoint& point : points) {
      values.push_back(point.*field);
    }
    return values;
  };
  ordered_json document{{"branch", column(&TracedPoint::branch)},
                        {"step", column(&TracedPoint::step)},
                        {"load_factor", column(&TracedPoint::load_factor)},
                        {"arc_length", column(&TracedPoint::arc_length)},
                        {"negative_eigenvalues", column(&TracedPoint::negative_eigenvalues)},
                        {"monitors", ordered_json::array()}};
  const std::vector<NamedValue>& monitors = points.front().monitors;
  for (std::size_t i = 0; i < monitors.size(); ++i) {
    ordered_json values = ordered_json::array();
    for (const TracedPoint& point : points) {
      values.push_back(i < point.monitors.size() ? ordered_json(point.monitors[i].value) : ordered_json());
    }
    document["monitors"].push_back({{"id", monitors[i].id}, {"values", std::move(values)}});
  }
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace snapthrough::server
