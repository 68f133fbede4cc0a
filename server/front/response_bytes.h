#pragma once
/// @file
/// Responses as they go over the wire.

#include <string>
#include <string_view>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// The phrase of a status code, e.g. "Not Found".
[[nodiscard]] std::string_view reason_phrase(int status);

/// @brief Head and body. Of a stream the head only; its end is the end of the connection.
/// @param head_only the request's method was HEAD
[[nodiscard]] std::string to_bytes(const Response& response, bool head_only, bool keep_alive);

/// @brief Compresses the body (gzip, level 1) where the client takes it and it pays. The entity tag of a
/// compressed body ends with "-gzip", since a strong tag names the bytes.
void compress(Response& response, std::string_view accept_encoding);

}  // namespace snapthrough::server::http
