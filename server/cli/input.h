#pragma once
/// @file
/// What the commands that read a document share.

#include <optional>
#include <string>
#include <vector>

#include "server/cli/app.h"
#include "solver/check/check.h"

namespace snapthrough::server::cli {

/// The text of a file, or of standard input for "-"; nothing when it cannot be read, which `err` then says.
[[nodiscard]] std::optional<std::string> read_all(const std::string& path, const Streams& streams);

/// One line a finding on `err`, JSON Pointer first.
void print_findings(const std::vector<Finding>& findings, const Streams& streams);

}  // namespace snapthrough::server::cli
