#pragma once
/// @file
/// Messages between the service and a runner, each with its length before it.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace snapthrough::server {

enum class FrameType : std::uint32_t {
  // to the runner
  job,     ///< memory, request
  sweep,   ///< forget those before, number, document
  points,  ///< memory, number of the sweep, whether to tell each outcome at once, points
  curve,   ///< memory, number of the sweep, first point
  // on the control pipe; tasks are counted from 1, sweeps are none
  enough,  ///< number of a task: no further point of it
  stop,    ///< number of a task: it shall end
  // from the runner
  news,      ///< progress, critical points that were found since
  job_run,   ///< JobRun
  outcomes,  ///< of points, in their order
  done       ///< of a list of points: no more outcomes
};

struct Frame {
  FrameType type = FrameType::done;
  std::string body;
};

/// @brief Writes a whole frame. @return false when the other side is gone
[[nodiscard]] bool write_frame(int fd, FrameType type, std::string_view body);
/// @brief Waits for a whole frame. @return false when the other side is gone, or says that there are more
/// than `most` bytes
[[nodiscard]] bool read_frame(int fd, Frame& frame,
                              std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

}  // namespace snapthrough::server
