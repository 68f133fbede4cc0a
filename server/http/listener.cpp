#include "server/http/listener.h"

#include <httplib.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

namespace snapthrough::server::http {
namespace {

/// The library asks for a backlog of 5; connections that arrive while all threads are busy shall wait
/// instead.
constexpr int kBacklog = 1024;
constexpr int kRequestsPerConnection = 1'000'000;

struct Peer {
  std::string address;
  int port = 0;
};

Peer peer_of(int socket) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  auto* address = reinterpret_cast<sockaddr*>(&storage);
  if (::getpeername(socket, address, &size) != 0 ||
      ::getnameinfo(address, size, host.data(), host.size(), port.data(), port.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return {};
  }
  return {host.data(), std::atoi(port.data())};
}

/// A request that was received already, read by the library; the response is collected.
class MemoryStream final : public httplib::Stream {
 public:
  MemoryStream(std::string_view input, const Peer& peer, int socket)
      : input_(input), peer_(peer), socket_(socket) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* data, std::size_t size) override {
    const std::size_t count = std::min(size, input_.size());
    std::memcpy(data, input_.data(), count);
    input_.remove_prefix(count);
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* data, std::size_t size) override {
    output_.append(data, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip = peer_.address;
    port = peer_.port;
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    ip.clear();
    port = 0;
  }
  int socket() const override { return socket_; }

  [[nodiscard]] const std::string& output() const { return output_; }

 private:
  std::string_view input_;
  std::string output_;
  const Peer& peer_;
  int socket_;
};

Request to_request(const httplib::Request& from) {
  Request request;
  request.method = from.method;
  request.path = from.path;
  request.query.assign(from.params.begin(), from.params.end());
  request.headers.assign(from.headers.begin(), from.headers.end());
  request.body = from.body;
  request.remote = from.remote_addr;
  return request;
}

void to_library(const Response& from, httplib::Response& response) {
  response.status = from.status;
  for (const auto& [name, value] : from.headers) {
    response.set_header(name, value);
  }
  if (!from.content_type.empty()) {
    response.set_content(from.body, from.content_type);
  }
}

std::string to_bytes(const Response& response) {
  std::string bytes = "HTTP/1.1 " + std::to_string(response.status) + " " +
                      std::string(reason_phrase(response.status)) + "\r\n";
  for (const auto& [name, value] : response.headers) {
    bytes += name + ": " + value + "\r\n";
  }
  bytes += "Content-Type: " + response.content_type +
           "\r\nContent-Length: " + std::to_string(response.body.size()) + "\r\nConnection: close\r\n\r\n" +
           response.body;
  return bytes;
}

}  // namespace

/// The library's server, given whole requests only: it neither waits for a client nor routes.
class Listener::Server final : public httplib::Server {
 public:
  Server(ListenerOptions options, Gateway& gateway) : options_(std::move(options)), gateway_(gateway) {
    new_task_queue = [this] { return new httplib::ThreadPool(static_cast<std::size_t>(options_.threads)); };
    set_tcp_nodelay(true);
    set_keep_alive_max_count(kRequestsPerConnection);
    set_keep_alive_timeout(options_.times.idle.count() / 1000);
    set_socket_options([this](socket_t socket) {
      // Only SO_REUSEADDR: with the library's SO_REUSEPORT two services could share a port without noticing.
      const int on = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
      listening_socket_ = socket;
    });
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      to_library(gateway_.serve(to_request(request)), response);
      return HandlerResponse::Handled;
    });
    // What the library itself refuses has no body yet.
    set_error_handler(httplib::Server::Handler([this](const auto& request, auto& response) {
      if (response.body.empty()) {
        Head head;
        head.method = request.method;
        head.target = request.path;
        head.refusal = Refusal{response.status, "The request is malformed."};
        to_library(gateway_.refuse(head, request.remote_addr), response);
      }
    }));
    set_exception_handler(
        [](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
          response.status = 500;
          response.set_content("{}", "application/problem+json");
        });
  }

  Status start() {
    errno = 0;
    const bool any_port = options_.port == 0;
    port_ = any_port ? bind_to_any_port(options_.host) : options_.port;
    if (port_ <= 0 || (!any_port && !bind_to_port(options_.host, options_.port))) {
      const int cause = errno;
      return {StatusCode::unavailable, "cannot listen on " + options_.host + ":" +
                                           std::to_string(options_.port) + ": " +
                                           std::generic_category().message(cause)};
    }
    ::listen(listening_socket_, kBacklog);
    thread_ = std::thread([this] {
      listen_after_bind();
      ended_ = true;
    });
    while (!is_running() && !ended_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // stop() is ignored before it runs
    }
    return {};
  }

  void shut_down() {
    stop_signal_.raise();
    stop();
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  [[nodiscard]] int port() const { return port_; }

 private:
  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, options_.limits, options_.times, stop_signal_);
    const Peer peer = peer_of(socket);
    while (serve_one(connection, peer, socket)) {
    }
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    return true;
  }

  /// One request of a connection; false when it was the last.
  bool serve_one(Connection& connection, const Peer& peer, socket_t socket) {
    Received received = connection.receive();
    if (received.kind == Received::Kind::closed) {
      return false;
    }
    if (received.kind == Received::Kind::refused) {
      if (connection.send(to_bytes(gateway_.refuse(received.head, peer.address)))) {
        connection.linger();
      }
      return false;
    }
    MemoryStream stream(received.head_text, peer, socket);
    bool closed = false;
    bool parsed = false;  // where the library could not parse a request, the next can't be trusted either
    const bool served =
        process_request(stream, stop_signal_.raised(), closed, [&](httplib::Request& request) {
          request.body = std::move(received.body);
          parsed = true;
        });
    return connection.send(stream.output()) && served && parsed && !closed && !stop_signal_.raised();
  }

  ListenerOptions options_;
  Gateway& gateway_;
  StopSignal stop_signal_;
  socket_t listening_socket_ = -1;
  int port_ = 0;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

Listener::Listener(ListenerOptions options, Gateway& gateway)
    : server_(std::make_unique<Server>(std::move(options), gateway)) {}

Listener::~Listener() { stop(); }

Status Listener::start() { return server_->start(); }

int Listener::port() const { return server_->port(); }

void Listener::stop() { server_->shut_down(); }

}  // namespace snapthrough::server::http
