#include "solver/sweep/critical_curve.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <memory>
#include <stdexcept>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/analysis/held_loads.h"
#include "solver/discrete/free_motions.h"
#include "solver/events/touching.h"
#include "solver/numeric/cancelled.h"
#include "solver/numeric/number_text.h"
#include "solver/support/law.h"
#include "solver/trace/trace.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Numbers of the curve of a critical load over a parameter; ratios without unit. Source: docs/sweeps.md.
struct CurveLimits {
  /// Distance from the critical point to both equilibria beside it, over the path length.
  static constexpr double reach = 0.01;
  static constexpr double interpolation = 1e-8;  ///< relative error of an interpolated load
  static constexpr double same_load = 1e-6;      ///< relative difference up to which loads agree
  static constexpr int halvings = 7;             ///< most halvings of a step from one value to the next
  static constexpr std::size_t nodes = 4;        ///< values that are extrapolated from: the degree is three
};

/// Equilibrium state, or coefficient of a series of states.
struct Place {
  VectorXd y;
  double lambda = 0.0;
};

/// Critical point with the path around it, for prediction at other values.
struct Expansion {
  double t = 0.0;  ///< value of the parameter, or its logarithm
  double reach = 0.0;
  /// Power series of the path in the distance from the critical point along the path's direction.
  std::array<Place, 4> series;
  bool bifurcation = false;
  int negative_before = 0;
  int negative_after = 0;

  [[nodiscard]] Place at(double s) const {
    Place place = series[0];
    double power = s;
    for (std::size_t i = 1; i < series.size(); ++i, power *= s) {
      place.y += power * series[i].y;
      place.lambda += power * series[i].lambda;
    }
    return place;
  }
};

/// Model of one value on the common mesh.
struct Family {
  Family(const CriticalCurveRequest& request, double value)
      : model(request.model(value)),
        structure(make_structure(model, request.analysis.discretization, request.analysis.geometry,
                                 mode_offsets(model, request.analysis), MeshUse::first)),
        problem(structure),
        follower(problem) {
    const FreeMotions motions(model);
    structure.free_motions = motions.of_nodes();
    structure.stop = request.stop;
    is_held = !has_one_sided_supports(model) || !start_refusal(model, UnilateralBalance(motions));
  }
  Family(Model model_of_value, Structure known)
      : model(std::move(model_of_value)),
        structure(std::move(known)),
        problem(structure),
        follower(problem) {}

  [[nodiscard]] PathStart start(Result& result) {
    return start_of_path(model, structure, problem, follower.solver(), 1.0, {}, result);
  }

  Model model;
  Structure structure;
  StructuralProblem problem;
  PathFollower follower;
  bool is_held = true;  ///< one-sided supports hold the loads at the start of the path
};

/// A segment of the path as a cubic, in the length from its first point.
class Cubic {
 public:
  explicit Cubic(const Segment& segment)
      : a_(segment.from()),
        b_(segment.to()),
        length_(segment.length()),
        rate_a_(segment.cosine(a_)),
        rate_b_(segment.cosine(b_)) {}
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double load_rate_a() const { return a_.tangent_lambda / rate_a_; }
  [[nodiscard]] double load_rate_b() const { return b_.tangent_lambda / rate_b_; }

  /// Power series of the cubic about a position.
  [[nodiscard]] std::array<Place, 4> series(double s) const {
    const auto about = [&](const auto& a, const auto& b, const auto& ma, const auto& mb) {
      const auto c2 = ((3.0 / length_ * (b - a) - 2.0 * ma - mb) / length_).eval();
      const auto c3 = ((-2.0 / length_ * (b - a) + ma + mb) / (length_ * length_)).eval();
      return std::array<VectorXd, 4>{a + s * (ma + s * (c2 + s * c3)), ma + s * (2.0 * c2 + 3.0 * s * c3),
                                     c2 + 3.0 * s * c3, c3};
    };
    const auto number = [](double value) { return VectorXd::Constant(1, value).eval(); };
    const auto y = about(a_.y, b_.y, VectorXd(a_.tangent / rate_a_), VectorXd(b_.tangent / rate_b_));
    const auto lambda =
        about(number(a_.lambda), number(b_.lambda), number(load_rate_a()), number(load_rate_b()));
    std::array<Place, 4> out;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {y[i], lambda[i][0]};
    return out;
  }
  /// Position inside at which the load is stationary; negative: none.
  [[nodiscard]] double stationary() const {
    // derivative of the load: c0 + c1 x + c2 x^2
    const double r0 = load_rate_a();
    const double r1 = load_rate_b();
    const double mean = (b_.lambda - a_.lambda) / length_;
    const double c1 = 6.0 * mean - 4.0 * r0 - 2.0 * r1;
    const double c2 = 3.0 * (r0 + r1) - 6.0 * mean;
    const double root = c1 * c1 - 4.0 * c2 * r0;
    if (!(r0 * r1 < 0.0) || !(root >= 0.0)) return -1.0;
    const double q = -0.5 * (c1 + (c1 < 0.0 ? -1.0 : 1.0) * std::sqrt(root));
    for (const double x : {r0 / q, q / c2})
      if (x > 0.0 && x < 1.0) return x * length_;
    return -1.0;
  }

