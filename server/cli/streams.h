#pragma once
/// @file
/// What the commands share: standard streams and exit statuses.

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

}  // namespace snapthrough::server::cli
