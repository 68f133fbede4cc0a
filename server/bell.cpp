#include "server/bell.h"

#include <sys/eventfd.h>

#include <cerrno>
#include <system_error>

namespace snapthrough::server {

PollBell::PollBell(bool one_by_one)
    : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | (one_by_one ? EFD_SEMAPHORE : 0))) {
  if (descriptor_.get() < 0) {
    throw std::system_error(errno, std::generic_category(), "eventfd");
  }
}

void PollBell::ring() const {
  const std::uint64_t one = 1;
  // The kernel refuses only a full counter, which is readable already.
  [[maybe_unused]] const ssize_t written = ::write(descriptor_.get(), &one, sizeof one);
}

void PollBell::silence() const {
  std::uint64_t rings = 0;
  [[maybe_unused]] const ssize_t size = ::read(descriptor_.get(), &rings, sizeof rings);
}

}  // namespace snapthrough::server
