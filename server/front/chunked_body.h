#pragma once
/// @file
/// Decoder of request bodies in chunks (RFC 9112, 7.1).

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/front/request_head.h"

namespace snapthrough::server::http {

/// @brief Decodes the chunks of one body. Chunk extensions and trailers are refused: clients of the service
/// do not use them, and request smuggling relies on parsers that read them differently. Not thread-safe.
class ChunkedBody {
 public:
  /// @param limit largest size of the decoded body in bytes
  explicit ChunkedBody(std::size_t limit) : limit_(limit) {}

  /// @brief Decodes the complete chunks in `bytes`.
  /// @param bytes the bytes after those of the previous calls that were taken
  /// @return number of bytes taken; the next call begins after them
  std::size_t take(std::string_view bytes);

  [[nodiscard]] bool complete() const { return state_ == State::complete; }
  /// Returns why the body is refused; take() must not be called afterwards.
  [[nodiscard]] const std::optional<Refusal>& refusal() const { return refusal_; }
  [[nodiscard]] std::size_t size() const { return body_.size(); }
  /// Moves the decoded body out of the decoder.
  [[nodiscard]] std::string release() { return std::move(body_); }

 private:
  enum class State { size, data, data_end, last_end, complete };

  std::size_t take_size(std::string_view bytes);
  std::size_t take_data(std::string_view bytes);
  std::size_t take_line_end(std::string_view bytes, State next);
  std::size_t refuse(int status, std::string detail);

  std::size_t limit_;
  State state_ = State::size;
  std::size_t left_ = 0;  ///< missing bytes of the chunk
  std::string body_;
  std::optional<Refusal> refusal_;
};

}  // namespace snapthrough::server::http
