#pragma once
/// @file
/// What counts as a large and as a small force in a state of a structure.

#include <Eigen/Core>
#include <cstddef>

#include "solver/discrete/structure.h"
#include "solver/element/element_set.h"
#include "solver/support/regime.h"

namespace snapthrough {

/// @brief Sizes of the forces of a structure, and estimates of its critical loads by them.
///
/// Initial strains and prescribed displacements that meet no resistance cause forces of rounding size. They
/// count as the smallest Euler load times the displacement gradient that they impose.
class ForceScales {
 public:
  /// @param structure kept by reference; must outlive this object
  ForceScales(const Structure& structure, ElementWork& elements);

  /// Largest section force at y, or load with the given factors.
  [[nodiscard]] double largest(const Eigen::VectorXd& y, const LoadFactors& factors) const;
  /// Denominator of the relative force residual: the largest force, or that of what is imposed.
  [[nodiscard]] double reference(const Eigen::VectorXd& y, const LoadFactors& factors) const;
  /// Largest section force of the response to some loads that counts as rounding. Zero where nothing is
  /// imposed.
  [[nodiscard]] double least(const LoadFactors& factors) const;
  /// Residual f over the forces and displacements that it balances.
  [[nodiscard]] double relative(const Eigen::VectorXd& f, const Eigen::VectorXd& y,
                                const LoadFactors& factors) const;
  /// Euler load factor of the member that buckles first: min over members of pi^2 EI / (N l^2).
  /// @param response to a unit load @param factors of that load
  [[nodiscard]] double first_critical_load(const Eigen::VectorXd& response, const LoadFactors& factors) const;
  /// Load factor at which the last member buckles with its foundations; 0 without axial force.
  [[nodiscard]] double last_critical_load(const Eigen::VectorXd& response, const LoadFactors& factors) const;

 private:
  [[nodiscard]] double of_rows(const Eigen::VectorXd& f) const;
  [[nodiscard]] double of_loads(ElementWork& elements, const LoadFactors& factors) const;
  [[nodiscard]] double imposed(const LoadFactors& factors) const;
  [[nodiscard]] double largest_axial(std::size_t member, const Eigen::VectorXd& response) const;

  const Structure& structure_;
  /// Largest force or moment of the unit proportional and of the constant loads, without what is imposed.
  LoadFactors loads_;
  /// Force scales of what the unit proportional and the constant actions impose.
  LoadFactors imposed_;
};

}  // namespace snapthrough
