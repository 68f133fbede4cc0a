#include "tests/stress/rod_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace snapthrough::testing {

double along(const std::vector<std::pair<double, double>>& points, double constant, double fraction,
             double power) {
  if (points.empty()) return constant;
  if (fraction <= points.front().first) return points.front().second;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& [from, first] = points[i - 1];
    const auto& [to, second] = points[i];
    if (fraction > to) continue;
    const double share = (fraction - from) / (to - from);
    if (power == 1.0) return first + (second - first) * share;
    return std::pow((1.0 - share) * std::pow(first, 1.0 / power) + share * std::pow(second, 1.0 / power),
                    power);
  }
  return points.back().second;
}

/// Slopes of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984): the weighted harmonic mean of the
/// chords on both sides, zero where these have different signs. The cubic has no second derivative at the
/// table's ends.
LawTable table_of(const ReactionLaw& law) {
  const std::vector<std::array<double, 2>>& points = law.points;
  LawTable out;
  if (points.front()[0] > 0.0) {
    out.w.push_back(0.0);
    out.p.push_back(0.0);
  }
  for (const auto& [w, p] : points) {
    out.w.push_back(w);
    out.p.push_back(p);
  }
  if (law.interpolation == ReactionLaw::Interpolation::linear) return out;
  const std::size_t last = out.w.size() - 1;
  std::vector<double> width(last), chord(last);
  for (std::size_t i = 0; i < last; ++i) {
    width[i] = out.w[i + 1] - out.w[i];
    chord[i] = (out.p[i + 1] - out.p[i]) / width[i];
  }
  out.slope.assign(last + 1, 0.0);
  if (last == 1) out.slope = {chord[0], chord[0]};
  for (std::size_t i = 1; i < last; ++i) {
    if (!(chord[i - 1] > 0.0 && chord[i] > 0.0) && !(chord[i - 1] < 0.0 && chord[i] < 0.0)) continue;
    const double share = (width[i - 1] + 2.0 * width[i]) / (3.0 * (width[i - 1] + width[i]));
    out.slope[i] = 1.0 / (share / chord[i - 1] + (1.0 - share) / chord[i]);
  }
  if (last > 1) {
    out.slope[0] = 1.5 * chord[0] - 0.5 * out.slope[1];
    out.slope[last] = 1.5 * chord[last - 1] - 0.5 * out.slope[last - 1];
  }
  return out;
}

namespace {

/// Force and slope of a table's lines at w >= 0, or of its cubic in Hermite's form.
std::array<double, 2> table_at(const LawTable& table, double w) {
  if (w >= table.w.back()) return {table.p.back(), 0.0};
  std::size_t i = 0;
  while (w >= table.w[i + 1]) ++i;
  const double h = table.w[i + 1] - table.w[i];
  const double t = (w - table.w[i]) / h;
  const double r = 1.0 - t;
  const double rise = table.p[i + 1] - table.p[i];
  if (table.slope.empty()) return {table.p[i] + rise * t, rise / h};
  const double a = h * table.slope[i];
  const double b = h * table.slope[i + 1];
  return {table.p[i] + rise * t * t * (3.0 - 2.0 * t) + a * t * r * r - b * t * t * r,
          (6.0 * rise * t * r + a * r * (1.0 - 3.0 * t) + b * t * (3.0 * t - 2.0)) / h};
}

/// Force and slope at w >= 0.
std::array<double, 2> response(const RodLaw& law, double w) {
  const double k = law.stiffness;
  const double P = law.capacity;
  if (law.type == ReactionLaw::Type::linear) return {k * w, k};
  if (law.type == ReactionLaw::Type::table) {
    const auto [force, slope] = table_at(*law.table, w);
    return {law.factor * force, law.factor * slope};
  }
  if (k == 0.0 || P == 0.0) return {0.0, 0.0};
  if (law.type == ReactionLaw::Type::tanh) {
    const double decay = std::exp(-2.0 * k * w / P);  // 1 - tanh^2 = 4 decay / (1 + decay)^2
    return {P * std::tanh(k * w / P), 4.0 * k * decay / ((1.0 + decay) * (1.0 + decay))};
  }
  if (law.type == ReactionLaw::Type::hyperbolic) {
    const double d = 1.0 + k * w / P;
    return {k * w / d, k / (d * d)};
  }
  const double power = P * std::pow(w / law.reference, law.exponent);
  if (k * w <= std::min(power, P)) return {k * w, k};
  return power < P ? std::array{power, law.exponent * power / w} : std::array{P, 0.0};
}

}  // namespace

double RodLaw::force(double w) const { return std::copysign(response(*this, std::abs(w))[0], w); }
double RodLaw::slope(double w) const { return response(*this, std::abs(w))[1]; }

std::vector<double> RodLaw::kinks() const {
  if (type == ReactionLaw::Type::hyperbolic) return {0.0};
  if (type == ReactionLaw::Type::table) return {table->w.begin() + 1, table->w.end()};
  if (type != ReactionLaw::Type::power || stiffness == 0.0 || capacity == 0.0) return {};
  // the line may reach the capacity first
  if (stiffness * reference <= capacity) return {capacity / stiffness, capacity / stiffness};
  const double line = std::pow(capacity / (stiffness * reference), 1.0 / (1.0 - exponent));
  return {reference * line, reference};
}

LawAlong::LawAlong(const ReactionLaw& law) {
  if (law.type == ReactionLaw::Type::table) constant_.table = std::make_shared<const LawTable>(table_of(law));
  constant_.type = law.type;
  constant_.stiffness = law.stiffness.constant;
  constant_.capacity = law.capacity.constant;
  constant_.reference = law.reference;
  constant_.exponent = law.exponent;
  constant_.factor = law.factor.constant;
  if (!law.stiffness.points.empty() || !law.capacity.points.empty() || !law.factor.points.empty())
    varying_ = law;
}

RodLaw LawAlong::at(double fraction) const {
  RodLaw out = constant_;
  if (!varying_) return out;
  const ReactionLaw& law = *varying_;
  out.stiffness = along(law.stiffness.points, law.stiffness.constant, fraction);
  out.capacity = along(law.capacity.points, law.capacity.constant, fraction);
  out.factor = along(law.factor.points, law.factor.constant, fraction);
  return out;
}

}  // namespace snapthrough::testing
