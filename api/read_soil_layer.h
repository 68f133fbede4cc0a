#pragma once
/// @file
/// Readers of what a layer of soil has in every document. Internal to api/.

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "api/soil/layers.h"
#include "api/value.h"

namespace snapthrough::api {

/// Reports a number that was read and breaks a rule; `rule` completes "`key` must be".
void require(Object& in, std::string_view key, double value, bool holds, const std::string& rule);
/// Reads a required number with 0 < number <= kMaxMagnitude.
void read_positive(Object& in, std::string_view key, double& out);

void read(const Value& value, soil::Loading& out);
/// Reads `accuracy` if it is there.
void read_accuracy(Object& in, double& out);

/// @brief Reads one number for both faces of a layer, or one for the upper and one for the lower face. The
/// values are not checked, and one that is no number is NaN.
/// @return empty where the field is missing or neither of the two, after a report
[[nodiscard]] std::optional<std::array<double, 2>> read_faces(Object& in, std::string_view key);

/// Reads `k`, and `phi` or `C1`, `C2` and `C3`.
[[nodiscard]] soil::Sand read_api_sand(Object& in);
/// Reads `Su`, `eps50` and `J`.
[[nodiscard]] soil::SoftClay read_soft_clay(Object& in);

}  // namespace snapthrough::api
