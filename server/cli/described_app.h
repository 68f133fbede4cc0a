#pragma once
/// @file
/// The command line as data, for manual pages and shell completion.

#include <CLI/CLI.hpp>
#include <memory>

namespace snapthrough::server::cli {

/// Returns all commands with options, help and defaults, as run() parses them.
[[nodiscard]] std::shared_ptr<const CLI::App> described_app();

}  // namespace snapthrough::server::cli
