#pragma once
/// @file
/// Limit loads of supports whose laws have a capacity.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/discrete/free_motions.h"

namespace snapthrough {

/// Largest actions that supports with a capacity hold, and the motion on which greater ones escape.
struct CapacityEnd {
  double factor = 0.0;     ///< factor on the proportional actions, beside the constant ones in full
  Eigen::VectorXd motion;  ///< unknowns of the rigid parts, length one
  std::vector<std::string> supports;  ///< ids of the springs and foundations that are at their capacity
};

/// @brief Limit load of rigid parts on supports with a capacity, by the theorems of limit analysis (D.
/// Drucker, W. Prager, H. Greenberg, Quart. Appl. Math. 9 (1952) 381).
///
/// V: strain-free motions of the structure without its one-sided supports and without its supports with a
/// capacity. D(v): work of the latter at their capacities c on a motion v in V, the sum of c |g.v|, or of
/// c max(g.v, 0) for a one-sided one, with g the displacement into the support as functional on V. K: the
/// motions that enter no one-sided support without capacity. With small displacements, actions F are in
/// equilibrium if and only if  F.v < D(v)  for all v in K with D(v) > 0 or F.v > 0 (UnilateralBalance is the
/// case D = 0). Hence the limit of C + lambda P is
///
///   min over v in K with P.v = 1  of  D(v) - C.v .
///
/// Actions F are in equilibrium if and only if (F, 1) is in the cone of all (r, 1), (0, 1) and (g, 0): r the
/// reactions at their capacities against a motion, g a place of a one-sided support without capacity.
/// Non-negative least squares give the distance of (C + lambda P, 1) from the cone of those that were found
/// so far, at the least upper bound lambda so far. The residual is the next motion: its reactions and the
/// places that it enters are added, and it may lower lambda. The search ends where the residual vanishes,
/// which is the lower bound theorem.
class CapacityBalance {
 public:
  /// @param motions with HeldBy::without_capacity; kept by reference
  explicit CapacityBalance(const FreeMotions& motions);

  /// @brief The motion on which the constant actions alone exceed the capacities; empty: they are held. The
  /// factor is the share of the constant actions that is held.
  [[nodiscard]] std::optional<CapacityEnd> end_of_constant() const;
  /// @brief Largest load factor of one sense, with the constant actions in full.
  /// @param direction of the load factor: 1 or -1, which is the sign of CapacityEnd::factor
  /// @return empty: the supports hold any load factor of this sense
  /// @pre end_of_constant() is empty
  [[nodiscard]] std::optional<CapacityEnd> end(double direction) const;

 private:
  /// A support without capacity, or with one, along a part of a member or at a place.
  struct Support {
    std::string id;
    bool one_sided = false;
    std::vector<double> places;        ///< fractions that divide the range into smooth parts; one: a spring
    const AxisCurve* curve = nullptr;  ///< axis of a member on which the displacement is not linear, or null
    std::function<Eigen::VectorXd(double)> row;  ///< displacement into the support at a fraction, on V
    std::function<double(double)> capacity;      ///< per fraction of the member; empty: no bound
  };
  [[nodiscard]] Eigen::VectorXd on_motions(const RigidParts::Row& row) const;
  void add(const ResolvedSpring& spring);
  void add(const ResolvedFoundation& foundation);
  void add_loads();
  [[nodiscard]] Eigen::VectorXd reactions_on(const Support& support, const Eigen::VectorXd& motion) const;
  [[nodiscard]] Eigen::VectorXd reactions_on(const Eigen::VectorXd& motion) const;
  [[nodiscard]] bool add_entered(const Eigen::VectorXd& motion, Eigen::MatrixXd& cone) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> unbounded_escape(const Eigen::VectorXd& force) const;
  [[nodiscard]] std::optional<CapacityEnd> end_of(const Eigen::VectorXd& constant,
                                                  const Eigen::VectorXd& growing) const;
  [[nodiscard]] std::vector<std::string> resisting(const Eigen::VectorXd& motion) const;

  const FreeMotions& motions_;
  std::vector<Support> capped_;
  std::vector<Support> unbounded_;  ///< one-sided supports without capacity
  Eigen::VectorXd constant_;        ///< actions on V
  Eigen::VectorXd proportional_;
};

/// Limit loads of a model's supports with a capacity.
struct CapacityEnds {
  FreeMotions motions;                  ///< to which the motions of the ends belong
  std::optional<CapacityEnd> constant;  ///< the constant actions alone exceed the capacities
  std::optional<CapacityEnd> growing;   ///< limit of positive load factors
  std::optional<CapacityEnd> falling;   ///< limit of negative load factors

  /// Limit on the side of a load factor's sense.
  [[nodiscard]] const std::optional<CapacityEnd>& of(double factor) const {
    return factor < 0.0 ? falling : growing;
  }
  /// @brief Whether no equilibrium exists at a load factor with small displacements. A load factor within the
  /// search's accuracy of the limit counts as beyond it.
  [[nodiscard]] bool is_beyond(double factor) const;
};

/// @brief Limit loads of a model; null: its supports hold any load factor, none has a capacity, the reaction
/// of some support falls beyond a peak (has_falling_laws()), or a joint has a law (has_joint_laws()).
/// @param model kept by reference
/// @pre the model passed check()
[[nodiscard]] std::shared_ptr<const CapacityEnds> capacity_ends(const ResolvedModel& model);

}  // namespace snapthrough
