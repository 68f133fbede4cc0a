/// Holds critical loads of random models against a mesh that is much finer, for docs/verification.md:
///   confirm_run frame|broad FIRST COUNT STRIDE ACCURACY
/// `frame`: small frames against 100 elements of order 5 a member, and where they differ against 400 of
/// order 6. `broad`: models of the stress test whose mesh is left to the solver, those with a critical load
/// against four times the elements of the result's mesh, one order higher. A line a seed: "seed outcome load
/// reference difference estimate factorizations seconds". The outcome is `good`, `off` (success, off by more
/// than the accuracy), `unconfirmed` (success without confirmation), `missed` (none was reported where the
/// fine mesh has one), `none` (neither has one), `unreferenced` (the fine mesh alone has none) or a code of
/// failure.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "solver/discrete/build_structure.h"
#include "solver/solve.h"
#include "tests/stress/broad_model.h"
#include "tests/stress/frame_model.h"

namespace {

using snapthrough::AnalysisType;
using snapthrough::CriticalPoint;
using snapthrough::Discretization;
using snapthrough::Result;
using snapthrough::StateOutput;
using snapthrough::testing::RandomRequest;

double load_of(const Result& result) { return result.summary.critical_load_factor.value_or(std::nan("")); }

Result on_mesh(RandomRequest request, int elements, int order) {
  Discretization& mesh = request.analysis.discretization;
  mesh.fixed_mesh = true;
  mesh.elements = elements;
  mesh.order = order;
  return solve(request.model, request.analysis);
}

std::string judge(const Result& result, const Result& fine, double accuracy) {
  if (result.failure) return result.failure->code;
  const bool confirmed = std::all_of(result.critical_points.begin(), result.critical_points.end(),
                                     [](const CriticalPoint& point) { return point.confirmed; });
  if (!confirmed) return "unconfirmed";
  const double load = load_of(result);
  const double reference = load_of(fine);
  if (std::isnan(reference)) return std::isnan(load) ? "none" : "unreferenced";
  if (std::isnan(load)) return "missed";
  return std::abs(load - reference) <= accuracy * std::abs(reference) ? "good" : "off";
}

RandomRequest drawn(bool frame, unsigned long seed, double accuracy) {
  if (frame) return snapthrough::testing::frame_request(seed, accuracy);
  RandomRequest request = snapthrough::testing::broad_request(seed);
  request.analysis.type = AnalysisType::critical;
  request.analysis.discretization = {};
  request.analysis.discretization.accuracy = accuracy;
  request.analysis.output.states = StateOutput::none;
  return request;
}

Result reference_of(bool frame, const RandomRequest& request, const Result& result, double accuracy) {
  constexpr int kRefine = 4;
  const int order = std::min(result.discretization.order + 1, snapthrough::kMaxOrder);
  if (!frame) {
    if (!result.summary.critical_load_factor) return {};
    const int members = static_cast<int>(request.model.members.size());
    const int elements = (result.discretization.elements + members - 1) / members;
    return on_mesh(request, kRefine * elements, order);
  }
  Result fine = on_mesh(request, 100, 5);
  const std::string outcome = judge(result, fine, accuracy);
  if (outcome == "good" || outcome == "none") return fine;
  return on_mesh(request, 400, 6);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string draw = argc == 6 ? argv[1] : "";
  if (draw != "frame" && draw != "broad") {
    std::fprintf(stderr, "usage: confirm_run frame|broad FIRST COUNT STRIDE ACCURACY\n");
    return 2;
  }
  const unsigned long first = std::strtoul(argv[2], nullptr, 10);
  const unsigned long count = std::strtoul(argv[3], nullptr, 10);
  const unsigned long stride = std::strtoul(argv[4], nullptr, 10);
  const double accuracy = std::strtod(argv[5], nullptr);
  for (unsigned long seed = first; seed < first + count; seed += stride) {
    const RandomRequest request = drawn(draw == "frame", seed, accuracy);
    const auto start = std::chrono::steady_clock::now();
    const Result result = solve(request.model, request.analysis);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const Result fine = reference_of(draw == "frame", request, result, accuracy);
    const double load = load_of(result);
    const double reference = load_of(fine);
    std::printf("%lu %s %.12g %.12g %.3g %.3g %d %.4f\n", seed, judge(result, fine, accuracy).c_str(), load,
                reference, std::abs(load / reference - 1.0),
                result.summary.error_estimate.value_or(std::nan("")), result.diagnostics.factorizations,
                elapsed.count());
    std::fflush(stdout);
  }
  return 0;
}
