/// @file
/// The program as it is, but what its runners compute does what the title of the model says: it never ends,
/// crashes, talks nonsense. Titles are "hostile:" and a name of kDeeds, and more after a blank.

#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <list>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "server/cli/app.h"
#include "server/worker/frame.h"
#include "server/worker/runner_process.h"
#include "solver/solve.h"

namespace snapthrough::server {
namespace {

using std::chrono::milliseconds;

/// Asked to stop or not.
[[noreturn]] void go_on_for_ever() {
  static std::atomic<unsigned> rounds = 0;
  for (;;) {
    ++rounds;
  }
}

[[noreturn]] void sleep_for_ever() {
  for (;;) {
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

/// Says which process this is, as the step that it is at, until it is killed or `time` is over.
void tell_process(const Hooks& hooks, milliseconds time) {
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < time) {
    hooks.on_progress({0, ::getpid(), 0.0, 0});
    std::this_thread::sleep_for(milliseconds(10));
  }
}

void take_memory() {
  for (std::list<std::string> all;;) {
    all.emplace_back(1 << 20, 'x');
  }
}

// NOLINTNEXTLINE(misc-no-recursion)
int overflow_stack(int depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow_stack(depth + 1) + frame[0];
}

std::string noise(std::size_t size) {
  std::random_device device;
  std::string bytes(size, '\0');
  for (char& byte : bytes) {
    byte = static_cast<char>(device());
  }
  return bytes;
}

/// Bytes as they are, as part of no frame.
void write_raw(std::string_view bytes) {
  if (::write(kTaskSocket, bytes.data(), bytes.size()) < 0) {
    std::abort();
  }
}

/// The head of a frame that is never sent to its end.
void write_half_a_frame() {
  struct {
    std::uint64_t size = 1000;
    FrameType type = FrameType::job_run;
    std::uint32_t none = 0;
  } head;
  write_raw({reinterpret_cast<const char*>(&head), sizeof head});
  write_raw("a part");
}

void do_as_told(const std::string& deed, const Hooks& hooks) {
  const std::map<std::string, std::function<void()>> deeds{
      {"memory", take_memory},
      {"endless", go_on_for_ever},
      {"asleep", sleep_for_ever},
      {"told", [&] { tell_process(hooks, std::chrono::hours(1)); }},
      {"slow", [&] { tell_process(hooks, milliseconds(300)); }},
      {"abort", [] { std::abort(); }},
      {"stack", [] { overflow_stack(0); }},
      {"exit", [] { ::_exit(EXIT_SUCCESS); }},
      {"throw", [] { throw std::runtime_error("as the title says"); }},
      {"noise", [] { write_raw(noise(4096)), sleep_for_ever(); }},
      {"record",
       [] {
         while (write_frame(kTaskSocket, FrameType::news, noise(256))) {
         }
       }},
      {"half", [] { write_half_a_frame(), sleep_for_ever(); }},
      {"close", [] { ::close(kTaskSocket), sleep_for_ever(); }},
      {"connect", [] { ::socket(AF_INET, SOCK_STREAM, 0), std::abort(); }},
  };
  deeds.at(deed)();
}

Result solve_or_harm(const Model& model, const Analysis& analysis, const Hooks& hooks) {
  constexpr std::string_view kMark = "hostile:";
  if (model.title.starts_with(kMark)) {
    do_as_told(model.title.substr(kMark.size(), model.title.find(' ') - kMark.size()), hooks);
  }
  return solve_checked(model, analysis, hooks);
}

}  // namespace
}  // namespace snapthrough::server

int main(int argc, char** argv) {
  using namespace snapthrough::server;
  if (argc == 3 && std::string_view(argv[1]) == kRunnerCommand) {
    return run_runner(std::atoi(argv[2]), solve_or_harm);
  }
  return cli::run(argc, argv, {std::cin, std::cout, std::cerr});
}
