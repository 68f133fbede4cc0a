#pragma once
/// @file
/// The command that makes figures of results and sweeps.

#include <CLI/CLI.hpp>
#include <memory>

#include "server/cli/app.h"

namespace snapthrough::server::cli {

struct PlotArguments;

/// Adds `plot` with its options to the program; the arguments are set when it parses.
std::shared_ptr<PlotArguments> add_plot_command(CLI::App& app);

/// @brief Writes the figure as SVG on `out`, or to a file: SVG, or PNG made by rsvg-convert.
///
/// A file is there when it is whole, else what was there before. kWrongRequest when no figure can be made of
/// the document: `err` has the pointer and the rule.
int plot_command(const PlotArguments& arguments, const Streams& streams);

}  // namespace snapthrough::server::cli
