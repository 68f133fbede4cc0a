#pragma once
/// @file
/// Beam elements of a mesh with their elastic supports, as contributions to a mixed equilibrium problem.
///
/// Planar geometrically exact beam (Reissner, ZAMP 23, 1972; Simo, CMAME 49, 1985) of order P, collocated at
/// P Gauss points. Unknowns of an element of length h, as increments from the stress-free axis:
///
///   u_a, u_b   displacement (x, y, rotation b) at its ends, shared with its neighbours
///   v_q        (u'_x, u'_y, b') at the Gauss points q;   u(xi) = u_a + h sum_q A_q(xi) v_q
///   s_q        (N, Q, M) at the Gauss points, independent of the displacements
///   m          (force x, force y, moment) through the end b: multiplier of u_b = u_a + h sum_q b_q v_q
///
/// The unknowns make stationary   sum_q h b_q [ s.(eps(v) - eps_0) - s.C s / 2 ] + foundations + m.(u_b - u_a
/// - h sum b_q v_q) - work, with  e = x'.d1 - t.d1_0,  g = x'.d2 - t.d2_0,  k = b'  and C the section's
/// compliance. An inextensible or unshearable section has C = 0, without large numbers or loss of digits.
/// Newton's method on these equations is the mixed-integration-point iteration of Magisano, Leonetti and
/// Garcea (2017).
///
/// Element interiors (v, s) are eliminated in terms of the strains, see element_work.h.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solver/element/bending_curve.h"
#include "solver/element/element_contacts.h"
#include "solver/element/element_parts.h"
#include "solver/element/foundation_contact.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/lanes.h"
#include "solver/support/law.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Follower pressure along an element, a linear function of the undeformed length.
struct LinePressure {
  double middle = 0.0;
  double change = 0.0;  ///< from the start of the element to its end

  [[nodiscard]] double at(double xi) const { return middle + (xi - 0.5) * change; }
  [[nodiscard]] bool acts() const { return middle != 0.0 || change != 0.0; }
  [[nodiscard]] LinePressure times(double factor) const { return {factor * middle, factor * change}; }
};

/// Stress-free geometry and section of an element; vectors have one entry per Gauss point.
struct ElementShape {
  double length = 0.0;
  std::vector<double> angle;  ///< angle of the stress-free section
  std::vector<std::array<double, 2>>
      t;  ///< derivative of the stress-free axis; h sum b_q t_q = chord exactly
  std::vector<double> axial_compliance;  ///< axial strain e per axial force N
  std::vector<double> shear_compliance;  ///< shear strain g per shear force Q; all zero: unshearable
  std::vector<double>
      bending_compliance;  ///< curvature k per moment M, without moment where `bending` is set
  /// Bending law: the curvature is `bending_compliance` times the moment that the curve gives for M. Null:
  /// the curvature is `bending_compliance` times M. Owned by Structure.
  const BendingCurve* bending = nullptr;
};

/// Element after elimination of its interior, with rows for (u_a, m):
///   K u_a + X^T m = ra,    X u_a - F m + u_b = rm,    and  + m  in the row of u_b.
struct CondensedElement {
  Eigen::Matrix3d K, X, F;
  int negative = 0;      ///< negative pivots of the interior beyond those of every mixed element
  double log_det = 0.0;  ///< log |det| of the interior
};

/// Resistance to a linear functional of the unknowns of several elements.
struct Coupling {
  std::vector<std::pair<int, double>> row;  ///< unknowns with their weights
  double compliance = 0.0;                  ///< inverse of the stiffness

  [[nodiscard]] double value(const double* y) const {
    double sum = 0.0;
    for (const auto& [unknown, weight] : row) sum += weight * y[unknown];
    return sum;
  }
  /// Adds a force along the functional.
  void push(double force, double* out) const {
    for (const auto& [unknown, weight] : row) out[unknown] += force * weight;
  }
};

/// Right-hand sides of CondensedElement, for four vectors at a time.
struct CondensedForces {
  Lanes3 ra, rm;
};

/// @brief Evaluates element forces, and their tangent condensed to the element ends.
///
/// Not thread safe: keeps the factors of the last linearise() and scratch memory. Vectors are in scaled
/// units, with the layout of ElementDofs.
class ElementWork {
 public:
  ElementWork() = default;
  ElementWork(const ElementWork&) = delete;
  ElementWork& operator=(const ElementWork&) = delete;
  ElementWork(ElementWork&&) = delete;
  ElementWork& operator=(ElementWork&&) = delete;
  virtual ~ElementWork() = default;

