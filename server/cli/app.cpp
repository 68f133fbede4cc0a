#include "server/cli/app.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string_view>
#include <thread>

#include "server/cli/commands.h"
#include "server/cli/convert.h"
#include "server/cli/plot.h"
#include "server/cli/remote_arguments.h"
#include "server/cli/shown.h"
#include "server/jobs/limits.h"

namespace snapthrough::server::cli {
namespace {

/// Default of `workers` and --threads in help texts: the manual pages are built on another machine.
constexpr const char* kOneForEachCore = "one for each core";

/// Runs a command with the parsed arguments; returns the exit status.
using Action = std::function<int(const Streams&)>;

/// Values of all command-line arguments.
struct Arguments {
  std::string request;
  bool csv = false;
  bool ndjson = false;
  std::string table;
  std::optional<std::uint64_t> point;
  std::string part = "1/1";
  std::string out;
  std::vector<std::string> parts;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string config_file;
  std::map<std::string, std::string> settings;  ///< values by name of the setting
  std::string store = "snapthrough.db";
  std::string target;
  double tolerance = 0.0;
  std::int64_t memory = std::int64_t{1} << 30;
  std::string address = "127.0.0.1:8080";
  bool ready = false;
  RemoteArguments remote;
  Action action;  ///< action of the given command
};

/// Returns the environment variables that are settings of the service, by name.
std::map<std::string, std::string> own_variables() {
  std::map<std::string, std::string> own;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::size_t equals = std::min(text.find('='), text.size());
    if (text.starts_with(kVariablePrefix) && !is_remote_variable(text.substr(0, equals))) {
      own.emplace(text.substr(0, equals), text.substr(std::min(equals + 1, text.size())));
    }
  }
  return own;
}

CLI::App* add_request_command(CLI::App& app, const char* name, const char* description,
                              Arguments& arguments) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("request", arguments.request, "Request document (JSON); - reads standard input")
      ->required();
  return command;
}

CLI::App* add_solve_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command =
      add_request_command(app, "solve", "Solve a request, result on standard output", arguments);
  command->add_flag("--csv", arguments.csv, "A table of the result instead of JSON");
  command
      ->add_option("--table", arguments.table, "Which table, as CSV; by default that of the type of analysis")
      ->check(CLI::IsMember({"points", "critical_points", "static", "buckling", "vibrations", "states"}));
  return command;
}

CLI::App* add_recompute_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = add_request_command(
      app, "recompute", "Solve a request again and compare with a stored result", arguments);
  command->add_option("result", arguments.target, "Result document (JSON)")->required();
  command->add_option("--tolerance", arguments.tolerance, "Largest relative difference of a number")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  return command;
}

CLI::App* add_sweep_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("sweep", "Solve every point of a sweep, one row each");
  command->add_option("sweep", arguments.request, "Sweep document (JSON); - reads standard input")
      ->required();
  CLI::Option* csv = command->add_flag("--csv", arguments.csv, "Comma-separated values instead of JSON");
  command->add_flag("--ndjson", arguments.ndjson, "One JSON object a line instead of one document")
      ->excludes(csv);
  command->add_option("--threads", arguments.threads, "Points at the same time; rows do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str(kOneForEachCore);
  CLI::Option* point = command->add_option("--point", arguments.point,
                                           "Only write the request of this point, numbered from 0");
  CLI::Option* out =
      command
          ->add_option("--out", arguments.out,
                       "Keep the rows in this file, which can be resumed; `merge` makes the table")
          ->excludes(csv)
          ->excludes("--ndjson")
          ->excludes(point);
  command->add_option("--part", arguments.part, "Only the points of part I of N, as I/N; needs --out")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return sweep_part_from(text) ? "" : "a part is I/N with numbers 1 <= I <= N, such as 3/16";
          },
          "I/N"))
      ->needs(out);
  return command;
}

CLI::App* add_merge_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command =
      app.add_subcommand("merge", "Write the table of a sweep whose parts were computed with sweep --out");
  command->add_option("files", arguments.parts, "Files of all parts, in any order")->required();
  CLI::Option* csv = command->add_flag("--csv", arguments.csv, "Comma-separated values instead of JSON");
  command->add_flag("--ndjson", arguments.ndjson, "One JSON object a line instead of one document")
      ->excludes(csv);
  return command;
}

api::TableForm form_of(const Arguments& arguments) {
  return arguments.csv      ? api::TableForm::csv
         : arguments.ndjson ? api::TableForm::ndjson
                            : api::TableForm::json;
}

/// Adds a command whose flags are the settings of the service, such as --log-level for log_level.
CLI::App* add_service_command(CLI::App& app, const char* name, const char* description,
                              Arguments& arguments) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("--config", arguments.config_file,
                      "Settings (TOML); environment and flags win over it");
  const ServiceConfig defaults = ServiceConfig::defaults();
  for (const Setting& setting : settings()) {
    std::string flag = "--" + setting.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    command
        ->add_option_function<std::string>(
            flag,
            [&arguments, name = setting.name](const std::string& value) { arguments.settings[name] = value; },
            setting.help + " [" + (setting.name == "workers" ? kOneForEachCore : setting.get(defaults)) + "]")
        ->type_name(setting.type);
  }
  command
      ->add_flag_callback(
          "--no-web", [&arguments] { arguments.settings["web"] = http::kNoPage; }, "No page at /")
      ->excludes("--web");
  return command;
}

