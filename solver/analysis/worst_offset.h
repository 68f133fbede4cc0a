#pragma once
/// @file
/// Search for the imperfection that lowers the critical load most.

#include <functional>
#include <optional>
#include <stop_token>

#include "solver/analysis/analyses.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// The worst imperfection that the model asks for; null: none.
[[nodiscard]] const WorstImperfection* worst_imperfection(const Model& model);

/// The model with other offsets in place of its worst imperfection.
/// @param scale factor on the offsets
[[nodiscard]] Model with_offsets(const Model& model, const std::vector<MemberOffsets>& offsets,
                                 double scale = 1.0);

/// Analysis that finds the first loss of stability on the meshes of `analysis`, and nothing else.
[[nodiscard]] Analysis search_analysis(const Analysis& analysis);

/// Runs the search analysis on a model without worst imperfection.
using RunCritical = std::function<Result(const ResolvedModel& model, const CriticalVisitor& visit)>;

/// Outcome of the search: one of both members.
struct WorstSearch {
  std::optional<WorstOffset> found;
  Result failed;         ///< result with its failure, where `found` is empty
  int failed_paths = 0;  ///< paths that failed; their offsets were passed over
};

/// @brief Finds the offsets of OffsetSpace that lower the first critical load most.
///
/// 1. The critical point of the model without the imperfection gives the works of offsets on its softest
///    motions (offset_works()).
/// 2. The steepest offsets of each motion, with both signs (a limit point's own motion with the sign that
///    lowers the load), are starts. The path of each start gives its critical load.
/// 3. From the two lowest starts of different motions: the works at the imperfect structure's critical point
///    give its steepest offsets; the path of these, or of a mean of both shapes, is followed, and so on while
///    the load falls and the shape changes by more than a thousandth of its norm.
/// 4. Parts of the steepest offsets of the other soft motions are added to the lowest shape, which may be a
///    saddle; where one lowers the load, step 3 follows again.
/// The lowest load of all paths wins. Deterministic.
/// @param stop a stop request ends the search with the failure "cancelled"
/// @pre worst_imperfection(model)
[[nodiscard]] WorstSearch find_worst_offset(const Model& model, const Analysis& analysis,
                                            const RunCritical& run, const std::stop_token& stop);

}  // namespace snapthrough
