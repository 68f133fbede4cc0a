#pragma once
/// @file
/// The command `convert`, which makes parts of a model from soil parameters, tables and drawings.

#include <CLI/CLI.hpp>
#include <memory>

#include "server/cli/streams.h"

namespace snapthrough::server::cli {

struct ConvertArguments;

/// Adds `convert` with its options to the app, whose parsing sets the returned arguments.
std::shared_ptr<ConvertArguments> add_convert_command(CLI::App& app);

/// @brief Writes the converted parts of a model to `out` as one JSON object.
///
/// kWrongRequest when the input has mistakes; `err` has the place and the rule of each, and `out` nothing.
int convert_command(const ConvertArguments& arguments, const Streams& streams);

}  // namespace snapthrough::server::cli
