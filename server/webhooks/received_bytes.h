#pragma once
/// @file
/// What a connection has received, whoever reads it.

#include <cstdint>

namespace snapthrough::server {

/// Returns the bytes that a TCP connection has received; 0 when the system does not tell.
[[nodiscard]] std::uint64_t received_bytes(int socket);

}  // namespace snapthrough::server
