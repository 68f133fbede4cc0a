#pragma once
/// @file
/// Requests and responses as the service sees them, whatever library carries them. Plain data.

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/status.h"

namespace snapthrough::server::http {

using Fields = std::vector<std::pair<std::string, std::string>>;

/// A complete request. Names of headers are compared without regard to case.
struct Request {
  std::string method;
  std::string path;  ///< percent-decoded, without the query
  Fields query;      ///< decoded, by name, those of one name in order
  Fields headers;    ///< in order
  std::string body;
  std::size_t body_bytes = 0;  ///< of the body as it came
  std::string id;              ///< identifies the request in logs and problems
  std::string remote;          ///< address of the peer
  std::string owner;           ///< whose key came with it; empty: no keys are asked for

  /// The first header of that name, or nothing.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
};

struct Response;

/// A response that has to wait for something: no thread waits meanwhile.
struct Deferred {
  /// Called once, with what is to be called (from any thread, at once if need be) when the wait is over.
  std::function<void(std::function<void()> wake)> arm;
  std::chrono::milliseconds wait{0};  ///< at most
  std::function<Response()> resume;   ///< makes the response when woken or when the time is over
};

/// @brief A body that is made while it is sent, so that it is never in memory as a whole.
/// Used by one thread at a time.
class BodySource {
 public:
  BodySource() = default;
  BodySource(const BodySource&) = delete;
  BodySource& operator=(const BodySource&) = delete;
  BodySource(BodySource&&) = delete;
  BodySource& operator=(BodySource&&) = delete;
  virtual ~BodySource() = default;
  /// Appends the next piece, about kPieceBytes; false when it was the last. Not called before the pieces so
  /// far were sent. After an error the connection ends, so that the client sees that the body is not whole.
  virtual StatusOr<bool> append_next(std::string& piece) = 0;
  /// Memory that is kept between pieces, about.
  [[nodiscard]] virtual std::size_t held_bytes() const = 0;
};

/// What a piece of a body has, about.
inline constexpr std::size_t kPieceBytes = 128 * 1024;

/// Where the pieces of a stream come from.
class StreamSource {
 public:
  StreamSource() = default;
  StreamSource(const StreamSource&) = delete;
  StreamSource& operator=(const StreamSource&) = delete;
  StreamSource(StreamSource&&) = delete;
  StreamSource& operator=(StreamSource&&) = delete;
  virtual ~StreamSource() = default;
  /// Called after each push, on a thread that may take its time: may push more.
  virtual void poll() = 0;
};

/// A response without an end: pieces are sent as they come.
struct Stream {
  /// Sends a piece, from any thread; false when the client is gone or too slow and nothing more should come.
  using Push = std::function<bool(std::string piece, bool last)>;
  /// Called once, when the head was sent. What it returns is kept for as long as the client is there.
  std::function<std::shared_ptr<StreamSource>(Push push)> open;
};

struct Response {
  int status = 200;
  Fields headers;  ///< without Content-Type and Content-Length
  std::string content_type;
  std::string body;
  std::string trouble;  ///< what went wrong inside, for the log only
  std::string route;    ///< template of the matched route for logs, e.g. "/v1/jobs/{id}"; empty: none
  std::optional<Deferred> deferred;  ///< set: everything else is still to come
  std::optional<Stream> stream;      ///< set: takes the place of the body
  std::shared_ptr<BodySource> rest;  ///< set: what follows `body`, which is the beginning

  /// The first header of that name, or nothing.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
};

/// Whether two ASCII texts are equal without regard to case.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// The text without spaces and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The text with everything but letters, digits, "-", "_", "." and "~" percent-encoded (RFC 3986).
[[nodiscard]] std::string percent_encoded(std::string_view text);

/// The parts between the separators, trimmed, empty ones left out.
[[nodiscard]] std::vector<std::string_view> split_list(std::string_view text, char separator);

}  // namespace snapthrough::server::http
