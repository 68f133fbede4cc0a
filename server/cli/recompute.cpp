#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>

#include "api/api.h"
#include "api/json_text.h"
#include "api/plot/plot_request.h"
#include "api/provenance.h"
#include "server/cli/commands.h"
#include "server/cli/input.h"
#include "server/cli/interruption.h"
#include "server/cli/shown.h"
#include "solver/model/pointer.h"
#include "solver/solve.h"

namespace snapthrough::server::cli {
namespace {

using nlohmann::json;

/// What two results have in common.
struct Comparison {
  std::uint64_t numbers = 0;    ///< compared
  std::uint64_t different = 0;  ///< numbers that are not equal
  double largest = 0.0;         ///< largest relative difference
  std::string largest_at;       ///< its JSON Pointer
  std::string mismatch;         ///< JSON Pointer of the first other difference; "": there is none
};

/// Relative difference of two numbers; 0 for equal ones.
double difference(double stored, double computed) {
  const double scale = std::max(std::abs(stored), std::abs(computed));
  return stored == computed ? 0.0 : std::abs(stored - computed) / scale;
}

void compare(const json& stored, const json& computed, const std::string& at, Comparison& found);

void compare_members(const json& stored, const json& computed, const std::string& at, Comparison& found) {
  for (const auto& [name, value] : stored.items()) {
    // what made it, and how long that took, is of each run
    const bool of_run = (at.empty() && name == "program") || (at == "/diagnostics" && name == "wall_time_s");
    const std::string place = at + "/" + escape_pointer_token(name);
    if (!of_run && computed.contains(name)) {
      compare(value, computed[name], place, found);
    } else if (!of_run && found.mismatch.empty()) {
      found.mismatch = place;
    }
  }
  for (const auto& [name, value] : computed.items()) {
    if (!stored.contains(name) && found.mismatch.empty()) {
      found.mismatch = at + "/" + escape_pointer_token(name);
    }
  }
}

void compare(const json& stored, const json& computed, const std::string& at, Comparison& found) {
  if (stored.is_number() && computed.is_number()) {
    ++found.numbers;
    const double relative = difference(stored.get<double>(), computed.get<double>());
    found.different += relative > 0.0 ? 1 : 0;
    if (relative > found.largest) {
      found.largest = relative;
      found.largest_at = at;
    }
  } else if (stored.is_object() && computed.is_object()) {
    compare_members(stored, computed, at, found);
  } else if (stored.is_array() && computed.is_array() && stored.size() == computed.size()) {
    for (std::size_t i = 0; i < stored.size(); ++i) {
      compare(stored[i], computed[i], at + "/" + std::to_string(i), found);
    }
  } else if (stored != computed && found.mismatch.empty()) {
    found.mismatch = at.empty() ? "the whole document" : at;
  }
}

/// Reads a result document; nullopt after a message.
std::optional<json> read_result(const std::string& path, const Streams& streams) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return std::nullopt;
  }
  const api::ParsedText parsed = api::parse_json(*text, api::kFigureLimits);
  if (parsed.document == nullptr || !parsed.document->is_object()) {
    print_findings(parsed.findings, streams);
    streams.err << "snapthrough: " << path << " is no result document\n";
    return std::nullopt;
  }
  return *parsed.document;
}

/// Tells what was compared; returns the exit status.
int tell(const Comparison& found, double tolerance, const Streams& streams) {
  streams.out << found.numbers << " numbers compared, " << found.different << " differ";
  if (found.different > 0) {
    streams.out << ", the largest relative difference is " << found.largest << " at " << found.largest_at;
  }
  streams.out << '\n';
  if (!found.mismatch.empty()) {
    streams.err << "snapthrough: the results differ in more than numbers, first at " << found.mismatch
                << '\n';
    return kNotCompleted;
  }
  if (found.largest > tolerance) {
    streams.err << "snapthrough: the results differ by more than the tolerance " << tolerance << '\n';
    return kNotCompleted;
  }
  return kDone;
}

}  // namespace

int recompute_command(const std::string& request_path, const std::string& result_path, double tolerance,
                      const Streams& streams) {
  const std::optional<std::string> text = read_all(request_path, streams);
  if (!text) {
    return kOther;
  }
  const api::ReadOutcome read = api::read_request(*text);
  if (!read.request) {
    print_findings(read.findings, streams);
    return kWrongRequest;
  }
  const std::optional<json> stored = read_result(result_path, streams);
  if (!stored) {
    return kOther;
  }
  const std::string digest = api::request_digest(*read.request->document);
  const auto named = stored->find("request_sha256");
  if (named != stored->end() && *named != digest) {
    streams.err << "snapthrough: the result is of another request: it names the digest "
                << shown(named->dump()) << ", the request has " << digest << '\n';
    return kWrongRequest;
  }
  const Interruption interruption;
  Hooks hooks;
  hooks.stop = interruption.token();
  const Result result = solve_checked(read.request->model, read.request->analysis, hooks);
  if (hooks.stop.stop_requested()) {
    return interruption.exit_status();
  }
  streams.out << "stored:   "
              << (stored->contains("program") ? shown((*stored)["program"].dump()) : "unknown")
              << "\ncomputed: " << api::program_text() << '\n';
  Comparison found;
  compare(*stored, api::write_result(*read.request, result, 0.0), "", found);  // the time is not compared
  return tell(found, tolerance, streams);
}

}  // namespace snapthrough::server::cli
