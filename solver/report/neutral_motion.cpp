#include "solver/report/neutral_motion.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "solver/mesh/dof_map.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Limits of the normal form of neutral motions; chosen far above rounding.
struct NeutralMotionLimits {
  /// Least component, over the largest, that may be a pivot or give a motion its sign.
  static constexpr double pivot = 1e-3;
};

/// Reduces the motions (columns) by Gauss-Jordan elimination in the order of the components.
MatrixXd reduced(MatrixXd motions) {
  Index done = 0;
  for (Index row = 0; row < motions.rows() && done < motions.cols(); ++row) {
    Index pivot = done;
    for (Index c = done; c < motions.cols(); ++c)
      if (std::abs(motions(row, c)) > std::abs(motions(row, pivot))) pivot = c;
    // a small pivot would amplify rounding in the other motions
    if (std::abs(motions(row, pivot)) < NeutralMotionLimits::pivot * motions.cwiseAbs().maxCoeff()) continue;
    motions.col(done).swap(motions.col(pivot));
    for (Index c = 0; c < motions.cols(); ++c)
      if (c != done) motions.col(c) -= motions(row, c) / motions(row, done) * motions.col(done);
    ++done;
  }
  return motions;
}

NeutralMotion told(const Structure& structure, const Eigen::VectorXd& motion) {
  const ResolvedModel& model = *structure.model;
  double displaced = 0.0;
  for (int j = 0; j < structure.first_ground; ++j)
    displaced = std::max(displaced, std::hypot(motion[DofMap::first(j)], motion[DofMap::first(j) + 1]));
  const double turned = motion.lpNorm<Eigen::Infinity>();
  const bool turns_only = displaced <= Rounding::motion * turned;
  // the first large component becomes positive
  double sign = 1.0;
  for (Index i = motion.size(); i-- > 0;)
    if (std::abs(motion[i]) > NeutralMotionLimits::pivot * turned) sign = motion[i] < 0.0 ? -1.0 : 1.0;
  const double unit = sign * (turns_only ? turned : displaced);
  const double length = structure.scales.length;
  NeutralMotion out;
  for (int j = 0; j < structure.first_ground; ++j) {
    const Eigen::Vector3d d = DofMap::at(motion, j) / unit;
    if (d.lpNorm<Eigen::Infinity>() <= Rounding::motion) continue;
    const auto cleaned = [](double value) { return std::abs(value) <= Rounding::motion ? 0.0 : value; };
    out.nodes.push_back({model.nodes[static_cast<std::size_t>(j)].id, turns_only ? 0.0 : cleaned(d[0]),
                         turns_only ? 0.0 : cleaned(d[1]), cleaned(d[2]) / (turns_only ? 1.0 : length)});
  }
  return out;
}

}  // namespace

std::vector<NeutralMotion> neutral_motions(const Structure& structure, const SharedHolds& holds) {
  std::vector<NeutralMotion> out;
  if (!holds) return out;
  const MatrixXd motions = reduced(holds->motions);
  for (Index i = 0; i < motions.cols(); ++i) out.push_back(told(structure, motions.col(i)));
  return out;
}

void NeutralMotionLog::note(const SharedHolds& holds, double load_factor) {
  if (holds == holds_) return;
  holds_ = holds;
  // motions released at the load factor where they were pinned were never free
  std::erase_if(out_, [&](const NeutralMotion& motion) {
    return motion.branch == branch_ && !motion.to && motion.from == load_factor;
  });
  for (NeutralMotion& motion : out_)
    if (motion.branch == branch_ && !motion.to) motion.to = load_factor;
  for (NeutralMotion& motion : neutral_motions(structure_, holds_)) {
    motion.branch = branch_;
    motion.from = load_factor;
    out_.push_back(std::move(motion));
  }
}

}  // namespace snapthrough
