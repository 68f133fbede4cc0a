#include "server/metrics/metrics.h"

#include <algorithm>
#include <charconv>

namespace snapthrough::server {
namespace {

void append_number(std::string& text, double value) {
  std::array<char, 40> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

}  // namespace

void RequestMetrics::count(std::string_view method, std::string_view route, int status, double seconds) {
  const std::string name(route.empty() ? "none" : route);
  const auto* bound = std::lower_bound(kBounds.begin(), kBounds.end(), seconds);
  const std::lock_guard guard(mutex_);
  ++requests_[{std::string(method), name, status}];
  Histogram& histogram = durations_[name];
  ++histogram.counts[static_cast<std::size_t>(bound - kBounds.begin())];
  histogram.sum += seconds;
}

void RequestMetrics::write(std::string& text) const {
  const std::lock_guard guard(mutex_);
  text += "# HELP snapthrough_requests_total Requests answered.\n# TYPE snapthrough_requests_total counter\n";
  for (const auto& [key, count] : requests_) {
    const auto& [method, route, status] = key;
    text += "snapthrough_requests_total{method=\"" + method + "\",route=\"" + route + "\",status=\"" +
            std::to_string(status) + "\"} " + std::to_string(count) + "\n";
  }
  text +=
      "# HELP snapthrough_request_seconds Time from a complete request to its response, waits included.\n"
      "# TYPE snapthrough_request_seconds histogram\n";
  for (const auto& [route, histogram] : durations_) {
    const std::string label = "{route=\"" + route + "\"";
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      below += histogram.counts[i];
      text += "snapthrough_request_seconds_bucket" + label + ",le=\"";
      if (i < kBounds.size()) {
        append_number(text, kBounds[i]);
      } else {
        text += "+Inf";
      }
      text += "\"} " + std::to_string(below) + "\n";
    }
    text += "snapthrough_request_seconds_sum" + label + "} ";
    append_number(text, histogram.sum);
    text += "\nsnapthrough_request_seconds_count" + label + "} " + std::to_string(below) + "\n";
  }
}

void write_metric(std::string& text, std::string_view name, std::string_view type, std::string_view help,
                  double value) {
  text.append("# HELP ").append(name).append(" ").append(help).append("\n# TYPE ").append(name);
  text.append(" ").append(type).append("\n").append(name).append(" ");
  append_number(text, value);
  text += '\n';
}

}  // namespace snapthrough::server