 private:
  const PathPoint& a_;
  const PathPoint& b_;
  double length_ = 0.0;
  double rate_a_ = 1.0;
  double rate_b_ = 1.0;
};

class Follower {
 public:
  explicit Follower(const CriticalCurveRequest& request) : request_(request) {}
  [[nodiscard]] CriticalCurve run();

 private:
  [[nodiscard]] double place_of(double value) const { return request_.logarithmic ? std::log(value) : value; }
  [[nodiscard]] double value_at(double t) const { return request_.logarithmic ? std::exp(t) : t; }
  [[nodiscard]] CriticalCurvePoint trace_at(double value);
  [[nodiscard]] bool follow_to(double value, int halvings);
  [[nodiscard]] Expansion predicted(double t) const;
  void add_value(std::size_t i, std::size_t& checked);
  void check_from(std::size_t first, std::size_t last);
  void remember(std::optional<Expansion> node);

  const CriticalCurveRequest& request_;
  CriticalCurve curve_;
  std::unique_ptr<Family> measure_;  ///< reference for norm and scales of all values
  std::deque<Expansion> nodes_;      ///< stored critical points, latest last
};

void Follower::remember(std::optional<Expansion> node) {
  if (!node) return;
  nodes_.push_back(*std::move(node));
  if (nodes_.size() > CurveLimits::nodes) nodes_.pop_front();
}

/// Normalised direction of the path at the critical point; at a limit point without the load.
Place direction_of(const Expansion& node, const PathNorm& path_norm) {
  const Place& first = node.series[1];
  const double load = node.bifurcation ? first.lambda : 0.0;
  const double norm = path_norm.metric().norm(first.y, load);
  return {first.y / norm, load / norm};
}

/// The equilibrium in the plane normal to a direction at a distance from the guessed critical point.
std::optional<PathPoint> equilibrium(PointSolver& solver, const Expansion& guess, const Place& direction,
                                     double distance) {
  const Place place = guess.at(distance);
  PathPoint lo;
  lo.y = place.y - guess.reach * direction.y;
  lo.lambda = place.lambda - guess.reach * direction.lambda;
  lo.tangent = direction.y;
  lo.tangent_lambda = direction.lambda;
  PathPoint hi = lo;
  hi.y = place.y + guess.reach * direction.y;
  hi.lambda = place.lambda + guess.reach * direction.lambda;
  return Segment(solver, lo, hi, direction.y, direction.lambda).point_at(0.5);
}

/// Position of a critical point after the first of two equilibria, and the load difference to the
/// interpolation of next lower order.
struct Found {
  double distance = -1.0;  ///< position of the critical point; negative: none
  double change = 0.0;
};

Found limit_point(const Cubic& path, const PathPoint& before) {
  const double s = path.stationary();
  if (s < 0.0) return {};
  const double load = path.series(s)[0].lambda;
  // Linear interpolation of the rates differs by the next order; this difference, times the distance over the
  // path length, bounds the error of the cubic.
  const double linear = path.length() * path.load_rate_a() / (path.load_rate_a() - path.load_rate_b());
  return {s, std::abs(before.lambda + 0.5 * path.load_rate_a() * linear - load)};
}

/// Zero of the determinant on the parabola through three points, with the difference to the line through two.
Found bifurcation(const Segment& segment, const Cubic& path, const PathPoint& middle) {
  const PathPoint& before = segment.from();
  const PathPoint& after = segment.to();
  const auto det = [&middle](const PathPoint& at) { return at.determinant(middle.log_abs_det); };
  const double x1 = segment.length_to(middle);
  const double x2 = path.length();
  const double d0 = det(before);
  const double slope = (det(after) - d0) / x2;
  const double bend = ((det(middle) - d0) / x1 - slope) / (x1 - x2);
  const double line = -d0 / slope;
  const double rate = slope - bend * x2;  // coefficient in d0 + rate s + bend s^2 at the first point
  const double s = -2.0 * d0 / (rate + std::copysign(std::sqrt(rate * rate - 4.0 * bend * d0), rate));
  if (!(line > 0.0 && line < x2 && s > 0.0 && s < x2)) return {};
  return {s, CurveLimits::reach * std::abs(path.series(s)[0].lambda - path.series(line)[0].lambda)};
}

