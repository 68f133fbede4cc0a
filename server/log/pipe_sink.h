#pragma once
/// @file
/// Log sink for a descriptor that may not be read.

#include <spdlog/sinks/base_sink.h>

#include <cstdint>
#include <mutex>
#include <string>

namespace snapthrough::server {

/// @brief Writes whole lines to a descriptor without blocking. Lines that do not fit are dropped; their
/// number is written before the next line that fits.
class PipeSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit PipeSink(int descriptor) : descriptor_(descriptor) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

 private:
  [[nodiscard]] bool write_pending();

  const int descriptor_;
  std::string pending_;  ///< rest of a partly written line
  std::int64_t lost_ = 0;
};

}  // namespace snapthrough::server
