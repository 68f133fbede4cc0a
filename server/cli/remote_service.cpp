#include "server/cli/remote_service.h"

#include <httplib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <thread>

#include "server/bell.h"

namespace snapthrough::server::cli {
namespace {

using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr seconds kToConnect{5};
// Exceeds the longest time that a service delays an answer until a job ends (longest_wait_s <= 60).
constexpr seconds kToAnswer{90};
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

/// @brief During its lifetime, a requested stop ends the client's request.
///
/// The client is stopped repeatedly, because it ignores a stop before its connection is open.
class Cutter {
 public:
  Cutter(httplib::Client& client, const std::stop_token& stop)
      : watcher_([&client, stop](const std::stop_token& done) {
          while (!done.stop_requested()) {
            if (stop.stop_requested()) {
              client.stop();
            }
            pause(done, kBetweenCuts);
          }
        }) {}

 private:
  std::jthread watcher_;
};

Answer answer_of(const httplib::Result& result) {
  Answer answer;
  if (!result) {
    answer.trouble = httplib::to_string(result.error());
    return answer;
  }
  answer.status = result->status;
  answer.body = result->body;
  for (const auto& [name, value] : result->headers) {
    answer.headers.emplace(lower_case(name), value);
  }
  return answer;
}

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

Answer RemoteService::get(const std::string& path, const Headers& headers) {
  return send("GET", path, "", headers);
}

Answer RemoteService::post(const std::string& path, const std::string& body, const Headers& headers) {
  return send("POST", path, body, headers);
}

Answer RemoteService::send(const std::string& method, const std::string& path, const std::string& body,
                           const Headers& headers) {
  const Clock::time_point deadline = Clock::now() + access_.patience;
  seconds own_pause{1};
  while (true) {
    Answer answer = send_once(method, path, body, headers);
    const seconds length = asked_pause(answer).value_or(own_pause);
    if (!may_pass(answer) || Clock::now() + length > deadline) {
      return answer;
    }
    on_pause_(answer.status == 0 ? answer.trouble : "HTTP status " + std::to_string(answer.status), length);
    pause(stop_, length);
    own_pause = std::min(2 * own_pause, kLongestPause);
  }
}

bool RemoteService::may_pass(const Answer& answer) const {
  if (stop_.stop_requested()) {
    return false;
  }
  if (answer.status == 0) {
    return was_reached_ || is_connection_lost_;
  }
  constexpr std::array kPassing{429, 502, 503, 504};
  return std::find(kPassing.begin(), kPassing.end(), answer.status) != kPassing.end();
}

Answer RemoteService::send_once(const std::string& method, const std::string& path, const std::string& body,
                                const Headers& headers) {
  httplib::Client client(access_.address.origin);
  if (!client.is_valid()) {
    return {0, "the address can't be used", "", {}};
  }
  client.set_connection_timeout(kToConnect);
  client.set_read_timeout(kToAnswer);
  client.set_write_timeout(kToAnswer);
  client.set_url_encode(false);
  client.set_follow_location(false);
  if (!access_.certificates.empty()) {
    client.set_ca_cert_path(access_.certificates);
  }
  httplib::Request request;
  request.method = method;
  request.path = access_.address.base + path;
  request.body = body;
  request.set_header("User-Agent", "snapthrough/" SNAPTHROUGH_VERSION);
  if (method == "POST") {
    request.set_header("Content-Type", "application/json");
  }
  if (!access_.key.empty()) {
    request.set_header("Authorization", "Bearer " + access_.key);
  }
  for (const auto& [name, value] : headers) {
    request.set_header(name, value);
  }
  const Cutter cutter(client, stop_);
  const httplib::Result result = client.send(request);
  was_reached_ = was_reached_ || static_cast<bool>(result);
  is_connection_lost_ =
      !result && (result.error() == httplib::Error::Read || result.error() == httplib::Error::Write);
  return answer_of(result);
}

}  // namespace snapthrough::server::cli
