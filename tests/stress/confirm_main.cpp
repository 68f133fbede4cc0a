/// Holds the critical loads of random frames against a mesh that is much finer (and where they differ,
/// against one four times finer still), for docs/verification.md:
///   confirm_run FIRST COUNT STRIDE ACCURACY [ELEMENTS ORDER]
/// A line a seed: "seed outcome load reference error estimate factorizations seconds"; the outcome is `good`,
/// `off` (success, and off by more than the accuracy), a code of failure, or `none` (no critical load on
/// either mesh); `missed`: none was reported where the fine mesh has one.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "solver/solve.h"
#include "tests/stress/frame_model.h"

namespace {

using snapthrough::Result;
using snapthrough::testing::RandomRequest;

double load_of(const Result& result) { return result.summary.critical_load_factor.value_or(std::nan("")); }

Result reference_of(RandomRequest request, int elements, int order) {
  request.analysis.discretization.fixed_mesh = true;
  request.analysis.discretization.elements = elements;
  request.analysis.discretization.order = order;
  return solve(request.model, request.analysis);
}

std::string judge(const Result& result, const Result& fine, double accuracy) {
  if (result.failure) return result.failure->code;
  const double load = load_of(result);
  const double reference = load_of(fine);
  if (std::isnan(reference)) return std::isnan(load) ? "none" : "unreferenced";
  if (std::isnan(load)) return "missed";
  return std::abs(load - reference) <= accuracy * std::abs(reference) ? "good" : "off";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 7) {
    std::fprintf(stderr, "usage: confirm_run FIRST COUNT STRIDE ACCURACY [ELEMENTS ORDER]\n");
    return 2;
  }
  const unsigned long first = std::strtoul(argv[1], nullptr, 10);
  const unsigned long count = std::strtoul(argv[2], nullptr, 10);
  const unsigned long stride = std::strtoul(argv[3], nullptr, 10);
  const double accuracy = std::strtod(argv[4], nullptr);
  const int elements = argc == 7 ? std::atoi(argv[5]) : 100;
  const int order = argc == 7 ? std::atoi(argv[6]) : 5;
  for (unsigned long seed = first; seed < first + count; seed += stride) {
    const RandomRequest request = snapthrough::testing::frame_request(seed, accuracy);
    const auto start = std::chrono::steady_clock::now();
    const Result result = solve(request.model, request.analysis);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    Result fine = reference_of(request, elements, order);
    if (judge(result, fine, accuracy) != "good") fine = reference_of(request, 4 * elements, order + 1);
    const double load = load_of(result);
    const double reference = load_of(fine);
    if (std::getenv("MSG")) std::printf("%s\n", result.summary.message.c_str());
    std::printf("%lu %s %.12g %.12g %.3g %.3g %d %.4f\n", seed, judge(result, fine, accuracy).c_str(), load,
                reference, std::abs(load / reference - 1.0),
                result.summary.error_estimate.value_or(std::nan("")), result.diagnostics.factorizations,
                elapsed.count());
    std::fflush(stdout);
  }
  return 0;
}
