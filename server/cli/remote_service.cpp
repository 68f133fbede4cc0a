#include "server/cli/remote_service.h"

#include <fcntl.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <charconv>
#include <mutex>
#include <thread>

#include "server/bell.h"
#include "server/descriptor.h"
#include "server/webhooks/received_bytes.h"

namespace snapthrough::server::cli {
namespace {

using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr int kOk = 200;
constexpr seconds kToConnect{5};
/// Time that an answer may take whatever the patience: a service reads and checks a costly document so long.
constexpr seconds kLeastPatience{10};
/// Bytes of a head after which the connection is cut: the library has no bound on the length of its lines.
constexpr std::uint64_t kMostOfHead = 1 << 20;
constexpr seconds kLongestPause{10};
constexpr std::chrono::milliseconds kBetweenCuts{20};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Returns the pause in Retry-After; nullopt without a valid one.
std::optional<seconds> asked_pause(const Answer& answer) {
  const std::string text = answer.header("retry-after");
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 0) {
    return std::nullopt;
  }
  return seconds(count);
}

/// @brief During its lifetime, a requested stop, the end of the time, or a head without end ends the client's
/// request.
///
/// The client is stopped repeatedly, because it ignores a stop before its connection is open.
class Cutter {
 public:
  Cutter(httplib::Client& client, const std::stop_token& stop, Clock::time_point deadline)
      : deadline_(deadline), watcher_([this, &client, stop](const std::stop_token& done) {
          while (!done.stop_requested()) {
            if (stop.stop_requested() || is_late() || has_long_head()) {
              client.stop();
            }
            pause(done, kBetweenCuts);
          }
        }) {}

  /// Watches how much a connection receives until head_came().
  void watch(int socket) {
    const std::lock_guard guard(mutex_);
    socket_ = Descriptor(::fcntl(socket, F_DUPFD_CLOEXEC, 0));
  }
  void head_came() { watch(-1); }
  void extend(Clock::time_point deadline) { deadline_ = deadline; }
  [[nodiscard]] bool is_late() const { return Clock::now() > deadline_.load(); }

 private:
  [[nodiscard]] bool has_long_head() {
    const std::lock_guard guard(mutex_);
    return socket_.get() >= 0 && received_bytes(socket_.get()) > kMostOfHead;
  }

  std::atomic<Clock::time_point> deadline_;
  std::mutex mutex_;
  Descriptor socket_;  ///< a duplicate, because the library may close its own at any time
  std::jthread watcher_;
};

/// Takes the head and the body of an answer.
class Receiver {
 public:
  Receiver(const Expected& expected, Cutter& cutter, seconds longest)
      : expected_(expected), cutter_(cutter), longest_(longest) {}

  bool take_head(int status) {
    cutter_.head_came();
    goes_to_sink_ = status == kOk && expected_.sink != nullptr;
    if (goes_to_sink_) {
      expected_.sink->begin();
    }
    return true;
  }
  bool take(std::string_view piece) {
    if (goes_to_sink_) {
      cutter_.extend(Clock::now() + longest_);
      is_unwritable_ = !expected_.sink->write(piece);
      return !is_unwritable_;
    }
    is_too_long_ = piece.size() > expected_.most - body_.size();
    if (!is_too_long_) {
      body_ += piece;
    }
    return !is_too_long_;
  }
  /// Returns the answer with what was received.
  Answer answer(const httplib::Result& result) {
    Answer answer;
    if (is_unwritable_ || is_too_long_) {
      answer.is_final = true;
      answer.trouble = is_unwritable_
                           ? "the answer cannot be written"
                           : "the answer has more than " + std::to_string(expected_.most >> 20U) + " MiB";
    } else if (!result && cutter_.is_late()) {
      answer.trouble = "no complete answer within " + std::to_string(longest_.count()) + " s (--patience)";
    } else if (!result) {
      answer.trouble = httplib::to_string(result.error());
    } else {
      answer.status = result->status;
      answer.body = std::move(body_);
      for (const auto& [name, value] : result->headers) {
        answer.headers.emplace(lower_case(name), value);
      }
    }
    return answer;
  }

