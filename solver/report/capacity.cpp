#include "solver/report/capacity.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/report/escape_text.h"

namespace snapthrough {
namespace {

std::string list_of(const std::vector<std::string>& ids) {
  std::string text = "\"" + ids.front() + "\"";
  const std::size_t named = std::min(ids.size(), static_cast<std::size_t>(MessageLimits::items));
  for (std::size_t i = 1; i < named; ++i) text += ", \"" + ids[i] + "\"";
  if (named < ids.size()) text += " and " + std::to_string(ids.size() - named) + " more";
  return text;
}

}  // namespace

CapacityLimit capacity_limit(const ResolvedModel& model, const CapacityEnds& ends, const CapacityEnd& end,
                             double load_factor) {
  CapacityLimit out;
  out.load_factor = load_factor;
  out.supports = end.supports;
  const Eigen::VectorXd motion = ends.motions.of_nodes(end.motion);
  double displaced = 0.0;
  for (std::size_t j = 0; j < model.nodes.size(); ++j)
    displaced = std::max(displaced, DofMap::displacement(motion, static_cast<Eigen::Index>(j)).norm());
  const double turned = motion.lpNorm<Eigen::Infinity>();
  const bool turns_only = displaced <= Rounding::motion * turned;
  const double unit = turns_only ? turned : displaced;
  const auto cleaned = [](double value) { return std::abs(value) <= Rounding::motion ? 0.0 : value; };
  for (std::size_t j = 0; j < model.nodes.size(); ++j) {
    const Eigen::Vector3d d = DofMap::at(motion, static_cast<Eigen::Index>(j)) / unit;
    if (d.lpNorm<Eigen::Infinity>() <= Rounding::motion) continue;
    out.nodes.push_back({model.nodes[j].id, cleaned(d[0]), cleaned(d[1]),
                         cleaned(d[2]) / (turns_only ? 1.0 : ends.motions.parts().length())});
  }
  return out;
}

std::string capacity_text(const ResolvedModel& model, const CapacityEnds& ends, const CapacityEnd& end) {
  const bool is_constant = ends.constant && &end == &*ends.constant;
  const double factor = is_constant ? 0.0 : end.factor;
  const Escape escape{end.motion, true, {1.0, factor}};
  return motion_of_escape(model, ends.motions, escape) + ": " +
         (end.supports.empty()
              ? std::string("no support resists this")
              : "the supports that resist this are at their capacity (" + list_of(end.supports) + ")") +
         ", and " + driver_of_escape(ends.motions, escape) + " drives it";
}

}  // namespace snapthrough
