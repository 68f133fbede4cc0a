#include "server/config.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <thread>

namespace snapthrough::server {
namespace {

constexpr int kMostWorkers = 1024;

bool is_loopback(const std::string& host) {
  in_addr address{};
  const bool numeric = ::inet_pton(AF_INET, host.c_str(), &address) == 1;
  return host == "localhost" || host == "::1" || (numeric && ntohl(address.s_addr) >> 24 == 127);
}

}  // namespace

ServiceConfig ServiceConfig::defaults() {
  ServiceConfig config;
  config.workers = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostWorkers);
  return config;
}

std::vector<ConfigMistake> ServiceConfig::check() const {
  std::vector<ConfigMistake> mistakes;
  const auto require = [&](bool holds, const char* field, const char* detail) {
    if (!holds) {
      mistakes.push_back({field, detail});
    }
  };
  require(is_loopback(listener.host), "listener.host",
          "the service has no authentication, so it listens on loopback only (127.0.0.1, ::1, localhost)");
  require(listener.port >= 0 && listener.port <= 65535, "listener.port", "must be 0 (any) to 65535");
  require(listener.threads >= 1 && listener.threads <= 900, "listener.threads", "must be 1 to 900");
  require(listener.limits.body_bytes > 0, "listener.limits.body_bytes", "must be > 0");
  require(waits.default_wait.count() >= 0, "waits.default_wait", "must be >= 0");
  require(waits.longest_wait >= waits.default_wait, "waits.longest_wait", "must be >= waits.default_wait");
  require(!store_path.empty(), "store_path", "must name a file");
  require(workers >= 1 && workers <= kMostWorkers, "workers", "must be 1 to 1024");
  require(max_crashes >= 1, "max_crashes", "must be >= 1");
  return mistakes;
}

std::optional<std::pair<std::string, int>> parse_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0) {
    return std::nullopt;
  }
  std::string_view host = text.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return std::nullopt;  // an IPv6 address without brackets
  }
  const std::string_view digits = text.substr(colon + 1);
  int port = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  if (!whole || host.empty() || port < 0 || port > 65535) {
    return std::nullopt;
  }
  return std::pair(std::string(host), port);
}

}  // namespace snapthrough::server
