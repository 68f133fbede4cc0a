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
/// Rigid frame of two storeys with clamped feet and at least that many members, a load on each joint, one
/// element of order 3 a member: four steps of its path. The front of its joints has the same size for all
/// numbers of bays.
[[nodiscard]] Case growing_bays(int members);
/// The same with as many storeys as bays. The factors of its joints fill in, as those of every plane grid.
[[nodiscard]] Case growing_square(int members);
/// The shallow arch on one-sided bases outside, that many beside one another, one element of order 3 on each:
/// four steps of its path.
[[nodiscard]] Case growing_bases(int bases);
/// The same on one-sided springs, one at the middle of each element.
[[nodiscard]] Case growing_springs(int springs);
/// One of the growing structures by its name: "bays", "square", "bases", "springs", or "elements", which may
/// be followed by the order of the elements.
[[nodiscard]] Case growing_case(const std::string& name, int size);
/// The shallow arch on a base outside of k = 1e6, cut into that many bases beside one another.
[[nodiscard]] Case arch_on_pieces(int pieces);
/// Pinned column with a spring of 100 EI / L^3 at half its length, linearised: P from the transfer matrix.
[[nodiscard]] Case column_with_spring();

}  // namespace snapthrough::bench
