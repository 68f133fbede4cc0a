#include "server/http/gateway.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace snapthrough::server::http {
namespace {

bool is_token(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !text.empty() && text.size() <= 128 && std::all_of(text.begin(), text.end(), allowed);
}

/// The client's identifier when it is harmless, else a new one.
std::string request_id(const Request& request, const Environment& environment) {
  const std::string_view given = request.header("X-Request-Id").value_or("");
  return is_token(given) ? std::string(given) : new_id(environment);
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
    default:
      return "bad-request";
  }
}

}  // namespace

std::string_view reason_phrase(int status) {
  switch (status) {
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 431:
      return "Request Header Fields Too Large";
    case 501:
      return "Not Implemented";
    default:
      return "Bad Request";
  }
}

Response Gateway::guarded(const Request& request) {
  try {
    return routes_.respond(request);
  } catch (const std::exception& error) {
    Response response = problem_response(
        {500, "internal-error", "Internal error", "The request could not be served.", {}, "", ""}, request);
    response.trouble = error.what();
    return response;
  }
}

Response Gateway::serve(Request request) {
  const double start = environment_.monotonic_seconds();
  request.id = request_id(request, environment_);
  Response response = guarded(request);
  complete(request, response, start);
  return response;
}

Response Gateway::refuse(const Head& head, const std::string& remote) {
  Request request;
  request.method = head.method;
  request.path = head.target.substr(0, std::min(head.target.find('?'), std::size_t{256}));
  request.remote = remote;
  request.id = new_id(environment_);
  const int status = head.refusal->status;
  Response response = problem_response(
      {status, problem_kind(status), std::string(reason_phrase(status)), head.refusal->detail, {}, "", ""},
      request);
  complete(request, response, environment_.monotonic_seconds());
  return response;
}

void Gateway::complete(const Request& request, Response& response, double start) {
  response.headers.emplace_back("X-Request-Id", request.id);
  response.headers.emplace_back("Date", http_date(environment_.now()));
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  if (!response.trouble.empty()) {
    log_.write(
        LogLevel::error, "trouble",
        {{"request_id", std::string_view(request.id)}, {"detail", std::string_view(response.trouble)}});
  }
  const double milliseconds = (environment_.monotonic_seconds() - start) * 1e3;
  log_.write(response.status >= 500 ? LogLevel::error : LogLevel::info, "request",
             {{"request_id", std::string_view(request.id)},
              {"method", std::string_view(request.method)},
              {"path", std::string_view(request.path)},
              {"route", std::string_view(response.route)},
              {"status", static_cast<std::int64_t>(response.status)},
              {"milliseconds", milliseconds},
              {"bytes_in", static_cast<std::int64_t>(request.body.size())},
              {"bytes_out", static_cast<std::int64_t>(response.body.size())},
              {"remote", std::string_view(request.remote)}});
}

}  // namespace snapthrough::server::http
