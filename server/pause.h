#pragma once
/// @file
/// A pause that a stop request ends.

#include <chrono>
#include <stop_token>

namespace snapthrough::server {

/// Waits for `time`, or until a stop is requested.
void pause(const std::stop_token& stop, std::chrono::milliseconds time);

}  // namespace snapthrough::server
