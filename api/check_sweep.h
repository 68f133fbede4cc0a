#pragma once
/// @file
/// The rules of a sweep document: what its fields say together, and with the model and the analysis. Internal
/// to api/.
///
/// The reader (read_sweep.cpp) calls each function when what it needs has been read, so that mistakes come in
/// the order of the document. Each reports what it finds at the value it is given, or in `report`.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "api/sweep.h"
#include "api/sweep_data.h"
#include "api/value.h"

namespace snapthrough::api {

/// A name is that of a column, and of no other. @pre the name is a text
void check_name(const SweepParameter& parameter, const Value& name);

/// The request has the place that a target names, or an object that it can be a new member of. Tells whether.
/// @param tokens of the pointer @param base model and analysis
[[nodiscard]] bool check_target(const std::vector<std::string>& tokens, const nlohmann::json& base,
                                const Value& pointer);

/// Values are numbers where a target computes with them, and so is what it gets. @pre the targets were read
void check_values(const SweepParameter& parameter, const Value& values);

/// A logarithmic range is positive; and the same as check_values() for all from one end to the other.
/// @pre the targets were read, and there is a range
void check_range(const SweepParameter& parameter, const Value& range);

/// Each value has a label, and no other value has it. @pre the values were read
void check_labels(const SweepParameter& parameter, const Value& label);

/// What following needs: the last parameter of a grid, numbers in order, a critical analysis on a fixed mesh,
/// and outputs that a curve has. @pre all else was read without a mistake
void check_follow(const SweepData& data, const Value& follow);

/// @brief Outputs are places that a result of this analysis and this model has (sweep_outputs.cpp).
/// @pre the parameters and outputs were read; an output that is no pointer has no tokens
void check_outputs(const SweepData& data, Report& report);

/// No name twice, and no place written by two targets: which one won would depend on their order.
void check_distinct(const SweepData& data, Report& report);

/// Sets the number of points, without building any; what is too many is not counted to its end.
void count_points(SweepData& data, std::uint64_t most, Report& report);

/// @brief What no point can do without: a request that is right beside the targets, and values of types that
/// their targets take. @pre all else holds
void check_points(const Sweep& sweep, const SweepData& data, std::vector<Finding>& findings);

}  // namespace snapthrough::api
