#pragma once
/// @file
/// Contact of foundations and one-sided springs with the structure.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Contact intervals [s0, s1] of a foundation in its member's arc length, ascending, adjacent ones
/// joined; the whole range for a bilateral foundation.
/// @param depth least penetration over the structure's length that counts as contact, >= 0
[[nodiscard]] std::vector<std::array<double, 2>> contact_intervals(const Structure& structure,
                                                                   const Eigen::VectorXd& y, int foundation,
                                                                   double depth = 0.0);

/// @brief Counts contact zones: the intervals of each one-sided foundation, 0 or 1 for each one-sided spring.
/// Penetrations within the rounding of positions do not count, because their zones change at every step.
class ContactZones {
 public:
  /// @param structure kept by reference; must outlive this object
  explicit ContactZones(const Structure& structure);

  /// Ids of the counted supports, in the order of the counts; empty: no support is one-sided.
  [[nodiscard]] const std::vector<std::string>& ids() const { return ids_; }
  /// @param zones overwritten; one count per id
  void count(const Eigen::VectorXd& y, std::vector<int>& zones) const;

 private:
  const Structure& structure_;
  std::vector<int> foundations_;
  std::vector<std::size_t> springs_;
  std::vector<std::string> ids_;
};

}  // namespace snapthrough
