#pragma once
/// @file
/// Warnings of a conversion, as the answers of the service and of the tools list them.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "solver/result.h"

namespace snapthrough::server::http {

/// @brief Returns the warnings as a result lists them: `[{"code": ..., "detail": ...}]`.
///
/// Options of the command are named as the parameters are: `join_tees` for `--join-tees`. Their number and
/// lengths are bounded whatever the drawing is (api/convert/dxf_joints.h), so that a header has room for
/// them.
[[nodiscard]] nlohmann::json conversion_warnings(const std::vector<Warning>& warnings);

}  // namespace snapthrough::server::http
