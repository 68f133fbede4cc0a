#pragma once
/// @file
/// A session of the Model Context Protocol over streams: JSON-RPC 2.0, one message a line.

#include <iosfwd>

#include "server/mcp/tools.h"

namespace snapthrough::server::mcp {

/// @brief Serves one client until its stream ends: tools/list, tools/call, ping.
///
/// Calls of tools are computed one after the other on a thread of their own, so that the client is heard in
/// the meantime: it can cancel a call, and answer what a call asks its user.
/// @param in messages of the client. @param out messages to it, each flushed
void serve_session(std::istream& in, std::ostream& out, Surroundings around);

}  // namespace snapthrough::server::mcp
