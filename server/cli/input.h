#pragma once
/// @file
/// Functions shared by the commands that read a document.

#include <optional>
#include <string>
#include <vector>

#include "server/cli/streams.h"
#include "solver/check/check.h"

namespace snapthrough::server::cli {

/// Returns the text of a file, or of standard input for "-"; nullopt after a message on `err`.
[[nodiscard]] std::optional<std::string> read_all(const std::string& path, const Streams& streams);

/// Writes findings to `err`, one a line, JSON Pointer first.
void print_findings(const std::vector<Finding>& findings, const Streams& streams);

}  // namespace snapthrough::server::cli
