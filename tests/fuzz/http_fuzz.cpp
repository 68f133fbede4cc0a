/// @file
/// Everything between the socket and the store on arbitrary bytes: framing, parsing, routes, responses.

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "server/front/gateway.h"
#include "server/front/request_head.h"
#include "server/front/request_reader.h"
#include "tests/fuzz/one_of_each.h"

namespace snapthrough::server::http {
namespace {

struct Front {
  std::ostringstream text;
  Environment environment = Environment::system();
  Log log{LogLevel::off, environment.now, text};
  test::FuzzedStore store;
  JobService jobs{store, environment, log};
  RequestMetrics metrics;
  Routes routes{jobs, {}};
  KeyRing keys;
  Gateway gateway{routes, environment, log, keys, metrics};
  HeadLimits limits;
};

void check_response(Response response) {
  while (response.deferred) {
    Response late = response.deferred->resume();  // the wait is over
    response = std::move(late);
  }
  if (response.stream) {
    const std::shared_ptr<StreamSource> source =
        response.stream->open([](const std::string& piece, bool last) {
          if (!last && !piece.empty() && !piece.ends_with("\n\n")) {
            std::abort();  // events are whole
          }
          return true;
        });
    source->poll();
  }
  const std::string bytes = to_bytes(response, false, true);
  if (response.status < 200 || response.status > 599 || reason_phrase(response.status) == "Unknown" ||
      bytes.find("\r\n\r\n") == std::string::npos) {
    std::abort();
  }
}

/// Else most would end at the question whether they are.
void make_local(Request& request) {
  for (auto& [name, value] : request.headers) {
    if (equal_ignoring_case(name, "Host")) {
      value = "localhost";
    }
  }
}

}  // namespace
}  // namespace snapthrough::server::http

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace snapthrough::server::http;
  static auto* front = new Front;
  RequestReader reader(front->limits);
  // In two pieces, so that every place is a border between packets at some time.
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = size == 0 ? 0 : data[0] % size;
  reader.append(bytes.substr(0, cut));
  bool second = false;
  for (int requests = 0; requests < 16; ++requests) {
    Received received = reader.next();
    if (received.kind == Received::Kind::request) {
      Request request = request_of(std::move(received.head));
      request.body = std::move(received.body);
      if (cut % 8 != 0) make_local(request);
      check_response(front->gateway.serve(std::move(request)));
    } else if (received.kind == Received::Kind::refused) {
      check_response(front->gateway.refuse(received.head, "fuzz"));
      return 0;
    } else if (!second) {
      reader.append(bytes.substr(cut));
      second = true;
    } else {
      return 0;
    }
  }
  return 0;
}
