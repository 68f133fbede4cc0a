#pragma once
/// @file
/// Reader of foundations that are the soil around a buried pipe. Internal to api/.

#include <optional>

#include "api/soil/buried_pipe.h"
#include "api/value.h"

namespace snapthrough::api {

/// Plane of a model with a buried pipe.
enum class PipePlane { vertical, horizontal };

/// Entry of `foundations` with a `pipe`.
struct PipeEntry {
  soil::BuriedPipe pipe;           ///< without its diameter
  std::optional<double> diameter;  ///< empty: that of the member's section
  PipePlane plane = PipePlane::vertical;
};

/// Reads an entry of `foundations` that has a `pipe`.
[[nodiscard]] PipeEntry read_pipe(const Value& value);

}  // namespace snapthrough::api
