#pragma once
/// @file
/// Readers of what a layer of soil has in every document. Internal to api/.

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

/// Reads `k`, and `phi` or `C1`, `C2` and `C3`.
[[nodiscard]] soil::Sand read_api_sand(Object& in);
/// Reads `Su`, `eps50` and `J`.
[[nodiscard]] soil::SoftClay read_soft_clay(Object& in);

}  // namespace snapthrough::api
