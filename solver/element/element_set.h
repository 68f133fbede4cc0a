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

#include "solver/element/foundation_contact.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/numeric/lanes.h"
#include "solver/support/ground_motion.h"
#include "solver/support/law.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Indices of an element's unknowns in the vector of all unknowns.
struct ElementDofs {
  std::array<int, 3> a{};  ///< displacement (x, y, rotation) at the start
  std::array<int, 3> b{};  ///< displacement (x, y, rotation) at the end
  int v = 0;               ///< first of 3 P unknowns: u'_x of all Gauss points, then u'_y, then b'
  int s = 0;               ///< first of 3 P unknowns: N of all Gauss points, then Q, then M
  int m = 0;               ///< first of 3 multipliers
};

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
  std::vector<double> axial_compliance;    ///< axial strain e per axial force N
  std::vector<double> shear_compliance;    ///< shear strain g per shear force Q; all zero: unshearable
  std::vector<double> bending_compliance;  ///< curvature k per moment M
};

/// State of a one-sided support that touches without pressure, used within Rounding::touching of touching:
/// taken from the critical motion, because rounding hides it. `none`: not such a support.
enum class Touch : char { none, absent, acts };

/// Spring on a linear functional of one element's displacements, w = a.u_a + sum_q v_q.(u'_q, b'_q); where
/// the ground moves, less a.u_g with its displacement u_g.
struct SupportSpring {
  int element = 0;
  GroundPlace ground;
  Law law;
  Touch touch = Touch::none;
  int spring = -1;  ///< index of the spring; -1: part of a foundation
  std::array<double, 3> a{};
  std::vector<std::array<double, 3>> v;
};

/// Touching spring, and whether it acts.
struct TouchingSpring {
  int spring = -1;  ///< index as in SupportSpring
  bool acts = false;
};

/// Parts of a touching contact that act.
struct TouchingContact {
  int element = 0;
  int foundation = 0;
  std::array<double, 2> range{};  ///< part of the element, in [0, 1]
  std::vector<ElementPart> acting;
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
  ElementSet() = default;
  ElementSet(const ElementSet&) = delete;
  ElementSet& operator=(const ElementSet&) = delete;
  ElementSet(ElementSet&&) = delete;
  ElementSet& operator=(ElementSet&&) = delete;
  virtual ~ElementSet() = default;

  [[nodiscard]] virtual int size() const = 0;
  /// Reserves memory for a number of elements.
  virtual void reserve(int elements) = 0;
  /// @brief Adds an element; element indices follow the order of calls.
  virtual void add(const ElementShape& shape, const ElementDofs& dofs) = 0;
  /// @brief Adds an element with the shape of one of another set, without its supports and pressure.
  /// @pre both sets have the same order
  virtual void add_like(const ElementSet& other, int element, const ElementDofs& dofs) = 0;
  virtual void add_spring(const SupportSpring& support) = 0;
  virtual void add_contact(int element, FoundationContact contact, Touch touch) = 0;
  /// @brief Sets the follower pressure of an element, force per deformed length along its deformed right
  /// normal (a medium on the left pushes), as a part proportional to the load factor and a constant part.
  virtual void set_pressure(int element, const LinePressure& proportional, const LinePressure& constant) = 0;
  /// @brief Makes the working memory for evaluations. @pre the set outlives the returned object
  [[nodiscard]] virtual std::unique_ptr<ElementWork> make_work() const = 0;

  /// @brief Sets contacts and springs of `out` to act where the penetration at y exceeds -`tolerance`.
  virtual void freeze_contact(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const = 0;
  /// @brief Contact zones of one-sided foundations at y; their ends move as y changes at `rate`.
  [[nodiscard]] virtual MovingZones moving_zones(const Eigen::VectorXd& y,
                                                 const Eigen::VectorXd& rate) const = 0;
  /// @brief Sets contacts of `out` to act on the given zones, and springs where they act at y.
  virtual void freeze_zones(const MovingZones& zones, const Eigen::VectorXd& y, FrozenContact& out) const = 0;
  /// @brief Length, in elements, on which contact at y differs from `frozen`, where the pressure (or
  /// stiffness times gap) exceeds 1e-6 of the largest pressure.
  [[nodiscard]] virtual double missed_contact(const FrozenContact& frozen,
                                              const Eigen::VectorXd& y) const = 0;
  /// @brief Marks contacts (over their whole range) and springs that touch without pressure at y, within the
  /// distance `near` for their stiffness.
  virtual void mark_touching(const Eigen::VectorXd& y, const TouchingDistance& near,
                             TouchingMarks& out) const = 0;
  /// Marked springs, ordered as in touching_displacements() and set_touching(). @param frozen null: none acts
  [[nodiscard]] virtual std::vector<TouchingSpring> touching_springs(const TouchingMarks& marks,
                                                                     const FrozenContact* frozen) const = 0;
  /// Appends the displacement into the medium of each marked spring.
  virtual void touching_displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                                      std::vector<double>& out) const = 0;
  /// @brief Sets which marked supports act: springs as given; contacts where `mode` moves into the medium, or
  /// on their whole range if `mode` is empty.
  virtual void set_touching(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                            std::span<const char> springs, FrozenContact& out) const = 0;
  /// Marked contacts with the parts on which they act. @param frozen null: no contact acts
  [[nodiscard]] virtual std::vector<TouchingContact> touching_contacts(const TouchingMarks& marks,
                                                                       const FrozenContact* frozen) const = 0;
  /// Fraction of an element on which a foundation acts.
  [[nodiscard]] virtual double frozen_share(const FrozenContact& frozen, int element,
                                            int foundation) const = 0;
};

/// @brief Makes an empty set for elements of an order in 1..kMaxOrder.
[[nodiscard]] std::unique_ptr<ElementSet> make_element_set(int order);

}  // namespace snapthrough
