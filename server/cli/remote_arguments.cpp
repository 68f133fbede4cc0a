#include "server/cli/remote_arguments.h"

#include <unistd.h>

namespace snapthrough::server::cli {
namespace {

CLI::App* add_command(CLI::App& app, const char* name, const char* description, RemoteArguments& arguments) {
  constexpr int kLongestPatience_s = 86400;
  CLI::App* command = app.add_subcommand(name, description);
  ServiceOptions& service = arguments.service;
  command->add_option("--service", service.url, "Address of the service, http:// or https://")
      ->envname(kServiceVariable)
      ->capture_default_str();
  command
      ->add_option("--key-file", service.key_file,
                   "File whose first line is the key, for a service that wants one")
      ->envname(kKeyFileVariable)
      ->check(CLI::ExistingFile);
  command
      ->add_option("--ca-file", service.certificates,
                   "Certificates (PEM) that https is verified with, in place of the system's")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--patience", service.patience_s,
                   "Seconds to wait for an answer, and to repeat a request while the service is full or away")
      ->check(CLI::Range(0, kLongestPatience_s))
      ->capture_default_str();
  return command;
}

void add_submit_command(CLI::App& app, RemoteArguments& arguments) {
  CLI::App* command = add_command(
      app, "submit", "Hand a request or a sweep in to a service, id on standard output", arguments);
  command->add_option("document", arguments.document, "Request or sweep (JSON); - reads standard input")
      ->required();
  command->add_option("--label", arguments.submit.label, "Text to find the job by, 1 to 200 characters");
  command->add_option("--idempotency-key", arguments.submit.idempotency_key,
                      "The same key within a day is the same job; by default a new one");
  command->callback([&arguments] {
    arguments.action = [&arguments](const Streams& streams) {
      return submit_command(arguments.document, arguments.service, arguments.submit, streams);
    };
  });
}

void add_wait_command(CLI::App& app, RemoteArguments& arguments) {
  CLI::App* command = add_command(
      app, "wait", "Wait for the end of a job or sweep of a service, status on standard output", arguments);
  command->add_option("id", arguments.id, "What submit wrote")->required();
  command
      ->add_option("--timeout", arguments.wait.timeout_s,
                   "Seconds to wait at most; then the exit status is 4")
      ->check(CLI::NonNegativeNumber);
  command->callback([&arguments] {
    arguments.action = [&arguments](const Streams& streams) {
      arguments.wait.show_progress = ::isatty(STDERR_FILENO) == 1;
      return wait_command(arguments.id, arguments.service, arguments.wait, streams);
    };
  });
}

void add_fetch_command(CLI::App& app, RemoteArguments& arguments) {
  CLI::App* command = add_command(
      app, "fetch", "Write the result of a job, or the table of a sweep, of a service", arguments);
  command->add_option("id", arguments.id, "What submit wrote")->required();
  CLI::Option* csv =
      command->add_flag("--csv", arguments.fetch.csv, "Comma-separated values instead of JSON");
  command->add_flag("--ndjson", arguments.fetch.ndjson, "Of a sweep: one JSON object a line")->excludes(csv);
  command
      ->add_option("--table", arguments.fetch.table,
                   "Of a job: which table, as CSV; by default that of the type of analysis")
      ->check(CLI::IsMember({"points", "critical_points", "static", "buckling", "vibrations", "states"}));
  command->add_option("-o,--output", arguments.fetch.output, "File to write instead of standard output");
  command->callback([&arguments] {
    arguments.action = [&arguments](const Streams& streams) {
      arguments.fetch.csv = arguments.fetch.csv || !arguments.fetch.table.empty();
      return fetch_command(arguments.id, arguments.service, arguments.fetch, streams);
    };
  });
}

}  // namespace

bool is_remote_variable(std::string_view name) {
  return name == kServiceVariable || name == kKeyFileVariable;
}

void add_remote_commands(CLI::App& app, RemoteArguments& arguments) {
  add_submit_command(app, arguments);
  add_wait_command(app, arguments);
  add_fetch_command(app, arguments);
}

}  // namespace snapthrough::server::cli
