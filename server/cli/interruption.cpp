#include "server/cli/interruption.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>

namespace snapthrough::server::cli {
namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

Interruption::Interruption() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM}) {
    if (!is_ignored(signal)) {
      sigaddset(&signals_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  incoming_ = Descriptor(::signalfd(-1, &signals_, SFD_CLOEXEC));
  watcher_ = std::thread([this] { watch(); });
}

Interruption::~Interruption() {
  finished_.ring();
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interruption::watch() {
  std::array<pollfd, 2> waited{{{finished_.descriptor(), POLLIN, 0}, {incoming_.get(), POLLIN, 0}}};
  nfds_t count = waited.size();
  while (true) {
    ::poll(waited.data(), count, -1);
    if (waited[0].revents != 0) {
      return;
    }
    signalfd_siginfo info{};
    if (waited[1].revents != 0 && ::read(incoming_.get(), &info, sizeof info) == sizeof info) {
      signal_ = static_cast<int>(info.ssi_signo);
      pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);  // a second signal ends the process
      count = 1;
      stop_.request_stop();
    }
  }
}

}  // namespace snapthrough::server::cli
