#pragma once
/// @file
/// What the service counts and times, in the text format of Prometheus.

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace snapthrough::server {

/// One label as the format has it, `name="value"`; several are joined by commas. Values are escaped.
[[nodiscard]] std::string label(std::string_view name, std::string_view value);

/// @brief How often something happened, by labels. Thread-safe.
///
/// Each combination of labels is kept for ever: their values must come from a bounded set.
class Counter {
 public:
  /// @param name ends with _total @param help a sentence
  Counter(std::string_view name, std::string_view help) : name_(name), help_(help) {}
  void add(const std::string& labels);
  /// Appends the metric; its HELP and TYPE lines also when nothing happened yet.
  void write(std::string& text) const;

 private:
  std::string_view name_;
  std::string_view help_;
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> counts_;
};

/// @brief How long something took, by labels as of a Counter. Thread-safe.
class Histogram {
 public:
  /// @param name ends with _seconds @param help a sentence
  Histogram(std::string_view name, std::string_view help) : name_(name), help_(help) {}
  void observe(double seconds, const std::string& labels = "");
  /// Appends the metric; its HELP and TYPE lines also when nothing was observed yet.
  void write(std::string& text) const;

 private:
  static constexpr std::array kBounds{0.0001, 0.0005, 0.001, 0.005, 0.01, 0.05,  0.1,
                                      0.5,    1.0,    5.0,   10.0,  60.0, 600.0, 3600.0};
  struct Series {
    std::array<std::uint64_t, kBounds.size() + 1> counts{};  ///< by the least bound that is not exceeded
    double sum = 0.0;
  };
  std::string_view name_;
  std::string_view help_;
  mutable std::mutex mutex_;
  std::map<std::string, Series> series_;
};

/// Observes how long it exists.
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

/// Appends one metric without labels. `type` is "gauge" or "counter".
void write_metric(std::string& text, std::string_view name, std::string_view type, std::string_view help,
                  double value);

}  // namespace snapthrough::server
