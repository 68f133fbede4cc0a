#include "api/sweep.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "server/cli/commands.h"
#include "server/cli/input.h"
#include "solver/solve.h"

namespace snapthrough::server::cli {
namespace {

using nlohmann::json;

json solve_point(const api::Sweep& sweep, std::uint64_t point) {
  const api::ReadOutcome outcome = api::read_request_document(sweep.document_at(point));
  if (!outcome.request) {
    std::string detail;
    for (const Finding& finding : outcome.findings) {
      detail += (detail.empty() ? "" : "; ") + finding.pointer + ": " + finding.detail;
    }
    return sweep.error_row(point, "wrong_request", detail);
  }
  const auto start = std::chrono::steady_clock::now();
  const Result result = solve(outcome.request->model, outcome.request->analysis);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (result.failure) {
    return sweep.error_row(point, result.failure->code, result.failure->detail);
  }
  return sweep.row(point, api::write_result(*outcome.request, result, elapsed.count()));
}

json row_of(const api::Sweep& sweep, std::uint64_t point) {
  try {
    return solve_point(sweep, point);
  } catch (const std::exception& error) {
    return sweep.error_row(point, "internal", error.what());
  }
}

/// Rows in design order. Each is computed alone, so that they do not depend on how many threads share them.
std::vector<json> solve_points(const api::Sweep& sweep, int threads) {
  std::vector<json> rows(sweep.size());
  std::atomic<std::uint64_t> next{0};
  const auto work = [&] {
    for (std::uint64_t point = next++; point < sweep.size(); point = next++) {
      rows[point] = row_of(sweep, point);
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < threads && static_cast<std::uint64_t>(i) < sweep.size(); ++i) {
    others.emplace_back(work);
  }
  work();
  others.clear();
  return rows;
}

void print(const api::Sweep& sweep, const std::vector<json>& rows, bool csv, std::ostream& out) {
  if (csv) {
    out << api::csv_line(sweep.columns());
    for (const json& row : rows) {
      out << api::csv_line(row);
    }
    out << std::flush;
    return;
  }
  out << "{\"columns\": " << json(sweep.columns()).dump() << ",\n \"rows\": [";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out << (i == 0 ? "\n  " : ",\n  ") << rows[i].dump();
  }
  out << "\n ]}\n" << std::flush;
}

}  // namespace

int sweep_command(const std::string& path, const Streams& streams, bool csv, int threads) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return kOther;
  }
  const api::SweepOutcome outcome = api::read_sweep(*text);
  if (!outcome.sweep) {
    print_findings(outcome.findings, streams);
    return kWrongRequest;
  }
  const std::vector<json> rows = solve_points(*outcome.sweep, threads);
  print(*outcome.sweep, rows, csv, streams.out);
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the rows\n";
    return kOther;
  }
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const json& row) { return !row.back().is_null(); });
  if (failed > 0) {
    streams.err << failed << " of " << rows.size()
                << " points could not be completed; the column error says why\n";
    return kNotCompleted;
  }
  return kDone;
}

}  // namespace snapthrough::server::cli
