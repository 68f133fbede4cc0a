#pragma once
/// @file
/// Which loads of an analysis one-sided supports can hold, before anything is computed.

#include <optional>
#include <string>
#include <vector>

#include "solver/discrete/unilateral_balance.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/result.h"

namespace snapthrough {

/// What of an analysis' loads is held (UnilateralBalance).
struct HeldLoads {
  std::optional<std::string> refusal;  ///< a sentence where some are not; empty: all are
  bool any = true;                     ///< some load is held that the analysis asks for
  std::vector<char> factors;           ///< `static`: for each of the load factors whether it is held
};

/// @brief Looks at the loads that an analysis begins with: for paths the constant actions with a little of
/// the proportional ones; for `buckling` also those of the reference load, whose contact it takes; for
/// `static` those of each load factor, and where a path leads to them also those that it begins with. For a
/// path that begins with a given state (Analysis::start) nothing is looked at: its loads count as held, and
/// the path ends with `no_start` where that state has no equilibrium.
[[nodiscard]] HeldLoads held_loads(const Model& model, const Analysis& analysis,
                                   const UnilateralBalance& balance);

/// @brief Why the path of growing load from the unloaded structure can't begin; empty: its loads are held.
[[nodiscard]] std::optional<std::string> start_refusal(const Model& model, const UnilateralBalance& balance);

/// @brief Withdraws a linearised critical load beyond the load factor up to which its loads are held: fails
/// with the code "not_held" and that factor.
void withdraw_load_not_held(const Model& model, const UnilateralBalance& balance, Result& result);

}  // namespace snapthrough
