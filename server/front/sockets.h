#pragma once
/// @file
/// Sockets that listen, and what they accept.

#include <string>

#include "server/descriptor.h"
#include "server/status.h"

namespace snapthrough::server::http {

/// Returns a listening socket; `unavailable` when the address cannot be bound.
[[nodiscard]] StatusOr<Descriptor> listen_on(const std::string& host, int port);
/// Returns the port of a bound socket.
[[nodiscard]] int port_of(int socket);
/// Accepts a client without waiting, and sets its address; -1 when none waits (errno has the reason).
[[nodiscard]] int accept_from(int listener, std::string& remote);

/// Raises the process' limit of open descriptors to the hard limit.
void raise_descriptor_limit();

}  // namespace snapthrough::server::http