  /// @brief Adds the internal forces and compatibility residuals at y to `residual`.
  /// @param factors load factors of follower pressures
  virtual void add_residual(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                            Eigen::VectorXd& residual) = 0;
  /// @brief Adds the residual like add_residual() and condenses all interiors: `condensed` (one entry per
  /// element) gets K, X, F, negative, log_det.
  virtual void linearise(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                         Eigen::VectorXd& residual, std::span<CondensedElement> condensed) = 0;
  /// @brief Reduces the interior part of right-hand sides to the ends of each element.
  virtual void reduce(const ColumnLanes& rhs, std::span<CondensedForces> condensed) = 0;
  /// @brief Replaces the interior rows of `x` (right-hand sides on entry) by the solution, from the end
  /// displacements and multipliers already in `x`.
  virtual void recover(const ColumnLanes& x) = 0;
  /// @brief Couplings of elements at the last evaluation: parts of the tangent that linearise() does not
  /// condense.
  [[nodiscard]] virtual std::span<const Coupling> couplings() const = 0;
  /// @brief Adds the forces on the elements' unknowns that a motion of the ground causes by the tangent of
  /// the last linearise(). @param motion unknowns, of which those of the ground are used
  virtual void add_ground_forces(const double* motion, double* out) const = 0;
  /// Adds the second derivative of the energy times `directions`, column by column, to `out`.
  virtual void add_tangent_products(const Eigen::VectorXd& y, const LoadFactors& factors,
                                    const Regime& regime, const Eigen::Ref<const Eigen::MatrixXd>& directions,
                                    Eigen::MatrixXd& out) = 0;
  /// @brief Adds the derivative of the tangent along a direction, times `directions`, column by column, to
  /// `out`. Supports whose law is linear change the tangent only where an end of contact moves.
  /// @param rates changes of the load factors of follower pressures along the direction
  virtual void add_tangent_changes(const Eigen::VectorXd& y, const LoadFactors& rates, const Regime& regime,
                                   const Eigen::VectorXd& along,
                                   const Eigen::Ref<const Eigen::MatrixXd>& directions,
                                   Eigen::MatrixXd& out) = 0;
  /// @brief Adds the derivative of the follower forces along a direction to `out` (a load vector). @pre large
  /// displacements
  virtual void add_pressure_change(const LoadFactors& factors, const Eigen::VectorXd& along,
                                   Eigen::VectorXd& out) = 0;
  /// @brief Adds the follower forces at y to `out` (a load vector, minus a residual).
  virtual void add_pressure_load(const Eigen::VectorXd& y, const LoadFactors& factors,
                                 bool small_displacements, Eigen::VectorXd& out) = 0;
  /// @brief Rounding of support forces at the last residual or linearisation, maximum over elements:
  /// stiffness times the rounding of the displacements in the penetration.
  [[nodiscard]] virtual double support_rounding() const = 0;
};

/// @brief All elements of one mesh and order with their supports; constant once the structure is made.
class ElementSet {
 public:
  ElementSet(const ElementSet&) = delete;
  ElementSet& operator=(const ElementSet&) = delete;
  ElementSet(ElementSet&&) = delete;
  ElementSet& operator=(ElementSet&&) = delete;
  virtual ~ElementSet() = default;

  [[nodiscard]] int size() const { return contacts_.elements(); }
  /// Supports at which contact can begin or end.
  [[nodiscard]] const ElementContacts& contacts() const { return contacts_; }
  /// Reserves memory for a number of elements.
  virtual void reserve(int elements) = 0;
  /// @brief Adds an element; element indices follow the order of calls.
  virtual void add(const ElementShape& shape, const ElementDofs& dofs) = 0;
  /// @brief Adds an element with the shape of one of another set, without its supports and pressure.
  /// @pre both sets have the same order
  virtual void add_like(const ElementSet& other, int element, const ElementDofs& dofs) = 0;
  /// @brief Adds a spring to the element added last.
  virtual void add_spring(const SupportSpring& support) = 0;
  /// @brief Adds part of a foundation to the element added last.
  virtual void add_foundation(int element, FoundationContact contact, Touch touch) = 0;
  /// @brief Sets the follower pressure of an element, force per deformed length along its deformed right
  /// normal (a medium on the left pushes), as a part proportional to the load factor and a constant part.
  virtual void set_pressure(int element, const LinePressure& proportional, const LinePressure& constant) = 0;
  /// @brief Makes the working memory for evaluations. @pre the set outlives the returned object
  [[nodiscard]] virtual std::unique_ptr<ElementWork> make_work() const = 0;

 protected:
  explicit ElementSet(int order) : contacts_(order) {}

  ElementContacts contacts_;
};

/// @brief Makes an empty set for elements of an order in 1..kMaxOrder.
[[nodiscard]] std::unique_ptr<ElementSet> make_element_set(int order);

}  // namespace snapthrough
