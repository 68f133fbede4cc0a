#pragma once
/// @file
/// The beam elements of a mesh and the elastic supports on them, as contributions to a mixed equilibrium
/// problem.
///
/// Planar geometrically exact beam (Reissner, ZAMP 23, 1972; Simo, CMAME 49, 1985) of order P, collocated at
/// P Gauss points. The unknowns of one element of length h, all as increments from the stress-free axis:
///
///   u_a, u_b   displacement (x, y, rotation b) at its ends, shared with its neighbours
///   v_q        (u'_x, u'_y, b') at the Gauss points q;   u(xi) = u_a + h sum_q A_q(xi) v_q
///   s_q        (N, Q, M) at the Gauss points, independent of the displacements
///   m          (force x, force y, moment) carried through the end b: the multiplier of u_b = u_a + h sum_q
///   b_q v_q
///
/// They make stationary   sum_q h b_q [ s.(eps(v) - eps_0) - s.C s / 2 ] + foundations + m.(u_b - u_a - h sum
/// b_q v_q) - work, with  e = x'.d1 - t.d1_0,  g = x'.d2 - t.d2_0,  k = b'   and C the section's compliance.
/// Because only compliances appear, an inextensible or unshearable section is just C = 0: no large numbers,
/// no loss of digits in the thin limit. Newton's method on these equations is the mixed-integration-point
/// iteration of Magisano, Leonetti and Garcea (2017).
///
/// Element interiors (v, s) are eliminated element by element in terms of the strains, see
/// element_work.h.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solver/element/foundation_contact.h"
#include "solver/numeric/gauss_rule.h"
#include "solver/support/law.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// Where the unknowns of an element are in the vector of all unknowns.
struct ElementDofs {
  std::array<int, 3> a{};  ///< displacement at the start
  std::array<int, 3> b{};  ///< displacement at the end
  int v = 0;               ///< first of 3 P: u'_x of all Gauss points, then u'_y, then b'
  int s = 0;               ///< first of 3 P: N of all Gauss points, then Q, then M
  int m = 0;               ///< first of 3
};

/// Stress-free geometry and section of an element; vectors have one entry a Gauss point.
struct ElementShape {
  double length = 0.0;
  std::vector<double> angle;  ///< of the stress-free section
  std::vector<std::array<double, 2>>
      t;  ///< derivative of the stress-free axis; h sum b_q t_q = chord exactly
  std::vector<double> axial_compliance;    ///< e per N
  std::vector<double> shear_compliance;    ///< g per Q; all zero: unshearable
  std::vector<double> bending_compliance;  ///< k per M
};

/// What a one-sided support does that touches without pressure, as long as it is this near to touching: known
/// from the motion that it meets first, which rounding does not tell. `none`: the support is no such one.
enum class Touch : char { none, absent, acts };
/// Distance from touching, over the structure's length, that rounding leaves next to a critical point.
inline constexpr double kTouchBand = 1e-7;

/// A linear functional of one element's displacements, w = a.u_a + sum_q v_q.(u'_q, b'_q), with a spring on
/// it.
struct SupportSpring {
  int element = 0;
  Law law;
  Touch touch = Touch::none;
  int spring = -1;  ///< its number among the springs; none: part of a foundation
  std::array<double, 3> a{};
  std::vector<std::array<double, 3>> v;
};

/// A support that touches without pressure.
struct TouchingSpring {
  int spring = -1;  ///< as in SupportSpring
  bool acts = false;
};

/// Where a contact that touches without pressure acts.
struct TouchingContact {
  int element = 0;
  int foundation = 0;
  std::array<double, 2> range{};  ///< of the element
  std::vector<ElementPart> acting;
};

/// What remains of an element once its interior is eliminated; with rows for (u_a, m):
///   K u_a + X^T m = ra,    X u_a - F m + u_b = rm,    and  + m  in the row of u_b.
struct CondensedElement {
  Eigen::Matrix3d K, X, F;
  Eigen::Vector3d ra, rm;
  int negative = 0;      ///< negative pivots of the interior beyond those every mixed element has
  double log_det = 0.0;  ///< log |det| of the interior
};

/// @brief What is computed of elements: forces, and their tangent eliminated down to the elements' ends.
///
/// Not thread safe: it keeps the factors of the last linearise(), and scratch. All vectors are in the
/// problem's scaled units and have the layout that the ElementDofs name.
class ElementWork {
 public:
  ElementWork() = default;
  ElementWork(const ElementWork&) = delete;
  ElementWork& operator=(const ElementWork&) = delete;
  ElementWork(ElementWork&&) = delete;
  ElementWork& operator=(ElementWork&&) = delete;
  virtual ~ElementWork() = default;

