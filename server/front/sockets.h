#pragma once
/// @file
/// Sockets that listen, and what they accept.

#include <string>

#include "server/descriptor.h"
#include "server/status.h"

namespace snapthrough::server::http {

/// A socket that listens; `unavailable` when the address can't be bound.
[[nodiscard]] StatusOr<Descriptor> listen_on(const std::string& host, int port);
/// The port of a bound socket.
[[nodiscard]] int port_of(int socket);
/// The next client, without waiting: -1 when there is none (errno says why). Sets its address.
[[nodiscard]] int accept_from(int listener, std::string& remote);

/// Lets the process open as many descriptors as it is allowed to.
void raise_descriptor_limit();

}  // namespace snapthrough::server::http
