#pragma once
/// @file
/// What is counted about requests, in the text format of Prometheus.

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>

namespace snapthrough::server {

/// @brief Counts requests and how long they took, by route template. Thread-safe.
class RequestMetrics {
 public:
  void count(std::string_view method, std::string_view route, int status, double seconds);
  /// Appends the counters and histograms.
  void write(std::string& text) const;

 private:
  static constexpr std::array kBounds{0.0005, 0.001, 0.002, 0.005, 0.01, 0.05, 0.1, 0.5, 1.0, 10.0, 60.0};
  struct Histogram {
    std::array<std::uint64_t, kBounds.size() + 1> counts{};
    double sum = 0.0;
  };
  mutable std::mutex mutex_;
  std::map<std::tuple<std::string, std::string, int>, std::uint64_t> requests_;
  std::map<std::string, Histogram> durations_;
};

/// Appends one metric with its HELP and TYPE lines. `type` is "gauge" or "counter".
void write_metric(std::string& text, std::string_view name, std::string_view type, std::string_view help,
                  double value);

}  // namespace snapthrough::server
