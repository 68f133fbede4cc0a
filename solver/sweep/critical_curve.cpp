#include "solver/sweep/critical_curve.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <stdexcept>
#include <utility>

#include "solver/events/critical_mode.h"
#include "solver/numeric/cancelled.h"
#include "solver/sweep/locus_point.h"
#include "solver/sweep/traced_path.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Numbers of the curve of a critical load over a parameter; ratios without unit. Source: docs/sweeps.md.
struct CurveLimits {
  /// Largest distance of a prediction from the critical point, over the path length.
  static constexpr double reach = 0.1;
  static constexpr double place = 1e-6;      ///< error of the state, over the path length
  static constexpr double same_load = 1e-6;  ///< relative difference up to which loads agree
  static constexpr int halvings = 7;         ///< most halvings of a step from one value to the next
  static constexpr std::size_t nodes = 5;    ///< critical points that a prediction uses
  static constexpr std::size_t stride =
      8;  ///< most values from one critical point with own factors to the next
  /// Error of a prediction, over the path length, below which the stride is doubled, and above which halved.
  static constexpr double accurate = 1e-4;
  static constexpr double inaccurate = 3e-3;
};

/// Critical points at the latest values, with what corrects those of other values.
struct KnownPoints {
  std::shared_ptr<const FamilyMember> reference;  ///< owns the weights of the metric
  double load_scale = 1.0;                        ///< scaled load factor over load factor
  LocusMetric metric;
  LocusOptions options;
  CriticalType type = CriticalType::limit_max;
  std::deque<LocusPoint> nodes;  ///< latest last
};

class Follower {
 public:
  explicit Follower(const CriticalCurveRequest& request)
      : request_(request),
        family_(request.model, request.analysis, request.logarithmic, request.values.front(),
                request.values.back()) {}
  [[nodiscard]] CriticalCurve run();

 private:
  [[nodiscard]] CriticalCurvePoint trace_at(double value);
  [[nodiscard]] CriticalCurvePoint point_of(const TraceOutcome& outcome, const TracedPath& traced,
                                            double value);
  [[nodiscard]] TraceOutcome trace_first(TracedPath& traced);
  [[nodiscard]] bool is_held(double value);
  void begin_at(const CriticalEvent& event, const TracedPath& traced, double value);
  [[nodiscard]] bool follow_to(double value, int halvings);
  [[nodiscard]] bool solve_node(double value);
  [[nodiscard]] bool solve_between(std::size_t first, std::size_t last);
  [[nodiscard]] LocusPoint predicted(double t) const;
  void add_values(std::size_t& checked);
  void add_followed(double value, double lambda);
  void check_from(std::size_t first, std::size_t last);

  const CriticalCurveRequest& request_;
  ModelFamily family_;
  CriticalCurve curve_;
  KnownPoints known_;
  LocusCounts counts_;
  std::unique_ptr<LocusSolver> solver_;
  std::size_t stride_ = 1;
  double error_ = 0.0;  ///< error of the last prediction, over the path length
};

/// Predicts the critical point by Lagrange's polynomial through the known ones; by the curve's tangent where
/// one is known.
LocusPoint Follower::predicted(double t) const {
  LocusPoint guess = known_.nodes.back();
  guess.t = t;
  if (known_.nodes.size() == 1) {
    const LocusDirection& way = guess.direction;
    const double factor = way.t == 0.0 ? 0.0 : (t - known_.nodes.back().t) / way.t;
    guess.y += factor * way.y;
    guess.lambda += factor * way.lambda;
    return guess;
  }
  guess.y.setZero();
  guess.null.setZero();
  guess.lambda = 0.0;
  for (const LocusPoint& node : known_.nodes) {
    double weight = 1.0;
    for (const LocusPoint& other : known_.nodes)
      if (&other != &node) weight *= (t - other.t) / (node.t - other.t);
    guess.y += weight * node.y;
    guess.null += weight * node.null;
    guess.lambda += weight * node.lambda;
  }
  guess.null /= known_.metric.path.norm(guess.null, 0.0);
  return guess;
}

/// Solves for the critical point of a value with new factors and adds it to the known ones; false: it is not
/// found, or another motion lost or gained stability before it.
bool Follower::solve_node(double value) {
  const double t = family_.coordinate_of(value);
  LocusPoint node = predicted(t);
  const LocusPoint guess = node;
  known_.options.directions = false;
  if (!solver_->solve(LocusSide::at_parameter, known_.options, node)) return false;
  if (node.others != guess.others || node.type() != known_.type) return false;
  error_ = known_.metric.path.norm(node.y - guess.y, node.lambda - guess.lambda) * CurveLimits::reach /
           known_.options.reach;
  known_.nodes.push_back(std::move(node));
  if (known_.nodes.size() > CurveLimits::nodes) known_.nodes.pop_front();
  return true;
}