 private:
  const Expected& expected_;
  Cutter& cutter_;
  const seconds longest_;
  std::string body_;
  bool goes_to_sink_ = false;
  bool is_unwritable_ = false;
  bool is_too_long_ = false;
};

}  // namespace

std::optional<ServiceAddress> parse_service_address(std::string_view text) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!text.starts_with(scheme)) {
      continue;
    }
    const std::size_t host = scheme.size();
    const std::size_t host_end = std::min(text.find('/', host), text.size());
    const bool is_plain = text.find_first_of("?#@ \t") == std::string_view::npos;
    if (host_end == host || !is_plain) {
      return std::nullopt;
    }
    std::string base(text.substr(host_end));
    base.erase(base.find_last_not_of('/') + 1);
    return ServiceAddress{std::string(text.substr(0, host_end)), base};
  }
  return std::nullopt;
}

std::string Answer::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

Answer RemoteService::get(const std::string& path, const Headers& headers, const Expected& expected) {
  return send({"GET", path, "", headers, expected});
}

Answer RemoteService::post(const std::string& path, const std::string& body, const Headers& headers) {
  return send({"POST", path, body, headers, {}});
}

seconds RemoteService::longest(const Call& call) const {
  return std::max(access_.patience, kLeastPatience) + call.expected.wait;
}

Answer RemoteService::send(const Call& call) {
  const Clock::time_point start = Clock::now();
  seconds own_pause{1};
  while (true) {
    Answer answer = send_once(call, start + longest(call));
    const seconds length = asked_pause(answer).value_or(own_pause);
    if (!may_pass(answer) || Clock::now() + length > start + access_.patience) {
      return answer;
    }
    on_pause_(answer.status == 0 ? answer.trouble : "HTTP status " + std::to_string(answer.status), length);
    pause(stop_, length);
    own_pause = std::min(2 * own_pause, kLongestPause);
  }
}

bool RemoteService::may_pass(const Answer& answer) const {
  if (stop_.stop_requested() || answer.is_final) {
    return false;
  }
  if (answer.status == 0) {
    return was_reached_ || is_connection_lost_;
  }
  constexpr std::array kPassing{429, 502, 503, 504};
  return std::find(kPassing.begin(), kPassing.end(), answer.status) != kPassing.end();
}

Answer RemoteService::send_once(const Call& call, Clock::time_point deadline) {
  httplib::Client client(access_.address.origin);
  if (!client.is_valid()) {
    return {0, "the address can't be used", true, "", {}};
  }
  const seconds most = longest(call);
  client.set_connection_timeout(kToConnect);
  client.set_read_timeout(most);
  client.set_write_timeout(most);
  client.set_url_encode(false);
  client.set_follow_location(false);
  if (!access_.certificates.empty()) {
    client.set_ca_cert_path(access_.certificates);
  }
  httplib::Request request;
  request.method = call.method;
  request.path = access_.address.base + call.path;
  request.body = call.body;
  request.set_header("User-Agent", "snapthrough/" SNAPTHROUGH_VERSION);
  request.set_header("Accept-Encoding", "gzip");
  if (call.method == "POST") {
    request.set_header("Content-Type", "application/json");
  }
  if (!access_.key.empty()) {
    request.set_header("Authorization", "Bearer " + access_.key);
  }
  for (const auto& [name, value] : call.headers) {
    request.set_header(name, value);
  }
  Cutter cutter(client, stop_, deadline);
  Receiver receiver(call.expected, cutter, most);
  client.set_socket_options([&cutter](int socket) { cutter.watch(socket); });
  request.response_handler = [&](const httplib::Response& response) {
    return receiver.take_head(response.status);
  };
  request.content_receiver = [&](const char* piece, std::size_t size, std::uint64_t, std::uint64_t) {
    return receiver.take({piece, size});
  };
  const httplib::Result result = client.send(request);
  was_reached_ = was_reached_ || static_cast<bool>(result);
  is_connection_lost_ =
      !result && (result.error() == httplib::Error::Read || result.error() == httplib::Error::Write);
  return receiver.answer(result);
}

}  // namespace snapthrough::server::cli
