#pragma once
/// @file
/// The only place of the front that sees the HTTP library: it decodes targets.

#include "server/front/request_head.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// @brief The request of a head, without body, id and peer.
/// @pre read_head() did not refuse it
[[nodiscard]] Request request_of(Head head);

}  // namespace snapthrough::server::http
