/// Critical loads of the half ring in a compression-only medium (thesis 4.5, figure 4.37) at 200 stiffnesses
/// from 1e2 to 1e7: each path traced by solve(), then the limit point followed; one run, one thread.
/// `bench_critical_curve examples/thesis/figure_4_35_ring.json [elements] [order]`

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "api/api.h"
#include "solver/solve.h"
#include "solver/sweep/critical_curve.h"

namespace {

using namespace snapthrough;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

api::Request read(const char* path, int elements, int order) {
  std::ifstream file(path);
  nlohmann::json document;
  file >> document;
  document["model"]["foundations"][0]["stiffness"] = 1;  // nothing else holds the ring
  const nlohmann::json request = {
      {"model", document["model"]},
      {"analysis", {{"type", "critical"}, {"discretization", {{"elements", elements}, {"order", order}}}}}};
  const api::ReadOutcome outcome = api::read_request(request.dump());
  if (!outcome.request) {
    std::fprintf(stderr, "%s\n", outcome.findings.front().detail.c_str());
    std::exit(2);
  }
  return *outcome.request;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_critical_curve figure_4_35_ring.json [elements] [order]\n");
    return 2;
  }
  const api::Request base =
      read(argv[1], argc > 2 ? std::atoi(argv[2]) : 64, argc > 3 ? std::atoi(argv[3]) : 5);
  CriticalCurveRequest request;
  request.analysis = base.analysis;
  request.logarithmic = true;
  request.model = [&](double k) {
    Model model = base.model;
    model.foundations[0].stiffness = 3.0 * k;
    return model;
  };
  for (int i = 0; i < 200; ++i) request.values.push_back(100.0 * std::pow(10.0, 5.0 * i / 199.0));
  Clock::time_point start = Clock::now();
  std::vector<double> loads;
  int factorizations = 0;
  for (const double k : request.values) {
    const Result result = solve(request.model(k), request.analysis);
    loads.push_back(result.summary.critical_load_factor.value_or(std::nan("")));
    factorizations += result.diagnostics.factorizations;
  }
  const double traced = seconds_since(start);
  start = Clock::now();
  const CriticalCurve curve = follow_critical_point(request);
  const double followed = seconds_since(start);
  double worst = 0.0;
  double where = 0.0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const double error = std::abs(curve.points[i].load_factor.value_or(0.0) / loads[i] - 1.0);
    if (!(error <= worst)) where = request.values[i];
    worst = std::isnan(error) ? error : std::max(worst, error);
  }
  std::printf(
      "path by path %.3f s, %d factorisations; followed %.3f s, %d factorisations: %.1f times faster\n",
      traced, factorizations, followed, curve.factorizations, traced / followed);
  std::printf("%d followed, %d paths traced, %d values inserted, %d checks disagreed\n", curve.followed,
              curve.traced, curve.inserted, curve.disagreed);
  std::printf("largest relative difference of the loads %.1e, at k = %.4g\n", worst, where);
  return 0;
}
