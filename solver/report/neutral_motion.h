#pragma once
/// @file
/// Motions without stiffness as results tell of them.

#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"
#include "solver/problem/holds.h"
#include "solver/result.h"

namespace snapthrough {

/// @brief The motions that are held at a point, each by the nodes that move: a basis in which each motion but
/// one leaves some node's component where it is, so that a translation is told as a translation.
/// @param holds empty: no motions
/// @return with neither branch nor load factors
[[nodiscard]] std::vector<NeutralMotion> neutral_motions(const Structure& structure, const Model& model,
                                                         const SharedHolds& holds);

/// @brief Writes down from where to where along a path motions are free.
class NeutralMotionLog {
 public:
  /// @param structure, model, out kept by reference, must outlive this
  NeutralMotionLog(const Structure& structure, const Model& model, std::vector<NeutralMotion>& out)
      : structure_(structure), model_(model), out_(out) {}

  /// A path begins: what was held before does not go on.
  void start(int branch) {
    branch_ = branch;
    holds_.reset();
  }
  /// @param holds of the path's next point
  /// @param load_factor there, of the model
  void note(const SharedHolds& holds, double load_factor);

 private:
  const Structure& structure_;
  const Model& model_;
  std::vector<NeutralMotion>& out_;
  int branch_ = 0;
  SharedHolds holds_;  ///< of the last point
};

}  // namespace snapthrough