/// Corrects a predicted critical point; empty when it is uncertain.
std::optional<Expansion> corrected(PointSolver& solver, const Expansion& guess, int attempts = 3) {
  const Place direction = direction_of(guess, solver.norm());
  const auto before = equilibrium(solver, guess, direction, -guess.reach);
  if (!before || before->negative != guess.negative_before) return std::nullopt;
  const auto after = equilibrium(solver, guess, direction, guess.reach);
  if (!after || after->negative != guess.negative_after) return std::nullopt;
  const Segment segment(solver, *before, *after, direction.y, direction.lambda);
  const Cubic path(segment);
  if (!(path.length() > 0.0)) return std::nullopt;
  Found found;
  if (guess.bifurcation) {
    const auto middle = equilibrium(solver, guess, direction, 0.0);
    if (middle) found = bifurcation(segment, path, *middle);
  } else {
    found = limit_point(path, *before);
  }
  if (found.distance < 0.0) return std::nullopt;
  Expansion node = guess;
  node.series = path.series(found.distance);
  // Adapts the distance of the equilibria so that the error stays well below the tolerance.
  const double wanted =
      0.1 * CurveLimits::interpolation * std::abs(node.series[0].lambda) / CurveLimits::reach;
  node.reach = guess.reach * std::clamp(std::cbrt(wanted / std::max(found.change, 1e-3 * wanted)), 0.3, 1.2);
  if (found.change <= 10.0 * wanted) return node;
  return attempts > 1 ? corrected(solver, node, attempts - 1) : std::nullopt;
}

/// Predicts the critical point by Lagrange extrapolation from the stored nodes.
Expansion Follower::predicted(double t) const {
  Expansion guess = nodes_.back();
  guess.t = t;
  for (Place& place : guess.series) {
    place.y.setZero();
    place.lambda = 0.0;
  }
  for (const Expansion& node : nodes_) {
    double weight = 1.0;
    for (const Expansion& other : nodes_)
      if (&other != &node) weight *= (t - other.t) / (node.t - other.t);
    for (std::size_t i = 0; i < guess.series.size(); ++i) {
      guess.series[i].y += weight * node.series[i].y;
      guess.series[i].lambda += weight * node.series[i].lambda;
    }
  }
  return guess;
}

/// Predicts and corrects the critical point of a value, and stores it as the latest node; false on failure.
bool Follower::follow_to(double value, int halvings) {
  if (nodes_.empty()) return false;
  const double t = place_of(value);
  Family member(request_, value);
  if (!member.is_held) return false;
  const Scales& scales = measure_->structure.scales;
  if (member.structure.size != measure_->structure.size || member.structure.scales.load != scales.load ||
      member.structure.scales.force != scales.force || member.structure.scales.length != scales.length)
    return false;
  member.follower.norm().adopt(measure_->follower.norm());
  std::optional<Expansion> node = corrected(member.follower.solver(), predicted(t));
  curve_.factorizations += member.follower.statistics().factorizations;
  if (node) {
    remember(std::move(node));
    return true;
  }
  if (halvings == CurveLimits::halvings) return false;
  const double middle = value_at(0.5 * (nodes_.back().t + t));
  if (!follow_to(middle, halvings + 1)) return false;
  ++curve_.inserted;
  return follow_to(value, halvings + 1);
}

