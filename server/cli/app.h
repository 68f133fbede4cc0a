#pragma once
/// @file
/// Entry point of the command line.

#include "server/cli/streams.h"

namespace snapthrough::server::cli {

/// Parses the arguments and runs one command; returns the exit status.
int run(int argc, const char* const* argv, const Streams& streams);

}  // namespace snapthrough::server::cli
