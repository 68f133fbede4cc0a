#pragma once
/// @file
/// Serialises responses to bytes of HTTP/1.1.

#include <string>
#include <string_view>

#include "server/resources/message.h"

namespace snapthrough::server::http {

/// Returns the phrase of a status code, such as "Not Found".
[[nodiscard]] std::string_view reason_phrase(int status);

/// @brief Returns head and body of a response; of a stream only the head (the connection's end ends it).
/// @param head_only the request's method was HEAD
/// @param chunked true: a body with `rest` is sent in chunks; false: the connection's end ends it
[[nodiscard]] std::string to_bytes(const Response& response, bool head_only, bool keep_alive,
                                   bool chunked = true);

/// Appends a piece of a chunked body, and the final chunk after the last piece.
void append_chunk(std::string& bytes, std::string_view piece, bool last);

/// @brief Compresses the body (gzip, level 1) if the client accepts it and it gets smaller. The entity tag of
/// a compressed body gets the suffix "-gzip", because a strong tag identifies bytes. A body with `rest` is
/// compressed piece by piece.
void compress(Response& response, std::string_view accept_encoding);

}  // namespace snapthrough::server::http
