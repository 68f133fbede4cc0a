#include "server/resources/routes.h"

#include <functional>
#include <utility>

#include "server/environment.h"
#include "server/resources/documents.h"

namespace snapthrough::server::http {
namespace {

/// Segments of a path that match "{id}" and "{n}".
struct Segments {
  std::string id;
  std::string point;
};

/// Returns whether a path matches a route's pattern; "{id}" and "{n}" match one segment each.
bool matches(std::string_view pattern, std::string_view path, Segments& found) {
  while (!pattern.empty() && !path.empty()) {
    const std::size_t pattern_end = std::min(pattern.find('/', 1), pattern.size());
    const std::size_t path_end = std::min(path.find('/', 1), path.size());
    const std::string_view segment = pattern.substr(0, pattern_end);
    if (segment == "/{id}" || segment == "/{n}") {
      (segment == "/{id}" ? found.id : found.point) = path.substr(1, path_end - 1);
    } else if (segment != path.substr(0, path_end)) {
      return false;
    }
    pattern.remove_prefix(pattern_end);
    path.remove_prefix(path_end);
  }
  return pattern.empty() && path.empty();
}

/// Whether a pattern has the id of a job or sweep.
bool names_work(std::string_view pattern) {
  return pattern.starts_with("/v1/jobs/{id}") || pattern.starts_with("/v1/sweeps/{id}");
}

/// Whether an id cannot be that of a job or sweep: a store is not asked for it, whatever bytes it has.
bool names_nothing(std::string_view pattern, std::string_view id) {
  return names_work(pattern) && !is_id(id);
}

/// Whether an operation adds work, which quotas bound.
bool hands_in(std::string_view method, std::string_view pattern) {
  return method == "POST" && (pattern == "/v1/jobs" || pattern == "/v1/sweeps" ||
                              pattern.ends_with("/retry") || pattern.ends_with("/job"));
}

}  // namespace

/// Answers for an id that names_nothing().
static Response missing(const Request& request, std::string_view pattern, const std::string& id) {
  return pattern.starts_with("/v1/jobs/") ? job_missing(request, id) : sweep_missing(request, id);
}

struct Routes::Route {
  const char* method;
  const char* pattern;
  /// Called with the request and the segment {id}.
  std::function<Response(Routes&, const Request&, const std::string&)> handler;
  /// Replaces `handler` for patterns with {n}, whose segment is the third argument.
  std::function<Response(Routes&, const Request&, const std::string&, const std::string&)> point_handler = {};
};

const std::vector<Routes::Route>& Routes::table() {
  static const std::vector<Route> routes{
      {"POST", "/v1/jobs", &Routes::create_job},
      {"GET", "/v1/jobs", &Routes::list_jobs},
      {"GET", "/v1/jobs/{id}", &Routes::job_status},
      {"GET", "/v1/jobs/{id}/result", &Routes::job_result},
      {"GET", "/v1/jobs/{id}/table.csv", &Routes::job_csv},
      {"GET", "/v1/jobs/{id}/request", &Routes::job_request},
      {"GET", "/v1/jobs/{id}/events", &Routes::job_events},
      {"POST", "/v1/jobs/{id}/dismiss", &Routes::dismiss_job},
      {"DELETE", "/v1/jobs/{id}", &Routes::delete_job},
      {"POST", "/v1/jobs/{id}/key", &Routes::create_job_key},
      {"POST", "/v1/sweeps", &Routes::create_sweep},
      {"GET", "/v1/sweeps", &Routes::list_sweeps},
      {"GET", "/v1/sweeps/{id}", &Routes::sweep_status},
      {"GET", "/v1/sweeps/{id}/request", &Routes::sweep_request},
      {"GET", "/v1/sweeps/{id}/table", &Routes::sweep_table},
      {"GET", "/v1/sweeps/{id}/table.csv", &Routes::sweep_csv},
      {"GET", "/v1/sweeps/{id}/events", &Routes::sweep_events},
      {"GET", "/v1/sweeps/{id}/points/{n}/request", nullptr, &Routes::point_request},
      {"POST", "/v1/sweeps/{id}/points/{n}/job", nullptr, &Routes::create_point_job},
      {"POST", "/v1/sweeps/{id}/dismiss", &Routes::dismiss_sweep},
      {"POST", "/v1/sweeps/{id}/retry", &Routes::retry_sweep},
      {"DELETE", "/v1/sweeps/{id}", &Routes::delete_sweep},
      {"GET", "/v1/usage", &Routes::usage},
      {"GET", "/v1/audit", &Routes::audit},
      {"GET", "/v1/hops", &Routes::list_components},
      {"GET", "/v1/hops/{id}", &Routes::describe_component},
      {"POST", "/v1/hops/{id}", &Routes::solve_component},
      {"POST", "/solve", &Routes::solve},
      {"POST", "/v1/check", &Routes::check},
      {"POST", "/v1/convert", &Routes::convert},
      {"POST", "/v1/plot", &Routes::plot},
      {"GET", "/v1/limits", &Routes::limits},
      {"GET", "/v1/openapi.json", &Routes::openapi},
      {"GET", "/v1/examples", &Routes::examples},
      {"GET", "/livez", &Routes::alive},
      {"GET", "/readyz", &Routes::ready},
      {"GET", "/metrics", &Routes::metrics},
  };
  return routes;
}

Response Routes::respond(Request& request) {
  const std::string_view method = request.method == "HEAD" ? "GET" : std::string_view(request.method);
  for (const Route& route : table()) {
    Segments found;
    if (method != route.method || !matches(route.pattern, request.path, found)) {
      continue;
    }
    std::optional<Response> refusal = names_nothing(route.pattern, found.id)
                                          ? missing(request, route.pattern, found.id)
                                          : admit_job_key(request, found.id);
    const bool refused = refusal.has_value();
    Response response = refused         ? *std::move(refusal)
                        : route.handler ? route.handler(*this, request, found.id)
                                        : route.point_handler(*this, request, found.id, found.point);
    if (!refused && names_work(route.pattern)) {
      response = told_of_deletion(request, found.id, std::move(response));
    }
    if (hands_in(route.method, route.pattern)) {
      tell_balance(request, response);
    }
    response.route = route.pattern;
    return response;
  }
  if (request.path == "/openapi.json" && method == "GET") {
    Response moved;
    moved.status = 308;
    moved.headers.emplace_back("Location", "/v1/openapi.json");
    return moved;
  }
  std::optional<Response> file = facts_.page.respond(request);
  if (file && method == "GET") {
    return *std::move(file);
  }
  const std::string allowed = file ? "GET, HEAD" : methods_at(request.path);
  if (allowed.empty()) {
    return simple_problem(request, 404, "not-found", "Not found", "There is nothing at this path.");
  }
  Response response = simple_problem(request, 405, "method-not-allowed", "Method not allowed",
                                     "This resource answers " + allowed + ".");
  response.headers.emplace_back("Allow", allowed);
  return response;
}

std::string Routes::methods_at(std::string_view path) {
  std::string methods;
  for (const Route& route : table()) {
    Segments found;
    if (matches(route.pattern, path, found)) {
      methods += (methods.empty() ? "" : ", ") + std::string(route.method);
      methods += std::string_view(route.method) == "GET" ? ", HEAD" : "";
    }
  }
  return methods;
}

std::vector<std::pair<std::string, std::string>> Routes::resources() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const Route& route : table()) {
    all.emplace_back(route.method, route.pattern);
  }
  return all;
}

}  // namespace snapthrough::server::http
