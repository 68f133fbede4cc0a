/// What a point of a sweep costs, and how much of it is not the solver: `bench_sweep_points sweep.json`.
/// One thread; the solver and the rest are measured in the same run.

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "server/jobs/content_key.h"
#include "server/worker/sweep_item.h"
#include "solver/solve.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace snapthrough;
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_sweep_points sweep.json\n");
    return 2;
  }
  std::ifstream file(argv[1]);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const api::SweepOutcome read = api::read_sweep(text);
  if (!read.sweep) {
    std::fprintf(stderr, "%s: %s\n", read.findings.front().pointer.c_str(),
                 read.findings.front().detail.c_str());
    return 2;
  }
  const api::Sweep& sweep = *read.sweep;
  double solving = 0.0;
  const server::SolveFunction solver = [&](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    const Clock::time_point start = Clock::now();
    Result result = solve_checked(model, analysis, hooks);
    solving += seconds_since(start);
    return result;
  };
  const Clock::time_point start = Clock::now();
  std::uint64_t failed = 0;
  std::shared_ptr<nlohmann::json> document;
  for (std::uint64_t item = 0; item < sweep.items(); ++item) {
    for (const api::PointOutcome& outcome : server::SweepItem(sweep, item).compute(solver, {}, document)) {
      failed += outcome.failed() ? 1 : 0;
    }
  }
  const double all = seconds_since(start);
  const Clock::time_point keys = Clock::now();
  std::size_t length = 0;
  for (std::uint64_t point = 0; point < sweep.size(); ++point) {
    length += server::point_key(*sweep.document_at(point), sweep.outputs_text(), "").size();
  }
  const double keyed = seconds_since(keys);
  const double points = static_cast<double>(sweep.size());
  std::printf(
      "%.0f points, %llu failed; us a point: solver %.1f, around it %.1f (ratio %.3f), document and key "
      "%.1f\n",
      points, static_cast<unsigned long long>(failed), 1e6 * solving / points, 1e6 * (all - solving) / points,
      (all - solving) / solving, 1e6 * keyed / points);
  return length == 64 * sweep.size() ? 0 : 1;
}
