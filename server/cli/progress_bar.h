#pragma once
/// @file
/// Progress of a sweep as a line on a terminal.

#include <cstdint>
#include <string>

namespace snapthrough::server::cli {

/// @brief Returns a bar with the counts of points, points per second, and the remaining time at that rate.
/// @param elapsed_s seconds since the first point began
[[nodiscard]] std::string progress_line(std::uint64_t done, std::uint64_t failed, std::uint64_t all,
                                        double elapsed_s);

}  // namespace snapthrough::server::cli
