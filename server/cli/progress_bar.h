#pragma once
/// @file
/// How far a sweep is, as a line of a terminal.

#include <cstdint>
#include <string>

namespace snapthrough::server::cli {

/// @brief A bar, points done of all, points a second, and the time left at that rate.
/// @param elapsed_s seconds since the first point began
[[nodiscard]] std::string progress_line(std::uint64_t done, std::uint64_t failed, std::uint64_t all,
                                        double elapsed_s);

}  // namespace snapthrough::server::cli
