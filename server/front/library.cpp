#include "server/front/library.h"

#include <httplib.h>

#include <algorithm>
#include <utility>

namespace snapthrough::server::http {

Request request_of(Head head) {
  Request request;
  const std::size_t path_end = std::min(head.target.find('?'), head.target.size());
  request.path = httplib::detail::decode_url(head.target.substr(0, path_end), false);
  if (path_end < head.target.size()) {
    httplib::Params parameters;
    httplib::detail::parse_query_text(head.target.substr(path_end + 1), parameters);
    request.query.assign(parameters.begin(), parameters.end());
  }
  request.method = std::move(head.method);
  request.headers = std::move(head.headers);
  return request;
}

}  // namespace snapthrough::server::http
