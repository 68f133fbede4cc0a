#include "server/cli/app.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <ostream>
#include <thread>

#include "server/cli/commands.h"

namespace snapthrough::server::cli {
namespace {

/// What the arguments set.
struct Arguments {
  std::string request;
  std::string listen = "127.0.0.1:8080";
  std::string log_level = "info";
  bool csv = false;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  ServiceConfig config = ServiceConfig::defaults();
};

CLI::App* add_request_command(CLI::App& app, const char* name, const char* description,
                              Arguments& arguments) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("request", arguments.request, "Request document (JSON); - reads standard input")
      ->required();
  return command;
}

CLI::App* add_sweep_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("sweep", "Solve every point of a sweep, one row each");
  command->add_option("sweep", arguments.request, "Sweep document (JSON); - reads standard input")
      ->required();
  command->add_flag("--csv", arguments.csv, "Comma-separated values instead of JSON");
  command->add_option("--threads", arguments.threads, "Points at the same time; rows do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  return command;
}

CLI::App* add_serve_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("serve", "Run the service");
  command->add_option("--listen", arguments.listen, "Loopback address and port; port 0 takes a free one")
      ->capture_default_str();
  command->add_option("--store", arguments.config.store_path, "Database file, created if need be")
      ->capture_default_str();
  command->add_option("--workers", arguments.config.workers, "Analyses at the same time")
      ->capture_default_str();
  command->add_option("--log-level", arguments.log_level, "debug, info, warning, error or off")
      ->capture_default_str();
  return command;
}

int serve(Arguments& arguments, const Streams& streams) {
  const auto address = parse_address(arguments.listen);
  if (!address) {
    streams.err << "--listen: expected host:port, got " << arguments.listen << '\n';
    return kOther;
  }
  const auto level = log_level_from(arguments.log_level);
  if (!level) {
    streams.err << "--log-level: expected debug, info, warning, error or off, got " << arguments.log_level
                << '\n';
    return kOther;
  }
  arguments.config.listener.host = address->first;
  arguments.config.listener.port = address->second;
  arguments.config.log_level = *level;
  return serve_command(arguments.config, streams);
}

}  // namespace

int run(int argc, const char* const* argv, const Streams& streams) {
  CLI::App app{"Equilibrium paths and critical loads of slender structures on elastic bases", "snapthrough"};
  app.set_version_flag("--version", "snapthrough " SNAPTHROUGH_VERSION);
  app.require_subcommand(1);
  Arguments arguments;
  const CLI::App* solve =
      add_request_command(app, "solve", "Solve a request, result on standard output", arguments);
  const CLI::App* check = add_request_command(app, "check", "Validate a request", arguments);
  const CLI::App* sweep = add_sweep_command(app, arguments);
  add_serve_command(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, streams.out, streams.err) == 0 ? kDone : kOther;
  }
  try {
    if (*solve) {
      return solve_command(arguments.request, streams, ::isatty(STDERR_FILENO) == 1);
    }
    if (*check) {
      return check_command(arguments.request, streams);
    }
    if (*sweep) {
      return sweep_command(arguments.request, streams, arguments.csv, arguments.threads);
    }
    return serve(arguments, streams);
  } catch (const std::exception& error) {
    streams.err << "snapthrough: " << error.what() << '\n';
    return kOther;
  }
}

}  // namespace snapthrough::server::cli
