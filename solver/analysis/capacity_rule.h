#pragma once
/// @file
/// Limit loads of supports with a capacity in the analyses that follow paths.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "solver/discrete/capacity_balance.h"
#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"
#include "solver/trace/trace.h"

namespace snapthrough {

/// @brief Rule that ends a path at the capacity of the structure's supports; empty: they hold any load.
/// @param ends limit loads of the model; null: there are none
/// @param asked load factors at which states are asked for; the path goes on to those below a limit
/// @param structure, problem kept by reference; must outlive the rule
[[nodiscard]] std::optional<CapacityRule> capacity_rule(const CapacityEnds* ends, const Structure& structure,
                                                        StructuralProblem& problem,
                                                        const std::vector<double>& asked);

/// @brief Load factor of the limit that ended a path: that of the critical point where the path lost its
/// stiffness, else the limit load of small displacements. Where a law bends to its plateau, the critical
/// point is the last point before the bend (locate_at_kink()), and the limit load is nearer.
/// @pre outcome.end is TraceEnd::capacity
[[nodiscard]] double capacity_load(const CapacityEnds& ends, const Structure& structure,
                                   const TraceOutcome& outcome);

/// @brief Adds the limit on the side of a load factor to the result.
/// @param load_factor that was found for the limit
/// @return sentence on the limit, the motion and the supports
[[nodiscard]] std::string report_capacity(const CapacityEnds& ends, const ResolvedModel& model,
                                          double load_factor, Result& result);

/// @brief Adds the limit that ended a path that was followed for its own sake, as critical point too: the one
/// at which the path lost its stiffness, or the limit load of small displacements with the share of it that
/// the path did not reach as error.
/// @param count critical points of the primary path in the result
/// @pre outcome.end is TraceEnd::capacity
void report_capacity_point(const Analysis& analysis, const CapacityEnds& ends, const Structure& structure,
                           const TraceOutcome& outcome, std::size_t count, Result& result);

/// @brief Adds the limits of a model, as small displacements have them, that load factors exceed.
/// @return sentence on the first of them; empty: all load factors are held
[[nodiscard]] std::string report_exceeded(const ResolvedModel& model, const CapacityEnds& ends,
                                          const std::vector<double>& factors, Result& result);

}  // namespace snapthrough
