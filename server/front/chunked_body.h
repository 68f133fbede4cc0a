#pragma once
/// @file
/// A request body that comes in chunks (RFC 9112, 7.1): from its bytes to the body.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/front/request_head.h"

namespace snapthrough::server::http {

/// @brief Decodes the chunks of one body. Chunk extensions and trailers are refused: no client of the service
/// needs them, and two parsers that read them differently see different requests. Not thread-safe.
class ChunkedBody {
 public:
  /// @param limit bytes that the decoded body may have
  explicit ChunkedBody(std::size_t limit) : limit_(limit) {}

  /// @brief Decodes what has come, as far as it is complete.
  /// @param bytes what follows the bytes that were taken before
  /// @return how many of them were taken: the next call begins behind them
  std::size_t take(std::string_view bytes);

  [[nodiscard]] bool complete() const { return state_ == State::complete; }
  /// Why the body is refused; nothing must be taken after that.
  [[nodiscard]] const std::optional<Refusal>& refusal() const { return refusal_; }
  [[nodiscard]] std::size_t size() const { return body_.size(); }
  /// The decoded body; it is no longer here afterwards.
  [[nodiscard]] std::string release() { return std::move(body_); }

 private:
  enum class State { size, data, data_end, last_end, complete };

  std::size_t take_size(std::string_view bytes);
  std::size_t take_data(std::string_view bytes);
  std::size_t take_line_end(std::string_view bytes, State next);
  std::size_t refuse(int status, std::string detail);

  std::size_t limit_;
  State state_ = State::size;
  std::size_t left_ = 0;  ///< bytes of the chunk that are still to come
  std::string body_;
  std::optional<Refusal> refusal_;
};

}  // namespace snapthrough::server::http
