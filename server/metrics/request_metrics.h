#pragma once
/// @file
/// What is measured of requests.

#include <string>

#include "server/metrics/metrics.h"

namespace snapthrough::server {

/// Requests that were answered. Thread-safe.
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
