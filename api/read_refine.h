#pragma once
/// @file
/// Reader of `refine` of a sweep document. Internal to api/.

#include "api/sweep_data.h"
#include "api/value.h"

namespace snapthrough::api {

/// Largest number of points of a curve or surface of a refined sweep.
inline constexpr int kMostRefined = 100'000;

/// @brief Reads `refine`, and divides the ranges of the refined parameters into all places that rows can
/// have.
///
/// Reports an output that the sweep does not have, a design other than a grid, parameters without a range of
/// two different ends, and `follow` beside it.
/// @pre the parameters, the design and the outputs were read; with findings only the fields are checked
void read_refine(Object& root, SweepData& data);

}  // namespace snapthrough::api
