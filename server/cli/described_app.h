#pragma once
/// @file
/// The command line as data: what manual pages and shell completion are made of.

#include <CLI/CLI.hpp>
#include <memory>

namespace snapthrough::server::cli {

/// Every command with its options, their help and their defaults, as run() parses them.
[[nodiscard]] std::shared_ptr<const CLI::App> described_app();

}  // namespace snapthrough::server::cli
