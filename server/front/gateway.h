#pragma once
/// @file
/// Common handling of all requests: identifier, owner, Date, log line, metrics.

#include "server/environment.h"
#include "server/front/cross_origin.h"
#include "server/front/keys.h"
#include "server/front/request_head.h"
#include "server/front/response_bytes.h"
#include "server/log/log.h"
#include "server/metrics/metrics.h"
#include "server/resources/message.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {

/// Counts and durations of answered requests. Thread-safe.
struct RequestMetrics {
  Counter answered{"snapthrough_requests_total", "Requests answered, by method, route template and status."};
  Histogram seconds{"snapthrough_request_seconds",
                    "From a complete request to its response, waits included, by route template."};

  void write(std::string& text) const {
    answered.write(text);
    seconds.write(text);
  }
};

/// Answered requests: all, or only those for the state of the process (/livez, /readyz, /metrics).
enum class Answers { all, state };

/// Who asks.
struct Caller {
  Access access;
  /// The owner, or the address where there is no known key: what clients share is bounded for each party.
  std::string party;
};

/// @brief Serves requests through the routes. Thread-safe; the constructor's arguments must outlive it.
class Gateway {
 public:
  Gateway(Routes& routes, const Environment& environment, Log& log, const KeyRing& keys,
          RequestMetrics& metrics, CrossOrigin cross_origin = CrossOrigin(), Answers answers = Answers::all)
      : routes_(routes),
        environment_(environment),
        log_(log),
        keys_(keys),
        metrics_(metrics),
        cross_origin_(std::move(cross_origin)),
        answers_(answers) {}

  /// Answers a request. Never throws: an exception of a resource is logged and becomes status 500 without
  /// details. A deferred response is returned deferred; its `resume` returns a complete, logged response.
  [[nodiscard]] Response serve(Request request, const Caller& caller);
  [[nodiscard]] Response serve(Request request) {
    const Caller caller = caller_of(request);
    return serve(std::move(request), caller);
  }
  /// Returns whether serve() answers a request from memory within microseconds: /livez and /readyz, which
  /// health checks use.
  [[nodiscard]] static bool answers_at_once(const Request& request);
  [[nodiscard]] Caller caller_of(const Request& request) const;
  /// Returns the refusal of a request by its head, whether or not its body has arrived; nullopt when its body
  /// is wanted. Sets the request's id and owner, and its key of a job.
  [[nodiscard]] std::optional<Response> refused_by_head(Request& request, const Caller& caller);
  /// Returns the response to a request that was refused while its bytes were read; `head` has what was read.
  [[nodiscard]] Response refuse(const Head& head, const std::string& remote);

 private:
  /// Returns a response that needs no resource, such as a refusal or a preflight; nullopt for other requests.
  [[nodiscard]] std::optional<Response> without_resource(const Request& request, const Access& access) const;
  Response guarded(const Request& request, const std::function<Response()>& work) const;
  Response finish(const std::shared_ptr<Request>& request, Response response, double start);
  void complete(const Request& request, Response& response, double start);

  Routes& routes_;
  const Environment& environment_;
  Log& log_;
  const KeyRing& keys_;
  RequestMetrics& metrics_;
  CrossOrigin cross_origin_;
  const Answers answers_;
};

}  // namespace snapthrough::server::http
