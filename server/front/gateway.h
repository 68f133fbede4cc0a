#pragma once
/// @file
/// What every request gets whatever it asks for: an identifier, an owner, a Date, one log line, its place in
/// the metrics.

#include "server/environment.h"
#include "server/front/cross_origin.h"
#include "server/front/keys.h"
#include "server/front/request_head.h"
#include "server/front/response_bytes.h"
#include "server/log/log.h"
#include "server/metrics/request_metrics.h"
#include "server/resources/message.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {

/// What is answered: everything, or only how the process is (/livez, /readyz, /metrics).
enum class Answers { all, state };

/// @brief Serves requests through the routes. Thread-safe; the parts it is given must outlive it.
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

  /// Never throws for a request: what a resource throws is logged and becomes status 500 without particulars.
  /// A deferred response comes back deferred; what its `resume` gives is complete and was logged.
  [[nodiscard]] Response serve(Request request);
  /// Whether serve() answers such a request from memory, in microseconds: what tells whether the service
  /// lives.
  [[nodiscard]] static bool answers_at_once(const Request& request);
  /// The response to a request that was refused from its bytes; what is known of it is in `head`.
  [[nodiscard]] Response refuse(const Head& head, const std::string& remote);

 private:
  /// The response that a request gets before any resource is asked, if it does.
  [[nodiscard]] std::optional<Response> without_resource(const Request& request, bool known) const;
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