/// Follows the critical point to a value in one step or, where that fails, in steps of half the length.
bool Follower::follow_to(double value, int halvings) {
  if (!is_held(value)) return false;
  if (solve_node(value)) return true;
  if (halvings == CurveLimits::halvings) return false;
  const double t = family_.coordinate_of(value);
  const double middle = family_.value_at(0.5 * (known_.nodes.back().t + t));
  if (!follow_to(middle, halvings + 1)) return false;
  ++curve_.inserted;
  return follow_to(value, halvings + 1);
}

/// Solves for the critical points of values before the last known one with its factors, and adds them.
bool Follower::solve_between(std::size_t first, std::size_t last) {
  std::vector<double> loads;
  for (std::size_t i = first; i < last; ++i) {
    if (!is_held(request_.values[i])) return false;
    LocusPoint point = predicted(family_.coordinate_of(request_.values[i]));
    if (!solver_->solve_with_last_factors(known_.options, point)) return false;
    loads.push_back(point.lambda);
  }
  for (std::size_t i = first; i < last; ++i) add_followed(request_.values[i], loads[i - first]);
  return true;
}

void Follower::add_followed(double value, double lambda) {
  curve_.points.push_back({value, lambda / known_.load_scale, known_.type, true, "", std::nullopt});
}

/// Whether one-sided supports hold the loads at the start of the path of a value.
bool Follower::is_held(double value) {
  const auto member = solver_->member_at(family_.coordinate_of(value));
  return member && (are_held_alike(*member->structure.model, *family_.reference().structure.model) ||
                    loads_are_held(*member->structure.model));
}

/// Traces the path of a value to its first loss of stability.
TraceOutcome Follower::trace_first(TracedPath& traced) {
  ++curve_.traced;
  TraceRules rules;
  rules.first_loss_of_stability = true;
  TraceOutcome outcome = traced.run(rules);
  curve_.factorizations += traced.factorizations();
  return outcome;
}

/// First critical point of a traced path.
CriticalCurvePoint Follower::point_of(const TraceOutcome& outcome, const TracedPath& traced, double value) {
  CriticalCurvePoint point{value, std::nullopt, CriticalType::limit_max, false, "", std::nullopt};
  point.failure = traced.failure();
  if (!point.failure.empty()) return point;
  const double scale = traced.member()->structure.scales.load;
  if (outcome.end != TraceEnd::critical_point) {
    point.none_up_to = outcome.last.lambda / scale;
    return point;
  }
  const CriticalEvent& event = outcome.critical.back();
  point.load_factor = event.point.lambda / scale;
  point.type = event.type;
  return point;
}

/// Traces the path of a value; its critical point becomes the only known one if it can be followed.
CriticalCurvePoint Follower::trace_at(double value) {
  known_ = {};
  solver_ = nullptr;
  TracedPath traced(request_.model(value), request_.analysis, request_.stop);
  const TraceOutcome outcome = trace_first(traced);
  CriticalCurvePoint point = point_of(outcome, traced, value);
  if (!point.load_factor) return point;
  const CriticalEvent& event = outcome.critical.back();
  // paths with pinned free motions or touching supports have no comparable neighbours
  if (!traced.touches() && event.cause == CriticalCause::smooth && event.multiplicity == 1 &&
      !event.point.context.holds)
    begin_at(event, traced, value);
  return point;
}

