#pragma once
/// @file
/// Equilibrium of loads on one-sided supports.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "solver/discrete/free_motions.h"
#include "solver/support/law.h"

namespace snapthrough {

/// Factors on the constant and on the proportional actions.
struct ActionFactors {
  double constant = 1.0;
  double proportional = 0.0;
};

/// Free motion that the supports do not prevent.
struct Escape {
  Eigen::VectorXd motion;  ///< unknowns of the rigid parts, length one; enters no one-sided support
  bool driven = false;  ///< true: the loads do work on it; false: no work, and its opposite enters a support
  ActionFactors actions;  ///< actions under which the motion occurs
};

/// @brief Condition for equilibrium on one-sided supports (G. Fichera, Mem. Accad. Naz. Lincei 7 (1964) 91;
/// Handbuch der Physik VIa/2, 1972).
///
/// V: the free motions. g_i: displacement into the medium at each place of a one-sided support, as functional
/// on V. K: the motions v in V with g_i.v <= 0 for all i (gaps are irrelevant, because K holds motions of
/// unlimited size). Loads F are in equilibrium if and only if F.v <= 0 on K, and F.v = 0 only if -v is in K,
/// too. Equivalently F = sum p_i g_i with p_i > 0: F is in the relative interior of the cone of the g_i.
/// Non-negative least squares decides: the solution gives the pressures, or the residual is the escaping
/// motion.
///
/// On a straight support g is linear in position, so that the ends of the support suffice. On a curved one,
/// the position that the escaping motion enters most is added until none is entered.
class UnilateralBalance {
 public:
  /// @param motions kept by reference; must outlive this object
  explicit UnilateralBalance(const FreeMotions& motions);

  [[nodiscard]] const FreeMotions& motions() const { return motions_; }
  /// Whether the constant actions do not load parts that only one-sided supports hold; then all load factors
  /// of one sign are held, or none.
  [[nodiscard]] bool is_proportional() const;
  /// @brief Motion on which the constant actions plus `factor` times the proportional ones escape; empty: the
  /// actions are held. With `factor` zero, parts without any action are at rest.
  [[nodiscard]] std::optional<Escape> escape(double factor) const;
  /// @brief Motion on which the constant actions plus arbitrarily small loads of one sign escape; empty:
  /// held.
  /// @param direction of the load factor: 1 or -1
  [[nodiscard]] std::optional<Escape> escape_at_start(double direction) const;
  /// @brief Limit of held load factors between one that is held and one beyond, to a relative 1e-11.
  [[nodiscard]] double largest_held(double held, double beyond) const;

 private:
  /// One-sided foundation on a curved member.
  struct CurvedSupport {
    int member = 0;
    std::array<double, 2> range{};  ///< fractions of the member
    FoundationLaw law;
  };
  /// Forces of one pattern on a group, with the sum of their magnitudes as reference for rounding.
  struct Forces {
    Eigen::VectorXd sum;
    double size = 0.0;
    [[nodiscard]] bool vanish() const;
  };
  /// One-sided supports whose rows span a subspace of V that is orthogonal to all other rows. Each group is
  /// in equilibrium by itself, relative to its own loads.
  struct Group {
    Eigen::MatrixXd basis;  ///< orthonormal columns in V that span the rows
    Eigen::MatrixXd rows;   ///< unit columns: in V while groups are formed, then in coordinates of the basis
    std::vector<CurvedSupport> curved;
    Eigen::VectorXd inside;  ///< force in the relative interior of the cone of the rows
    Forces constant;
    Forces proportional;
  };

  [[nodiscard]] Eigen::VectorXd on_motions(const RigidParts::Row& row) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> unit_row(const RigidParts::Row& row) const;
  [[nodiscard]] RigidParts::Row row_at(const CurvedSupport& support, double fraction) const;
  void add(const ResolvedSpring& spring);
  void add(const ResolvedFoundation& foundation);
  void add_support(const std::vector<RigidParts::Row>& rows, const CurvedSupport* curved);
  void close_groups();
  void add_loads();
  [[nodiscard]] std::optional<Eigen::VectorXd> row_in(const Group& group, const CurvedSupport& support,
                                                      double fraction) const;
  [[nodiscard]] bool add_entered(const Group& group, const Eigen::VectorXd& motion, double tolerance,
                                 Eigen::MatrixXd& rows) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> unbalanced(const Group& group, const Eigen::VectorXd& force,
                                                          double margin) const;
  [[nodiscard]] std::optional<Escape> escape_of(const Group& group, const ActionFactors& actions,
                                                double margin) const;
  [[nodiscard]] std::optional<Escape> escape_with(double factor, double margin) const;

  const FreeMotions& motions_;
  std::vector<Group> groups_;
};

}  // namespace snapthrough
