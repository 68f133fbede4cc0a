/// Solves one of the benchmarks' problems a number of times, for counting instructions and memory from
/// outside.
///
///   bench_probe CASE ACCURACY TIMES       a case of bench/cases.h
///   bench_probe grow:PART SIZE TIMES      four steps of growing_case(PART, SIZE) of bench/cases.h
///
/// Prints the unknowns, the factorisations, the relative error (case) and the peak of the resident memory in
/// kB.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/cases.h"
#include "solver/solve.h"

int main(int argc, char** argv) {
  using namespace snapthrough;
  if (argc != 4) {
    std::fprintf(stderr, "usage: bench_probe CASE ACCURACY TIMES | grow:PART SIZE TIMES\n");
    return 2;
  }
  const std::string name = argv[1];
  const std::string grow = "grow:";
  const bool growing = name.rfind(grow, 0) == 0;
  bench::Case c =
      growing ? bench::growing_case(name.substr(grow.size()), std::atoi(argv[2])) : bench::case_named(name);
  if (!growing) c.analysis.discretization.accuracy = std::atof(argv[2]);
  Result result;
  for (int i = 0; i < std::atoi(argv[3]); ++i) result = solve(c.model, c.analysis);
  const double error = growing || result.critical_points.empty()
                           ? 0.0
                           : result.critical_points.back().load_factor / c.load - 1.0;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("unknowns %d factorizations %d error %.2e peak_kb %ld\n", result.discretization.unknowns,
              result.diagnostics.factorizations, std::abs(error), usage.ru_maxrss);
  return 0;
}
