#include "server/worker/confinement.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

#include "server/worker/sanitizer.h"

namespace snapthrough::server {
namespace {

void write_once(const char* path, std::string_view text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) {
    return;
  }
  // best effort: a refused write changes nothing
  [[maybe_unused]] const ssize_t written = ::write(file, text.data(), text.size());
  ::close(file);
}

void limit(decltype(RLIMIT_CORE) resource, rlim_t soft) {
  rlimit now{};
  ::getrlimit(resource, &now);
  now.rlim_cur = std::min(soft, now.rlim_max);
  ::setrlimit(resource, &now);
}

/// Returns the text of a file in /proc.
template <std::size_t n>
std::string_view contents(int file, std::array<char, n>& text) {
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  return {text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

/// Removes the first number from a text and returns it; 0 when there is none.
std::int64_t first_number(std::string_view& text) {
  std::int64_t value = 0;
  text.remove_prefix(std::min(text.find_first_of("0123456789"), text.size()));
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value).ptr;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

bool confine_process(int parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    return false;
  }
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  limit(RLIMIT_CORE, 0);
  write_once("/proc/self/oom_score_adj", "1000");
  return true;
}

void confine_calls() {
  ::prctl(PR_SET_DUMPABLE, 0);  // files of /proc/self then belong to root
#if !SNAPTHROUGH_SANITIZED && defined(__x86_64__)
  static constexpr std::array kAllowed{SYS_read,
                                       SYS_write,
                                       SYS_pread64,
                                       SYS_sendmsg,
                                       SYS_close,
                                       SYS_mmap,
                                       SYS_munmap,
                                       SYS_mprotect,
                                       SYS_mremap,
                                       SYS_brk,
                                       SYS_madvise,
                                       SYS_futex,
                                       SYS_exit,
                                       SYS_exit_group,
                                       SYS_rt_sigreturn,
                                       SYS_rt_sigprocmask,
                                       SYS_rt_sigaction,
                                       SYS_clock_gettime,
                                       SYS_clock_nanosleep,
                                       SYS_getrusage,
                                       SYS_prlimit64,
                                       SYS_setrlimit,
                                       SYS_getrlimit,
                                       SYS_sched_yield,
                                       SYS_getpid,
                                       SYS_gettid,
                                       SYS_tgkill,
                                       SYS_restart_syscall,
                                       SYS_rseq,
                                       SYS_set_robust_list};  // first calls of a new thread
  std::vector<sock_filter> filter;
  const auto load = [&](std::size_t offset) {
    filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  };
  load(offsetof(seccomp_data, arch));
  filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 1, 0));
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
  load(offsetof(seccomp_data, nr));
  for (std::size_t i = 0; i < kAllowed.size(); ++i) {
    const auto to_allow = static_cast<std::uint8_t>(kAllowed.size() - i);
    filter.push_back(
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(kAllowed.at(i)), to_allow, 0));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program);
#endif
}

MemoryBound::MemoryBound()
    : pages_(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC)),
      status_(::open("/proc/self/status", O_RDONLY | O_CLOEXEC)),
      reset_(::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC)) {}

MemoryBound::~MemoryBound() {
  ::close(pages_);
  ::close(status_);
  ::close(reset_);
}

void MemoryBound::set(std::int64_t bytes) {
  constexpr std::string_view kResetPeak = "5";
  constexpr int kResident = 1;
  constexpr int kData = 5;
  if (::write(reset_, kResetPeak.data(), kResetPeak.size()) < 0) {
    // peak() then counts from the start of the process
  }
  std::array<char, 256> text{};
  std::string_view rest = contents(pages_, text);
  std::array<std::int64_t, kData + 1> pages{};
  for (std::int64_t& count : pages) {
    count = first_number(rest);
  }
  const std::int64_t page = ::sysconf(_SC_PAGESIZE);
  resident_before_ = pages[kResident] * page;
#if SNAPTHROUGH_SANITIZED
  static_cast<void>(bytes);
#else
  limit(RLIMIT_DATA, static_cast<rlim_t>(pages[kData] * page + bytes));
#endif
}

void MemoryBound::lift() { limit(RLIMIT_DATA, RLIM_INFINITY); }

std::int64_t MemoryBound::peak() const {
  std::array<char, 4096> text{};
  std::string_view status = contents(status_, text);
  status.remove_prefix(std::min(status.find("\nVmHWM:"), status.size()));
  return std::max<std::int64_t>(0, first_number(status) * 1024 - resident_before_);
}

}  // namespace snapthrough::server
