/// Compiled against the solver with the blocks of docs/howto/add-a-path-event.md; see path_event.py.
#include <cmath>
#include <cstdio>

#include "tests/solver/path/small_problem.h"
#include "tests/solver/trace/follow.h"

namespace {

using namespace snapthrough;

/// Counts passings of the marked load and keeps the last.
class Marks final : public PathObserver {
 public:
  int count = 0;
  double load = 0.0;
  void on_marked_load(const PathPoint& point) override {
    ++count;
    load = point.lambda;
  }
};

}  // namespace

int main() {
  // lambda = a - a^2 / 2 without a critical point before a = 1
  auto problem = testing::pitchfork(5.0, 0.0);
  TraceRules rules;
  rules.rotation = {[](const PathPoint& point) { return point.y[0]; }, {-1.0, 0.8}};
  rules.marked_load = 0.3;
  Marks marks;
  const TraceOutcome outcome = testing::follow(problem, rules, {&marks});
  const bool ended = outcome.end == TraceEnd::rotation && std::abs(outcome.last.y[0] - 0.8) < 1e-11;
  const bool marked = marks.count == 1 && std::abs(marks.load - 0.3) < 1e-11;
  std::printf("ended at %.15g, %d passing(s) at load %.15g\n", outcome.last.y[0], marks.count, marks.load);
  return ended && marked ? 0 : 1;
}
