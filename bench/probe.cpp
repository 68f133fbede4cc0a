/// Solves one of the benchmarks' problems a number of times, for counting instructions and memory from
/// outside.
///
///   bench_probe CASE ACCURACY TIMES       a case of bench/cases.h
///   bench_probe path:CASE ACCURACY TIMES          forty steps of its path, with masses
///   bench_probe frequencies:CASE ACCURACY TIMES   the same with three frequencies at each point
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

namespace {

using namespace snapthrough;

/// The case that a name on the command line stands for. @param argument accuracy, or size of what grows
bench::Case case_of(const std::string& name, const char* argument) {
  const std::size_t colon = name.find(':');
  const std::string kind = colon == std::string::npos ? "" : name.substr(0, colon);
  if (kind == "grow") return bench::growing_case(name.substr(colon + 1), std::atoi(argument));
  bench::Case out = bench::case_named(colon == std::string::npos ? name : name.substr(colon + 1));
  out.analysis.discretization.accuracy = std::atof(argument);
  if (kind.empty()) return out;
  for (Section& section : out.model.sections) section.mass = 1.0;
  out.analysis.type = AnalysisType::path;
  out.analysis.stop.steps = 40;
  out.analysis.output.frequencies = kind == "frequencies" ? 3 : 0;
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr,
                 "usage: bench_probe [path:|frequencies:]CASE ACCURACY TIMES | grow:PART SIZE TIMES\n");
    return 2;
  }
  const bench::Case c = case_of(argv[1], argv[2]);
  Result result;
  for (int i = 0; i < std::atoi(argv[3]); ++i) result = solve(c.model, c.analysis);
  const double error = c.load == 0.0 || result.critical_points.empty()
                           ? 0.0
                           : result.critical_points.back().load_factor / c.load - 1.0;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("unknowns %d factorizations %d error %.2e peak_kb %ld\n", result.discretization.unknowns,
              result.diagnostics.factorizations, std::abs(error), usage.ru_maxrss);
  return 0;
}
