#pragma once
/// @file
/// Requests and responses, independent of the HTTP library. Plain data.

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

/// A complete request. Names of headers are not case-sensitive.
struct Request {
  std::string method;
  std::string path;  ///< path, percent-decoded, without the query
  Fields query;      ///< decoded, sorted by name, values of one name in order
  Fields headers;    ///< in order of arrival
  std::string body;
  std::size_t body_bytes = 0;  ///< size of the received body
  std::string id;              ///< identifies the request in logs and problems
  std::string remote;          ///< address of the peer
  std::string owner;           ///< owner of the request's key; empty: the service has no keys
  /// Digest of the key of a job that the request presents. The owner is known when the store has compared
  /// it. Empty: the request has another key, or none.
  std::string job_key_sha256;

  /// Returns the first header with a name; nullopt when absent.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
};

struct Response;

/// A response that waits for an event without occupying a thread.
struct Deferred {
  /// Called once with a function to call at the event (from any thread, possibly at once).
  std::function<void(std::function<void()> wake)> arm;
  std::chrono::milliseconds wait{0};  ///< longest wait
  std::function<Response()> resume;   ///< returns the response, after the event or the wait
};

/// @brief A body that is produced while it is sent, so that it is never in memory as a whole. Used by one
/// thread at a time.
class BodySource {
 public:
  BodySource() = default;
  BodySource(const BodySource&) = delete;
  BodySource& operator=(const BodySource&) = delete;
  BodySource(BodySource&&) = delete;
  BodySource& operator=(BodySource&&) = delete;
  virtual ~BodySource() = default;
  /// Appends the next piece, about kPieceBytes; returns false after the last one. Called when all earlier
  /// pieces were sent. An error closes the connection, so that the client sees that the body is incomplete.
  virtual StatusOr<bool> append_next(std::string& piece) = 0;
  /// Returns the approximate memory in use between pieces, in bytes.
  [[nodiscard]] virtual std::size_t held_bytes() const = 0;
};

/// Approximate size of a piece of a body in bytes.
inline constexpr std::size_t kPieceBytes = 128 * 1024;

/// Source of the pieces of a stream.
class StreamSource {
 public:
  StreamSource() = default;
  StreamSource(const StreamSource&) = delete;
  StreamSource& operator=(const StreamSource&) = delete;
  StreamSource(StreamSource&&) = delete;
  StreamSource& operator=(StreamSource&&) = delete;
  virtual ~StreamSource() = default;
  /// Called after each push on a thread that may block; may push more.
  virtual void poll() = 0;
};

/// A response without defined end: pieces are sent when they are pushed.
struct Stream {
  /// Sends a piece, from any thread; returns false for a lost or slow client: push nothing more then.
  using Push = std::function<bool(std::string piece, bool last)>;
  /// Called once after the head was sent. The returned source is kept until the client disconnects.
  std::function<std::shared_ptr<StreamSource>(Push push)> open;
};

struct Response {
  int status = 200;
  Fields headers;  ///< all but Content-Type and Content-Length
  std::string content_type;
  std::string body;
  std::string trouble;  ///< internal error, for the log only
  std::string route;    ///< template of the matched route for logs, such as "/v1/jobs/{id}"; empty: none
  std::optional<Deferred> deferred;  ///< set: all other members are unset
  std::optional<Stream> stream;      ///< set: replaces the body
  std::shared_ptr<BodySource> rest;  ///< set: rest of the body after `body`

  /// Returns the first header with a name; nullopt when absent.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
};

/// Returns whether two ASCII texts are equal, ignoring case.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Returns the text without spaces and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Returns the text percent-encoded except for letters, digits, "-", "_", "." and "~" (RFC 3986).
[[nodiscard]] std::string percent_encoded(std::string_view text);

/// Returns the trimmed parts between separators, without empty ones.
[[nodiscard]] std::vector<std::string_view> split_list(std::string_view text, char separator);

}  // namespace snapthrough::server::http
