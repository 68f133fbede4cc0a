#include "solver/accuracy/critical_loads.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "solver/accuracy/differences.h"
#include "solver/events/touching.h"
#include "solver/numeric/cancelled.h"
#include "solver/numeric/number_text.h"
#include "solver/report/critical_point.h"
#include "solver/report/result_parts.h"
#include "solver/report/state.h"
#include "solver/report/support_state.h"

namespace snapthrough {
namespace {

MeshAnswer said_by(const Structure& structure, const FoundPoint* found) {
  MeshAnswer answer{static_cast<int>(structure.mesh.elements.size()), structure.mesh.order, std::nullopt};
  if (found != nullptr) answer.load_factor = found->event.point.lambda / structure.scales.load;
  return answer;
}

}  // namespace

void CriticalLoads::on_critical(const CriticalEvent& event) {
  targets_.push_back({event, last_, result_.critical_points.size() - 1});
}

const Structure& CriticalLoads::structure_of(int number) const {
  return number == 0 ? structure_ : levels_[number - 1]->structure();
}

const PathNorm& CriticalLoads::norm_of(int number) const {
  return number == 0 ? follower_.norm() : levels_[number - 1]->norm();
}

/// The n-th finer mesh, n >= 1, built on first use; null when it does not exist.
FineMesh* CriticalLoads::level(int number) {
  while (static_cast<int>(levels_.size()) < number) {
    const Structure& coarse = structure_of(static_cast<int>(levels_.size()));
    const auto mesh = finer_mesh(coarse.mesh);
    if (!mesh) return nullptr;
    const Discretization& asked = analysis_.discretization;
    const double tolerance = asked.fixed_mesh ? 1e-9 : std::min(1e-7, 1e-3 * asked.accuracy);
    levels_.push_back(std::make_unique<FineMesh>(with_finer_piece(coarse, *mesh), follower_, tolerance));
  }
  return levels_[number - 1].get();
}

/// Error estimate from this point of the path on the coarser mesh; empty when that path has no such point.
std::optional<double> CriticalLoads::error_to_earlier(const Target& target) const {
  const CriticalPoint& point = result_.critical_points[target.index];
  std::optional<double> least;
  for (const CriticalPoint& other : earlier_) {
    const bool same = other.branch == point.branch && other.type == point.type &&
                      other.negative_before == point.negative_before &&
                      other.negative_after == point.negative_after;
    if (!same) continue;
    const double error = Differences().add(other.load_factor, point.load_factor);
    least = std::min(error, least.value_or(error));
  }
  return least;
}

CriticalLoads::Answer CriticalLoads::answer_for(const Target& target) {
  const bool fixed = analysis_.discretization.fixed_mesh;
  const double accuracy = analysis_.discretization.accuracy;
  Answer answer{{target.event, target.event.point}, 0, std::nullopt, {}};
  FoundPoint at = answer.found;
  Differences differences;
  std::vector<MeshAnswer> meshes{said_by(structure_, &at)};
  for (int number = 1; number <= (fixed ? 1 : Differences::most_levels); ++number) {
    FineMesh* mesh = level(number);
    if (mesh == nullptr) break;
    const auto next = mesh->find(structure_of(number - 1), at.event, structure_, target.before);
    meshes.push_back(said_by(mesh->structure(), next ? &*next : nullptr));
    if (!next) {
      answer.error.reset();  // agreement of earlier meshes was accidental
      break;
    }
    const double error = differences.add(at.event.point.lambda, next->event.point.lambda);
    answer = {at, number - 1, error, {}};
    if (differences.confirm(accuracy)) break;
    at = *next;
  }
  answer.meshes = std::move(meshes);
  if (const auto error = error_to_earlier(target); !fixed && error && *error < answer.error.value_or(1.0))
    answer.error = error;
  return answer;
}

void CriticalLoads::report(const Target& target, const Answer& answer) {
  CriticalPoint& point = result_.critical_points[target.index];
  point.error_estimate = answer.error;
  point.meshes = answer.meshes;
  const Discretization& asked = analysis_.discretization;
  point.confirmed = answer.error && (asked.fixed_mesh || *answer.error <= asked.accuracy);
  Summary& summary = result_.summary;
  const bool is_first = summary.critical_load_factor && !summary.error_estimate && point.branch == 0 &&
                        *summary.critical_load_factor == point.load_factor;
  if (answer.level > 0) {
    const Structure& structure = structure_of(answer.level);
    set_values(structure, answer.found.event, point);
    const PathPoint& at = answer.found.equilibrium;
    // else the state stays that of the path's mesh
    if (point.state && imbalance(structure, at.y, at.lambda) <= StateLimits::imbalance) {
      State& state = result_.states[*point.state];
      const int branch = state.branch;
      state = make_state(structure, at.y, at.lambda, analysis_.output);
      state.branch = branch;
      state.refinements = answer.level;
      if (point.mode)
        point.mode = mode_at(structure, levels_[answer.level - 1]->problem(), answer.found.event, analysis_);
    }
  }
  if (is_first) {
    summary.critical_load_factor = point.load_factor;
    summary.error_estimate = answer.error;
  }
}

void CriticalLoads::report_meshes(int finest, double largest, int without, std::string& text) {
  report_mesh(structure_of(finest), finest, result_);
  if (without > 0)
    text += "; no error estimate for " + std::to_string(without) +
            " critical points, which were not found again on a finer mesh";
  if (analysis_.discretization.fixed_mesh) return;
  if (targets_.empty()) return;
  if (without == 0) result_.discretization.estimated_accuracy = largest;
  if (largest > analysis_.discretization.accuracy)
    text += "; the accuracy asked for was not reached: estimated " + rounded(largest);
}

std::optional<double> CriticalLoads::finer_imperfection(const CriticalEvent& bifurcation) {
  FineMesh* finer = level(1);
  if (finer == nullptr) return bifurcation.imperfection;
  const auto found = finer->bifurcation(structure_, bifurcation);
  if (!found) return std::nullopt;
  return found->imperfection;
}

bool CriticalLoads::confirm_end(const PathPoint& end) {
  FineMesh* finer = level(1);
  return finer == nullptr || finer->has(structure_, end);
}

bool CriticalLoads::confirm(const std::stop_token& stop, std::string& text, const Complete& complete) {
  bool all = true;
  int finest = 0;
  int without = 0;
  double largest = 0.0;
  for (const Target& target : targets_) {
    if (stop.stop_requested()) return false;
    Answer answer;
    if (!unless_cancelled([&] { answer = answer_for(target); })) return false;
    report(target, answer);
    if (complete) {
      const auto add = [&] {
        complete(structure_of(answer.level), norm_of(answer.level), answer.found.event,
                 result_.critical_points[target.index]);
      };
      if (!unless_cancelled(add)) return false;
    }
    all = all && result_.critical_points[target.index].confirmed;
    finest = std::max(finest, answer.level);
    largest = std::max(largest, answer.error.value_or(0.0));
    without += answer.error ? 0 : 1;
  }
  report_meshes(finest, largest, without, text);
  for (const auto& mesh : levels_) add_statistics(mesh->statistics(), result_);
  return all;
}

}  // namespace snapthrough
