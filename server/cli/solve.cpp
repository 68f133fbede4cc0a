#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <span>

#include "api/api.h"
#include "api/json_text.h"
#include "api/sweep.h"
#include "server/cli/commands.h"
#include "server/cli/input.h"
#include "server/cli/interruption.h"
#include "server/cli/shown.h"
#include "solver/numeric/number_text.h"
#include "solver/solve.h"

namespace snapthrough::server::cli {
namespace {

/// A valid request, or an exit status after the findings were printed.
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

Result solve_watched(const api::Request& request, const Streams& streams, const Interruption& interruption,
                     bool show_progress) {
  Hooks hooks;
  hooks.stop = interruption.token();
  if (show_progress) {
    hooks.on_progress = [&](const Progress& progress) {
      streams.err << line_start << "branch " << progress.branch << ", step " << progress.step
                  << ", load factor " << progress.load_factor << "   " << std::flush;
    };
  }
  Result result = solve_checked(request.model, request.analysis, hooks);
  if (show_progress) {
    streams.err << '\n';
  }
  return result;
}

/// Returns the table to write; an inner nullopt for the result document, an outer one after a message on
/// `err` that results of this analysis lack the table.
std::optional<std::optional<api::ResultTable>> chosen_table(const api::Request& request,
                                                            const SolveOptions& options,
                                                            const Streams& streams) {
  if (!options.csv) {
    return std::optional<api::ResultTable>();
  }
  const auto type = request.document->at("analysis").at("type").get<std::string>();
  const std::span<const api::ResultTable> tables = api::tables_of(type);
  const api::ResultTable table = options.table.value_or(tables.front());
  if (std::find(tables.begin(), tables.end(), table) == tables.end()) {
    streams.err << "snapthrough: an analysis of type " << type << " has no such table; it has "
                << api::table_names(tables) << '\n';
    return std::nullopt;
  }
  return table;
}

void write(const api::Request& request, const Result& result, double seconds,
           const std::optional<api::ResultTable>& table, std::ostream& out) {
  if (table == api::ResultTable::points) {
    std::string csv;
    api::PointsTable(result.branches).append_rows(csv, std::string::npos);
    out << csv;
  } else if (const nlohmann::json document = api::write_result(request, result, seconds); table) {
    out << api::result_csv(document, *table);
  } else {
    out << document.dump(2) << '\n';
  }
  out << std::flush;
}

/// Prints warnings on the error stream: a table does not contain them, and in a long document they are easily
/// missed.
void print_warnings(const Result& result, const Streams& streams) {
  for (const Warning& warning : result.warnings) {
    streams.err << "Warning: " << warning.detail << " [" << warning.code << "]\n";
  }
}

/// Returns the load to use where the structure is nearly unstable before it loses stability; nullopt
/// elsewhere.
std::optional<double> load_to_use(const Result& result) {
  const bool warned = std::any_of(result.warnings.begin(), result.warnings.end(),
                                  [](const Warning& warning) { return warning.code == "nearly_unstable"; });
  return warned && result.summary.softest ? std::optional(result.summary.softest->load_factor) : std::nullopt;
}

/// Returns what monitors read at the last load factor of a static analysis or of the first path; "" without
/// monitors.
std::string last_readings(const Result& result) {
  const bool is_static = result.static_table.has_value();
  if (!is_static && result.branches.empty()) {
    return "";
  }
  const auto& monitors = is_static ? result.static_table->monitors : result.branches.front().monitors;
  const auto& loads = is_static ? result.static_table->load_factor : result.branches.front().load_factor;
  std::string text;
  for (const NamedSeries& monitor : monitors) {
    if (!monitor.values.empty()) {
      text += (text.empty() ? "" : ", ") + monitor.id + " " + rounded(monitor.values.back(), 5);
    }
  }
  return text.empty() ? "" : text + " at load factor " + rounded(loads.back(), 5);
}

/// Prints what the analysis was asked for as the last line of a terminal: the load to use, else the critical
/// load, else what monitors read.
void print_answer(const Result& result, const Streams& streams) {
  const Summary& summary = result.summary;
  if (const std::optional<double> use = load_to_use(result)) {
    streams.err << "Load factor to use: " << number(*use) << '\n';
  } else if (summary.critical_load_factor) {
    streams.err << "Critical load factor: " << number(*summary.critical_load_factor) << '\n';
  } else if (result.buckling && !result.buckling->load_factors.empty()) {
    streams.err << "Buckling load factor: " << number(result.buckling->load_factors.front()) << '\n';
  } else if (const std::string readings = last_readings(result); !readings.empty()) {
    streams.err << readings << '\n';
  }
}

}  // namespace

int solve_command(const std::string& path, const Streams& streams, const SolveOptions& options) {
  const Read read_request = read(path, streams);
  if (!read_request.request) {
    return read_request.exit_status;
  }
  const auto table = chosen_table(*read_request.request, options, streams);
  if (!table) {
    return kOther;
  }
  const Interruption interruption;
  const auto start = std::chrono::steady_clock::now();
  const Result result = solve_watched(*read_request.request, streams, interruption, options.show_progress);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  // After a failure the output holds the computed part; exit status and error stream report the failure.
  write(*read_request.request, result, elapsed.count(), *table, streams.out);
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the result\n";
    return kOther;
  }
  print_warnings(result, streams);
  if (!result.failure) {
    if (options.show_progress) {
      print_answer(result, streams);
    }
    return kDone;
  }
  streams.err << "The analysis could not be completed: " << result.failure->detail << " ["
              << result.failure->code << "]\n";
  return interruption.signal() != 0 && result.failure->code == "cancelled" ? interruption.exit_status()
                                                                           : kNotCompleted;
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
    if (outcome.sweep) {
      size = ", a sweep of " + std::to_string(outcome.sweep->size()) +
             (outcome.sweep->refines() ? " refined curves or surfaces" : " points");
    }
  } else if (parsed.document != nullptr) {
    findings = api::read_request_document(parsed.document).findings;
  }
  print_findings(findings, streams);
  if (!findings.empty()) {
    return kWrongRequest;
  }
  streams.out << shown(name) << ": valid" << size << '\n';
  return kDone;
}

}  // namespace snapthrough::server::cli
