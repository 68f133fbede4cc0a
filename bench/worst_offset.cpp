/// Worst imperfections of seven structures against random offsets of the same norm.
///
///   build/release/bench/bench_worst_offset [COUNT]
///
/// COUNT (default 200) offsets of each kind: "random" are rough and smooth ones in turn, "beside" are the
/// worst ones with a third of a smooth random shape added. The program ends with status 1 when one of them
/// has a critical load below that of the worst imperfection by more than the estimated errors of both loads.
#include <cstdio>
#include <cstdlib>

#include "tests/solver/analysis/worst_structures.h"

namespace {

using namespace snapthrough;
using namespace snapthrough::testing;

constexpr int kPoints = 15;  // of the carrier, docs/theory.md

int measure(const WorstCase& one, OffsetNorm norm, int count) {
  const Analysis analysis = critical_load(1e-5);
  Model model = one.model;
  model.imperfections.emplace_back(WorstImperfection{norm, one.amplitude});
  const Result worst = solve(model, analysis);
  const char* kind = norm == OffsetNorm::rms ? "rms" : "max";
  if (!worst.worst_imperfection || !worst.worst_imperfection->load_factor) {
    std::printf("| %s | %s | no load: %s |\n", one.name.c_str(), kind, worst.summary.message.c_str());
    return 1;
  }
  const WorstOffset& found = *worst.worst_imperfection;
  const double perfect = found.perfect_load_factor;
  const Offsets best = offsets_of(one.model, found, kPoints);
  RandomOffsets random(one.model, kPoints, 1U);
  const double size = random.norm(norm, best);
  const auto draw = [&](int i) {
    return random.scaled(norm, i % 2 == 0 ? random.rough() : random.smooth(), one.amplitude);
  };
  const Duel any = duel(one.model, analysis, worst, count, draw);
  const Duel near =
      duel(one.model, analysis, worst, count, [&](int) { return random.beside(norm, best, 1.0 / 3.0); });
  const auto fall = [&](double load) { return 100.0 * (1.0 - load / perfect); };
  std::printf("| %s | %s | %g (%.6f) | %.6g %s | ", one.name.c_str(), kind, one.amplitude,
              size / one.amplitude, perfect, is_limit(found.perfect_type) ? "limit" : "bifurcation");
  if (found.first_order_load_factor)
    std::printf("%.4g %% | ", fall(*found.first_order_load_factor));
  else
    std::printf("- | ");
  std::printf("%.6g (%.4g %%) | %.4g %% | %d of %d | %.4g %% | %d of %d | %d | %d |\n", *found.load_factor,
              fall(*found.load_factor), fall(any.lowest), any.beaten_by, any.tried, fall(near.lowest),
              near.beaten_by, near.tried, any.without + near.without, found.paths);
  std::fflush(stdout);
  return any.beaten_by + near.beaten_by;
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 200;
  std::printf(
      "| structure | norm | amplitude (norm over it) | load, perfect | fall, first order | load, worst "
      "(fall) | "
      "largest fall, random | beaten | largest fall, beside | beaten | without load | paths |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  int beaten = 0;
  for (const WorstCase& one : worst_cases())
    for (const OffsetNorm norm : {OffsetNorm::rms, OffsetNorm::max}) beaten += measure(one, norm, count);
  return beaten == 0 ? 0 : 1;
}
