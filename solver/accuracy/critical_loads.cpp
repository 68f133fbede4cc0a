#include "solver/accuracy/critical_loads.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/post/state.h"

namespace snapthrough {
namespace {

/// On the difference to the next finer mesh, for the error that the finer one still has: up to half of the
/// coarser one's where meshes are so coarse that errors change their sign from order to order.
constexpr double kSafety = 2.0;
/// Successive differences must fall at least by this, or another mesh is asked.
constexpr double kFall = 4.0;
/// Elements beyond which no mesh is refined.
constexpr std::size_t kMostElements = 4000;

/// The next finer mesh; empty when there is none.
std::optional<Mesh> finer(const Mesh& mesh, bool one_sided) {
  if (!one_sided && mesh.order < kMaxOrder) return with_order(mesh, mesh.order + 1);
  if (2 * mesh.elements.size() > kMostElements) return std::nullopt;
  return halved(mesh);
}

}  // namespace

TraceSink CriticalLoads::watch(TraceSink sink) {
  TraceSink out = sink;
  out.on_point = [this, inner = sink.on_point](const PathPoint& point) {
    inner(point);
    last_ = point;
  };
  out.on_critical = [this, inner = sink.on_critical](const CriticalEvent& event) {
    inner(event);
    targets_.push_back({event, last_, result_.critical_points.size() - 1});
  };
  return out;
}

const Structure& CriticalLoads::structure_of(int number) const {
  return number == 0 ? structure_ : levels_[number - 1]->structure();
}

/// The finer mesh of a number from 1 on, built when first asked for; null when there is none.
FineMesh* CriticalLoads::level(int number) {
  while (static_cast<int>(levels_.size()) < number) {
    const auto mesh = finer(structure_of(static_cast<int>(levels_.size())).mesh, structure_.one_sided);
    if (!mesh) return nullptr;
    const double tolerance = std::min(1e-7, 1e-3 * analysis_.discretization.accuracy);
    levels_.push_back(
        std::make_unique<FineMesh>(on_mesh(structure_, model_, *mesh), continuation_, tolerance));
  }
  return levels_[number - 1].get();
}

CriticalLoads::Answer CriticalLoads::answer_for(const Target& target) {
  constexpr int kMostLevels = 6;
  const bool fixed = analysis_.discretization.fixed_mesh;
  const double accuracy = analysis_.discretization.accuracy;
  Answer answer{target.event, 0, std::nullopt};
  CriticalEvent at = target.event;
  double last_difference = 0.0;
  for (int number = 1; number <= (fixed ? 1 : kMostLevels); ++number) {
    FineMesh* mesh = level(number);
    if (mesh == nullptr) break;
    const auto next = mesh->find(structure_of(number - 1), at, structure_, target.before);
    if (!next) break;
    const double size = std::abs(next->point.lambda);
    const double difference = size > 0.0 ? std::abs(at.point.lambda - next->point.lambda) / size : 1.0;
    const bool falls = number == 1 || difference <= last_difference / kFall;
    const double error = kSafety * (falls ? difference : std::max(difference, last_difference));
    answer = {at, number - 1, error};
    if (error <= accuracy) break;
    last_difference = difference;
    at = *next;
  }
  return answer;
}

void CriticalLoads::report(const Target& target, const Answer& answer) {
  CriticalPoint& point = result_.critical_points[target.index];
  point.error_estimate = answer.error;
  Summary& summary = result_.summary;
  const bool is_first = summary.critical_load_factor && !summary.error_estimate && point.branch == 0 &&
                        *summary.critical_load_factor == point.load_factor;
  if (answer.level > 0) {
    const Structure& structure = structure_of(answer.level);
    point.load_factor = answer.event.point.lambda / structure.scales.load;
    for (std::size_t i = 0; i < point.monitors.size(); ++i)
      point.monitors[i].value = structure.monitors[i].row.dot(answer.event.point.y);
    if (point.state) {
      State& state = result_.states[*point.state];
      const int branch = state.branch;
      state = make_state(structure, model_, answer.event.point.y, answer.event.point.lambda,
                         analysis_.output.points_per_member);
      state.branch = branch;
      state.load_factor = point.load_factor;
    }
  }
  if (is_first) {
    summary.critical_load_factor = point.load_factor;
    summary.error_estimate = answer.error;
  }
}

void CriticalLoads::report_meshes(int finest, double largest, int without) {
  MeshReport& report = result_.discretization;
  const Structure& structure = structure_of(finest);
  report.elements = static_cast<int>(structure.mesh.elements.size());
  report.order = structure.mesh.order;
  report.unknowns = structure.free_displacements;
  report.refinements = finest;
  std::string& message = result_.summary.message;
  if (without > 0)
    message += "; no error estimate for " + std::to_string(without) +
               " critical points, which were not found again on a finer mesh";
  if (analysis_.discretization.fixed_mesh || targets_.empty()) return;
  if (without == 0) report.estimated_accuracy = largest;
  if (largest > analysis_.discretization.accuracy)
    message += "; the accuracy asked for was not reached: estimated " + number(largest);
}

void CriticalLoads::estimate(const std::stop_token& stop) {
  int finest = 0;
  int without = 0;
  double largest = 0.0;
  for (const Target& target : targets_) {
    Answer answer{target.event, 0, std::nullopt};
    if (!stop.stop_requested()) answer = answer_for(target);
    report(target, answer);
    finest = std::max(finest, answer.level);
    largest = std::max(largest, answer.error.value_or(0.0));
    without += answer.error ? 0 : 1;
  }
  report_meshes(finest, largest, without);
  for (const auto& mesh : levels_) add_statistics(mesh->statistics(), result_);
}

}  // namespace snapthrough
