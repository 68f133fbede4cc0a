#pragma once
/// @file
/// Messages between the service and a runner, each with its length before it.

#include <cstdint>
#include <string>
#include <string_view>

namespace snapthrough::server {

enum class FrameType : std::uint32_t {
  // to the runner
  job,    ///< memory, request
  sweep,  ///< forget those before, number, document
  units,  ///< memory, number of the sweep, whether to tell each unit at once, numbers of units
  // on the control pipe; tasks are counted from 1, sweeps are none
  enough,  ///< number of a task: no further unit of it
  stop,    ///< number of a task: it shall end
  // from the runner
  news,      ///< progress, critical points that were found since
  job_run,   ///< JobRun
  outcomes,  ///< of the points of units, in their order
  done       ///< of a list of units: no more outcomes
};

struct Frame {
  FrameType type = FrameType::done;
  std::string body;
};

/// @brief Writes a whole frame. @return false when the other side is gone
[[nodiscard]] bool write_frame(int fd, FrameType type, std::string_view body);
/// @brief Waits for a whole frame. @return false when the other side is gone
[[nodiscard]] bool read_frame(int fd, Frame& frame);

/// @brief Puts frames together from what has arrived, and never waits: the other side may send a part of one
/// and then nothing.
class FrameReceiver {
 public:
  enum class State { incomplete, complete, gone };

  /// @param most bytes of a frame; the other side is taken for gone when it says that there are more
  [[nodiscard]] State receive(int fd, std::uint64_t most);
  /// @pre receive() said that it is complete
  [[nodiscard]] Frame take();

 private:
  std::string head_;
  std::uint64_t size_ = 0;  ///< of the body, once the head is there
  Frame frame_;
};

}  // namespace snapthrough::server