/// Makes the critical point of a traced path the only known one.
void Follower::begin_at(const CriticalEvent& event, const TracedPath& traced, double value) {
  KnownPoints& known = known_;
  const PathNorm& norm = traced.norm();
  known.reference = traced.member();
  known.load_scale = traced.member()->structure.scales.load;
  known.type = event.type;
  known.metric.path = {&traced.member()->structure.metric, norm.metric().load_weight};
  known.metric.parameter_weight = 1.0 / std::max(family_.span() * family_.span(), 1e-300);
  const double scale = norm.search_scale(event.point);
  known.options.place = CurveLimits::place * scale;
  known.options.load = LocateOptions().tolerance;
  known.options.reach = CurveLimits::reach * scale;
  known.options.least_load = norm.least_load();
  known.options.imperfection = LocateOptions().perfect;
  known.options.directions = family_.span() > 0.0;
  LocusPoint node;
  node.bifurcation = event.type == CriticalType::bifurcation;
  node.t = family_.coordinate_of(value);
  node.y = event.point.y;
  node.lambda = event.point.lambda;
  node.null = event.null.size() > 0 ? VectorXd(event.null.col(0))
                                    : null_vector(traced.member()->problem, event.point, event.point.tangent);
  node.null /= known.metric.path.norm(node.null, 0.0);
  family_.set_reference(traced.member());
  solver_ = std::make_unique<LocusSolver>(family_, known_.metric, counts_);
  if (solver_->solve(LocusSide::at_parameter, known.options, node) &&
      node.others == std::min(event.negative_before, event.negative_after))
    known.nodes.push_back(std::move(node));
  stride_ = 1;
}

/// Checks a followed point by its traced path; if that has another critical point, all values since `first`
/// are traced.
void Follower::check_from(std::size_t first, std::size_t last) {
  TracedPath path(request_.model(request_.values[last]), request_.analysis, request_.stop);
  const CriticalCurvePoint traced = point_of(trace_first(path), path, request_.values[last]);
  CriticalCurvePoint& followed = curve_.points[last];
  const bool same = traced.load_factor && traced.type == followed.type &&
                    std::abs(*traced.load_factor - *followed.load_factor) <=
                        CurveLimits::same_load * std::abs(*traced.load_factor);
  if (same) return;
  ++curve_.disagreed;
  for (std::size_t i = first; i < last; ++i)
    if (curve_.points[i].followed) curve_.points[i] = trace_at(request_.values[i]);
  followed = trace_at(request_.values[last]);
}

/// Adds the next values, up to the next critical point with factors of its own; values before `checked` are
/// verified.
void Follower::add_values(std::size_t& checked) {
  const std::size_t first = curve_.points.size();
  const std::size_t count = request_.values.size();
  const std::size_t last = std::min(first + stride_, count) - 1;
  const KnownPoints before = known_;
  if (known_.nodes.empty() || !follow_to(request_.values[last], last == first ? 0 : CurveLimits::halvings) ||
      !solve_between(first, last)) {
    if (last > first) {  // again in smaller steps
      known_ = before;
      stride_ = 1;
      return;
    }
    if (first > checked && curve_.points.back().followed) check_from(checked, first - 1);
    curve_.points.push_back(trace_at(request_.values[first]));
    checked = first + 1;
    return;
  }
  add_followed(request_.values[last], known_.nodes.back().lambda);
  if (error_ < CurveLimits::accurate) stride_ = std::min(2 * stride_, CurveLimits::stride);
  if (error_ > CurveLimits::inaccurate) stride_ = std::max<std::size_t>(stride_ / 2, 1);
  if (last + 1 == count || last - checked + 1 >= static_cast<std::size_t>(request_.check_every)) {
    check_from(checked, last);
    checked = last + 1;
  }
}

CriticalCurve Follower::run() {
  std::size_t checked = 0;
  const bool all = unless_cancelled([&] {
    while (curve_.points.size() < request_.values.size()) {
      if (request_.stop.stop_requested()) throw Cancelled{};
      add_values(checked);
    }
  });
  if (!all) curve_.points.resize(checked);  // values followed since the last check are unverified
  for (std::size_t i = curve_.points.size(); i < request_.values.size(); ++i)
    curve_.points.push_back(
        {request_.values[i], std::nullopt, CriticalType::limit_max, false, "cancelled", std::nullopt});
  curve_.factorizations += counts_.factorizations;
  curve_.followed = static_cast<int>(std::count_if(curve_.points.begin(), curve_.points.end(),
                                                   [](const auto& point) { return point.followed; }));
  return std::move(curve_);
}

}  // namespace

CriticalCurve follow_critical_point(const CriticalCurveRequest& request) {
  if (request.values.empty() || request.check_every < 1 || !request.analysis.traits().ends_at_loss() ||
      !request.analysis.discretization.fixed_mesh)
    throw std::invalid_argument("a critical point is followed on a fixed mesh, over at least one value");
  if (request.logarithmic && *std::min_element(request.values.begin(), request.values.end()) <= 0.0)
    throw std::invalid_argument("values must be positive where the logarithm is followed");
  return Follower(request).run();
}

}  // namespace snapthrough
