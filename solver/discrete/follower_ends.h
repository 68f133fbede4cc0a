#pragma once
/// @file
/// The unsymmetric part of follower pressures' tangent: at nodes where a pressed line ends free.

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace snapthrough {

/// A node, free to move in the plane, where a pressed line ends (or the pressure changes): the residual has
/// the derivative  -c [0 1; -1 0]  by its displacement (x, y) beyond the symmetric tangent, with c the
/// factors' sum of these, half the pressure that ends there.
struct FollowerEnd {
  int node = 0;
  double proportional = 0.0;
  double constant = 0.0;
};

/// @brief Turns solutions with the symmetric tangent S into solutions with J = S + E A E^T.
///
/// E picks the ends' displacements, A has a block a end. Sherman, Morrison and Woodbury:
/// J^-1 r = x - W (I + A E^T W)^-1 A E^T x,  x = S^-1 r,  W = S^-1 E. Follower pressure on a free boundary
/// does work that depends on the path; Newton's method without this part converges slowly or not at all.
class FollowerEnds {
 public:
  explicit FollowerEnds(const std::vector<FollowerEnd>& ends) : ends_(ends) {}

  [[nodiscard]] bool empty() const { return ends_.empty(); }
  /// @brief Prepares for the factors of S at hand.
  /// @param solve x := S^-1 x
  /// @return det J / det S
  double prepare(double proportional, double constant, Eigen::Index size,
                 const std::function<void(Eigen::VectorXd&)>& solve);
  /// x := J^-1 r from x = S^-1 r.
  void correct(Eigen::VectorXd& x) const;
  /// Adds E A E^T direction to `out`, with the factors given.
  void add_product(double proportional, double constant, const Eigen::Ref<const Eigen::VectorXd>& direction,
                   Eigen::Ref<Eigen::VectorXd> out) const;

 private:
  [[nodiscard]] Eigen::VectorXd weighted(const Eigen::VectorXd& x) const;

  const std::vector<FollowerEnd>& ends_;
  std::vector<double> c_;
  Eigen::MatrixXd W_;
  Eigen::MatrixXd inverse_;
};

}  // namespace snapthrough
