#include "api/plot/plot_error.h"

#include <utility>

namespace snapthrough::api {

PlotError::PlotError(std::string pointer, std::string rule)
    : std::runtime_error(pointer.empty() ? rule : pointer + ": " + rule),
      pointer_(std::move(pointer)),
      rule_(std::move(rule)) {}

}  // namespace snapthrough::api
