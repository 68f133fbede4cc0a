#pragma once
/// @file
/// Stability of a structure with one-sided supports that touch without pressure.

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Lowest buckling load of a piece: linear problem in which a set of touching supports acts, the others not.
struct Piece {
  double load = 0.0;     ///< smallest buckling load above zero
  Eigen::VectorXd mode;  ///< buckling mode, largest displacement one
};

/// Buckling functions of the piece that is currently set.
struct PieceSolver {
  /// Lowest buckling load; empty: none exists, or the piece is unstable under the constant actions alone.
  std::function<std::optional<Piece>()> lowest;
  /// Rayleigh quotient of a motion.
  std::function<double(const Eigen::VectorXd&)> quotient;
};

struct LeastPiece {
  bool found = false;
  bool certain = false;  ///< the load is proven to be the least over all admissible pieces
  double above = 0.0;    ///< lower bound of the critical load
  /// Critical motion, oriented into the foundations that it meets; empty when only springs touch.
  Eigen::VectorXd motion = {};
};

/// @brief Sets the touching supports in a frozen contact to the piece that becomes unstable first.
///
/// Each touching support resists motions v into it and no others, so the second variation of the energy,
///
///   Q(v) = v.K(lambda) v + sum_i k_i max(d_i.v, 0)^2,
///
/// is quadratic in each cone of motions that meet the same supports. The structure is stable while Q > 0 for
/// all v. At the critical load the critical motion is the lowest mode of the piece of its own cone: Q is C1,
/// hence stationary there, and a lower mode of that piece would make Q negative nearby. The critical load is
/// therefore the least lowest load among the pieces whose mode lies in their own cone. The load of a piece is
/// a lower bound for all pieces with additional supports.
///
/// Springs only: pieces are visited in ascending order of load, starting without springs, until a mode lies
/// in its own cone; the result is proven. Foundations: the Rayleigh quotient of Q is minimised from the modes
/// of the structure without and with all touching supports, in both senses, each step towards the lowest mode
/// of the current piece.
/// @param marks touching supports of the prestress
/// @param near critical motion on a coarser mesh, then the only starting point; empty: unknown
/// @param contact frozen contact of the prestress that `solver` uses; set to the resulting piece
[[nodiscard]] LeastPiece set_least_piece(const StructuralProblem& problem, const PieceSolver& solver,
                                         const TouchingMarks& marks, const Eigen::VectorXd& near,
                                         FrozenContact& contact);

}  // namespace snapthrough
