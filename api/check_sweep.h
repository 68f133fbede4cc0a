#pragma once
/// @file
/// Rules that relate several fields of a sweep document, or a field and the model or the analysis. Internal
/// to api/.
///
/// The reader (read_sweep.cpp) calls each function as soon as its input is read, so that findings have the
/// order of the document. Each function reports at the Value it receives, or in `report`.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "api/sweep.h"
#include "api/sweep_data.h"
#include "api/value.h"

namespace snapthrough::api {

/// Reports a name that is empty, begins with / or is the name of another column. @pre the name is a text
void check_name(const SweepParameter& parameter, const Value& name);

/// Reports a target whose place the request lacks and cannot get. Returns whether the target is valid.
/// @param tokens tokens of the target's pointer @param base model and analysis
[[nodiscard]] bool check_target(const std::vector<std::string>& tokens, const nlohmann::json& base,
                                const Value& pointer);

/// Reports values that give no finite number at a target with scale or power. @pre the targets were read
void check_values(const SweepParameter& parameter, const Value& values);

/// Reports a range with log spacing that is not positive, or that gives no finite number at a target.
/// @pre the targets were read, and the parameter has a range
void check_range(const SweepParameter& parameter, const Value& value);

/// Reports labels that are empty, repeated, or not as many as values. @pre the values were read
void check_labels(const SweepParameter& parameter, const Value& label);

/// Reports why a critical point cannot be followed: design, order of values, analysis, mesh, outputs.
/// @pre the rest of the document has no findings
void check_follow(const SweepData& data, const Value& follow);

/// @brief Reports outputs that no result of this analysis and model has (sweep_outputs.cpp).
/// @pre the parameters and outputs were read; an output that is no pointer has no tokens
void check_outputs(const SweepData& data, Report& report);

/// Reports repeated names and targets that overlap, for which the order of targets would decide.
void check_distinct(const SweepData& data, Report& report);

/// Sets the number of points without building points; reports more than `most` and stops counting there.
void count_points(SweepData& data, std::uint64_t most, Report& report);

/// @brief Reports mistakes that all points share: in the request apart from the targets, and in the types of
/// values. @pre no other findings
void check_points(const Sweep& sweep, const SweepData& data, std::vector<Finding>& findings);

}  // namespace snapthrough::api
