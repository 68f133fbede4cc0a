#pragma once
/// @file
/// Nonsymmetric part of the tangent of follower pressures: at free ends of pressed lines, and where the
/// pressure changes along them.

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace snapthrough {

/// Place at which the residual has the derivative  -c [0 1; -1 0]  with respect to its displacement (x, y) in
/// addition to the symmetric tangent, c as proportional and constant parts. At a movable node where a pressed
/// line ends or the pressure jumps, c is half the difference of the pressures that meet there. At a Gauss
/// point of an element whose pressure changes, c is minus half its weight times the change.
struct FollowerEnd {
  /// Unknown of x, unknown of y and weight; the displacement is the sum of the weighted unknowns.
  struct Term {
    int x = 0;
    int y = 0;
    double weight = 1.0;
  };
  std::vector<Term> terms;
  double proportional = 0.0;
  double constant = 0.0;
};

/// @brief Converts solutions with the symmetric tangent S into solutions with J = S + E A E^T.
///
/// E gives the displacements of the ends, A has a block per end. Sherman-Morrison-Woodbury formula: J^-1 r
/// = x - W (I + A E^T W)^-1 A E^T x,  x = S^-1 r,  W = S^-1 E. Follower pressure on a free boundary is not
/// conservative; without this part Newton's method converges slowly or not at all.
class FollowerEnds {
 public:
  explicit FollowerEnds(const std::vector<FollowerEnd>& ends) : ends_(ends) {}

  [[nodiscard]] bool empty() const { return ends_.empty(); }
  /// @brief Prepares corrections for the current factors of S.
  /// @param solve x := S^-1 x
  /// @return det J / det S
  double prepare(double proportional, double constant, Eigen::Index size,
                 const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve);
  /// x := J^-1 r from x = S^-1 r.
  void correct(Eigen::Ref<Eigen::VectorXd> x) const;
  /// Adds E A E^T direction to `out`, for the given load factors.
  void add_product(double proportional, double constant, const Eigen::Ref<const Eigen::VectorXd>& direction,
                   Eigen::Ref<Eigen::VectorXd> out) const;

 private:
  [[nodiscard]] Eigen::VectorXd weighted(const Eigen::Ref<const Eigen::VectorXd>& x) const;

  const std::vector<FollowerEnd>& ends_;
  std::vector<double> c_;
  Eigen::MatrixXd W_;
  Eigen::MatrixXd inverse_;
};

}  // namespace snapthrough
