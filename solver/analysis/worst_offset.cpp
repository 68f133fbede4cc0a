#include "solver/analysis/worst_offset.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/numeric/number_text.h"
#include "solver/report/result_parts.h"
#include "solver/sensitivity/offset_space.h"
#include "solver/sensitivity/offset_works.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Extent of the search. Chosen: random offsets and offsets beside the result beat none
/// (docs/verification.md).
struct SearchLimits {
  static constexpr std::size_t starts = 2;  ///< starts that are improved
  static constexpr int improvements = 30;   ///< accepted improvements of a start at most
  static constexpr int halvings = 10;       ///< tries of one improvement, each half as far as the one before
  static constexpr int saddles = 4;         ///< saddles that are left at most
  static constexpr double settled = 1e-3;   ///< change of the shape that ends a search, over its norm
  /// Parts of other shapes that are added where the first-order law sees no lower load, over the norm.
  static constexpr double parts[] = {0.3, 0.1};
};

/// Offsets of norm one with the critical load factor of their structure.
struct Shape {
  VectorXd offsets;
  std::size_t motion = 0;                                 ///< the motion that the start came from
  double load = std::numeric_limits<double>::infinity();  ///< infinity: no stability is lost
  std::optional<OffsetWorks> works = {};                  ///< at the critical point; empty: not asked for
};

class Search {
 public:
  Search(const Model& model, const Analysis& analysis, const RunCritical& run, const std::stop_token& stop)
      : model_(model),
        resolved_(resolve(model)),
        norm_(worst_imperfection(model)->norm),
        amplitude_(worst_imperfection(model)->amplitude),
        run_(run),
        stop_(stop),
        analysis_(analysis),
        space_(lengths_of(resolved_)) {}

  [[nodiscard]] WorstSearch find();

 private:
  static std::vector<double> lengths_of(const ResolvedModel& model);
  Result follow(const VectorXd& offsets, std::optional<OffsetWorks>* works);
  void evaluate(Shape& shape, bool with_works);
  [[nodiscard]] std::vector<Shape> starts(const OffsetWorks& perfect) const;
  [[nodiscard]] VectorXd steepest_descent(const Shape& from) const;
  [[nodiscard]] bool improve(Shape& shape);
  void improve_until_settled(Shape& shape);
  [[nodiscard]] bool leave_saddle(Shape& shape);
  [[nodiscard]] Shape best_of(std::vector<Shape> shapes);
  [[nodiscard]] WorstOffset report(const Result& perfect, const OffsetWorks& at_perfect,
                                   const Shape& best) const;

  const Model& model_;
  const ResolvedModel resolved_;
  const OffsetNorm norm_;
  const double amplitude_;
  const RunCritical& run_;
  const std::stop_token& stop_;
  const Analysis& analysis_;
  std::optional<ModeOffsets> modes_;  ///< found at the first critical point
  const OffsetSpace space_;
  int paths_ = 0;
  int failed_ = 0;  ///< paths that failed
};

std::vector<double> Search::lengths_of(const ResolvedModel& model) {
  std::vector<double> out;
  for (const auto& axis : make_axes(model)) out.push_back(axis->length());
  return out;
}

/// Follows the path of the model with offsets of the wanted amplitude.
/// @param works receives the works at the critical point; null: they are not needed
Result Search::follow(const VectorXd& offsets, std::optional<OffsetWorks>* works) {
  const ResolvedModel with =
      resolve(with_offsets(model_, space_.member_offsets(resolved_, amplitude_ * offsets)));
  ++paths_;
  if (works == nullptr) return run_(with, {});
  std::optional<OffsetWorks> last;
  double load = 0.0;
  const auto visit = [&](const Structure& structure, const LocatedPoint& at, const CriticalPoint& point,
                         int& factorisations) {
    const bool loses_stability = point.negative_before == 0 && point.negative_after > 0;
    if (!loses_stability || point.type == CriticalType::broken_bifurcation) return;
    if (!modes_) modes_ = mode_offsets(with, analysis_, stop_);
    last = offset_works(structure, at, space_, *modes_, factorisations);
    load = point.load_factor;
  };
  Result result = run_(with, visit);
  if (last && result.summary.critical_load_factor == load) *works = std::move(last);
  return result;
}

void Search::evaluate(Shape& shape, bool with_works) {
  const Result result = follow(shape.offsets, with_works ? &shape.works : nullptr);
  if (result.failure) ++failed_;
  shape.load = result.summary.critical_load_factor.value_or(std::numeric_limits<double>::infinity());
}

std::vector<Shape> Search::starts(const OffsetWorks& perfect) const {
  std::vector<Shape> out;
  for (Index j = 0; j < perfect.works.cols(); ++j) {
    const bool linear = j == 0 && perfect.load_rate;
    const VectorXd along = space_.steepest(norm_, linear ? *perfect.load_rate : perfect.works.col(j));
    if (along.isZero(0.0)) continue;
    out.push_back({-along, static_cast<std::size_t>(j)});
    if (!linear) out.push_back({along, static_cast<std::size_t>(j)});
  }
  return out;
}

/// Offsets that lower the load most by the first-order law at the critical point of a shape. Where that law
/// does not hold there, the steepest offsets of the softest motion, with the sign nearer to the shape.
VectorXd Search::steepest_descent(const Shape& from) const {
  if (from.works->load_rate) return -space_.steepest(norm_, *from.works->load_rate);
  const VectorXd along = space_.steepest(norm_, from.works->works.col(0));
  return along.dot(from.offsets) < 0.0 ? VectorXd(-along) : along;
}

