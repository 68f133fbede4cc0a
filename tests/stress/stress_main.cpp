/// Runs seeds and writes a line for each, for scripts/stress.sh:
///   stress_run <first|broad|laws|media|soil|members> FIRST COUNT STRIDE SECONDS
/// "start seed", then "done seed reached termination points uncovered residual inertia undecided stretch
/// seconds" and a line "fail seed what" for each failure, "note seed why" where no stop rule was reached.
#include <sys/time.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/stress/stress_run.h"

namespace {

void print(unsigned long seed, const snapthrough::testing::StressOutcome& out) {
  const auto& c = out.check;
  std::printf("done %lu %d %s %d %d %.3g %d %d %.3g %.3f\n", seed, out.reached ? 1 : 0,
              out.termination.c_str(), c.points, c.uncovered, c.residual, c.inertia, c.undecided, c.stretch,
              out.seconds);
  for (const std::string& what : c.failures) std::printf("fail %lu %s\n", seed, what.c_str());
  if (!out.reached) std::printf("note %lu %s: %s\n", seed, out.termination.c_str(), out.detail.c_str());
  if (!out.reached || !c.failures.empty()) std::printf("model %lu %s\n", seed, out.features.c_str());
  std::fflush(stdout);
}

/// Ends the process by a signal after that much processor time from now.
void end_after(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  const auto draw = argc == 6 ? snapthrough::testing::draw_named(argv[1]) : std::nullopt;
  if (!draw) {
    std::fprintf(stderr,
                 "usage: stress_run first|broad|laws|media|soil|members FIRST COUNT STRIDE SECONDS\n");
    return 2;
  }
  const unsigned long first = std::strtoul(argv[2], nullptr, 10);
  const unsigned long count = std::strtoul(argv[3], nullptr, 10);
  const unsigned long stride = std::strtoul(argv[4], nullptr, 10);
  const double bound = std::strtod(argv[5], nullptr);
  for (unsigned long seed = first; seed < first + count; seed += stride) {
    std::printf("start %lu\n", seed);
    std::fflush(stdout);
    end_after(10.0 * bound + 60.0);  // where the solver does not listen, or its result takes long to check
    print(seed, snapthrough::testing::run_seed(*draw, seed, bound));
  }
  return 0;
}
