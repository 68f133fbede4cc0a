#pragma once
/// @file
/// The command `plot`, which draws figures of results, models and sweeps.

#include <CLI/CLI.hpp>
#include <memory>

#include "server/cli/streams.h"

namespace snapthrough::server::cli {

struct PlotArguments;

/// Adds `plot` with its options to the app, whose parsing sets the returned arguments.
std::shared_ptr<PlotArguments> add_plot_command(CLI::App& app);

/// @brief Writes the figure as SVG to `out` or a file, or as PNG to a file (with rsvg-convert).
///
/// A failure leaves an existing file unchanged. kWrongRequest when the document gives no figure; `err` has
/// the pointer and the rule.
int plot_command(const PlotArguments& arguments, const Streams& streams);

}  // namespace snapthrough::server::cli
