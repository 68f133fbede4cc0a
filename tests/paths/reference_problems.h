#pragma once
/// @file
/// The benchmark problems of the path follower: arches, rings, frames and columns with known critical loads,
/// as a user would ask for them: no step, no tolerance, no mesh named.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/verification/cases.h"

namespace snapthrough::testing {

/// A model, what to do with it, and the load factor of its first limit point where one is known.
struct ReferenceProblem {
  std::string name;
  Model model;
  Analysis analysis;
  std::optional<double> first_limit;  ///< source: see the function that makes it
  double digits = 1e-4;               ///< half a unit of the last digit printed, relative
};

inline Analysis default_path(int limit_points) {
  Analysis analysis = analysis_of(AnalysisType::path, {});
  analysis.stop.limit_points = limit_points;
  return analysis;
}

/// The thesis' shallow arch (4.4.1, 4.4.2): R = 100, 20 degrees in all, pinned, crown load P R^2 / EI.
/// @param slenderness EA R^2 / EI; 3e6 in the thesis
inline ReferenceProblem shallow_arch(double k, Side side, std::optional<double> limit,
                                     double slenderness = 3e6) {
  ReferenceProblem p;
  p.name =
      std::string("arch, base ") + (side == Side::left ? "outside" : "inside") + ", k " + std::to_string(k);
  p.model = arch(20.0, 1.4e-4 * slenderness, 1.4);
  if (k > 0.0) add_soil(p.model, k, side);
  p.analysis = default_path(1);
  p.first_limit = limit;
  return p;
}

/// The thesis' deep arch (4.4.3): R = 100, clamped on the left, hinged on the right, EA R^2 / EI = 1.2e5.
inline ReferenceProblem deep_arch(double degrees, double k, double limit, double slenderness = 1.2e5) {
  ReferenceProblem p;
  p.name = "deep arch " + std::to_string(static_cast<int>(degrees)) + ", k " + std::to_string(k);
  p.model = arch(degrees, 1e-2 * slenderness, 100.0, true);
  if (k > 0.0) add_soil(p.model, k, Side::left);
  p.analysis = default_path(1);
  p.first_limit = limit;
  return p;
}

/// Half a ring in a medium outside (4.5).
/// @param slenderness EA R^2 / EI
inline ReferenceProblem ring_in_medium(double k, std::optional<double> limit, double digits,
                                       double slenderness = 1.2e5) {
  ReferenceProblem p;
  p.name = "ring, k " + std::to_string(k);
  p.model = half_ring_in_medium(k, slenderness * 300.0);
  p.analysis = default_path(1);
  p.first_limit = limit;
  p.digits = digits;
  return p;
}

/// Lee's frame: through its snap-back to the limit point below zero (frames_limit_points.csv).
inline ReferenceProblem lee_frame_path(std::optional<double> limit, double slenderness = 43200.0) {
  ReferenceProblem p;
  p.name = "Lee's frame";
  p.model = lee_frame(slenderness * 1000.0);
  p.model.monitors = {{"v", at_member("beam", 0.2), Component::y}};
  p.analysis = default_path(2);
  p.first_limit = limit;
  return p;
}

/// Pinned column on a one-sided base (4.3.3): L = 5, EI = 100, EA = 1e5, imperfection of two half waves. It
/// leaves the base at Euler's load.
inline ReferenceProblem one_sided_column(double K, double slenderness = 2.5e4) {
  ReferenceProblem p;
  p.name = "column on one-sided base, K " + std::to_string(K);
  p.model = column(5.0, 100.0, slenderness * 4.0, K);
  p.model.foundations[0].reaction = Reaction::compression_only;
  p.model.imperfections = {SineImperfection{"column", 2, 1e-4}};
  p.analysis = default_path(1);
  p.analysis.stop.limit_points.reset();
  p.analysis.stop.monitor = MonitorRange{"mid", {-0.5, 0.5}};
  return p;
}

/// Pinned column on a bonded base, K = 10, with an imperfection of one half wave, until it is bent by a
/// fifth.
inline ReferenceProblem imperfect_column(double amplitude) {
  ReferenceProblem p;
  p.name = "column, imperfection " + std::to_string(std::log10(amplitude));
  p.model = column(5.0, 100.0, 1e6, 10.0);
  p.model.imperfections = {SineImperfection{"column", 1, 5.0 * amplitude}};
  p.analysis = default_path(1);
  p.analysis.stop.limit_points.reset();
  p.analysis.stop.monitor = MonitorRange{"mid", {-1.0, 1.0}};
  return p;
}

/// Loads of thesis.md, to the digits printed there; arches and rings by collocation with the contact ends as
/// unknowns, deep arches likewise.
inline std::vector<ReferenceProblem> benchmark_problems() {
  std::vector<ReferenceProblem> out;
  const struct {
    double k;
    std::optional<double> limit;
  } outside[] = {{0.0, 76.149346},  {1e2, {}},       {1e3, {}},        {1e4, {}},
                 {1e5, 75.760435},  {1e6, 74.9673},  {1e7, 93.117814}, {1e8, 101.5530},
                 {1e9, 102.934123}, {1e10, 103.151}, {1e11, 103.186}};
  for (const auto& row : outside) out.push_back(shallow_arch(row.k, Side::left, row.limit));
  const std::pair<double, double> inside[] = {{1e4, 83.511959}, {2.5e4, 98.264666}};
  for (const auto& [k, limit] : inside) out.push_back(shallow_arch(k, Side::right, limit));
  for (double k = 1e5; k < 2e11; k *= 10.0) {  // no limit point from about k = 35 500 on
    out.push_back(shallow_arch(k, Side::right, {}));
    out.back().analysis.stop.limit_points.reset();
    out.back().analysis.stop.load_factor = std::array{-1.0, 300.0};
  }
  const struct {
    double k, at235, at215;
  } deep[] = {{0.0, 5.038759, 8.971920},   {1e2, 8.245224, 8.514371},   {1e3, 12.468653, 12.561736},
              {1e4, 19.230526, 19.484637}, {1e5, 27.794704, 28.223936}, {1e6, 32.486402, 33.033693}};
  for (const auto& row : deep) {
    out.push_back(deep_arch(235.0, row.k, row.at235));
    out.push_back(deep_arch(215.0, row.k, row.at215));
  }
  const struct {
    double k;
    std::optional<double> limit;
    double digits;
  } rings[] = {{300.0, 8.4151, 1e-5},  {600.0, 10.671, 1e-4},    {1200.0, 13.626900, 1e-7},
               {5e3, 22.8265, 1e-5},   {1e4, 29.278687, 1e-7},   {2e4, 37.1931, 1e-5},
               {5e4, 49.388072, 1e-7}, {1.8e5, 65.729727, 1e-7}, {1e6, 77.448742, 1e-7},
               {1e7, 80.904, 1e-4},    {1e8, {}, 0.0},           {1e9, {}, 0.0}};
  for (const auto& row : rings) out.push_back(ring_in_medium(row.k, row.limit, row.digits));
  out.push_back(lee_frame_path(18.55672753757));
  for (double a = 1e-2; a > 0.5e-12; a *= 0.1) out.push_back(imperfect_column(a));
  for (const double K : {10.0, 50.0, 75.0, 500.0, 1000.0}) out.push_back(one_sided_column(K));
  return out;
}

}  // namespace snapthrough::testing
