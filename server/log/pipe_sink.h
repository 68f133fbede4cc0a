#pragma once
/// @file
/// Log lines to a descriptor that may not be read.

#include <spdlog/sinks/base_sink.h>

#include <cstdint>
#include <mutex>
#include <string>

namespace snapthrough::server {

/// @brief Writes whole lines to a descriptor and never waits for who reads it: lines that find no room are
/// lost, and the first one that finds some again is preceded by how many.
class PipeSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit PipeSink(int descriptor) : descriptor_(descriptor) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

 private:
  [[nodiscard]] bool write_pending();

  const int descriptor_;
  std::string pending_;  ///< of a line that is written in part
  std::int64_t lost_ = 0;
};

}  // namespace snapthrough::server
