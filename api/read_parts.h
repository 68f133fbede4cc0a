#pragma once
/// @file
/// Readers of the two members of a request document.

#include "api/value.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"

namespace snapthrough::api {

void read(const Value& value, Model& model);
void read(const Value& value, Section& out);
void read(const Value& value, Load& out);
/// Appends the loads of load cases, with the factors of their cases, to the model's loads.
void read_load_cases(const Value& value, Model& model);
void read(const Value& value, Pattern& out);
void read(const Value& value, Side& out);
void read(const Value& value, Location& out);
void read(const Value& value, Analysis& analysis);

}  // namespace snapthrough::api
