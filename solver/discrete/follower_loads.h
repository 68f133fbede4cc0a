#pragma once
/// @file
/// Loads that follow the structure, beyond what elements know of them: the nonsymmetric part of the tangent
/// of pressures, and point forces that turn with the section on which they act or stay on a line.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "solver/discrete/low_rank.h"
#include "solver/support/regime.h"

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

/// @brief Point force whose action depends on the motion (u, v, b) of its place. The load vectors hold the
/// dead force F; this adds the rest, whose derivative has no counterpart that would make the tangent
/// symmetric.
///
/// A force that turns with its place adds the force (R(b) - 1) F. A force that stays on its line adds its
/// moment about the place, which has moved away from the line: v F_x - u F_y.
struct FollowerForce {
  /// Unknowns of x, y and rotation with one weight; displacement and rotation are their weighted sums.
  struct Term {
    int x = 0;
    int y = 0;
    int turn = 0;
    double weight = 1.0;
  };
  std::vector<Term> terms;
  std::array<double, 2> proportional{};  ///< F per unit load factor
  std::array<double, 2> constant{};
  bool fixed_line = false;  ///< stays on its line; else turns
};

/// @brief Converts solutions with the symmetric tangent S into solutions with J = S + L R^T, and adds what
/// following forces do to residuals and products.
///
/// L R^T has two columns for each FollowerEnd and one for each FollowerForce. Such loads have no potential;
/// without this part Newton's method converges slowly or not at all.
class FollowerLoads {
 public:
  FollowerLoads(const std::vector<FollowerEnd>& ends, const std::vector<FollowerForce>& forces)
      : ends_(ends), forces_(forces) {}

  [[nodiscard]] bool empty() const { return ends_.empty() && forces_.empty(); }
  /// @brief Prepares corrections for the current factors of S, at the unknowns y.
  /// @param solve x := S^-1 x
  /// @return det J / det S
  double prepare(const Eigen::VectorXd& y, const LoadFactors& factors,
                 const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve);
  /// @brief Whether corrections are those of J^T, from the next prepare() on.
  void transpose(bool transposed) { transposed_ = transposed; }
  /// x := J^-1 r from x = S^-1 r.
  void correct(const Eigen::Ref<Eigen::VectorXd>& x) const { part_.correct(x); }
  /// Adds L R^T direction at the unknowns y to `out`.
  void add_product(const Eigen::VectorXd& y, const LoadFactors& factors,
                   const Eigen::Ref<const Eigen::VectorXd>& direction, Eigen::Ref<Eigen::VectorXd> out) const;
  /// @brief Adds the derivative of L R^T along a direction, times `direction`.
  /// @param rates changes of the load factors along it
  void add_change(const Eigen::VectorXd& y, const LoadFactors& factors, const LoadFactors& rates,
                  const Eigen::VectorXd& along, const Eigen::Ref<const Eigen::VectorXd>& direction,
                  Eigen::Ref<Eigen::VectorXd> out) const;
  /// Adds what the motion of their places changes in the forces to a load vector.
  void add_load(const Eigen::VectorXd& y, const LoadFactors& factors, Eigen::Ref<Eigen::VectorXd> out) const;

 private:
  const std::vector<FollowerEnd>& ends_;
  const std::vector<FollowerForce>& forces_;
  bool transposed_ = false;
  LowRankPart part_;
};

}  // namespace snapthrough
