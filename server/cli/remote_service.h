#pragma once
/// @file
/// A client of a service, for the commands submit, wait and fetch.

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

namespace snapthrough::server::cli {

/// Address of a service.
struct ServiceAddress {
  std::string origin;  ///< origin such as "https://host:port"
  std::string base;    ///< path before that of each resource, without a slash at its end; often empty
};

/// @brief Splits an address such as http://127.0.0.1:8080 or https://host/snapthrough/; nullopt unless it
/// begins with http:// or https:// and a host, and has no query or fragment.
[[nodiscard]] std::optional<ServiceAddress> parse_service_address(std::string_view text);

/// Largest body of an answer that is a document, such as a status: 16 MiB.
inline constexpr std::size_t kMostOfDocument = std::size_t{16} << 20U;
/// Largest body of an answer that is kept in memory although it has what was computed: what a failed job has
/// reached, or tables that are joined. 256 MiB.
inline constexpr std::size_t kMostKept = std::size_t{256} << 20U;

/// Takes the body of an answer with status 200 as it comes.
class BodySink {
 public:
  BodySink() = default;
  BodySink(const BodySink&) = delete;
  BodySink& operator=(const BodySink&) = delete;
  BodySink(BodySink&&) = delete;
  BodySink& operator=(BodySink&&) = delete;
  virtual ~BodySink() = default;
  /// A body begins; again when the connection broke and the request was repeated.
  virtual void begin() = 0;
  /// Returns false when the piece cannot be written, which ends the request.
  virtual bool write(std::string_view piece) = 0;
};

/// What the answer to a request may be.
struct Expected {
  std::chrono::seconds wait{0};        ///< time for which the service was asked to wait (Prefer: wait)
  std::size_t most = kMostOfDocument;  ///< bytes of Answer::body; a longer answer is no complete response
  BodySink* sink = nullptr;  ///< takes a body with status 200, of any length, in place of Answer::body
};

/// Answer of a service to one request.
struct Answer {
  int status = 0;                              ///< HTTP status; 0: no complete response
  std::string trouble;                         ///< why there is no complete response
  bool is_final = false;                       ///< repeating the request would not help
  std::string body;                            ///< complete body
  std::map<std::string, std::string> headers;  ///< by name in lower case

  [[nodiscard]] std::string header(const std::string& name) const;
};

/// Access data and options of requests.
struct RemoteAccess {
  ServiceAddress address;
  std::string key;                  ///< bearer key; empty: no key
  std::string certificates;         ///< PEM file to verify https; empty: certificates of the system
  std::chrono::seconds patience{};  ///< time for which a request is repeated, and an answer may take
};

/// @brief Sends requests to one service, one at a time, each on its own connection without a proxy.
///
/// A request is repeated until `patience` is over while the service answers 429, 502, 503 or 504, or the
/// connection breaks. Pauses last as long as Retry-After says, else 1, 2, 4, 8, then 10 s. A request fails at
/// once if no response was ever received and no connection was opened: the address is wrong or no service
/// runs. Requests must be safe to repeat: POST needs an Idempotency-Key.
///
/// An answer, with all repetitions, is complete within `patience`, or 10 s if that is longer, and the time
/// for which the service was asked to wait. Where a sink takes the body, that bounds the time to its first
/// piece and between its pieces.
class RemoteService {
 public:
  using Headers = std::multimap<std::string, std::string>;

  /// @param stop ends the current request, whose answer then has status 0
  /// @param on_pause called with the reason and the pause in seconds before a request is repeated
  RemoteService(RemoteAccess access, std::stop_token stop,
                std::function<void(const std::string& why, std::chrono::seconds pause)> on_pause)
      : access_(std::move(access)), stop_(std::move(stop)), on_pause_(std::move(on_pause)) {}

  [[nodiscard]] Answer get(const std::string& path, const Headers& headers = {},
                           const Expected& expected = {});
  /// @param body JSON
  [[nodiscard]] Answer post(const std::string& path, const std::string& body, const Headers& headers);
  /// Returns the address of a resource, for messages.
  [[nodiscard]] std::string address_of(const std::string& path) const {
    return access_.address.origin + access_.address.base + path;
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Call {
    const std::string& method;
    const std::string& path;
    const std::string& body;
    const Headers& headers;
    const Expected& expected;
  };
  Answer send(const Call& call);
  Answer send_once(const Call& call, Clock::time_point deadline);
  /// Returns the longest time for an answer.
  [[nodiscard]] std::chrono::seconds longest(const Call& call) const;
  /// Returns whether repeating the request may succeed.
  [[nodiscard]] bool may_pass(const Answer& answer) const;

  const RemoteAccess access_;
  const std::stop_token stop_;
  const std::function<void(const std::string&, std::chrono::seconds)> on_pause_;
  bool was_reached_ = false;         ///< a response was received, with any status
  bool is_connection_lost_ = false;  ///< the last request failed on an open connection
};

}  // namespace snapthrough::server::cli
