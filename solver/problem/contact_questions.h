#pragma once
/// @file
/// Which one-sided supports of a structure touch in a state, and which of them act.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/problem/force_scales.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// @brief Answers questions about the contact of a structure with its one-sided supports.
///
/// Springs are ordered as nodes' springs, then elements' springs. A support touches without pressure where
/// its distance is below 1e-9 of the largest displacement and its force below 1e-6 of the largest force.
/// Source of both: docs/decisions/0009.
class ContactQuestions {
 public:
  /// @param structure, scales kept by reference; must outlive this object
  /// @param unloaded factors of the loads at load factor 0
  ContactQuestions(const Structure& structure, const ForceScales& scales, const LoadFactors& unloaded)
      : structure_(structure), scales_(scales), unloaded_(unloaded) {}

  /// @brief Contact state at y: one-sided supports act where they touch, and are absent elsewhere.
  /// @param small_displacements rods change their lengths by the linear part of the displacements
  [[nodiscard]] FrozenContact frozen(const Eigen::VectorXd& y, bool small_displacements = false) const;
  /// @brief Contact state in which foundations act on the given zones, and springs where they act at y.
  [[nodiscard]] FrozenContact frozen(const MovingZones& zones, const Eigen::VectorXd& y) const;
  /// @brief Marks the one-sided supports that touch without pressure at y, foundations on their whole part of
  /// an element.
  [[nodiscard]] TouchingMarks marks_at(const Eigen::VectorXd& y, bool small_displacements = false) const;
  [[nodiscard]] std::size_t springs(const TouchingMarks& marks) const;
  /// @brief Displacement of `mode` into the medium at each marked spring; `out` is overwritten.
  void displacements(const TouchingMarks& marks, const Eigen::VectorXd& mode, std::vector<double>& out) const;
  /// @brief Sets which marked supports act: springs as given, foundations where `mode` moves into the medium.
  /// @param mode empty: marked foundations act everywhere
  /// @param springs one entry per marked spring
  void set(const TouchingMarks& marks, const Eigen::VectorXd& mode, std::span<const char> springs,
           FrozenContact& out) const;
  /// Marked supports with the contact of set(). @param frozen null: no marked support acts
  [[nodiscard]] TouchingSupports touching(const TouchingMarks& marks, const FrozenContact* frozen) const;

 private:
  [[nodiscard]] TouchingDistance touching_distance(const Eigen::VectorXd& y) const;
  [[nodiscard]] double displacement(const NodeSpring& spring, const Eigen::VectorXd& y,
                                    bool small_displacements) const;

  const Structure& structure_;
  const ForceScales& scales_;
  LoadFactors unloaded_;
};

}  // namespace snapthrough
