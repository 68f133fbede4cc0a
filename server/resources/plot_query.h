#pragma once
/// @file
/// The choices of a figure as query parameters, which have the names of the command line's options.

#include <optional>

#include "api/plot/plot_request.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// @brief Reads the query parameters of a figure into `figure`.
/// @return a problem about the first parameter that is unknown, repeated or invalid; nullopt when all are
/// valid
[[nodiscard]] std::optional<Response> read_plot_query(const Request& request, api::PlotRequest& figure);

}  // namespace snapthrough::server::http
