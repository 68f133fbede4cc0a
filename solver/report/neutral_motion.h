#pragma once
/// @file
/// Reports motions without stiffness.

#include <vector>

#include "solver/discrete/structure.h"
#include "solver/problem/holds.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief Held motions as displacements of nodes in a reduced basis: each pivot component (of a node) is
/// nonzero in one motion only, so that a translation is reported as such.
/// @param holds null: no motions
/// @return motions without branch and load factors
[[nodiscard]] std::vector<NeutralMotion> neutral_motions(const Structure& structure,
                                                         const SharedHolds& holds);

/// @brief Records the load factor range in which motions are free along a path.
class NeutralMotionLog {
 public:
  /// @param structure, out kept by reference; must outlive this object
  NeutralMotionLog(const Structure& structure, std::vector<NeutralMotion>& out)
      : structure_(structure), out_(out) {}

  /// Starts a branch; motions of the previous branch end.
  void start(int branch) {
    branch_ = branch;
    holds_.reset();
  }
  /// @param holds holds at the path's next point
  /// @param load_factor load factor of that point, in the model's units
  void note(const SharedHolds& holds, double load_factor);

 private:
  const Structure& structure_;
  std::vector<NeutralMotion>& out_;
  int branch_ = 0;
  SharedHolds holds_;  ///< holds at the last point
};

}  // namespace snapthrough
