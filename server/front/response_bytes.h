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
/// @param chunked how a body with a `rest` is sent; else its end is the end of the connection
[[nodiscard]] std::string to_bytes(const Response& response, bool head_only, bool keep_alive,
                                   bool chunked = true);

/// Appends a piece of a chunked body, and its end after the last one.
void append_chunk(std::string& bytes, std::string_view piece, bool last);

/// @brief Compresses the body (gzip, level 1) where the client takes it and it pays. The entity tag of a
/// compressed body ends with "-gzip", since a strong tag names the bytes. A body with a `rest` is compressed
/// piece by piece.
void compress(Response& response, std::string_view accept_encoding);

}  // namespace snapthrough::server::http
