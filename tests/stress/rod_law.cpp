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

namespace {

/// Slopes of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984): the weighted harmonic mean of the
/// chords on both sides, zero where these have different signs. The cubic has no second derivative at the
/// table's ends.
void set_cubic(LawTable& out) {
  const std::size_t last = out.x.size() - 1;
  std::vector<double> width(last), chord(last);
  for (std::size_t i = 0; i < last; ++i) {
    width[i] = out.x[i + 1] - out.x[i];
    chord[i] = (out.f[i + 1] - out.f[i]) / width[i];
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
}

/// @param argument which of a point's two numbers is x
LawTable table_through(const std::vector<std::array<double, 2>>& points, std::size_t argument,
                       Interpolation interpolation) {
  LawTable out;
  if (points.front()[argument] > 0.0) {
    out.x.push_back(0.0);
    out.f.push_back(0.0);
  }
  for (const std::array<double, 2>& point : points) {
    out.x.push_back(point[argument]);
    out.f.push_back(point[1 - argument]);
  }
  if (interpolation == Interpolation::monotone_cubic) set_cubic(out);
  return out;
}

/// Curvatures by the moment.
LawTable table_of(const BendingLaw& law) { return table_through(law.points, 1, law.interpolation); }

/// Slope of a table's first line, or of its cubic at the origin.
double first_slope(const LawTable& table) {
  return table.slope.empty() ? table.f[1] / table.x[1] : table.slope.front();
}

/// Slope of a table before its last point.
double last_slope(const LawTable& table) {
  const std::size_t n = table.x.size();
  return table.slope.empty() ? (table.f[n - 1] - table.f[n - 2]) / (table.x[n - 1] - table.x[n - 2])
                             : table.slope.back();
}

}  // namespace

LawTable table_of(const ReactionLaw& law) { return table_through(law.points, 0, law.interpolation); }

namespace {

/// Value and slope of a table's lines, or of its cubic in Hermite's form.
/// @pre 0 <= x < the last point
std::array<double, 2> table_at(const LawTable& table, double x) {
  std::size_t i = 0;
  while (x >= table.x[i + 1]) ++i;
  const double h = table.x[i + 1] - table.x[i];
  const double t = (x - table.x[i]) / h;
  const double r = 1.0 - t;
  const double rise = table.f[i + 1] - table.f[i];
  if (table.slope.empty()) return {table.f[i] + rise * t, rise / h};
  const double a = h * table.slope[i];
  const double b = h * table.slope[i + 1];
  return {table.f[i] + rise * t * t * (3.0 - 2.0 * t) + a * t * r * r - b * t * t * r,
          (6.0 * rise * t * r + a * r * (1.0 - 3.0 * t) + b * t * (3.0 * t - 2.0)) / h};
}

/// Force and slope at w >= 0.
std::array<double, 2> response(const RodLaw& law, double w) {
  const double k = law.stiffness;
  const double P = law.capacity;
  if (law.type == ReactionLaw::Type::linear) return {k * w, k};
  if (law.type == ReactionLaw::Type::table) {
    const LawTable& table = *law.table;
    if (w >= table.x.back()) return {law.factor * table.f.back(), 0.0};
    const auto [force, slope] = table_at(table, w);
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
  if (type == ReactionLaw::Type::table) return {table->x.begin() + 1, table->x.end()};
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

BendingCurvature::BendingCurvature(const BendingLaw& law, double EI) {
  if (law.type == BendingLaw::Type::table) {
    table_ = table_of(law);
    return;
  }
  moment_ = law.moment;
  coefficient_ = law.coefficient;
  exponent_ = law.exponent;
  compliance_ = 1.0 / EI;
}

BendingCurvature BendingCurvature::scaled(double moment, double curvature) const {
  BendingCurvature out = *this;
  out.moment_unit_ *= moment;
  out.curvature_unit_ *= curvature;
  return out;
}

/// Curvature and slope at moments that are not negative.
std::array<double, 2> BendingCurvature::response(double moment) const {
  const double M = moment * moment_unit_;
  std::array<double, 2> out{};
  if (table_.x.empty()) {
    const double ratio = M / moment_;
    out = {compliance_ * (M + coefficient_ * moment_ * std::pow(ratio, exponent_)),
           compliance_ * (1.0 + coefficient_ * exponent_ * std::pow(ratio, exponent_ - 1.0))};
  } else if (M >= table_.x.back()) {
    out = {table_.f.back() + last_slope(table_) * (M - table_.x.back()), last_slope(table_)};
  } else {
    out = table_at(table_, M);
  }
  return {out[0] / curvature_unit_, out[1] * moment_unit_ / curvature_unit_};
}

double BendingCurvature::at(double moment) const {
  return std::copysign(response(std::abs(moment))[0], moment);
}

double BendingCurvature::slope(double moment) const { return response(std::abs(moment))[1]; }

double BendingCurvature::moment_of(double curvature) const {
  constexpr int kDoublings = 2000;
  constexpr int kHalvings = 200;
  const double wanted = std::abs(curvature);
  double low = 0.0;
  double high = 1.0;
  for (int it = 0; it < kDoublings && at(high) < wanted; ++it) high *= 2.0;
  for (int it = 0; it < kHalvings; ++it) {
    const double middle = 0.5 * (low + high);
    (at(middle) < wanted ? low : high) = middle;
  }
  return std::copysign(0.5 * (low + high), curvature);
}

double BendingCurvature::change(double moment, double noise) const {
  const double here = at(moment);
  return std::max(at(moment + noise) - here, here - at(moment - noise));
}

std::array<double, 2> BendingCurvature::slopes_near(double moment, double noise) const {
  const double size = std::abs(moment);
  const double here = slope(moment);
  std::array<double, 2> out{here, here};
  const auto widen = [&](double at) {
    const double there = slope(at);
    out = {std::min(out[0], there), std::max(out[1], there)};
  };
  widen(std::max(size - noise, 0.0));
  widen(size + noise);
  for (const double kink : table_.x)
    if (std::abs(kink / moment_unit_ - size) < noise) widen(kink / moment_unit_);
  return out;
}

double bending_stiffness_of(const BendingLaw& law) { return 1.0 / first_slope(table_of(law)); }

}  // namespace snapthrough::testing
