#include "server/front/gateway.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "server/authority.h"
#include "server/resources/documents.h"
#include "server/resources/hops/protocol.h"
#include "server/resources/job_key.h"
#include "server/resources/page.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::server::http {
namespace {

bool is_token(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !text.empty() && text.size() <= 128 && std::all_of(text.begin(), text.end(), allowed);
}

/// Returns the trace id of a W3C traceparent header ("00-<32 hexadecimal digits>-..."), else "".
std::string_view trace_of(const Request& request) {
  const std::string_view parent = request.header("traceparent").value_or("");
  return parent.size() >= 55 && parent[2] == '-' && parent[35] == '-' ? parent.substr(3, 32) : "";
}

/// Returns the client's X-Request-Id if it is a token, else the trace id, else a new id.
std::string request_id(const Request& request, const Environment& environment) {
  for (const std::string_view given : {request.header("X-Request-Id").value_or(""), trace_of(request)}) {
    if (is_token(given)) {
      return std::string(given);
    }
  }
  return new_id(environment);
}

bool is_probe(std::string_view path) { return path == "/livez" || path == "/readyz"; }

/// Returns whether a path reports the state of the process.
bool is_state(std::string_view path) { return is_probe(path) || path == "/metrics"; }

/// Returns whether a request needs no key, because its answer contains no jobs. Hops sends no key when it
/// asks for the description of a component.
bool is_public(const Request& request) {
  const std::string_view path = request.path;
  const bool reads = request.method == "GET" || request.method == "HEAD";
  return is_probe(path) || path == "/v1/openapi.json" || path == "/openapi.json" || is_page_path(path) ||
         (reads && hops::is_description_path(path));
}

const char* problem_kind(int status) {
  switch (status) {
    case 411:
      return "length-required";
    case 413:
      return "body-too-large";
    case 414:
      return "target-too-long";
    case 415:
      return "unsupported-media-type";
    case 431:
      return "headers-too-large";
    case 501:
      return "unknown-method";
    case 503:
      return "overloaded";
    default:
      return "bad-request";
  }
}

/// Returns whether a request comes from a foreign page: the Host header is not local (DNS rebinding), or the
/// Origin is neither the service's own nor allowed.
bool comes_from_elsewhere(const Request& request, const CrossOrigin& allowed) {
  const std::string_view host = request.header("Host").value_or("localhost");
  const std::string_view name = without_brackets(Authority::of(host).host);
  if (!equal_ignoring_case(name, "localhost") && !is_loopback(name)) {
    return true;
  }
  const std::optional<std::string_view> origin = request.header("Origin");
  return origin && *origin != "http://" + std::string(host) && !allowed.allows(*origin);
}

/// Returns a 503 that asks the client to repeat its request.
Response unavailable(const char* kind, const char* title, const char* detail, const Request& request) {
  Response response = problem_response({503, kind, title, detail, {}, "", ""}, request);
  response.headers.emplace_back("Retry-After", "5");
  return response;
}

/// Returns the answer to a request whose document was not read to its end.
Response ended_response(WorkEnd cause, const Request& request) {
  if (cause == WorkEnd::stopping) {
    return unavailable("not-ready", "Not ready", "The service is stopping.", request);
  }
  const char* const detail =
      cause == WorkEnd::abandoned
          ? "The client left before this document was read and checked."
          : "Reading and checking this document takes longer than a request may wait for it. Shorter lists, "
            "and curves with fewer half-waves, are read sooner.";
  return problem_response({422, "too-costly-to-read", "Too costly to read", detail, {}, "", ""}, request);
}

/// Returns the refusal of a request that needs a key, by what its key opens; nullopt for a key that serves,
/// or may: the store knows that of a job.
std::optional<Response> refusal_of_key(const Request& request, const Access& access) {
  if (access.expired) {
    return unauthorized(request, "key-expired", "Key expired",
                        "This key expired at " + rfc3339(*access.expired) + ".");
  }
  if (!access.job_key_sha256.empty()) {
    return job_key_permits(request.method, request.path)
               ? std::nullopt
               : std::optional(simple_problem(request, 403, "scope-missing", "Scope missing",
                                              "The key of a job permits GET and HEAD of that job's status, "
                                              "result, table.csv, request and events, and nothing else."));
  }
  if (!access.owner) {
    return unauthorized(request, "unauthorized", "Unauthorized",
                        "This service needs a key (Authorization: Bearer ..., or RhinoComputeKey: ...) that "
                        "it knows.");
  }
  const Scopes needed = scopes_for(request.method, request.path);
  if (needed.meets(access.scopes)) {
    return std::nullopt;
  }
  return simple_problem(request, 403, "scope-missing", "Scope missing",
                        "This needs a key with the scope " + names_of(needed, " or ") + "; this key has " +
                            names_of(access.scopes, " and ") + ".");
}

/// A body source that logs failures and turns exceptions into failures.
class GuardedSource final : public BodySource {
 public:
  GuardedSource(std::shared_ptr<BodySource> source, Log& log, std::string request_id)
      : source_(std::move(source)), log_(log), request_id_(std::move(request_id)) {}

  StatusOr<bool> append_next(std::string& piece) override {
    StatusOr<bool> more = attempt(piece);
    if (!more.ok()) {
      log_.write(LogLevel::error, "trouble",
                 {{"request_id", std::string_view(request_id_)},
                  {"detail", std::string_view(more.status().message())}});
    }
    return more;
  }
  [[nodiscard]] std::size_t held_bytes() const override { return source_->held_bytes(); }

 private:
  StatusOr<bool> attempt(std::string& piece) {
    try {
      return source_->append_next(piece);
    } catch (const std::exception& error) {
      return Status(StatusCode::io_error, error.what());
    }
  }