  /// @brief Adds the internal forces and compatibility residuals at y to `residual`.
  /// @param factors on follower pressures
  virtual void add_residual(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                            Eigen::VectorXd& residual) = 0;
  /// @brief As add_residual, and eliminates all interiors: `condensed` (one an element) gets K, X, F,
  /// negative, log_det.
  virtual void linearise(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                         Eigen::VectorXd& residual, std::span<CondensedElement> condensed) = 0;
  /// @brief Interior part of a right-hand side: fills ra and rm of `condensed`.
  virtual void reduce(const Eigen::VectorXd& rhs, std::span<CondensedElement> condensed) = 0;
  /// @brief Replaces the interior rows of `x` (a right-hand side on entry) by the solution, from the solution
  /// at the ends and the multipliers that `x` already holds.
  virtual void recover(Eigen::VectorXd& x) = 0;
  /// Adds the second derivative of the energy times `directions`, column by column, to `out`.
  virtual void add_tangent_products(const Eigen::VectorXd& y, const LoadFactors& factors,
                                    const Regime& regime, const Eigen::Ref<const Eigen::MatrixXd>& directions,
                                    Eigen::MatrixXd& out) = 0;
  /// @brief Adds the follower forces at y to `out` (a load: minus a residual).
  virtual void add_pressure_load(const Eigen::VectorXd& y, const LoadFactors& factors,
                                 bool small_displacements, Eigen::VectorXd& out) = 0;
  /// @brief Rounding of the forces of foundations and springs at the last residual or linearisation, the
  /// largest of an element: stiffness times the rounding of the displacements that their penetrations are
  /// differences of.
  [[nodiscard]] virtual double support_rounding() const = 0;
};

/// @brief All elements of one mesh, of one order, with the supports on them: data alone, which nothing
/// changes once a structure is made.
class ElementSet {
 public:
  ElementSet() = default;
  ElementSet(const ElementSet&) = delete;
  ElementSet& operator=(const ElementSet&) = delete;
  ElementSet(ElementSet&&) = delete;
  ElementSet& operator=(ElementSet&&) = delete;
  virtual ~ElementSet() = default;

  [[nodiscard]] virtual int size() const = 0;
  /// Makes room for that many elements.
  virtual void reserve(int elements) = 0;
  /// @brief Adds an element; elements are numbered in the order of adding.
  virtual void add(const ElementShape& shape, const ElementDofs& dofs) = 0;
  virtual void add_spring(const SupportSpring& support) = 0;
  virtual void add_contact(int element, FoundationContact contact, Touch touch) = 0;
  /// @brief Follower pressure of an element: force per deformed length, along its deformed right normal (so a
  /// medium on the left pushes), proportional to the load factor and constant.
  virtual void set_pressure(int element, double proportional, double constant) = 0;
  /// @brief Room to compute in; refers to this set, which must outlive it.
  [[nodiscard]] virtual std::unique_ptr<ElementWork> make_work() const = 0;

  /// @brief Where one-sided supports touch at y (penetration above `-tolerance`): sets contacts and springs.
  virtual void freeze_contact(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const = 0;
  /// @brief Where one-sided foundations act at y, which moves at `rate` along a path.
  [[nodiscard]] virtual MovingZones moving_zones(const Eigen::VectorXd& y,
                                                 const Eigen::VectorXd& rate) const = 0;
  /// @brief One-sided supports that act: foundations in these zones, springs where they do at y. Sets
  /// contacts and springs.
  virtual void freeze_zones(const MovingZones& zones, const Eigen::VectorXd& y, FrozenContact& out) const = 0;
  /// @brief Elements on which one-sided foundations act at y and not in `frozen`, or the other way, with a
  /// pressure (or, in the gap, its like) that counts beside the largest.
  [[nodiscard]] virtual double missed_contact(const FrozenContact& frozen,
                                              const Eigen::VectorXd& y) const = 0;
  /// @brief The one-sided supports that touch without pressure at y: those no further from touching than
  /// `near` says of their stiffness, contacts on all of their range. Sets contacts and springs.
  virtual void mark_touching(const Eigen::VectorXd& y, const TouchingDistance& near,
                             TouchingMarks& out) const = 0;
  /// In the order of the two functions below. @param frozen null: none acts
  [[nodiscard]] virtual std::vector<TouchingSpring> touching_springs(const TouchingMarks& marks,
                                                                     const FrozenContact* frozen) const = 0;
  /// Appends the displacement of each touching support into its medium.
  virtual void touching_displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                                      std::vector<double>& out) const = 0;
  /// @brief Of the supports that touch these springs act, and contacts where `mode` moves into their medium;
  /// with an empty mode they act on all of their range.
  virtual void set_touching(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                            std::span<const char> springs, FrozenContact& out) const = 0;
  /// As set_touching() left them. @param frozen null: none acts
  [[nodiscard]] virtual std::vector<TouchingContact> touching_contacts(const TouchingMarks& marks,
                                                                       const FrozenContact* frozen) const = 0;
  /// Share of an element on which a foundation acts.
  [[nodiscard]] virtual double frozen_share(const FrozenContact& frozen, int element,
                                            int foundation) const = 0;
};

/// @brief An empty set for elements of an order in 1..kMaxOrder.
[[nodiscard]] std::unique_ptr<ElementSet> make_element_set(int order);

}  // namespace snapthrough