/// Traces the path of a value; its critical point becomes the only node if it can be followed.
CriticalCurvePoint Follower::trace_at(double value) {
  ++curve_.traced;
  nodes_.clear();
  CriticalCurvePoint point{value, std::nullopt, CriticalType::limit_max, false, ""};
  auto member = std::make_unique<Family>(request_, value);
  if (!member->is_held) {
    point.failure = "not_held";
    return point;
  }
  Result result;
  auto start = member->start(result);
  auto touching = with_least_piece(member->model, member->structure, member->problem, member->follower.norm(),
                                   start, result);
  if (touching) {
    member = std::make_unique<Family>(Model(member->model), std::move(*touching));
    start = member->start(result);
  }
  if (!start) {
    point.failure = result.failure ? result.failure->code : "no_start";
    return point;
  }
  TraceRules rules;
  rules.first_loss_of_stability = true;
  const TraceOutcome outcome = trace(member->follower, start.point, rules, request_.analysis.step, {}, {});
  if (outcome.end == TraceEnd::step_underflow) point.failure = "step_underflow";
  if (outcome.end == TraceEnd::critical_point) {
    const CriticalEvent& event = outcome.critical.back();
    point.load_factor = event.point.lambda / member->structure.scales.load;
    point.type = event.type;
    // paths with pinned free motions or touching supports have no comparable neighbours
    if (!touching && event.cause == CriticalCause::smooth && event.multiplicity == 1 && !event.point.holds) {
      Expansion guess;
      guess.t = place_of(value);
      guess.reach = CurveLimits::reach * member->follower.norm().search_scale(event.point);
      const VectorXd zero = VectorXd::Zero(event.point.y.size());
      guess.bifurcation = event.type == CriticalType::bifurcation;
      guess.series = {Place{event.point.y, event.point.lambda},
                      {event.point.tangent, event.point.tangent_lambda},
                      {zero, 0.0},
                      {zero, 0.0}};
      guess.series[1] = direction_of(guess, member->follower.norm());
      guess.negative_before = event.negative_before;
      guess.negative_after = event.negative_after;
      remember(corrected(member->follower.solver(), guess));
    }
  }
  curve_.factorizations += member->follower.statistics().factorizations;
  measure_ = std::move(member);
  return point;
}

/// Checks a followed point by its traced path; if that has another critical point, all values since `first`
/// are traced.
void Follower::check_from(std::size_t first, std::size_t last) {
  const std::deque<Expansion> nodes = nodes_;
  std::unique_ptr<Family> measure = std::move(measure_);
  const CriticalCurvePoint traced = trace_at(request_.values[last]);
  CriticalCurvePoint& followed = curve_.points[last];
  const bool same = traced.load_factor && traced.type == followed.type &&
                    std::abs(*traced.load_factor - *followed.load_factor) <=
                        CurveLimits::same_load * std::abs(*traced.load_factor);
  if (same) {
    measure_ = std::move(measure);
    nodes_ = nodes;
    return;
  }
  ++curve_.disagreed;
  for (std::size_t i = first; i < last; ++i)
    if (curve_.points[i].followed) curve_.points[i] = trace_at(request_.values[i]);
  followed = trace_at(request_.values[last]);
}

/// Adds the next value; values before `checked` are verified.
void Follower::add_value(std::size_t i, std::size_t& checked) {
  const double value = request_.values[i];
  if (!follow_to(value, 0)) {
    if (i > checked && curve_.points.back().followed) check_from(checked, i - 1);
    curve_.points.push_back(trace_at(value));
    checked = i + 1;
    return;
  }
  const CriticalCurvePoint& last = curve_.points.back();
  const double load = nodes_.back().series[0].lambda / measure_->structure.scales.load;
  curve_.points.push_back({value, load, last.type, true, ""});
  if (i + 1 == request_.values.size() || i - checked + 1 >= static_cast<std::size_t>(request_.check_every)) {
    check_from(checked, i);
    checked = i + 1;
  }
}

CriticalCurve Follower::run() {
  std::size_t checked = 0;
  const bool all = unless_cancelled([&] {
    for (std::size_t i = 0; i < request_.values.size(); ++i) {
      if (request_.stop.stop_requested()) throw Cancelled{};
      add_value(i, checked);
    }
  });
  if (!all) curve_.points.resize(checked);  // values followed since the last check are unverified
  for (std::size_t i = curve_.points.size(); i < request_.values.size(); ++i)
    curve_.points.push_back({request_.values[i], std::nullopt, CriticalType::limit_max, false, "cancelled"});
  curve_.followed = static_cast<int>(std::count_if(curve_.points.begin(), curve_.points.end(),
                                                   [](const auto& point) { return point.followed; }));
  return std::move(curve_);
}

}  // namespace

CriticalCurve follow_critical_point(const CriticalCurveRequest& request) {
  if (request.values.empty() || request.check_every < 1 || request.analysis.type != AnalysisType::critical ||
      !request.analysis.discretization.fixed_mesh)
    throw std::invalid_argument("a critical point is followed on a fixed mesh, over at least one value");
  if (request.logarithmic && *std::min_element(request.values.begin(), request.values.end()) <= 0.0)
    throw std::invalid_argument("values must be positive where the logarithm is followed");
  return Follower(request).run();
}

}  // namespace snapthrough
