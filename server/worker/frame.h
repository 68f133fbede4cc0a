#pragma once
/// @file
/// Messages between the service and a runner, each preceded by its length.

#include <cstdint>
#include <string>
#include <string_view>

namespace snapthrough::server {

enum class FrameType : std::uint32_t {
  // to the runner
  job,    ///< body: memory limit, request
  sweep,  ///< body: whether to forget all sweeps, number, document
  items,  ///< body: memory limit, sweep's number, whether to send each item at once, items' numbers
  // on the control pipe; tasks are counted from 1, without sweeps
  enough,  ///< body: number of a task that begins no further item
  stop,    ///< body: number of a task that ends now
  // from the runner
  news,      ///< body: progress, critical points and path points since the last news
  job_run,   ///< body: JobRun, the outcome of a job
  outcomes,  ///< body: outcomes of the points of items, in order
  done       ///< body: WorkUsage; end of a list of items
};

struct Frame {
  FrameType type = FrameType::done;
  std::string body;
};

/// @brief Writes a frame. @return false when the peer is gone
[[nodiscard]] bool write_frame(int fd, FrameType type, std::string_view body);
/// @brief Waits for a complete frame. @return false when the peer is gone
[[nodiscard]] bool read_frame(int fd, Frame& frame);

/// @brief Assembles frames from the bytes that have arrived, without blocking: the peer may send a part of a
/// frame and then nothing.
class FrameReceiver {
 public:
  enum class State { incomplete, complete, gone };

  /// @param most largest size of a frame; returns `gone` for a larger one
  [[nodiscard]] State receive(int fd, std::uint64_t most);
  /// Returns the frame. @pre receive() returned `complete`
  [[nodiscard]] Frame take();

 private:
  std::string head_;
  std::uint64_t size_ = 0;  ///< size of the body, from the head
  Frame frame_;
};

}  // namespace snapthrough::server
