#pragma once
/// @file
/// The real program as a process of its own.

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/support/eventually.h"
#include "tests/server/support/temp_dir.h"

namespace snapthrough::server::test {

inline std::string read_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_file(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// The program, started with its streams in files of a folder.
class Process {
 public:
  Process(const TempDir& folder, const std::vector<std::string>& arguments, const std::string& input = "",
          const std::string& program = SNAPTHROUGH_EXECUTABLE)
      : out_(folder.file("out")), err_(folder.file("err")) {
    write_file(folder.file("in"), input);
    write_file(out_, "");  // nothing of a process before this one
    write_file(err_, "");
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
      argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const std::string in = folder.file("in");
    id_ = ::fork();
    if (id_ == 0) {
      redirect(in, O_RDONLY, STDIN_FILENO);
      redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
      redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
  }
  ~Process() {
    if (id_ > 0) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  Process(Process&&) = delete;
  Process& operator=(Process&&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  /// Processes that it started and has not waited for, such as its runners; ended ones included.
  [[nodiscard]] std::vector<pid_t> started() const {
    std::vector<pid_t> all;
    std::error_code gone;
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(id_) + "/task", gone)) {
      std::ifstream file(thread.path() / "children");
      for (pid_t id = 0; file >> id;) {
        all.push_back(id);
      }
    }
    return all;
  }
  void signal(int number) const { ::kill(id_, number); }
  /// Whether the process has ended. Leaves its status to wait().
  [[nodiscard]] bool has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == id_;
  }
  /// Processor time that the process has used, in seconds; 0 when it has ended and was waited for.
  [[nodiscard]] double processor_seconds() const {
    const std::string stat = read_file("/proc/" + std::to_string(id_) + "/stat");
    std::istringstream fields(stat.substr(stat.rfind(')') + 1));
    std::string skipped;
    for (int i = 3; i < 14; ++i) {  // utime and stime are the fields 14 and 15
      fields >> skipped;
    }
    double user = 0.0;
    double system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  /// Exit status; 1000 plus the signal when one ended it.
  int wait() {
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }
  [[nodiscard]] std::string out() const { return read_file(out_); }
  [[nodiscard]] std::string err() const { return read_file(err_); }

 private:
  static void redirect(const std::string& path, int flags, int target) {
    ::dup2(::open(path.c_str(), flags, 0600), target);
  }
  std::string out_;
  std::string err_;
  pid_t id_ = -1;
};

/// Waits until a service that was started says in its log which port it has; 0 when it does not.
inline int listening_port(const Process& service) {
  int port = 0;
  const auto has_ended_or_listens = [&] {
    const bool ended = service.has_ended();  // before the log is read, which is whole then
    std::istringstream lines(service.err());
    for (std::string line; std::getline(lines, line);) {
      const nlohmann::json entry = nlohmann::json::parse(line, nullptr, false);
      if (entry.is_object() && entry.value("event", "") == "listening") {
        port = entry["port"].get<int>();
      }
    }
    return ended || port != 0;
  };
  (void)eventually(has_ended_or_listens);
  return port;
}

}  // namespace snapthrough::server::test
