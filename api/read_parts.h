#pragma once
/// @file
/// Readers of the two members of a request document.

#include "api/value.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::api {

void read(const Value& value, Model& model);
void read(const Value& value, Analysis& analysis);

}  // namespace snapthrough::api
