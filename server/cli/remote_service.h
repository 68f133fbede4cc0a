#pragma once
/// @file
/// A service elsewhere, as the commands submit, wait and fetch ask it.

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

namespace snapthrough::server::cli {

/// Where a service is.
struct ServiceAddress {
  std::string origin;  ///< "https://host:port"
  std::string base;    ///< path that its resources are under, without a slash at its end; mostly empty
};

/// @brief Splits an address such as http://127.0.0.1:8080 or https://host/snapthrough/; nothing when it does
/// not begin with http:// or https:// and a host, or has a query or a fragment.
[[nodiscard]] std::optional<ServiceAddress> parse_service_address(std::string_view text);

/// What a service answered to one request.
struct Answer {
  int status = 0;                              ///< of HTTP; 0: there was no whole response
  std::string trouble;                         ///< why there was none
  std::string body;                            ///< whole
  std::map<std::string, std::string> headers;  ///< names in lower case

  [[nodiscard]] std::string header(const std::string& name) const;
};

/// How a service is asked.
struct RemoteAccess {
  ServiceAddress address;
  std::string key;                  ///< bearer key; empty: none is sent
  std::string certificates;         ///< PEM file to verify https with; empty: what the system trusts
  std::chrono::seconds patience{};  ///< how long a request is repeated
};

/// @brief Sends requests to one service, one at a time, each on a connection of its own, by no proxy.
///
/// A request is sent again while the service answers 429, 502, 503 or 504, or its connection breaks, after
/// the pause that Retry-After asks for or else 1, 2, 4, 8 and so on to 10 s, until `patience` is over. A
/// request that never reached anything fails at once: the address is wrong or nothing runs there. So requests
/// have to be such that sending one twice does no harm: POST comes with an Idempotency-Key.
class RemoteService {
 public:
  using Headers = std::multimap<std::string, std::string>;

  /// @param stop cuts what is being asked; its answer then has status 0
  /// @param on_pause is told why a request is repeated, and after how many seconds
  RemoteService(RemoteAccess access, std::stop_token stop,
                std::function<void(const std::string& why, std::chrono::seconds pause)> on_pause)
      : access_(std::move(access)), stop_(std::move(stop)), on_pause_(std::move(on_pause)) {}

  [[nodiscard]] Answer get(const std::string& path, const Headers& headers = {});
  /// @param body JSON
  [[nodiscard]] Answer post(const std::string& path, const std::string& body, const Headers& headers);
  /// Address of a resource, for messages.
  [[nodiscard]] std::string address_of(const std::string& path) const {
    return access_.address.origin + access_.address.base + path;
  }

 private:
  Answer send(const std::string& method, const std::string& path, const std::string& body,
              const Headers& headers);
  Answer send_once(const std::string& method, const std::string& path, const std::string& body,
                   const Headers& headers);
  /// Whether sending it again may help.
  [[nodiscard]] bool may_pass(const Answer& answer) const;

  const RemoteAccess access_;
  const std::stop_token stop_;
  const std::function<void(const std::string&, std::chrono::seconds)> on_pause_;
  bool was_reached_ = false;         ///< there was a response, whatever it said
  bool is_connection_lost_ = false;  ///< the last request broke after it had been connected
};

}  // namespace snapthrough::server::cli
