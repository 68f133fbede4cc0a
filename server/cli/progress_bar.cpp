#include "server/cli/progress_bar.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace snapthrough::server::cli {
namespace {

constexpr std::size_t kWidth = 30;

/// Returns a duration as 1:02:03, or as 02:03 below an hour.
std::string clock_time(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  std::array<char, 40> text{};
  if (whole >= 3600) {
    std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%02lld:%02lld", whole / 60, whole % 60);
  }
  return text.data();
}

}  // namespace

std::string progress_line(std::uint64_t done, std::uint64_t failed, std::uint64_t all, double elapsed_s) {
  const double part = all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all);
  const auto filled = static_cast<std::size_t>(part * static_cast<double>(kWidth));
  std::string line = "[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "] ";
  line += std::to_string(done) + "/" + std::to_string(all);
  if (done > 0 && elapsed_s > 0.0) {
    const double rate = static_cast<double>(done) / elapsed_s;
    std::array<char, 60> text{};
    std::snprintf(text.data(), text.size(), ", %.3g points/s, ", rate);
    line += text.data() + clock_time(static_cast<double>(all - done) / rate) + " left";
  }
  if (failed > 0) {
    line += ", " + std::to_string(failed) + " failed";
  }
  return line;
}

}  // namespace snapthrough::server::cli