CLI::App* add_copy_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("copy", "Copy what one store keeps to another, again to go on");
  command->add_option("source", arguments.store, "Database file, or postgresql://...")->required();
  command->add_option("target", arguments.target, "Database file, or postgresql://...")->required();
  return command;
}

CLI::App* add_backup_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("backup", "Copy a store while a service may be using it");
  command->add_option("--store", arguments.store, "Database file")->capture_default_str();
  command->add_option("target", arguments.target, "File to write")->required();
  return command;
}

CLI::App* add_health_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("health", "Ask a service on this machine whether it lives");
  command->add_option("address", arguments.address, "host:port")->capture_default_str();
  command->add_flag("--ready", arguments.ready, "Ask whether it takes work, too");
  return command;
}

CLI::App* add_mcp_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand(
      "mcp", "Serve a language model: Model Context Protocol on standard input and output");
  command->add_option("--memory", arguments.memory, "Largest memory of one analysis in bytes")
      ->check(CLI::Range(kLeastJobMemory, std::int64_t{1} << 50))
      ->capture_default_str();
  return command;
}

SettingSources sources_of(const Arguments& arguments) {
  SettingSources sources{arguments.config_file, own_variables(), {}};
  const auto file = sources.environment.find(kConfigVariable);
  if (sources.file.empty() && file != sources.environment.end()) {
    sources.file = file->second;
  }
  sources.flags.assign(arguments.settings.begin(), arguments.settings.end());
  return sources;
}

/// Makes `action` the action of a command. @pre the arguments outlive the command
void on(CLI::App* command, Arguments& arguments, const Action& action) {
  command->callback([&arguments, action] { arguments.action = action; });
}

/// Adds the commands that solve in this process.
void add_solving_commands(CLI::App& app, Arguments& arguments) {
  on(add_solve_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    return solve_command(arguments.request, streams,
                         {arguments.csv || !arguments.table.empty(), api::result_table_from(arguments.table),
                          ::isatty(STDERR_FILENO) == 1});
  });
  on(add_request_command(app, "check", "Validate a request", arguments), arguments,
     [&arguments](const Streams& streams) { return check_command(arguments.request, streams); });
  on(add_recompute_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    return recompute_command(arguments.request, arguments.target, arguments.tolerance, streams);
  });
  on(add_sweep_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    // Rows on the terminal replace the bar, unless a file takes the rows.
    const bool bar = ::isatty(STDERR_FILENO) == 1 && (::isatty(STDOUT_FILENO) == 0 || !arguments.out.empty());
    return sweep_command(arguments.request, streams,
                         {form_of(arguments), arguments.threads, bar, arguments.point, arguments.out,
                          *sweep_part_from(arguments.part)});
  });
  on(add_merge_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    return merge_command(arguments.parts, form_of(arguments), streams);
  });
  on(add_mcp_command(app, arguments), arguments,
     [&arguments](const Streams& streams) { return mcp_command(arguments.memory, streams); });
  const std::shared_ptr<PlotArguments> plot = add_plot_command(app);
  on(app.get_subcommand("plot"), arguments,
     [plot](const Streams& streams) { return plot_command(*plot, streams); });
  const std::shared_ptr<ConvertArguments> conversion = add_convert_command(app);
  on(app.get_subcommand("convert"), arguments,
     [conversion](const Streams& streams) { return convert_command(*conversion, streams); });
}

/// Adds the commands that run the service or maintain its store.
void add_service_commands(CLI::App& app, Arguments& arguments) {
  on(add_service_command(app, "serve", "Run the service", arguments), arguments,
     [&arguments](const Streams& streams) { return serve_command(sources_of(arguments), true, streams); });
  on(add_service_command(
         app, "work", "Work on what the service was given on other hosts, which share the store", arguments),
     arguments,
     [&arguments](const Streams& streams) { return serve_command(sources_of(arguments), false, streams); });
  on(add_service_command(app, "migrate", "Bring the schema of the store up to date, and end", arguments),
     arguments,
     [&arguments](const Streams& streams) { return migrate_command(sources_of(arguments), streams); });
  on(add_copy_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    return copy_command(arguments.store, arguments.target, streams);
  });
  on(add_backup_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    return backup_command(arguments.store, arguments.target, streams);
  });
  on(add_health_command(app, arguments), arguments, [&arguments](const Streams& streams) {
    return health_command(arguments.address, arguments.ready, streams);
  });
}

/// Adds all commands with their options. @pre the arguments outlive the app
void describe(CLI::App& app, Arguments& arguments) {
  app.description("Equilibrium paths and critical loads of slender structures on elastic bases");
  app.name("snapthrough");
  app.set_version_flag("--version", "snapthrough " SNAPTHROUGH_VERSION);
  app.require_subcommand(1);
  add_solving_commands(app, arguments);
  add_remote_commands(app, arguments.remote);
  add_service_commands(app, arguments);
}

}  // namespace

std::shared_ptr<const CLI::App> described_app() {
  struct Described {
    Arguments arguments;
    CLI::App app;
  };
  const auto described = std::make_shared<Described>();
  describe(described->app, described->arguments);
  return {described, &described->app};
}

int run(int argc, const char* const* argv, const Streams& given) {
  ShownStream err(given.err);
  const Streams streams{given.in, given.out, err};
  CLI::App app;
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, streams.out, streams.err) == 0 ? kDone : kOther;
  }
  try {
    return arguments.remote.action ? arguments.remote.action(streams) : arguments.action(streams);
  } catch (const std::exception& error) {
    streams.err << "snapthrough: " << error.what() << '\n';
    return kOther;
  }
}

}  // namespace snapthrough::server::cli
