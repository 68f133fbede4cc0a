#pragma once
/// @file
/// States of supports for which the equations are evaluated.

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace snapthrough {

/// Part of an element, in its own [0, 1].
struct ElementPart {
  double from = 0.0;
  double to = 0.0;
};

/// Contact independent of the displacements. Entries follow the lists of the structure.
struct FrozenContact {
  /// Parts on which each foundation acts, per foundation on an element.
  std::vector<std::vector<ElementPart>> contacts;
  std::vector<char> element_springs;  ///< whether each one-sided spring on an element acts
  std::vector<char> node_springs;     ///< whether each spring at a node acts
  /// Unknowns at whose displacements laws with a curve are linearised through the origin; empty: they are
  /// not.
  Eigen::VectorXd linearised_at;
};

/// Contact zone of a one-sided foundation, with the rates of its ends along a path.
struct MovingZone {
  double from = 0.0;  ///< arc length from the start of the first element
  double to = 0.0;
  double from_rate = 0.0;  ///< rate of `from` per arc length of the path; 0 at an end of the foundation
  double to_rate = 0.0;
};
/// Contact zones of each foundation, ascending.
using MovingZones = std::vector<std::vector<MovingZone>>;

/// One-sided supports that touch without pressure; entries as in FrozenContact.
struct TouchingMarks {
  std::vector<char> contacts;
  std::vector<char> element_springs;
  std::vector<char> node_springs;
};

/// Distances at which a support counts as touching without pressure; smaller for stiff supports.
struct TouchingDistance {
  double any = 0.0;       ///< distance for the softest supports
  double force = 0.0;     ///< force of a support that counts as unloaded
  double rounding = 0.0;  ///< rounding of displacements: lower limit of the distance

  [[nodiscard]] double of(double stiffness) const {
    return std::min(any, std::max(force / stiffness, rounding));
  }
};

[[nodiscard]] inline bool has_any(const TouchingMarks& marks) {
  const auto any = [](const std::vector<char>& list) {
    return std::find(list.begin(), list.end(), 1) != list.end();
  };
  return any(marks.contacts) || any(marks.element_springs) || any(marks.node_springs);
}

struct ElementMasses;

/// Factors on the proportional and the constant actions.
struct LoadFactors {
  double proportional = 0.0;
  double constant = 0.0;
};

/// @brief Options of the equilibrium equations: state of one-sided supports and kinematics.
struct Regime {
  enum class Contact {
    unilateral,  ///< one-sided supports act where the displacement exceeds the gap
    bilateral,   ///< one-sided supports act as bilateral ones without gap
    frozen       ///< one-sided supports act according to `frozen`
  };
  Contact contact = Contact::unilateral;
  const FrozenContact* frozen = nullptr;
  double softness = 1.0;  ///< factor on the stiffness of one-sided supports, in (0, 1]
  /// Additional bilateral stiffness without gap of one-sided supports, over their stiffness.
  double grip = 0.0;
  /// Resistance of rods to displacements of one end against the other from those of `dragged_from`, in every
  /// direction, over their stiffness.
  double drag = 0.0;
  const Eigen::VectorXd* dragged_from = nullptr;  ///< unknowns; given where `drag` is above zero
  bool small_displacements = false;               ///< strains linearised about the stress-free axis
  /// Unknowns whose small displacements give the forces with which rods resist turning; null: those of the
  /// state.
  const Eigen::VectorXd* prestress = nullptr;
  /// Masses M of which linearise() subtracts `shift` M from the tangent, see element/element_masses.h; null:
  /// none. Residuals and products do not include them.
  const ElementMasses* masses = nullptr;
  double shift = 0.0;

  [[nodiscard]] bool bilateral() const { return contact == Contact::bilateral; }
  [[nodiscard]] bool is_frozen() const { return contact == Contact::frozen; }
  /// Unknowns at which laws with a curve are linearised; null: laws act as they are.
  [[nodiscard]] const Eigen::VectorXd* linearised_at() const {
    return is_frozen() && frozen->linearised_at.size() > 0 ? &frozen->linearised_at : nullptr;
  }
};

}  // namespace snapthrough
