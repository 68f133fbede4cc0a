#pragma once
/// @file
/// The only file of front/ that uses the HTTP library, which decodes targets.

#include "server/front/request_head.h"
#include "server/resources/message.h"

namespace snapthrough::server::http {

/// @brief Returns the request of a head, without body, id and peer.
/// @pre read_head() did not refuse the head
[[nodiscard]] Request request_of(Head head);

}  // namespace snapthrough::server::http
