#pragma once
/// @file
/// Numbers of an equilibrium state that two meshes are compared by.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Kinds of numbers of a state; a difference is measured by the largest number of its kind.
enum class ValueKind { displacement, rotation, axial_force, shear_force, moment };
inline constexpr std::size_t kValueKinds = 5;

/// @brief Magnitudes of a state by kind, scaled: for each member those of displacements and section forces at
/// places of its elements, for each spring that of its force.
struct StateValues {
  std::array<std::vector<std::vector<double>>, kValueKinds> of;
  double least_force = 0.0;  ///< forces below it are rounding of a structure that moves without forces

  [[nodiscard]] std::vector<std::vector<double>>& operator[](ValueKind kind) {
    return of[static_cast<std::size_t>(kind)];
  }
};

/// @brief The numbers of a state at the start of each member and at places of each element.
/// @param y, lambda scaled unknowns and scaled load factor
/// @param halves elements are the halves of a coarser mesh: they have half as many places, the same ones
[[nodiscard]] StateValues values_of(const Structure& structure, const Eigen::VectorXd& y, double lambda,
                                    bool halves);

/// @brief Error of the coarser of two states in the largest magnitudes of its members, over the largest of
/// the kind in the structure.
///
/// The error of a magnitude is twice the difference of the largest values, or the largest difference at
/// places where it is near its largest: nodes are more exact than what lies between them, and a reader looks
/// for the largest value at places of his own. N and Q, which jump where a one-sided support presses a place,
/// and rotations count by their largest values alone. A kind whose largest value is rounding of the forces or
/// displacements of all kinds does not count.
/// @param accuracy a difference that exceeds it within rounding counts as the accuracy: no mesh decreases it
[[nodiscard]] double relative_error(const StateValues& coarse, const StateValues& fine, double accuracy);

/// @brief How far the unknowns of a state on a mesh are from polynomials on each element of a coarser mesh:
/// the largest difference of section forces and displacement gradients, over the largest of the kind, for
/// each element of the coarser mesh.
///
/// The difference of two solutions has a part from every other element of the structure; this one has not.
/// @param fine structure on finer_mesh() of the mesh of `coarse`
/// @param y scaled unknowns of `fine`
[[nodiscard]] std::vector<double> local_differences(const Structure& coarse, const Structure& fine,
                                                    const Eigen::VectorXd& y);

}  // namespace snapthrough
