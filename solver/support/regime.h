#pragma once
/// @file
/// How supports are taken when a structure is linearised.

#include <algorithm>
#include <vector>

namespace snapthrough {

/// Part of an element, in its own [0, 1].
struct ElementPart {
  double from = 0.0;
  double to = 0.0;
};

/// Where one-sided supports act, whatever the displacements. In the order of the structure's own lists.
struct FrozenContact {
  std::vector<std::vector<ElementPart>> contacts;  ///< where each foundation on an element acts
  std::vector<char> element_springs;               ///< which springs on elements act
  std::vector<char> node_springs;                  ///< which springs at nodes act
};

/// A stretch of members on which a one-sided foundation acts, and how fast its ends move along a path.
struct MovingZone {
  double from = 0.0;  ///< length, counted from the first element on
  double to = 0.0;
  double from_rate = 0.0;  ///< by the path's arc length; 0 where the foundation itself ends
  double to_rate = 0.0;
};
/// Those of each foundation, ascending.
using MovingZones = std::vector<std::vector<MovingZone>>;

/// One-sided supports that touch without pressure, in the same order.
struct TouchingMarks {
  std::vector<char> contacts;
  std::vector<char> element_springs;
  std::vector<char> node_springs;
};

/// How near to touching a support is that touches without pressure: a stiff one that is pressed hardly moves.
struct TouchingDistance {
  double any = 0.0;       ///< of the softest
  double force = 0.0;     ///< that it carries there at most
  double rounding = 0.0;  ///< of a displacement, whatever force that is

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

/// Factors on the proportional and the constant actions.
struct LoadFactors {
  double proportional = 0.0;
  double constant = 0.0;
};

/// @brief What an equation of equilibrium takes its supports and displacements for.
struct Regime {
  enum class Contact {
    unilateral,  ///< one-sided supports push or pull where they are touched
    bilateral,   ///< they are glued, without gap
    frozen       ///< they act where `frozen` says
  };
  Contact contact = Contact::unilateral;
  const FrozenContact* frozen = nullptr;
  double softness = 1.0;  ///< share of their stiffness that one-sided supports have, in (0, 1]
  double grip = 0.0;      ///< share of it with which they react in both directions, without gap, as well
  bool small_displacements = false;  ///< strains linearised about the stress-free axis

  [[nodiscard]] bool bilateral() const { return contact == Contact::bilateral; }
  [[nodiscard]] bool is_frozen() const { return contact == Contact::frozen; }
};

}  // namespace snapthrough
