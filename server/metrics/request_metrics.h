#pragma once
/// @file
/// Metrics of requests.

#include <string>

#include "server/metrics/metrics.h"

namespace snapthrough::server {

/// Counts and durations of answered requests. Thread-safe.
struct RequestMetrics {
  Counter answered{"snapthrough_requests_total", "Requests answered, by method, route template and status."};
  Histogram seconds{"snapthrough_request_seconds",
                    "From a complete request to its response, waits included, by route template."};

  void write(std::string& text) const {
    answered.write(text);
    seconds.write(text);
  }
};

}  // namespace snapthrough::server
