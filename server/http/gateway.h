#pragma once
/// @file
/// What every request gets whatever it asks for: an identifier, a Date, one log line.

#include "server/environment.h"
#include "server/http/message.h"
#include "server/http/routes.h"
#include "server/http/wire.h"
#include "server/log/log.h"

namespace snapthrough::server::http {

/// @brief Serves requests through the routes. Thread-safe; the parts it is given must outlive it.
class Gateway {
 public:
  Gateway(Routes& routes, const Environment& environment, Log& log)
      : routes_(routes), environment_(environment), log_(log) {}

  /// Never throws for a request: what a resource throws is logged and becomes status 500 without particulars.
  [[nodiscard]] Response serve(Request request);
  /// The response to a request that was refused from its bytes; what is known of it is in `head`.
  [[nodiscard]] Response refuse(const Head& head, const std::string& remote);

 private:
  Response guarded(const Request& request);
  void complete(const Request& request, Response& response, double start);

  Routes& routes_;
  const Environment& environment_;
  Log& log_;
};

/// The phrase of a status code, e.g. "Not Found".
[[nodiscard]] std::string_view reason_phrase(int status);

}  // namespace snapthrough::server::http