  std::shared_ptr<BodySource> source_;
  Log& log_;
  const std::string request_id_;
};

}  // namespace

Response Gateway::guarded(const Request& request, const std::function<Response()>& work) const {
  try {
    return work();
  } catch (const WorkEnded& ended) {
    return ended_response(ended.cause, request);
  } catch (const std::bad_alloc& error) {
    Response response =
        unavailable("overloaded", "Overloaded", "There is no memory for this request now.", request);
    response.trouble = error.what();
    return response;
  } catch (const std::exception& error) {
    Response response = problem_response(
        {500, "internal-error", "Internal error", "The request could not be served.", {}, "", ""}, request);
    response.trouble = error.what();
    return response;
  }
}

std::optional<Response> Gateway::without_resource(const Request& request, const Access& access) const {
  if (answers_ == Answers::state && !is_state(request.path)) {
    return problem_response(
        {404,
         "not-found",
         "Not found",
         "This process only works on what others were given; it answers /livez, /readyz and "
         "/metrics.",
         {},
         "",
         ""},
        request);
  }
  if (keys_.open() && !is_public(request) && comes_from_elsewhere(request, cross_origin_)) {
    return problem_response(
        {403,
         "foreign-origin",
         "Foreign origin",
         "A service without keys answers to local names only, and to pages of its own and "
         "of the origins that it allows.",
         {},
         "",
         ""},
        request);
  }
  if (cross_origin_.is_preflight(request)) {
    const std::string methods = Routes::methods_at(request.path);
    return methods.empty() ? std::nullopt : std::optional(CrossOrigin::preflight(methods));
  }
  return is_public(request) ? std::nullopt : refusal_of_key(request, access);
}

bool Gateway::answers_at_once(const Request& request) { return is_probe(request.path); }

Caller Gateway::caller_of(const Request& request) const {
  Caller caller{keys_.access(request, environment_.now()), "address " + request.remote};
  if (caller.access.owner && !keys_.open()) {
    caller.party = "owner " + *caller.access.owner;
  }
  return caller;
}

std::optional<Response> Gateway::refused_by_head(Request& request, const Caller& caller) {
  const double start = environment_.monotonic_seconds();
  request.id = request_id(request, environment_);
  request.owner = caller.access.owner.value_or("");
  request.job_key_sha256 = is_public(request) ? "" : caller.access.job_key_sha256;
  std::optional<Response> refusal = without_resource(request, caller.access);
  if (refusal) {
    complete(request, *refusal, start);
  }
  return refusal;
}

Response Gateway::serve(Request request, const Caller& caller) {
  const double start = environment_.monotonic_seconds();
  request.body_bytes = request.body.size();
  if (std::optional<Response> refusal = refused_by_head(request, caller)) {
    return *std::move(refusal);
  }
  const auto kept = std::make_shared<Request>(std::move(request));
  return finish(kept, guarded(*kept, [&] { return routes_.respond(*kept); }), start);
}

Response Gateway::finish(const std::shared_ptr<Request>& request, Response response, double start) {
  if (!response.deferred) {
    complete(*request, response, start);
    return response;
  }
  std::string().swap(request->body);  // the body was read
  response.deferred->resume = [this, request, start, route = response.route,
                               resume = std::move(response.deferred->resume)] {
    Response late = guarded(*request, resume);
    late.deferred.reset();
    late.route = route;
    complete(*request, late, start);
    return late;
  };
  return response;
}

Response Gateway::refuse(const Head& head, const std::string& remote) {
  Request request;
  request.method = head.method;
  request.path = head.target.substr(0, std::min(head.target.find('?'), std::size_t{256}));
  request.remote = remote;
  request.headers = head.headers;
  request.id = request_id(request, environment_);
  const int status = head.refusal->status;
  Response response = problem_response(
      {status, problem_kind(status), std::string(reason_phrase(status)), head.refusal->detail, {}, "", ""},
      request);
  if (status == 503) {
    response.headers.emplace_back("Retry-After", "1");
  }
  complete(request, response, environment_.monotonic_seconds());
  return response;
}

void Gateway::complete(const Request& request, Response& response, double start) {
  compress(response, request.header("Accept-Encoding").value_or(""));
  if (response.rest) {
    response.rest = std::make_shared<GuardedSource>(std::move(response.rest), log_, request.id);
  }
  response.headers.emplace_back("X-Request-Id", request.id);
  response.headers.emplace_back("Date", http_date(environment_.now()));
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  cross_origin_.mark(request.header("Origin").value_or(""), response);
  if (!response.trouble.empty()) {
    log_.write(
        LogLevel::error, "trouble",
        {{"request_id", std::string_view(request.id)}, {"detail", std::string_view(response.trouble)}});
  }
  const double seconds = environment_.monotonic_seconds() - start;
  const std::string route = label("route", response.route.empty() ? "none" : response.route);
  const std::string method = label("method", is_known_method(request.method) ? request.method : "other");
  metrics_.answered.add(method + "," + route + "," + label("status", std::to_string(response.status)));
  metrics_.seconds.observe(seconds, route);
  log_.write(response.status >= 500 ? LogLevel::error : LogLevel::info, "request",
             {{"request_id", std::string_view(request.id)},
              {"method", std::string_view(request.method)},
              {"path", std::string_view(request.path)},
              {"route", std::string_view(response.route)},
              {"status", static_cast<std::int64_t>(response.status)},
              {"milliseconds", seconds * 1e3},
              {"bytes_in", static_cast<std::int64_t>(request.body_bytes)},
              {"bytes_out", static_cast<std::int64_t>(response.body.size())},
              {"owner", std::string_view(request.owner)},
              {"trace", trace_of(request)},
              {"remote", std::string_view(request.remote)}});
}

}  // namespace snapthrough::server::http
