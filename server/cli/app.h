#pragma once
/// @file
/// Entry point of the command line.

#include <iosfwd>

namespace snapthrough::server::cli {

/// Exit statuses of the program.
inline constexpr int kDone = 0;
inline constexpr int kOther = 1;         ///< wrong usage, failed file or socket, other errors
inline constexpr int kWrongRequest = 2;  ///< invalid document; the error stream has the findings
inline constexpr int kNotCompleted = 3;  ///< the analysis could not be completed
inline constexpr int kUnfinished = 4;    ///< a job or sweep of a service has not ended
// 128 + signal: solve or sweep was interrupted after it wrote what was complete

/// Standard streams, or streams of a test.
struct Streams {
  std::istream& in;
  std::ostream& out;
  std::ostream& err;
};

/// Parses the arguments and runs one command; returns the exit status.
int run(int argc, const char* const* argv, const Streams& streams);

}  // namespace snapthrough::server::cli
