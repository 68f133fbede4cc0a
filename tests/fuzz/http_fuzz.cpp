/// @file
/// Everything between the socket and the store on arbitrary bytes: framing, parsing, routes, responses.

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

#include "server/http/gateway.h"
#include "server/http/library.h"
#include "server/http/request_reader.h"
#include "tests/server/support/failing_sweep_store.h"

namespace snapthrough::server::http {
namespace {

/// A store with nothing in it, and no room for anything.
class EmptyStore final : public Store {
 public:
  StatusOr<Submitted> submit(const NewJob&, const std::function<void()>&) override { return full(); }
  StatusOr<std::optional<Claim>> claim(const Lease&, Time) override { return std::optional<Claim>(); }
  StatusOr<std::vector<std::string>> renew(const std::vector<Claim>&, Time, Time) override { return full(); }
  Status finish(const Claim&, const JobResult&, Time) override { return full(); }
  Status fail(const Claim&, const JobFailure&, const StoredPath&, Time) override { return full(); }
  Status requeue(const Claim&) override { return full(); }
  StatusOr<Recovery> recover(int, Time) override { return full(); }
  StatusOr<Recovery> rescue(std::string_view, int, Time) override { return full(); }
  StatusOr<Dismissal> dismiss(std::string_view, Time) override { return Dismissal{}; }
  StatusOr<bool> remove(std::string_view) override { return false; }
  StatusOr<int> retire(Time, int) override { return 0; }
  Status forget_keys(Time) override { return full(); }
  Status probe(Time) override { return full(); }
  StatusOr<std::optional<std::string>> find_result(std::string_view, std::string_view) override {
    return std::optional<std::string>();
  }
  StatusOr<JobCounts> counts() override { return JobCounts{}; }
  StatusOr<std::optional<Job>> get(std::string_view) override { return std::optional<Job>(); }
  StatusOr<JobPage> list(const JobQuery&) override { return JobPage{}; }
  StatusOr<std::optional<std::string>> request(std::string_view) override {
    return std::optional<std::string>();
  }
  StatusOr<std::optional<std::string>> result(std::string_view) override {
    return std::optional<std::string>();
  }
  SweepStore& sweeps() override { return sweeps_; }
  StatusOr<StoredPath> path(std::string_view) override { return StoredPath{}; }

 private:
  static Status full() { return {StatusCode::unavailable, "full"}; }
  test::FailingSweepStore sweeps_{StatusCode::unavailable};
};

struct Front {
  std::ostringstream text;
  Environment environment = Environment::system();
  Log log{LogLevel::off, environment.now, text};
  EmptyStore store;
  JobDesk desk{store, environment, log};
  RequestMetrics metrics;
  Routes routes{desk, {}};
  Gateway gateway{routes, environment, log, KeyRing(), metrics};
  RequestParser parser;
  WireLimits limits;
};

void check_response(const Response& response) {
  const std::string bytes = to_bytes(response, false, true);
  if (response.status < 200 || response.status > 599 || reason_phrase(response.status) == "Unknown" ||
      bytes.find("\r\n\r\n") == std::string::npos) {
    std::abort();
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
      if (auto request = front->parser.parse(received.head_text)) {
        request->body = std::move(received.body);
        check_response(front->gateway.serve(std::move(*request)));
      }
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
