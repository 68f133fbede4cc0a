#pragma once
/// @file
/// The command line.

#include <iosfwd>

namespace snapthrough::server::cli {

/// Exit statuses of the program.
inline constexpr int kDone = 0;
inline constexpr int kOther = 1;         ///< usage, files, sockets, anything unexpected
inline constexpr int kWrongRequest = 2;  ///< the request document is wrong: findings are on the error stream
inline constexpr int kNotCompleted = 3;  ///< the analysis could not be completed
inline constexpr int kUnfinished = 4;    ///< what a service was asked for has not ended yet
// 128 + signal: solve and sweep were interrupted, and wrote what they had

/// Standard streams, or a test's.
struct Streams {
  std::istream& in;
  std::ostream& out;
  std::ostream& err;
};

/// Parses the arguments and runs one command; returns the exit status.
int run(int argc, const char* const* argv, const Streams& streams);

}  // namespace snapthrough::server::cli
