#include "solver/sweep/critical_locus.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <utility>

#include "solver/events/critical_mode.h"
#include "solver/numeric/cancelled.h"
#include "solver/sweep/locus_walk.h"
#include "solver/sweep/traced_path.h"

namespace snapthrough {
namespace {

/// Numbers of the search for curves; ratios without unit.
struct LocusSearch {
  static constexpr double same_load = 1e-6;  ///< relative difference up to which loads agree
  static constexpr int limit_points = 2;     ///< limit points after which a path is not searched further
  static constexpr double reach = 0.1;       ///< largest correction of a point, in the locus norm
  static constexpr double place = 1e-9;      ///< error of a point, in the locus norm
};

class Search {
 public:
  explicit Search(const CriticalLocusRequest& request)
      : request_(request),
        family_(request.model, request.analysis, request.logarithmic, request.values.front(),
                request.values.back()) {
    for (const double value : request.values) coordinates_.push_back(family_.coordinate_of(value));
  }
  [[nodiscard]] CriticalLocus run();

 private:
  [[nodiscard]] TraceOutcome trace_at(std::size_t index);
  void search_at(std::size_t index);
  void search_empty_values();
  void follow(const CriticalEvent& event, std::size_t index);
  [[nodiscard]] bool is_known(std::size_t index, double load_factor) const;

  const CriticalLocusRequest& request_;
  ModelFamily family_;
  std::vector<double> coordinates_;
  CriticalLocus out_;
  std::shared_ptr<const FamilyMember> reference_;  ///< structure of the first traced path
  std::unique_ptr<TracedPath> traced_;             ///< path that was traced last
  LocusMetric metric_;
  LocusOptions options_;
  LocusCounts counts_;
};

/// Whether a followed curve has a critical point.
bool Search::is_known(std::size_t index, double load_factor) const {
  for (const LocusCurve& curve : out_.curves) {
    for (const LocusLoad& load : curve.loads)
      if (load.value == index &&
          std::abs(load.load_factor - load_factor) <= LocusSearch::same_load * std::abs(load_factor))
        return true;
  }
  return false;
}

void Search::follow(const CriticalEvent& event, std::size_t index) {
  LocusPoint point;
  point.bifurcation = event.type == CriticalType::bifurcation;
  point.y = event.point.y;
  point.lambda = event.point.lambda;
  point.null = event.null.col(0) / metric_.path.norm(event.null.col(0), 0.0);
  LocusWalk walk(family_, metric_, coordinates_, reference_->structure.scales.load, options_, counts_);
  if (auto curve = walk.run(std::move(point), index, request_.stop, out_.steps))
    out_.curves.push_back(*std::move(curve));
}

/// Traces the path of a value; the first one becomes the reference. Sets `failure` where there is no path.
TraceOutcome Search::trace_at(std::size_t index) {
  traced_ = std::make_unique<TracedPath>(request_.model(request_.values[index]), request_.analysis,
                                         request_.stop, reference_.get());
  TraceRules rules;
  rules.limit_points = LocusSearch::limit_points;
  TraceOutcome outcome = traced_->run(rules);
  out_.factorizations += traced_->factorizations();
  // a path that cannot be traced further has critical points up to there
  out_.failure = outcome.critical.empty() ? traced_->failure() : "";
  if (reference_ || !out_.failure.empty()) return outcome;
  reference_ = traced_->member();
  family_.set_reference(reference_);
  const PathNorm& norm = traced_->norm();
  metric_.path = {&reference_->structure.metric, norm.metric().load_weight};
  metric_.parameter_weight = 1.0 / (family_.span() * family_.span());
  options_.place = LocusSearch::place;
  options_.reach = LocusSearch::reach;
  options_.least_load = norm.least_load();
  options_.imperfection = LocateOptions().perfect;
  return outcome;
}

/// Follows the critical points of the path of a value that no curve has.
void Search::search_at(std::size_t index) {
  const TraceOutcome outcome = trace_at(index);
  if (!out_.failure.empty()) return;
  int number = 0;
  for (CriticalEvent event : outcome.critical) {
    if (event.type == CriticalType::broken_bifurcation) continue;
    const bool asked = !request_.number || *request_.number == number++;
    if (!asked || event.cause != CriticalCause::smooth || event.multiplicity != 1 ||
        event.point.context.holds || is_known(index, event.point.lambda / reference_->structure.scales.load))
      continue;
    if (event.null.size() == 0) event.null = mode_of(traced_->member()->problem, event);
    follow(event, index);
  }
}

/// Traces the paths of the values at which no curve has a point. A critical point that is met there becomes a
/// curve of its own that is not followed.
void Search::search_empty_values() {
  std::vector<char> has_point(request_.values.size(), 0);
  for (const LocusCurve& curve : out_.curves)
    for (const LocusLoad& load : curve.loads) has_point[load.value] = 1;
  for (std::size_t i = 0; i < has_point.size(); ++i) {
    if (has_point[i]) continue;
    const TraceOutcome outcome = trace_at(i);
    if (!out_.failure.empty()) return;
    const double scale = reference_->structure.scales.load;
    if (outcome.critical.empty()) {
      out_.none_up_to[i] = outcome.last.lambda / scale;
      continue;
    }
    const CriticalEvent& first = outcome.critical.front();
    LocusCurve& curve = out_.curves.emplace_back();
    curve.bifurcation = first.type == CriticalType::bifurcation;
    curve.events.push_back({LocusEventType::not_followed, request_.values[i], first.point.lambda / scale});
  }
}

CriticalLocus Search::run() {
  out_.none_up_to.resize(request_.values.size());
  const bool all = unless_cancelled([&] {
    search_at(0);
    if (!request_.number && out_.failure.empty()) search_at(request_.values.size() - 1);
    if (out_.failure.empty()) search_empty_values();
  });
  if (!all || request_.stop.stop_requested()) out_.failure = "cancelled";
  out_.factorizations += counts_.factorizations;
  return std::move(out_);
}

bool is_monotonic(const std::vector<double>& values) {
  const bool up = values.back() > values.front();
  return std::adjacent_find(values.begin(), values.end(),
                            [up](double a, double b) { return up ? !(a < b) : !(a > b); }) == values.end();
}

}  // namespace

CriticalLocus follow_critical_locus(const CriticalLocusRequest& request) {
  if (request.values.size() < 2 || !is_monotonic(request.values) ||
      !request.analysis.traits().ends_at_loss() || !request.analysis.discretization.fixed_mesh)
    throw std::invalid_argument(
        "critical points are followed on a fixed mesh, over rising or falling values");
  if (request.logarithmic && std::min(request.values.front(), request.values.back()) <= 0.0)
    throw std::invalid_argument("values must be positive where the logarithm is followed");
  return Search(request).run();
}

}  // namespace snapthrough
