#pragma once
/// @file
/// The JSON that stores keep beside the columns of a critical point or a branch: the fields that are kStored
/// in api/result_fields.h, so that a new one needs no migration.

#include <optional>
#include <string>
#include <string_view>

#include "solver/result.h"

namespace snapthrough::api {

/// A JSON object by name of field; nothing where no stored field has a value.
[[nodiscard]] std::optional<std::string> stored_fields(const CriticalPoint& point);
[[nodiscard]] std::optional<std::string> stored_fields(const Branch& branch);

/// @brief Sets the fields that the JSON has. Those that it lacks, which an earlier version did not store,
/// stay; names that are unknown here, of a later version, are passed over.
/// @throws std::runtime_error when the text is no such object
void read_stored_fields(std::string_view json, CriticalPoint& point);
void read_stored_fields(std::string_view json, Branch& branch);

}  // namespace snapthrough::api
