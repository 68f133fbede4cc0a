#pragma once
/// @file
/// The supports of elements at which contact can begin or end, and where they touch in a state.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "solver/element/element_parts.h"
#include "solver/element/foundation_contact.h"
#include "solver/element/shear_layer.h"
#include "solver/numeric/max_order.h"
#include "solver/support/regime.h"

namespace snapthrough {

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

/// Displacement of an element relative to the ground: at its start, and h u'_x, h u'_y at the Gauss points.
struct DisplacementOnGround {
  std::array<double, 2> start{};
  std::array<double, kMaxOrder> x{}, y{};
  int order = 0;

  [[nodiscard]] std::span<const double> dx() const {
    return std::span(x).first(static_cast<std::size_t>(order));
  }
  [[nodiscard]] std::span<const double> dy() const {
    return std::span(y).first(static_cast<std::size_t>(order));
  }
};

/// @brief Foundations on elements that are one-sided or have a law with a curve, and one-sided springs on
/// elements.
///
/// Constant once the structure is made. Vectors y are the unknowns of the structure. Lists for each contact
/// and each spring follow the order of the calls of add_contact() and add_spring().
class ElementContacts {
 public:
  /// Contacts of one one-sided foundation with a shear layer, ascending.
  struct Layer {
    int foundation = 0;
    std::vector<std::size_t> contacts;
    std::vector<int> elements;
  };

  /// @param order of the elements
  explicit ElementContacts(int order) : order_(order) {}

  /// Adds an element; its contacts and springs are added before the next element.
  void add_element(double length, const ElementDofs& dofs);
  void add_spring(const SupportSpring& support);
  void add_contact(int element, FoundationContact contact, Touch touch);

  [[nodiscard]] int elements() const { return static_cast<int>(elements_.size()); }
  [[nodiscard]] const std::vector<FoundationContact>& contacts() const { return contacts_; }
  [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
  /// Number of a contact's layer, or -1, and its place in it.
  [[nodiscard]] std::pair<int, std::size_t> layer_of(std::size_t contact) const {
    return layer_of_contact_[contact];
  }
  /// @brief Parts of the element on which a contact without shear layer acts; `out` is overwritten.
  /// @param start, dx, dy as in FoundationContact::penetration()
  void acting_parts(std::size_t contact, std::array<double, 2> start, std::span<const double> dx,
                    std::span<const double> dy, std::vector<ElementPart>& out) const;
  /// Displacements under a layer at the unknowns y.
  [[nodiscard]] std::vector<LayerCell> cells_of(const Layer& layer, const double* y) const;
  /// Changes of the penetrations under a layer along a direction.
  [[nodiscard]] std::vector<LayerCell> rates_of(const Layer& layer, const double* along) const;
  /// Parts on which the contacts of a layer act at displacements of its cells.
  [[nodiscard]] LayerParts acting_parts(const Layer& layer, const std::vector<LayerCell>& cells) const;

  /// @brief Sets contacts and springs of `out` to act where the penetration at y exceeds -`tolerance`.
  void freeze(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const;
  /// @brief Sets contacts of `out` to act on the given zones, and springs where they act at y.
  void freeze(const MovingZones& zones, const Eigen::VectorXd& y, FrozenContact& out) const;
  /// @brief Contact zones of one-sided foundations at y; their ends move as y changes at `rate`.
  [[nodiscard]] MovingZones moving_zones(const Eigen::VectorXd& y, const Eigen::VectorXd& rate) const;
  /// @brief Length, in elements, on which contact at y differs from `frozen`, where the pressure (or
  /// stiffness times gap) exceeds 1e-6 of the largest pressure.
  [[nodiscard]] double missed(const FrozenContact& frozen, const Eigen::VectorXd& y) const;
  /// @brief Marks contacts (over their whole range) and springs that touch without pressure at y, within the
  /// distance `near` for their stiffness.
  void mark_touching(const Eigen::VectorXd& y, const TouchingDistance& near, TouchingMarks& out) const;
  /// Marked springs, ordered as in touching_displacements() and set_touching(). @param frozen null: none acts
  [[nodiscard]] std::vector<TouchingSpring> touching_springs(const TouchingMarks& marks,
                                                             const FrozenContact* frozen) const;
  /// Appends the displacement into the medium of each marked spring.
  void touching_displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode,
                              std::vector<double>& out) const;
  /// @brief Sets which marked supports act: springs as given; contacts where `mode` moves into the medium, or
  /// on their whole range if `mode` is empty.
  void set_touching(const TouchingMarks& marks, const Eigen::VectorXd& mode, std::span<const char> springs,
                    FrozenContact& out) const;
  /// Marked contacts with the parts on which they act. @param frozen null: no contact acts
  [[nodiscard]] std::vector<TouchingContact> touching_contacts(const TouchingMarks& marks,
                                                               const FrozenContact* frozen) const;
  /// Fraction of an element on which a foundation acts.
  [[nodiscard]] double share(const FrozenContact& frozen, int element, int foundation) const;

 private:
  struct Element {
    double length = 0.0;  ///< scaled
    ElementDofs dofs;
    std::size_t first = 0, end = 0;  ///< its contacts
  };
  struct OneSidedSpring {
    std::size_t index = 0;  ///< among all springs on elements
    SupportSpring support;
  };

  void add_to_layer(const FoundationContact& contact, int element);
  [[nodiscard]] DisplacementOnGround displacement(const FoundationContact& contact, const Element& element,
                                                  const double* y) const;
  [[nodiscard]] double value(const SupportSpring& support, const Eigen::VectorXd& y) const;
  [[nodiscard]] bool acts(const SupportSpring& support, const Eigen::VectorXd& y) const;
  [[nodiscard]] LayerParts parts_on_layers(const double* y) const;
  void add_moving_layers(const Eigen::VectorXd& y, const Eigen::VectorXd& rate, MovingZones& out) const;
  void freeze_layers(const Eigen::VectorXd& y, double tolerance, FrozenContact& out) const;
  void unmark_pressed_layers(const Eigen::VectorXd& y, const TouchingDistance& near,
                             TouchingMarks& out) const;
  void set_touching_layers(const TouchingMarks& marks, const Eigen::VectorXd& mode, FrozenContact& out) const;

  int order_;
  std::vector<Element> elements_;
  std::vector<OneSidedSpring> springs_;
  std::size_t all_springs_ = 0;
  std::vector<FoundationContact> contacts_;
  std::vector<Touch> touches_;  ///< one per contact
  std::vector<Layer> layers_;
  std::vector<std::pair<int, std::size_t>> layer_of_contact_;
};

}  // namespace snapthrough
