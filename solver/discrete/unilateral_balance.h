#pragma once
/// @file
/// Whether one-sided supports can carry loads.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "solver/discrete/free_motions.h"
#include "solver/support/law.h"

namespace snapthrough {

/// Factors on the actions of both patterns.
struct ActionFactors {
  double constant = 1.0;
  double proportional = 0.0;
};

/// A motion on which loads are not held.
struct Escape {
  Eigen::VectorXd motion;  ///< unknowns of the rigid parts; length one. It enters no one-sided support
  bool driven = false;    ///< the loads do work on it; false: they do none, and its opposite enters a support
  ActionFactors actions;  ///< under which it escapes
};

/// @brief Condition for equilibrium on one-sided supports (G. Fichera, Mem. Accad. Naz. Lincei 7 (1964) 91;
/// Handbuch der Physik VIa/2, 1972).
///
/// With V the free motions, g_i the displacement into the medium at each place of a one-sided support, as
/// functionals on V, and K the motions v in V with g_i.v <= 0 for all i (gaps do not matter: K is the cone of
/// what can go on for ever), loads F are held if and only if F.v <= 0 on K, and F.v = 0 only where -v is in K
/// too. Equivalently there are pressures p_i > 0 with F = sum p_i g_i: F is in the relative interior of the
/// cone of the g_i. That is asked by non-negative least squares: its solution is the pressures, or else its
/// residual is the motion that escapes.
///
/// Along a straight support g is linear in the place, so that its ends decide. Along a curved one the place
/// that the escaping motion enters most is added until there is none.
class UnilateralBalance {
 public:
  /// @param motions kept by reference, must outlive this
  explicit UnilateralBalance(const FreeMotions& motions);

  [[nodiscard]] const FreeMotions& motions() const { return motions_; }
  /// Whether constant actions load no part that one-sided supports alone hold: then load factors of one sense
  /// are all held or none.
  [[nodiscard]] bool is_proportional() const;
  /// @brief How the constant actions and `factor` times the proportional ones escape; empty: they are held.
  /// Parts that no action loads are at rest unloaded where `factor` is zero.
  [[nodiscard]] std::optional<Escape> escape(double factor) const;
  /// @brief How the constant actions and all sufficiently small loads of one sense escape; empty: they are
  /// held.
  /// @param direction of the load factor: 1 or -1
  [[nodiscard]] std::optional<Escape> escape_at_start(double direction) const;
  /// @brief The limit of what is held between a load factor that is and one that is not, to 1e-10.
  [[nodiscard]] double largest_held(double held, double beyond) const;

 private:
  /// A one-sided foundation on a curved member.
  struct CurvedSupport {
    int member = 0;
    std::array<double, 2> range{};  ///< fractions of the member
    Direction direction;
  };
  /// Forces of one pattern on a group, and the sum of their sizes, which rounding is a share of.
  struct Forces {
    Eigen::VectorXd sum;
    double size = 0.0;
    [[nodiscard]] bool vanish() const;
  };
  /// One-sided supports whose rows span one subspace of V that those of all others are orthogonal to: each
  /// group is balanced by itself, relative to its own loads.
  struct Group {
    Eigen::MatrixXd basis;  ///< orthonormal columns in V that span the rows
    Eigen::MatrixXd rows;   ///< unit columns: in V while groups are found, then by the basis
    std::vector<CurvedSupport> curved;
    Eigen::VectorXd inside;  ///< a force in the relative interior of the cone of the rows
    Forces constant;
    Forces proportional;
  };

  [[nodiscard]] Eigen::VectorXd on_motions(const RigidParts::Row& row) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> unit_row(const RigidParts::Row& row) const;
  [[nodiscard]] RigidParts::Row row_at(const CurvedSupport& support, double fraction) const;
  void add(const Spring& spring);
  void add(const Foundation& foundation);
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
