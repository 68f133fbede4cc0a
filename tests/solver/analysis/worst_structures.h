#pragma once
/// @file
/// Structures whose worst imperfection is compared with random ones, and random offsets of a given norm.
/// Norms of random offsets are sums over dense samples, without the solver's OffsetSpace.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/geometry/cubic_spline.h"
#include "solver/resolve/resolved_model.h"
#include "solver/solve.h"
#include "tests/solver/structures.h"

namespace snapthrough::testing {

struct WorstCase {
  std::string name;
  Model model;
  double amplitude = 0.0;  ///< of the worst imperfection
};

/// Column between one-sided bases on both sides, which touch it.
inline Model column_between_bases(double K) {
  Model model = column(1.0, 1.0, 1e9, K);
  Foundation& left = model.foundations.front();
  left.reaction = Reaction::compression_only;
  Foundation right = left;
  right.id = "other";
  right.side = Side::right;
  model.foundations.push_back(right);
  return model;
}

/// Clamped pipeline on a one-sided seabed with a hump; the load factor is the rise of temperature.
inline Model pipeline() {
  Model model;
  model.nodes = {{"left", 0.0, 0.0}, {"right", 100.0, 0.0}};
  model.sections = {{"pipe", 2484000.0, 28980.0, {}}};
  model.members = {{"pipe", "left", "right", "pipe", LineCurve{}, false, false}};
  model.supports = {{"left", true, true, true, 0.0, {}}, {"right", true, true, true, 0.0, {}}};
  Foundation seabed;
  seabed.id = "seabed";
  seabed.member = "pipe";
  seabed.stiffness = 2000.0;
  seabed.reaction = Reaction::compression_only;
  seabed.side = Side::right;
  model.foundations = {seabed};
  model.loads = {DistributedLoad{"pipe", {0.0, -5.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::constant},
                 InitialStrain{"pipe", 1.2e-5, 0.0, Pattern::proportional}};
  model.imperfections = {PointsImperfection{
      "pipe", {{0.3, 0.0}, {0.35, 0.0}, {0.425, 0.05}, {0.5, 0.1}, {0.575, 0.05}, {0.65, 0.0}, {0.7, 0.0}}}};
  return model;
}

/// Amplitudes are about a thousandth of a member's length, that of the pipeline 3 % of its hump.
inline std::vector<WorstCase> worst_cases() {
  return {{"shallow arch", arch(20.0, 420.0, 1.4), 0.03},
          {"column between one-sided bases", column_between_bases(100.0), 1e-3},
          {"column with two modes at nearly one load", column(1.0, 1.0, 1e9, 380.0), 1e-3},
          {"Lee's frame", lee_frame(4.32e9), 0.2},
          {"buried ring", half_ring_in_medium(1200.0, 36e6), 0.03},
          {"deep arch, one foot clamped", arch(215.0, 1e8, 1e6, true), 0.3},
          {"pipeline with a hump", pipeline(), 0.003}};
}

/// Requests the critical load alone.
inline Analysis critical_load(double accuracy) {
  Analysis analysis;
  analysis.discretization.accuracy = accuracy;
  analysis.output.states = StateOutput::none;
  return analysis;
}

/// Offsets of every member at equally spaced interior points; zero at the ends.
using Offsets = std::vector<std::vector<double>>;

/// Random offsets and their norms for the members of a model.
class RandomOffsets {
 public:
  RandomOffsets(const Model& model, int points, unsigned seed) : points_(points), random_(seed) {
    for (const auto& axis : make_axes(resolve(model))) lengths_.push_back(axis->length());
  }

  /// Independent normal values at all points.
  [[nodiscard]] Offsets rough() {
    Offsets out(lengths_.size());
    for (auto& member : out)
      for (int i = 0; i < points_; ++i) member.push_back(normal_(random_));
    return out;
  }
  /// Seven half waves with normal amplitudes that fall with their number.
  [[nodiscard]] Offsets smooth() {
    Offsets out(lengths_.size(), std::vector<double>(static_cast<std::size_t>(points_), 0.0));
    for (auto& member : out)
      for (int waves = 1; waves <= 7; ++waves) {
        const double size = normal_(random_) / waves;
        for (int i = 0; i < points_; ++i)
          member[static_cast<std::size_t>(i)] +=
              size * std::sin(waves * std::numbers::pi * (i + 1.0) / (points_ + 1.0));
      }
    return out;
  }
  [[nodiscard]] double norm(OffsetNorm norm, const Offsets& offsets) const {
    constexpr int kSamples = 4000;
    double sum = 0.0;
    double length = 0.0;
    double largest = 0.0;
    for (std::size_t m = 0; m < offsets.size(); ++m) {
      std::vector<double> t{0.0};
      std::vector<double> w{0.0};
      for (int i = 0; i < points_; ++i) {
        t.push_back((i + 1.0) / (points_ + 1.0));
        w.push_back(offsets[m][static_cast<std::size_t>(i)]);
      }
      t.push_back(1.0);
      w.push_back(0.0);
      const CubicSpline spline(t, w);
      double square = 0.0;
      for (int i = 0; i <= kSamples; ++i) {
        const double value = spline.at(static_cast<double>(i) / kSamples)[0];
        square += value * value / kSamples;
        largest = std::max(largest, std::abs(value));
      }
      sum += square * lengths_[m];
      length += lengths_[m];
    }
    return norm == OffsetNorm::max ? largest : std::sqrt(sum / length);
  }
  /// Offsets in the direction of `offsets` with the given norm.
  [[nodiscard]] Offsets scaled(OffsetNorm kind, Offsets offsets, double size) const {
    const double factor = size / norm(kind, offsets);
    for (auto& member : offsets)
      for (double& value : member) value *= factor;
    return offsets;
  }
  /// `share` of a random shape beside the given one, with the norm of the given one.
  [[nodiscard]] Offsets beside(OffsetNorm kind, const Offsets& given, double share) {
    const double size = norm(kind, given);
    Offsets out = scaled(kind, smooth(), share * size);
    for (std::size_t m = 0; m < out.size(); ++m)
      for (std::size_t i = 0; i < out[m].size(); ++i) out[m][i] += given[m][i];
    return scaled(kind, std::move(out), size);
  }

 private:
  int points_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<double> lengths_;
};

/// The model with offsets added.
inline Model with(const Model& model, const Offsets& offsets) {
  Model out = model;
  for (std::size_t m = 0; m < offsets.size(); ++m) {
    PointsImperfection points{model.members[m].id, {}};
    const double n = static_cast<double>(offsets[m].size()) + 1.0;
    for (std::size_t i = 0; i < offsets[m].size(); ++i)
      points.offsets.push_back({(static_cast<double>(i) + 1.0) / n, offsets[m][i]});
    out.imperfections.emplace_back(std::move(points));
  }
  return out;
}

/// The found offsets; zero on members without.
inline Offsets offsets_of(const Model& model, const WorstOffset& found, int points) {
  Offsets out(model.members.size(), std::vector<double>(static_cast<std::size_t>(points), 0.0));
  for (const MemberOffsets& member : found.imperfections)
    for (std::size_t m = 0; m < model.members.size(); ++m)
      if (model.members[m].id == member.member)
        for (std::size_t i = 0; i < out[m].size(); ++i) out[m][i] = member.offsets[i + 1][1];
  return out;
}

/// Critical loads of random offsets beside that of the worst ones.
struct Duel {
  int tried = 0;
  int beaten_by = 0;  ///< loads below the worst one by more than the estimated errors of both
  int without = 0;    ///< offsets without a critical load
  double lowest = 0.0;
};

/// @param draw gives offsets of the norm of the worst imperfection
template <class Draw>
Duel duel(const Model& model, const Analysis& analysis, const Result& worst, int count, const Draw& draw) {
  Duel out;
  out.lowest = HUGE_VAL;
  const double load = *worst.worst_imperfection->load_factor;
  for (int i = 0; i < count; ++i) {
    const Result other = solve(with(model, draw(i)), analysis);
    ++out.tried;
    if (!other.summary.critical_load_factor) {
      ++out.without;
      continue;
    }
    const double its = *other.summary.critical_load_factor;
    const double error =
        worst.summary.error_estimate.value_or(0.0) + other.summary.error_estimate.value_or(0.0);
    out.lowest = std::min(out.lowest, its);
    if (its < load - error * std::abs(load)) ++out.beaten_by;
  }
  return out;
}

}  // namespace snapthrough::testing
