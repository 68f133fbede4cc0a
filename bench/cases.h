#pragma once
/// @file
/// Structures with known loads that the benchmarks share.

#include <string>
#include <vector>

#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::bench {

struct Case {
  std::string name;
  Model model;
  Analysis analysis;     ///< what is asked for; states are not
  double load = 0.0;     ///< the load factor it has to find
  double target_ms = 0;  ///< wanted at accuracy 1e-3; 0: none
};

/// @brief A column on a base, shallow and deep arches, rings, a frame: the first critical load of each.
///
/// Sources: column and base, P = P_e + K L^2 / pi^2; all others collocation of the boundary-value problems,
/// 10 to 12 digits (tests/verification/data).
[[nodiscard]] std::vector<Case> cases();
/// @pre one of cases() has the name, or it is "column_with_spring"
[[nodiscard]] Case case_named(const std::string& name);

/// Pinned shallow arch without base on a mesh of that many elements, four steps of its path, far below its
/// first critical load.
[[nodiscard]] Case growing_arch(int elements, int order = 1);
/// The shallow arch on a base outside of k = 1e6, cut into that many bases beside one another.
[[nodiscard]] Case arch_on_pieces(int pieces);
/// Pinned column with a spring of 100 EI / L^3 at half its length, linearised: P from the transfer matrix.
[[nodiscard]] Case column_with_spring();

}  // namespace snapthrough::bench
