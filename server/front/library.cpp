#include "server/front/library.h"

#include <httplib.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

namespace snapthrough::server::http {
namespace {

/// A request that was received already; what the library would answer is discarded.
class MemoryStream final : public httplib::Stream {
 public:
  explicit MemoryStream(std::string_view input) : input_(input) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* data, std::size_t size) override {
    const std::size_t count = std::min(size, input_.size());
    std::memcpy(data, input_.data(), count);
    input_.remove_prefix(count);
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* /*data*/, std::size_t size) override { return static_cast<ssize_t>(size); }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip.clear();
    port = 0;
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    ip.clear();
    port = 0;
  }
  int socket() const override { return -1; }

 private:
  std::string_view input_;
};

Request to_request(const httplib::Request& from) {
  Request request;
  request.method = from.method;
  request.path = from.path;
  request.query.assign(from.params.begin(), from.params.end());
  request.headers.assign(from.headers.begin(), from.headers.end());
  return request;
}

/// Where the parse() of this thread wants its request.
thread_local std::optional<Request>* collected = nullptr;

}  // namespace

/// The library's server, given whole heads only: it neither waits for a client nor routes nor answers.
class RequestParser::Library final : public httplib::Server {
 public:
  Library() {
    set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
      *collected = to_request(request);
      response.status = 204;
      return HandlerResponse::Handled;
    });
  }
  std::optional<Request> parse(const std::string& head) {
    std::optional<Request> request;
    collected = &request;
    MemoryStream stream(head);
    bool closed = false;
    process_request(stream, true, closed, nullptr);
    collected = nullptr;
    return request;
  }
};

RequestParser::RequestParser() : library_(std::make_unique<Library>()) {}

RequestParser::~RequestParser() = default;

std::optional<Request> RequestParser::parse(const std::string& head) const { return library_->parse(head); }

}  // namespace snapthrough::server::http
