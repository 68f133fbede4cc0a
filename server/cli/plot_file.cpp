#include "server/cli/plot_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>

#include "server/descriptor.h"

namespace snapthrough::server::cli {
namespace {

std::string reason(const std::string& what) { return what + ": " + std::strerror(errno); }

bool write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) {
      return false;
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  return true;
}

/// Returns the permissions of a new file (0666 without the umask).
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// Calls `fill` with a temporary file and renames that file to `file` after success. Writes directly to an
/// existing `file` that is not regular, such as a pipe.
std::string replace(const std::string& file, const std::function<std::string(int)>& fill) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    const Descriptor target(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
    return target.get() < 0 ? reason("cannot write " + file) : fill(target.get());
  }
  std::string beside = file + ".XXXXXX";
  std::string problem;
  {
    const Descriptor target(::mkostemp(beside.data(), O_CLOEXEC));
    if (target.get() < 0) {
      return reason("cannot write " + file);
    }
    problem = fill(target.get());
    if (problem.empty() && (::fchmod(target.get(), new_file_mode()) != 0 || ::fsync(target.get()) != 0)) {
      problem = reason("cannot write " + file);
    }
  }
  if (problem.empty() && std::rename(beside.c_str(), file.c_str()) != 0) {
    problem = reason("cannot write " + file);
  }
  if (!problem.empty()) {
    ::unlink(beside.c_str());
  }
  return problem;
}

/// Returns the first line of an error output.
std::string first_line(int descriptor) {
  std::array<char, 300> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  const std::string all(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return all.substr(0, all.find('\n'));
}

std::string convert(const std::string& svg, int output, double scale) {
  const Descriptor input(::memfd_create("figure", MFD_CLOEXEC));
  const Descriptor errors(::memfd_create("errors", MFD_CLOEXEC));
  if (input.get() < 0 || errors.get() < 0 || !write_all(input.get(), svg) ||
      ::lseek(input.get(), 0, SEEK_SET) != 0) {
    return reason("cannot hand the figure to rsvg-convert");
  }
  posix_spawn_file_actions_t streams;
  ::posix_spawn_file_actions_init(&streams);
  ::posix_spawn_file_actions_adddup2(&streams, input.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&streams, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&streams, errors.get(), STDERR_FILENO);
  std::array<std::string, 5> words{"rsvg-convert", "--format", "png", "--zoom", std::to_string(scale)};
  std::array<char*, 6> argv{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    argv[i] = words[i].data();
  }
  pid_t process = 0;
  const int failure = ::posix_spawnp(&process, argv[0], &streams, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&streams);
  if (failure == ENOENT) {
    return "PNG needs the program rsvg-convert, which is not there: install the package librsvg2-bin, or "
           "write .svg";
  }
  if (failure != 0) {
    return std::string("cannot run rsvg-convert: ") + std::strerror(failure);
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ""
                                                       : "rsvg-convert failed: " + first_line(errors.get());
}

}  // namespace

std::string write_whole(const std::string& text, const std::string& file) {
  return replace(file, [&](int descriptor) {
    return write_all(descriptor, text) ? std::string() : reason("cannot write " + file);
  });
}

std::string write_png(const std::string& svg, const std::string& file, double scale) {
  return replace(file, [&](int descriptor) { return convert(svg, descriptor, scale); });
}

std::string png_of(const std::string& svg, std::string& png) {
  constexpr double kScale = 1.5;
  const Descriptor output(::memfd_create("png", MFD_CLOEXEC));
  if (output.get() < 0) {
    return reason("cannot make a file in memory");
  }
  if (std::string problem = convert(svg, output.get(), kScale); !problem.empty()) {
    return problem;
  }
  png.resize(static_cast<std::size_t>(::lseek(output.get(), 0, SEEK_END)));
  return ::pread(output.get(), png.data(), png.size(), 0) == static_cast<ssize_t>(png.size())
             ? ""
             : reason("cannot read the figure");
}

}  // namespace snapthrough::server::cli
