#pragma once
/// @file
/// Test, before any analysis, whether one-sided supports can hold the loads.

#include <optional>
#include <string>
#include <vector>

#include "solver/discrete/capacity_balance.h"
#include "solver/discrete/unilateral_balance.h"
#include "solver/model/analysis.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Loads of an analysis that the supports hold, by UnilateralBalance.
struct HeldLoads {
  std::optional<std::string> refusal;  ///< sentence on the loads that are not held; empty: all loads are held
  bool any = true;                     ///< some requested load is held
  std::vector<char> factors;           ///< `static`: whether each load factor is held
  const char* code = "not_held";       ///< failure code of the refusal
};

/// @brief Tests the loads that an analysis needs. Paths: the constant actions with a small proportional load.
/// `buckling`: also the reference load, which determines contact. `static`: each load factor, and the start
/// of the path that leads there. A path from a given state (Analysis::start) is not tested; it ends with
/// `no_start` when the state has no equilibrium.
[[nodiscard]] HeldLoads held_loads(const ResolvedModel& model, const Analysis& analysis,
                                   const UnilateralBalance& balance);

/// @brief Refuses the actions that exceed the capacity of supports before anything is computed: the constant
/// ones of any analysis, and the load factors of analyses with small displacements. Analyses with large
/// displacements follow the path to the limit.
/// @param[in,out] held the loads that one-sided supports hold
void refuse_beyond_capacity(const ResolvedModel& model, const Analysis& analysis, const CapacityEnds& ends,
                            HeldLoads& held, Result& result);

/// @brief Why the path of growing load from the unloaded structure cannot start; empty: its loads are held.
[[nodiscard]] std::optional<std::string> start_refusal(const ResolvedModel& model,
                                                       const UnilateralBalance& balance);

/// @brief Withdraws a linearised critical load above the largest load factor that is held: sets the failure
/// "not_held" with that factor.
void withdraw_load_not_held(const ResolvedModel& model, const UnilateralBalance& balance, Result& result);

}  // namespace snapthrough
