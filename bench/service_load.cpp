// How many requests a running service answers, and what a small synchronous job costs besides its solving.
//   bench_service_load PORT SECONDS CONNECTIONS          as fast as it goes
//   bench_service_load PORT SECONDS CONNECTIONS RATE     RATE jobs a second, each solved and read; 0: as many
//   as are solved
// Prints /livez, status reads and durable asynchronous submissions per second, and the overhead of
// synchronous jobs, each in the same run; what the numbers mean is in bench/README.md.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A connection that is kept; ends the program when it breaks.
class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      std::perror("connect");
      std::exit(1);
    }
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Sends a request; the whole response.
  const std::string& ask(const std::string& request) {
    if (::send(socket_, request.data(), request.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(request.size())) {
      std::perror("send");
      std::exit(1);
    }
    response_.clear();
    std::size_t total = std::string::npos;
    while (response_.size() < total) {
      const ssize_t count = ::recv(socket_, chunk_.data(), chunk_.size(), 0);
      if (count <= 0) {
        std::fprintf(stderr, "the connection ended\n");
        std::exit(1);
      }
      response_.append(chunk_.data(), static_cast<std::size_t>(count));
      const std::size_t head = response_.find("\r\n\r\n");
      const std::size_t length = response_.find("Content-Length: ");
      if (total == std::string::npos && head != std::string::npos) {
        total = head + 4 + (length < head ? std::strtoul(response_.c_str() + length + 16, nullptr, 10) : 0);
      }
    }
    return response_;
  }

 private:
  int socket_;
  std::string response_;
  std::array<char, 65536> chunk_{};
};

std::string get(const std::string& path) { return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n"; }

std::string post(const std::string& title, const char* prefer) {
  const std::string body =
      R"({"model":{"title":")" + title +
      R"(","nodes":[{"id":"a","x":0,"y":0},{"id":"b","x":1,"y":0}],"sections":[{"id":"s","EA":1e6,"EI":1}],)"
      R"("members":[{"id":"m","start":"a","end":"b","section":"s"}],)"
      R"("supports":[{"node":"a","fixed":["x","y","rotation"]}],)"
      R"("loads":[{"type":"point","at":{"node":"b"},"force":[-1,0]}]},)"

      R"("analysis":{"type":"buckling","discretization":{"elements":4,"order":2}}})";
  return std::string("POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n") +
         prefer + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

/// Requests a second of that many connections, each made by `make(number)`; every response must start so.
double rate(int port, int connections, double seconds, const std::string& expected,
            const std::function<std::string(int)>& make) {
  std::atomic<long> answered = 0;
  std::atomic<int> number = 0;
  const Clock::time_point start = Clock::now();
  std::vector<std::thread> threads;
  for (int i = 0; i < connections; ++i) {
    threads.emplace_back([&] {
      Client client(port);
      while (seconds_since(start) < seconds) {
        const std::string& response = client.ask(make(number++));
        if (!response.starts_with(expected)) {
          std::fprintf(stderr, "%s\n", response.c_str());
          std::exit(1);
        }
        ++answered;
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return static_cast<double>(answered) / seconds_since(start);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Time of one 4 kB append with fsync in the current folder (milliseconds).
double fsync_time() {
  const int file = ::open("fsync.tmp", O_CREAT | O_WRONLY | O_TRUNC, 0600);
  const std::string page(4096, 'x');
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) {
    const Clock::time_point start = Clock::now();
    if (::write(file, page.data(), page.size()) < 0 || ::fdatasync(file) != 0) {
      std::perror("fsync");
    }
    times.push_back(seconds_since(start) * 1e3);
  }
  ::close(file);
  ::unlink("fsync.tmp");
  return median(times);
}

void synchronous_jobs(int port, const std::string& run, double fsync) {
  Client client(port);
  std::vector<double> overheads;
  std::vector<double> solves;
  for (int i = 0; i < 200; ++i) {
    const Clock::time_point start = Clock::now();
    const std::string& response = client.ask(post(run + "-sync-" + std::to_string(i), ""));
    const double total = seconds_since(start);
    const std::size_t at = response.find("\"wall_time_s\":");
    if (!response.starts_with("HTTP/1.1 200") || at == std::string::npos) {
      std::fprintf(stderr, "%s\n", response.c_str());
      std::exit(1);
    }
    const double solve = std::strtod(response.c_str() + at + 14, nullptr);
    solves.push_back(solve * 1e3);
    overheads.push_back((total - solve) * 1e3);
  }
  std::printf("synchronous job: median %.3f ms above its solve time of %.3f ms; one fsync takes %.3f ms\n",
              median(overheads), median(solves), fsync);
}

/// Jobs that are handed in, solved and answered, at most `wanted` a second (0: as many as are solved).
double solved_rate(int port, int connections, double seconds, double wanted, const std::string& run) {
  const Clock::time_point start = Clock::now();
  return rate(port, connections, seconds, "HTTP/1.1 200", [&](int number) {
    if (wanted > 0.0) {
      std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                                std::chrono::duration<double>(number / wanted)));
    }
    return post(run + "-solved-" + std::to_string(number), "");
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: bench_service_load PORT SECONDS CONNECTIONS [RATE]\n");
    return 1;
  }
  const int port = std::atoi(argv[1]);
  const double seconds = std::atof(argv[2]);
  const int connections = std::atoi(argv[3]);
  const std::string run = std::to_string(Clock::now().time_since_epoch().count());
  if (argc == 5) {
    std::printf("solved %.0f jobs/s\n", solved_rate(port, connections, seconds, std::atof(argv[4]), run));
    return 0;
  }
  synchronous_jobs(port, run, fsync_time());
  std::string job = Client(port).ask(post(run, ""));
  job = job.substr(job.find("\r\nLocation: ") + 12);
  job = job.substr(0, job.find('\r'));
  const double livez = rate(port, connections, seconds, "HTTP/1.1 200", [](int) { return get("/livez"); });
  const double status = rate(port, connections, seconds, "HTTP/1.1 200", [&](int) { return get(job); });
  const double submit = rate(port, connections, seconds, "HTTP/1.1 201", [&](int number) {
    return post(run + "-" + std::to_string(number), "Prefer: respond-async\r\n");
  });
  std::printf("/livez %.0f/s; status %.0f/s = %.2f of it; durable submissions %.0f/s = %.3f of it\n", livez,
              status, status / livez, submit, submit / livez);
  return 0;
}
