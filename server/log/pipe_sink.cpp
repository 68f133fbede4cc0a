#include "server/log/pipe_sink.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <climits>

namespace snapthrough::server {

/// Writes the pending bytes; returns false if some are left. A writable pipe takes PIPE_BUF bytes at once.
bool PipeSink::write_pending() {
  while (!pending_.empty()) {
    pollfd ready{descriptor_, POLLOUT, 0};
    if (::poll(&ready, 1, 0) <= 0) {
      return false;
    }
    const ssize_t written =
        ::write(descriptor_, pending_.data(), std::min<std::size_t>(pending_.size(), PIPE_BUF));
    if (written < 0) {
      pending_.clear();  // the reader has closed the pipe
      return true;
    }
    pending_.erase(0, static_cast<std::size_t>(written));
  }
  return true;
}

void PipeSink::sink_it_(const spdlog::details::log_msg& message) {
  if (!write_pending()) {
    ++lost_;
    return;
  }
  if (lost_ > 0) {
    pending_ = R"({"level":"warning","event":"log","lost_lines":)" + std::to_string(lost_) + "}\n";
    lost_ = 0;
  }
  spdlog::memory_buf_t line;
  formatter_->format(message, line);
  pending_.append(line.data(), line.size());
  static_cast<void>(write_pending());
}

}  // namespace snapthrough::server
