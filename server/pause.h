#pragma once
/// @file
/// Waiting that ends early when its thread is asked to stop.

#include <chrono>
#include <stop_token>

namespace snapthrough::server {

/// Waits, or returns at once when a stop is requested.
void pause(const std::stop_token& stop, std::chrono::milliseconds time);

}  // namespace snapthrough::server
