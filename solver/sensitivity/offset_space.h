#pragma once
/// @file
/// The stress-free offsets among which a worst imperfection is sought.

#include <Eigen/Core>
#include <vector>

#include "solver/geometry/cubic_spline.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Offsets of all members along their left normals: on each member the C2 spline of a
/// PointsImperfection through kPoints values at equally spaced interior points, zero at both ends.
///
/// Coefficients are the values in the model's units, kPoints per member, members in the model's order. The
/// zeros keep members at their nodes. A half wave needs about two points, so that the space has up to
/// kPoints / 2 half waves per member.
class OffsetSpace {
 public:
  static constexpr int kPoints = 15;  ///< interior points per member, at fractions i / (kPoints + 1)

  /// @param lengths undeformed length of each member
  explicit OffsetSpace(std::vector<double> lengths);

  [[nodiscard]] Eigen::Index size() const { return kPoints * static_cast<Eigen::Index>(lengths_.size()); }
  /// @brief Root mean square over the length of all members, or the largest |w| of the splines.
  [[nodiscard]] double norm(OffsetNorm norm, const Eigen::VectorXd& offsets) const;
  /// @brief Offsets of norm one that maximise gradient . offsets; zero where the gradient is.
  ///
  /// rms: the gradient's representative in the inner product of the norm. max: a linear program per member,
  /// |w| <= 1 at eight points of each interval, by affine scaling (Dikin, Soviet Math. Dokl. 8, 1967), then
  /// scaled to max |w| = 1 on the member.
  [[nodiscard]] Eigen::VectorXd steepest(OffsetNorm norm, const Eigen::VectorXd& gradient) const;
  /// @brief The offsets as they stand in a request, one entry per member.
  [[nodiscard]] std::vector<MemberOffsets> member_offsets(const ResolvedModel& model,
                                                          const Eigen::VectorXd& offsets) const;

 private:
  [[nodiscard]] Eigen::VectorXd steepest_within_one(const Eigen::VectorXd& gradient) const;

  std::vector<double> lengths_;
  double length_ = 0.0;      ///< total length of the members
  Eigen::MatrixXd gram_;     ///< integrals of products of two cardinal splines over the fraction
  Eigen::MatrixXd samples_;  ///< cardinal splines at the points of the linear program, one row per point
};

}  // namespace snapthrough
