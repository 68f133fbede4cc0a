#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include "server/cli/commands.h"
#include "server/front/sockets.h"
#include "server/store/copy.h"
#include "server/store/open_store.h"
#include "server/store/sqlite/sqlite_store.h"

namespace snapthrough::server::cli {
namespace {

Descriptor connect_to(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list) != 0) {
    return Descriptor();
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(list, &::freeaddrinfo);
  for (const addrinfo* address = list; address != nullptr; address = address->ai_next) {
    Descriptor socket(::socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const timeval patience{3, 0};
    ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (::connect(socket.get(), address->ai_addr, address->ai_addrlen) == 0) {
      return socket;
    }
  }
  return Descriptor();
}

}  // namespace

int copy_command(const std::string& source, const std::string& target, const Streams& streams) {
  if (!is_shared_location(source) && !std::filesystem::exists(source)) {
    streams.err << "snapthrough: " << source << ": there is no such file\n";
    return kOther;
  }
  const Time now = Environment::system().now();
  const StatusOr<std::unique_ptr<Store>> from = open_store(source, 1, now);
  if (!from.ok()) {
    streams.err << "snapthrough: " << from.status().message() << '\n';
    return kOther;
  }
  const StatusOr<std::unique_ptr<Store>> to = open_store(target, 1, now, true);
  if (!to.ok()) {
    streams.err << "snapthrough: " << to.status().message() << '\n';
    return kOther;
  }
  CopyCounts counts;
  const auto tell = [&](const CopyCounts& sofar) {
    if ((sofar.jobs + sofar.sweeps + sofar.there) % 1000 == 0) {
      streams.err << sofar.jobs + sofar.sweeps + sofar.there << " of " << sofar.all << '\n';
    }
  };
  const Status status = copy_store(**from, **to, counts, tell);
  streams.out << "copied " << counts.jobs << " jobs and " << counts.sweeps << " sweeps from "
              << shown_location(source) << " to " << shown_location(target) << "; " << counts.there
              << " were there\n";
  if (!status.ok()) {
    streams.err << "snapthrough: " << status.message() << "; run it again to go on\n";
    return kOther;
  }
  return kDone;
}

int migrate_command(const SettingSources& sources, const Streams& streams) {
  const auto [config, mistakes] = load_config(sources);
  for (const ConfigMistake& mistake : mistakes) {
    streams.err << mistake.field << ": " << mistake.detail << '\n';
  }
  if (!mistakes.empty()) {
    return kOther;
  }
  const StatusOr<std::unique_ptr<Store>> opened =
      open_store(config.store_path, 1, Environment::system().now());
  if (!opened.ok()) {
    streams.err << "snapthrough: " << opened.status().message() << '\n';
    return kOther;
  }
  streams.out << shown_location(config.store_path) << " has the schema of this version\n";
  return kDone;
}

int backup_command(const std::string& store, const std::string& target, const Streams& streams) {
  if (is_shared_location(store)) {
    streams.err << "snapthrough: a database is backed up by its own tools: pg_dump or pg_basebackup\n";
    return kOther;
  }
  if (const Status status = sqlite::back_up(store, target); !status.ok()) {
    streams.err << "snapthrough: " << status.message() << '\n';
    return kOther;
  }
  streams.out << "copied " << store << " to " << target << ", integrity check passed\n";
  return kDone;
}

int health_command(const std::string& address, bool ready, const Streams& streams) {
  const auto parsed = parse_address(address);
  if (!parsed) {
    streams.err << "expected host:port, got " << address << '\n';
    return kOther;
  }
  const std::string host = parsed->first == "0.0.0.0" ? "127.0.0.1" : parsed->first;
  const Descriptor socket = connect_to(host, parsed->second);
  const std::string path = ready ? "/readyz" : "/livez";
  const std::string request = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  std::array<char, 64> reply{};
  const bool sent = socket.get() >= 0 && ::send(socket.get(), request.data(), request.size(), MSG_NOSIGNAL) ==
                                             static_cast<ssize_t>(request.size());
  const ssize_t count = sent ? ::recv(socket.get(), reply.data(), reply.size(), MSG_WAITALL) : 0;
  const std::string text(reply.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  if (!text.starts_with("HTTP/1.1 200 ")) {
    streams.err << path << " of " << address << ": " << (text.empty() ? "no answer" : text.substr(9, 3))
                << '\n';
    return kOther;
  }
  return kDone;
}

}  // namespace snapthrough::server::cli
