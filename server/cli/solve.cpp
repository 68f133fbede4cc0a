#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "api/api.h"
#include "api/json_text.h"
#include "api/sweep.h"
#include "server/cli/commands.h"
#include "server/cli/input.h"
#include "solver/solve.h"

namespace snapthrough::server::cli {
namespace {

/// The request in a file, or the exit status with what is wrong already said.
struct Read {
  std::optional<api::Request> request;
  int exit_status = kDone;
};

Read read(const std::string& path, const Streams& streams) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return {std::nullopt, kOther};
  }
  api::ReadOutcome outcome = api::read_request(*text);
  print_findings(outcome.findings, streams);
  return {std::move(outcome.request), outcome.findings.empty() ? kDone : kWrongRequest};
}

Result solve_watched(const api::Request& request, const Streams& streams, bool show_progress) {
  Hooks hooks;
  if (show_progress) {
    hooks.on_progress = [&](const Progress& progress) {
      streams.err << "\rbranch " << progress.branch << ", step " << progress.step << ", load factor "
                  << progress.load_factor << "   " << std::flush;
    };
  }
  Result result = solve_checked(request.model, request.analysis, hooks);
  if (show_progress) {
    streams.err << '\n';
  }
  return result;
}

}  // namespace

int solve_command(const std::string& path, const Streams& streams, bool show_progress) {
  const Read read_request = read(path, streams);
  if (!read_request.request) {
    return read_request.exit_status;
  }
  const auto start = std::chrono::steady_clock::now();
  const Result result = solve_watched(*read_request.request, streams, show_progress);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  // After a failure the document holds what was reached; the exit status and the error stream say that it
  // failed.
  streams.out << api::write_result(*read_request.request, result, elapsed.count()).dump(2) << '\n'
              << std::flush;
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the result\n";
    return kOther;
  }
  if (result.failure) {
    streams.err << "The analysis could not be completed: " << result.failure->detail << " ["
                << result.failure->code << "]\n";
    return kNotCompleted;
  }
  return kDone;
}

int check_command(const std::string& path, const Streams& streams) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return kOther;
  }
  const std::string name = path == "-" ? "standard input" : path;
  const api::ParsedText parsed = api::parse_json(*text);
  std::vector<Finding> findings = parsed.findings;
  std::string size;
  if (parsed.document != nullptr && api::is_sweep(*parsed.document)) {
    const api::SweepOutcome outcome = api::read_sweep_document(parsed.document);
    findings = outcome.findings;
    size = outcome.sweep ? ", a sweep of " + std::to_string(outcome.sweep->size()) + " points" : "";
  } else if (parsed.document != nullptr) {
    findings = api::read_request_document(parsed.document).findings;
  }
  print_findings(findings, streams);
  if (!findings.empty()) {
    return kWrongRequest;
  }
  streams.out << name << ": valid" << size << '\n';
  return kDone;
}

}  // namespace snapthrough::server::cli
