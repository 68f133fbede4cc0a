#pragma once
/// @file
/// Turns the bytes of a connection into requests. Without sockets, clock or library, so that the result
/// depends on the bytes alone.

#include <optional>
#include <string>
#include <string_view>

#include "server/front/chunked_body.h"
#include "server/front/request_head.h"

namespace snapthrough::server::http {

/// State of the next request after the bytes received so far.
struct Received {
  enum class Kind {
    head_incomplete,  ///< more bytes are needed for the head
    body_incomplete,  ///< `head` is complete; more bytes are needed for its body
    request,          ///< `head` and `body` are complete
    refused           ///< `head.refusal` is set; later bytes have no defined meaning
  } kind = Kind::head_incomplete;
  Head head;
  std::string body;
};

/// @brief Collects the bytes of a connection and extracts requests. Not thread-safe.
class RequestReader {
 public:
  /// `limits` must outlive the reader.
  explicit RequestReader(const HeadLimits& limits) : limits_(limits) {}

  void append(std::string_view bytes) { buffer_.append(bytes); }
  /// Extracts the next request if it is complete. After `refused` the reader must not be used.
  Received next();

  /// Returns the number of bytes held.
  [[nodiscard]] std::size_t held() const { return buffer_.size() + (chunks_ ? chunks_->size() : 0); }
  /// Releases memory that an earlier, larger request needed.
  void shrink();
  /// Forgets what it holds. The reader must not be used then.
  void release() {
    std::string().swap(buffer_);
    chunks_.reset();
  }

 private:
  Received refused(Head head);
  Received next_of_chunks();

  const HeadLimits& limits_;
  std::string buffer_;
  std::size_t searched_ = 0;   ///< no end of a head begins before this index
  std::size_t head_size_ = 0;  ///< size of the head whose body is incomplete; 0: none
  Head head_;
  std::optional<ChunkedBody> chunks_;  ///< decoder of a body whose chunks are incomplete
};

}  // namespace snapthrough::server::http
