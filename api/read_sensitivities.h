#pragma once
/// @file
/// Values of the model with respect to which critical loads are differentiated. Internal to api/.

#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "api/value.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::api {

/// @brief Completes the analysis' sensitivities, of which only the pointers were read: value, size of a large
/// change, and model as a function of the value. Reports pointers to anything but numbers on which the
/// structure depends smoothly.
/// @param document request document; the variations keep a reference to it
/// @param model model read from the document
void read_sensitivities(const std::shared_ptr<const nlohmann::json>& document, const Model& model,
                        Analysis& analysis, Report& report);

}  // namespace snapthrough::api
