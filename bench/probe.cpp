/// Solves one of the benchmarks' problems a number of times, for counting instructions and memory from
/// outside.
///
///   bench_probe CASE ACCURACY TIMES       a case of bench/cases.h
///   bench_probe growing ELEMENTS TIMES    four steps of an arch on that many elements of order 1
///   bench_probe growing3 ELEMENTS TIMES   of order 3; so to 8
///
/// Prints the unknowns, the relative error (case) and the peak of the resident memory in kB.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bench/cases.h"
#include "solver/solve.h"

int main(int argc, char** argv) {
  using namespace snapthrough;
  const bool growing = argc == 4 && std::strncmp(argv[1], "growing", 7) == 0;
  if (argc != 4) {
    std::fprintf(stderr, "usage: bench_probe CASE ACCURACY TIMES | growing ELEMENTS TIMES\n");
    return 2;
  }
  bench::Case c = growing ? bench::growing_arch(std::atoi(argv[2]), argv[1][7] == 0 ? 1 : argv[1][7] - '0')
                          : bench::case_named(argv[1]);
  if (!growing) c.analysis.discretization.accuracy = std::atof(argv[2]);
  Result result;
  for (int i = 0; i < std::atoi(argv[3]); ++i) result = solve(c.model, c.analysis);
  const double error = growing || result.critical_points.empty()
                           ? 0.0
                           : result.critical_points.back().load_factor / c.load - 1.0;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("unknowns %d error %.2e peak_kb %ld\n", result.discretization.unknowns, std::abs(error),
              usage.ru_maxrss);
  return 0;
}
