#pragma once
/// @file
/// Bytes of one connection to whole requests. No sockets, no clock, no library: what it does depends on the
/// bytes alone.

#include <optional>
#include <string>
#include <string_view>

#include "server/front/chunked_body.h"
#include "server/front/request_head.h"

namespace snapthrough::server::http {

/// What the bytes so far amount to.
struct Received {
  enum class Kind {
    head_incomplete,  ///< more bytes are needed to know what is asked
    body_incomplete,  ///< `head` is known, its body is not complete
    request,          ///< complete
    refused           ///< `head.refusal` says why; what follows can't be trusted
  } kind = Kind::head_incomplete;
  Head head;
  std::string body;
};

/// @brief Collects the bytes of a connection and takes requests off them. Not thread-safe.
class RequestReader {
 public:
  /// `limits` must outlive the reader.
  explicit RequestReader(const HeadLimits& limits) : limits_(limits) {}

  void append(std::string_view bytes) { buffer_.append(bytes); }
  /// Takes the next request if it is there. After `refused` the reader must not be used any more.
  Received next();

  /// Bytes that are held.
  [[nodiscard]] std::size_t held() const { return buffer_.size() + (chunks_ ? chunks_->size() : 0); }
  /// Gives memory back that an earlier, larger request needed.
  void shrink();

 private:
  Received refused(Head head);
  Received next_of_chunks();

  const HeadLimits& limits_;
  std::string buffer_;
  std::size_t searched_ = 0;   ///< no end of a head before this place
  std::size_t head_size_ = 0;  ///< of the request whose body is awaited; 0: none
  Head head_;
  std::optional<ChunkedBody> chunks_;  ///< of the request whose body is awaited in chunks
};

}  // namespace snapthrough::server::http
