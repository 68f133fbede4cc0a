#pragma once
/// @file
/// Stability where one-sided supports touch without pressure: the least load over the pieces of the tangent.

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// A piece is the linear problem in which some of the touching supports act and the others are absent.
struct Piece {
  double load = 0.0;     ///< the lowest above zero
  Eigen::VectorXd mode;  ///< largest displacement one
};

/// What the search asks of the piece that is set.
struct PieceSolver {
  /// Its lowest buckling load; empty: there is none, or it is unstable under the constant actions alone.
  std::function<std::optional<Piece>()> lowest;
  /// Rayleigh's quotient of a motion.
  std::function<double(const Eigen::VectorXd&)> quotient;
};

struct LeastPiece {
  bool found = false;
  bool certain = false;  ///< no piece has a lower load that its mode does not contradict
  double above = 0.0;    ///< a load that the least one is not below
  /// The critical motion of foundations, in the sense in which it meets them; empty where springs alone
  /// touch.
  Eigen::VectorXd motion = {};
};

/// @brief Sets the touching supports in a frozen contact to the piece that becomes unstable first.
///
/// Each touching support resists motions v into it and no others, so the second variation of the energy,
///
///   Q(v) = v.K(lambda) v + sum_i k_i max(d_i.v, 0)^2,
///
/// is quadratic in each cone of motions that meet the same supports. The structure is stable while Q > 0 for
/// all v. Where that ends first, the motion is the lowest mode of the piece of its own cone: Q is
/// continuously differentiable, so it is stationary there, and above any lower mode of that piece Q would be
/// negative beside it. So the critical load is the least lowest load of a piece whose mode is in the piece's
/// own cone, and each piece's load is a lower bound of all that have more supports.
///
/// Springs only: pieces are taken in the order of their loads, from none that acts on, until one's mode is in
/// its cone. That one is the least, with certainty. Foundations: Rayleigh's quotient of Q falls from the
/// modes of the free and of the glued structure, both ways, each step towards the lowest mode of the piece at
/// hand.
/// @param near the critical motion of a coarser mesh, from which alone it falls then; empty: not known
/// @param contact of the prestress that `solver` uses; the solver computes with what is set here
/// @param marks of the same prestress
[[nodiscard]] LeastPiece set_least_piece(const StructuralProblem& problem, const PieceSolver& solver,
                                         const TouchingMarks& marks, const Eigen::VectorXd& near,
                                         FrozenContact& contact);

}  // namespace snapthrough
