#pragma once
/// @file
/// Where foundations and one-sided springs touch the structure.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"

namespace snapthrough {

/// @brief Contact intervals [s0, s1] of a foundation in its member's arc length, ascending, neighbours
/// joined; the whole range of a bilateral one.
/// @param depth penetration over the structure's length that is taken for none, at least 0
[[nodiscard]] std::vector<std::array<double, 2>> contact_intervals(const Structure& structure,
                                                                   const Model& model,
                                                                   const Eigen::VectorXd& y, int foundation,
                                                                   double depth = 0.0);

/// @brief Counts contact zones: of each one-sided foundation its intervals, of each one-sided spring 0 or 1.
/// What is not deeper than the rounding of positions is no contact here: where nothing moves, zones of
/// rounding would come and go at every step.
class ContactZones {
 public:
  /// @param structure, model kept by reference, must outlive this
  ContactZones(const Structure& structure, const Model& model);

  /// Ids of the supports that are counted, in the order of the counts; empty: nothing is one-sided.
  [[nodiscard]] const std::vector<std::string>& ids() const { return ids_; }
  /// @param zones overwritten, one count an id
  void count(const Eigen::VectorXd& y, std::vector<int>& zones) const;

 private:
  struct SpringRow {
    SparseRow row;  ///< acts where it exceeds the gap
    double gap = 0.0;
  };
  const Structure& structure_;
  const Model& model_;
  std::vector<int> foundations_;
  std::vector<SpringRow> springs_;
  std::vector<std::string> ids_;
};

}  // namespace snapthrough