/// Replaces a shape by one with a lower load. @return false: none was found, or it hardly differs
bool Search::improve(Shape& shape) {
  if (!shape.works) return false;
  const VectorXd way = steepest_descent(shape) - shape.offsets;
  double part = 1.0;
  for (int n = 0; n < SearchLimits::halvings && !stop_.stop_requested(); ++n, part *= 0.5) {
    Shape next{shape.offsets + part * way, shape.motion};
    const double size = space_.norm(norm_, next.offsets);
    if (!(size > 0.0)) continue;
    next.offsets /= size;
    const double change = space_.norm(norm_, next.offsets - shape.offsets);
    if (change <= SearchLimits::settled) return false;
    evaluate(next, true);
    if (!(next.load < shape.load)) continue;
    shape = std::move(next);
    return true;
  }
  return false;
}

void Search::improve_until_settled(Shape& shape) {
  for (int n = 0; n < SearchLimits::improvements && improve(shape); ++n) {
  }
}

/// Adds parts of the steepest offsets of the other soft motions. A shape without them may be a saddle: one
/// half wave of a column that buckles into one or two at nearly the same load. @return whether the load is
/// lower
bool Search::leave_saddle(Shape& shape) {
  if (!shape.works) return false;
  const OffsetWorks works = *shape.works;
  const double before = shape.load;
  for (const double part : SearchLimits::parts) {
    for (Index j = 1; j < works.works.cols(); ++j) {
      for (const double sign : {1.0, -1.0}) {
        if (stop_.stop_requested()) return false;
        Shape next{shape.offsets + sign * part * space_.steepest(norm_, works.works.col(j)), shape.motion};
        next.offsets /= space_.norm(norm_, next.offsets);
        evaluate(next, true);
        if (next.load < shape.load) shape = std::move(next);
      }
    }
  }
  return shape.load < before;
}

/// Lowest shape after the lowest starts of different motions were improved.
Shape Search::best_of(std::vector<Shape> shapes) {
  for (Shape& shape : shapes)
    if (!stop_.stop_requested()) evaluate(shape, false);
  std::ranges::stable_sort(shapes, {}, &Shape::load);
  Shape best = shapes.front();
  std::vector<std::size_t> improved;
  for (Shape& shape : shapes) {
    if (improved.size() == SearchLimits::starts || stop_.stop_requested()) break;
    if (std::ranges::find(improved, shape.motion) != improved.end()) continue;
    improved.push_back(shape.motion);
    if (!(shape.load < std::numeric_limits<double>::infinity())) continue;
    evaluate(shape, true);
    improve_until_settled(shape);
    if (shape.load <= best.load) best = shape;
  }
  for (int n = 0; n < SearchLimits::saddles && leave_saddle(best); ++n) improve_until_settled(best);
  return best;
}

WorstOffset Search::report(const Result& perfect, const OffsetWorks& at_perfect, const Shape& best) const {
  WorstOffset out;
  out.perfect_load_factor = *perfect.summary.critical_load_factor;
  out.perfect_type = *perfect.summary.critical_type;
  if (at_perfect.load_rate) {
    const VectorXd first = space_.steepest(norm_, *at_perfect.load_rate);
    out.first_order_load_factor = out.perfect_load_factor - amplitude_ * at_perfect.load_rate->dot(first);
  }
  if (best.load < std::numeric_limits<double>::infinity()) out.load_factor = best.load;
  out.paths = paths_;
  out.imperfections = space_.member_offsets(resolved_, amplitude_ * best.offsets);
  return out;
}

WorstSearch Search::find() {
  std::optional<OffsetWorks> works;
  WorstSearch out;
  out.failed = follow(VectorXd::Zero(space_.size()), &works);
  if (out.failed.failure) return out;
  const std::vector<Shape> first = works ? starts(*works) : std::vector<Shape>();
  if (!first.empty()) {
    const Shape best = best_of(first);
    if (!stop_.stop_requested()) {
      out.found = report(out.failed, *works, best);
      out.failed_paths = failed_;
      return out;
    }
    fail(out.failed, "cancelled", "cancelled while the worst imperfection was sought");
  } else if (works) {
    fail(out.failed, "no_worst_imperfection", "no offset of a member acts on the critical point");
  } else {
    fail(out.failed, "no_worst_imperfection",
         "a worst imperfection lowers the first critical load, and the structure without it has none: " +
             out.failed.summary.message);
  }
  withdraw_critical_load(out.failed);
  return out;
}

}  // namespace

const WorstImperfection* worst_imperfection(const Model& model) {
  for (const Imperfection& imperfection : model.imperfections)
    if (const auto* worst = std::get_if<WorstImperfection>(&imperfection)) return worst;
  return nullptr;
}

Model with_offsets(const Model& model, const std::vector<MemberOffsets>& offsets, double scale) {
  Model out = model;
  std::erase_if(out.imperfections,
                [](const Imperfection& one) { return std::holds_alternative<WorstImperfection>(one); });
  for (const MemberOffsets& member : offsets) {
    PointsImperfection points{member.member, member.offsets};
    for (auto& [fraction, offset] : points.offsets) offset *= scale;
    out.imperfections.emplace_back(std::move(points));
  }
  return out;
}

Analysis search_analysis(const Analysis& analysis) {
  Analysis out;
  out.type = AnalysisType::critical;
  out.discretization = analysis.discretization;
  out.output.states = StateOutput::none;
  return out;
}

WorstSearch find_worst_offset(const Model& model, const Analysis& analysis, const RunCritical& run,
                              const std::stop_token& stop) {
  return Search(model, analysis, run, stop).find();
}

}  // namespace snapthrough
