#include "server/webhooks/post.h"

#include <fcntl.h>
#include <httplib.h>
#include <sys/socket.h>

#include "server/webhooks/received_bytes.h"

namespace snapthrough::server {
namespace {

constexpr std::size_t kMostRead = 65536;  // bytes read of a response body; its sender can then finish
/// Bytes of a response, its head among them, after which the connection is cut: the library has no bound on
/// the length of a line of a head.
constexpr std::uint64_t kMostReceived = 1 << 20;

}  // namespace

void Poster::watch(int socket) {
  const std::lock_guard guard(mutex_);
  socket_ = Descriptor(::fcntl(socket, F_DUPFD_CLOEXEC, 0));
}

void Poster::cut_late(bool now) {
  const std::lock_guard guard(mutex_);
  if (socket_.get() >= 0 &&
      (now || Clock::now() > deadline_ || received_bytes(socket_.get()) > kMostReceived)) {
    ::shutdown(socket_.get(), SHUT_RDWR);
  }
}

PostOutcome Poster::post(const std::string& target, const std::string& body,
                         const std::vector<std::pair<std::string, std::string>>& headers) {
  httplib::Client client(origin_);
  if (!client.is_valid()) {
    return {0, "the address can't be used"};
  }
  {
    const std::lock_guard guard(mutex_);
    deadline_ = Clock::now() + longest_;
  }
  client.set_connection_timeout(longest_);
  client.set_read_timeout(longest_);
  client.set_write_timeout(longest_);
  client.set_url_encode(false);
  client.set_decompress(false);
  client.set_follow_location(false);
  client.set_socket_options([this](int socket) { watch(socket); });
  int status = 0;
  std::size_t read = 0;
  httplib::Request request;
  request.method = "POST";
  request.path = target;
  request.body = body;
  request.set_header("Content-Type", "application/json");
  request.set_header("User-Agent", "snapthrough/" SNAPTHROUGH_VERSION);
  for (const auto& [name, value] : headers) {
    request.set_header(name, value);
  }
  // The status decides, even if the body fails.
  request.response_handler = [&](const httplib::Response& response) {
    status = response.status;
    return true;
  };
  request.content_receiver = [&](const char*, std::size_t size, std::uint64_t, std::uint64_t) {
    read += size;
    return read <= kMostRead;
  };
  const httplib::Result result = client.send(request);
  watch(-1);
  if (result) {
    return {result->status, ""};
  }
  return {status, status == 0 ? httplib::to_string(result.error()) : ""};
}

}  // namespace snapthrough::server
