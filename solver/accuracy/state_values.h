#pragma once
/// @file
/// Numbers of an equilibrium state that two meshes are compared by.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"

namespace snapthrough {

/// Kinds of numbers of a state; a difference is measured by the largest number of its kind.
enum class ValueKind { displacement, rotation, axial_force, shear_force, moment };
inline constexpr std::size_t kValueKinds = 5;

/// @brief Numbers of a state by kind, scaled: displacements and section forces at places of each element,
/// forces of springs, monitors.
struct StateValues {
  std::array<std::vector<double>, kValueKinds> of;
  double least_force = 0.0;  ///< forces below it are rounding of a structure that moves without forces

  [[nodiscard]] std::vector<double>& operator[](ValueKind kind) { return of[static_cast<std::size_t>(kind)]; }
};

/// @brief The numbers of a state at the start of each member and at places of each element.
/// @param y, lambda scaled unknowns and scaled load factor
/// @param places in (0, 1], ascending, of each element. With {1/4, 1} on a mesh and {1/2, 1} on
/// finer_mesh() of it, the numbers of the finer mesh at (1/2, 1) of first halves and at 1 of second ones are
/// those of the same places.
/// @param halves elements are the halves of a coarser mesh: the first half has the place 1/2, the second 1
[[nodiscard]] StateValues values_of(const Structure& structure, const Model& model, const Eigen::VectorXd& y,
                                    double lambda, bool halves);

/// @brief Largest difference between numbers of two states over the largest number of the kind.
///
/// Differences within rounding of the largest force or displacement of all kinds count as none.
[[nodiscard]] double relative_difference(const StateValues& coarse, const StateValues& fine);

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
