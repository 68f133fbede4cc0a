#pragma once
/// @file
/// What kind of equations a model has.

namespace snapthrough {

/// @brief Properties of the equilibrium equations that methods presume, or that change what they do.
///
/// They are found once, when a structure is built, and methods ask them here.
struct ModelTraits {
  /// Some support acts on one side only: the tangent jumps where contact begins or ends.
  bool one_sided = false;
  /// The law of some support, joint or section has a curve, at whose bends the tangent may jump.
  bool has_curves = false;
  /// The stiffness of some support, joint or section changes with the state: a law with a curve, or a
  /// surface.
  bool changing_stiffness = false;
  /// All actions have a potential: the tangent is symmetric, and stability is lost by divergence alone.
  bool symmetric = true;
  bool has_mass = false;
  /// The loads move the structure without strain, until members that pull only are tight: it has no state
  /// without load.
  bool loose = false;
  /// Some support remembers the path to a state, so that unknowns and load factor alone do not determine its
  /// forces.
  bool remembers = false;

  /// Whether a path may turn within less than a step.
  [[nodiscard]] bool may_kink() const { return one_sided || has_curves; }
};

}  // namespace snapthrough
