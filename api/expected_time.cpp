#include "api/expected_time.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "api/names.h"
#include "api/sweep_data.h"
#include "solver/numeric/number_text.h"

namespace snapthrough::api {
namespace {

// Law of bench/expected_time.py (`measure`, then `fit`):
//   log(seconds) = constant(type) + power(type) * log(unknowns / 100) + sum of coefficient * term.
// Fitted by least squares to kRequests analyses on 2 cores of an x86-64 server, variations of the documents
// in examples/ and random frames of up to kMost unknowns. What it is off by was judged on requests of
// structures that were held back from the fit. 7 requests were stopped after 8 seconds, which count as their
// time.
constexpr int kRequests = 247;
constexpr int kMost = 33300;

/// Constant and power of a type of analysis, and measured seconds over expected ones of requests held back.
struct TypeLaw {
  AnalysisType type;
  double constant;
  double power;
  double half;  ///< half of them were off by less than this factor
  double low;   ///< quotient that a tenth of them lay below
  double high;  ///< quotient that a tenth of them lay above
};
constexpr TypeLaw kTypes[] = {
    {AnalysisType::buckling, -7.975, 1.792, 2.33, 0.19, 3.72},
    {AnalysisType::critical, -6.350, 1.287, 1.88, 0.33, 5.62},
    {AnalysisType::path, -5.314, 1.006, 2.71, 0.21, 5.97},
    {AnalysisType::static_, -6.377, 1.315, 2.07, 0.31, 4.47},
    {AnalysisType::vibration, -5.786, 1.378, 1.58, 0.40, 3.12},
};

bool is_one_sided(const Foundation& base) { return base.reaction != Reaction::bilateral; }

/// Part of the law beside type and unknowns; features() of bench/expected_time.py has the same names.
struct Term {
  double coefficient;
  double (*value)(const Model& model, const Analysis& analysis);
};

double given_mesh(const Model& /*model*/, const Analysis& analysis) {
  return analysis.discretization.fixed_mesh ? 1.0 : 0.0;
}

double log_order(const Model& /*model*/, const Analysis& analysis) {
  return analysis.discretization.fixed_mesh ? std::log(analysis.discretization.order) : 0.0;
}

double members(const Model& model, const Analysis& /*analysis*/) {
  return std::log(static_cast<double>(model.members.size()));
}

/// Bases that act in both senses.
double bases(const Model& model, const Analysis& /*analysis*/) {
  const auto one_sided = std::ranges::count_if(model.foundations, is_one_sided);
  return std::log1p(static_cast<double>(std::ssize(model.foundations) - one_sided));
}

double rows(const Model& /*model*/, const Analysis& analysis) {
  const auto count = static_cast<double>(std::max<std::size_t>(1, analysis.load_factors.size()));
  return analysis.traits().has_rows ? std::log(count) : 0.0;
}

double modes(const Model& /*model*/, const Analysis& analysis) {
  const bool asked = analysis.traits().linearised || analysis.traits().vibrates;
  return asked ? std::log(analysis.modes) : 0.0;
}

double limit_points(const Model& /*model*/, const Analysis& analysis) {
  return analysis.traits().reports_path ? std::log1p(analysis.stop.limit_points.value_or(0)) : 0.0;
}

double path_points(const Model& /*model*/, const Analysis& analysis) {
  const bool asked = analysis.traits().reports_path;
  return asked ? std::log1p(analysis.output.path_points.value_or(0) / 100.0) : 0.0;
}

double worst(const Model& model, const Analysis& /*analysis*/) {
  const bool sought = std::ranges::any_of(model.imperfections, [](const Imperfection& one) {
    return std::holds_alternative<WorstImperfection>(one);
  });
  return sought ? 1.0 : 0.0;
}

/// States beside those of critical points.
double states(const Model& /*model*/, const Analysis& analysis) {
  const StateOutput asked = analysis.output.states;
  return asked == StateOutput::none || asked == StateOutput::critical ? 0.0 : 1.0;
}

/// Buckling loads of a structure with contact.
double contact_buckling(const Model& model, const Analysis& analysis) {
  return analysis.traits().linearised && std::ranges::any_of(model.foundations, is_one_sided) ? 1.0 : 0.0;
}

constexpr Term kTerms[] = {
    {1.315, given_mesh}, {-1.066, log_order}, {-0.348, members},         {0.643, bases},
    {0.596, rows},       {0.435, modes},      {0.552, limit_points},     {0.929, path_points},
    {4.330, worst},      {0.913, states},     {1.099, contact_buckling},
};

/// Analyses alone that a curve of n values takes which is followed: first + of_value * n, by
/// bench/expected_time.py (`sweeps`): two curves of 2 to 200 values, within a factor of three of it.
struct CurveLaw {
  double first;
  double of_value;
};
constexpr CurveLaw kFirstPoint{3.0, 0.08};  ///< one critical point
constexpr CurveLaw kLocus{33.0, 0.15};      ///< all of them up to the second limit point

const TypeLaw& law_of(AnalysisType type) { return *std::ranges::find(kTypes, type, &TypeLaw::type); }

std::string about_the_law(const TypeLaw& law, int unknowns) {
  std::string text =
      "a law fitted by least squares to the processor time of " + std::to_string(kRequests) +
      " variations of the examples on 2 cores of an x86-64 server; of those held back from the fit "
      "with the type " +
      std::string(name_of(kAnalysisTypes, law.type)) + ", half were off by less than a factor of " +
      rounded(law.half, 2) + ", and 80 % took " + rounded(law.low, 2) + " to " + rounded(law.high, 2) +
      " times what was expected (low, high)";
  if (unknowns > kMost) {
    text += "; this one has more unknowns than any of them had (" + std::to_string(kMost) + ")";
  }
  return text;
}

ExpectedTime times(double factor, ExpectedTime time) {
  time.cpu_seconds *= factor;
  time.low *= factor;
  time.high *= factor;
  return time;
}

}  // namespace

ExpectedTime expected_time(const Model& model, const Analysis& analysis, int unknowns) {
  const TypeLaw& law = law_of(analysis.type);
  double logarithm = law.constant + law.power * std::log(std::max(1, unknowns) / 100.0);
  for (const Term& term : kTerms) {
    logarithm += term.coefficient * term.value(model, analysis);
  }
  const double seconds = std::exp(logarithm);
  return {seconds, law.low * seconds, law.high * seconds, about_the_law(law, unknowns)};
}

std::optional<ExpectedTime> expected_time(const Sweep& sweep, std::vector<ExpectedTime> points) {
  if (points.empty()) {
    return std::nullopt;
  }
  const auto median = points.begin() + static_cast<std::ptrdiff_t>((points.size() - 1) / 2);
  std::ranges::nth_element(points, median, {}, &ExpectedTime::cpu_seconds);
  if (!sweep.follows()) {
    ExpectedTime time = times(static_cast<double>(sweep.size()), std::move(*median));
    time.model = "the number of points times the median of those that were read, each by " + time.model;
    return time;
  }
  const CurveLaw& law = sweep.data().followed.locus ? kLocus : kFirstPoint;
  const double curve = law.first + law.of_value * static_cast<double>(sweep.item_size());
  ExpectedTime time = times(static_cast<double>(sweep.items()) * curve, std::move(*median));
  time.model = "a curve that is followed takes as many times the median of the points that were read as " +
               rounded(law.first, 2) + " + " + rounded(law.of_value, 2) + " * its values, each by " +
               time.model;
  return time;
}

}  // namespace snapthrough::api
