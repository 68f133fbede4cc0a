#pragma once
/// @file
/// Detection of mechanisms: structures that can move without strain.

#include <vector>

#include "solver/model/finding.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// @brief Finds strain-free motions of the unloaded structure on which the loads do work, with one-sided
/// supports as bilateral.
///
/// Motions without work are allowed: the analysis pins them and reports them (Result::neutral_motion).
/// @return one finding with code "mechanism", or "too_connected" if the test would take too long; else empty
/// @pre the model passed all other checks
[[nodiscard]] std::vector<Finding> find_mechanism(const ResolvedModel& model);

/// @brief Whether a structure that can move without strain has members that only pull, which may hold it when
/// they are tight: the loads drive such a motion, or these members are slack as they are drawn. A structure
/// of cables and rods alone counts as one.
/// @pre the model passed all other checks
[[nodiscard]] bool is_loose(const ResolvedModel& model);

/// @brief Whether the unloaded structure, with one-sided supports as bilateral, can move without strain.
/// @pre the model passed all other checks
[[nodiscard]] bool can_move(const ResolvedModel& model);

/// @brief Fast sufficient test that find_mechanism() finds nothing: at most ten connected straight members
/// and arcs of comparable stiffness, without releases, whose rigid supports fix a rigid body with good
/// leverage.
/// @return false when the test is inconclusive
/// @pre the model passed all other checks
[[nodiscard]] bool is_plainly_held(const ResolvedModel& model);

}  // namespace snapthrough
