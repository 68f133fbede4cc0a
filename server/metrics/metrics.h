#pragma once
/// @file
/// Counters and histograms in the text format of Prometheus.

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// Returns a label `name="value"` with the value escaped; commas join several labels.
[[nodiscard]] std::string label(std::string_view name, std::string_view value);

/// @brief Counts events by labels. Thread-safe.
///
/// Each combination of labels is kept for ever, so values must come from a bounded set.
class Counter {
 public:
  /// @param name ends with _total @param help a sentence
  Counter(std::string_view name, std::string_view help) : name_(name), help_(help) {}
  void add(const std::string& labels);
  /// Appends the metric, with HELP and TYPE lines even without events.
  void write(std::string& text) const;

 private:
  std::string_view name_;
  std::string_view help_;
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> counts_;
};

/// @brief Distribution of durations by labels (see Counter). Thread-safe.
class Histogram {
 public:
  /// @param name ends with _seconds @param help a sentence
  Histogram(std::string_view name, std::string_view help) : name_(name), help_(help) {}
  void observe(double seconds, const std::string& labels = "");
  /// Appends the metric, with HELP and TYPE lines even without observations.
  void write(std::string& text) const;

 private:
  static constexpr std::array kBounds{0.0001, 0.0005, 0.001, 0.005, 0.01, 0.05,  0.1,
                                      0.5,    1.0,    5.0,   10.0,  60.0, 600.0, 3600.0};
  struct Series {
    std::array<std::uint64_t, kBounds.size() + 1> counts{};  ///< count of each interval of kBounds
    double sum = 0.0;
  };
  std::string_view name_;
  std::string_view help_;
  mutable std::mutex mutex_;
  std::map<std::string, Series> series_;
};

/// Observes the duration of its lifetime.
class Timed {
 public:
  explicit Timed(Histogram& histogram) : histogram_(histogram) {}
  ~Timed() { histogram_.observe(std::chrono::duration<double>(Clock::now() - start_).count()); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;
  Timed(Timed&&) = delete;
  Timed& operator=(Timed&&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Histogram& histogram_;
  Clock::time_point start_ = Clock::now();
};

/// Appends a metric without labels. `type` is "gauge" or "counter".
void write_metric(std::string& text, std::string_view name, std::string_view type, std::string_view help,
                  double value);

}  // namespace snapthrough::server
