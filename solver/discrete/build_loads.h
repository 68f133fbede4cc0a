#pragma once
/// @file
/// Loads of a structure.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/element/element_set.h"
#include "solver/resolve/action.h"

namespace snapthrough {

/// @brief Adds the actions of a model to a structure, and scales them by their size.
class LoadBuilder {
 public:
  /// @param like null, or a structure with the same mesh, axes and scales, whose load vectors are taken over
  /// where the actions are the same
  /// @param elements, out kept by reference; the unknowns and supports are set
  LoadBuilder(const Structure* like, ElementSet& elements, Structure& out)
      : model_(*out.model), like_(like), elements_(elements), out_(out) {}

  /// @param load_scale scale of another mesh or model; empty: from the actions
  void add_all(std::optional<double> load_scale);
  /// Whether constant actions cause displacements, and not only reactions of rigid supports.
  [[nodiscard]] bool is_moved_by_constant_actions() const;

 private:
  /// Scaled follower pressure of an element, proportional and constant part; needs the load scale.
  struct ElementPressure {
    int element;
    LinePressure proportional;
    LinePressure constant;
  };

  /// Adds an action to the load vectors.
  void add(const PointAction& load);
  void add(const LineAction& load);
  void add(const PressureAction&) {}  // add_pressure() has added it to the elements
  void add(const StrainAction& load);
  void add_pressure(const PressureAction& load);
  void add_at(int element, double xi, const std::array<double, 3>& action, Eigen::VectorXd& load) const;
  [[nodiscard]] Eigen::VectorXd& pattern(Pattern p) {
    return p == Pattern::proportional ? out_.proportional_load : out_.constant_load;
  }
  [[nodiscard]] double size_of_loads() const;
  void scale_other_actions();
  void add_cables();
  void find_follower_ends(double load_scale);
  void add_follower_changes(const ElementPressure& pressure, double load_scale);

  const ResolvedModel& model_;
  const Structure* like_;
  ElementSet& elements_;
  Structure& out_;
  std::vector<ElementPressure> pressures_;
  double strain_size_ = 0.0;  ///< magnitude of the forces that the proportional initial strains correspond to
};

}  // namespace snapthrough
