#pragma once
/// @file
/// The numbers of the model that critical loads are differentiated by. Internal to api/.

#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "api/value.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::api {

/// @brief Completes the analysis' sensitivities, of which only the pointers were read: their values and
/// sizes, and how the model is with another value. Reports pointers that name no number which the structure
/// depends on smoothly.
/// @param document of the request; the variations keep it
/// @param model as it was read from there
void read_sensitivities(const std::shared_ptr<const nlohmann::json>& document, const Model& model,
                        Analysis& analysis, Report& report);

}  // namespace snapthrough::api
