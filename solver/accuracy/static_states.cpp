#include "solver/accuracy/static_states.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "solver/accuracy/layers.h"
#include "solver/accuracy/state_values.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/transfer.h"
#include "solver/newton/corrector.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/rounding.h"
#include "solver/path/point_solver.h"
#include "solver/problem/structural_problem.h"
#include "solver/report/result_parts.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;

/// Numbers of the refinement of states; ratios where no unit is given. Chosen: docs/theory.md, Accuracy of
/// states.
struct StateRefinement {
  static constexpr int most_meshes = 24;  ///< meshes after the first one: a kink in 1e-6 of an element
  /// Share of the largest local difference above which an element is halved.
  static constexpr double marked = 0.05;
  /// Decrease of smooth local differences by one halving of elements of order 4.
  static constexpr double gain = 32.0;
  static constexpr int most_halvings = 3;  ///< Most halvings of an element at once.
  /// Residual after a correction, over that before it, at which the correction is the difference of two
  /// states: the rest changes the estimate by this share.
  static constexpr double contraction = 0.02;
  static constexpr int corrections = 4;  ///< most corrections of a state that is compared only
  /// Rise of the stiffness of a rigid foundation by halving its elements.
  static constexpr double hardening = 16.0;
};

/// A mesh with its equations.
class MeshStates {
 public:
  explicit MeshStates(std::shared_ptr<const Structure> structure)
      : structure_(std::move(structure)), problem_(*structure_), metric_{&structure_->metric, 0.0} {}

  [[nodiscard]] const Structure& structure() const { return *structure_; }
  [[nodiscard]] const std::shared_ptr<const Structure>& shared() const { return structure_; }
  [[nodiscard]] int factorizations() const { return factorizations_; }

  /// The state at the unknowns of another mesh, not in equilibrium.
  [[nodiscard]] StaticState transferred(const Structure& from, const StaticState& state) const {
    StaticState out = state;
    out.y = transfer(from, state.y, *structure_);
    return out;
  }
  [[nodiscard]] bool approach(StaticState& state);
  [[nodiscard]] bool settle(StaticState& state);

 private:
  [[nodiscard]] bool settle_with(double softness, StaticState& state);

  std::shared_ptr<const Structure> structure_;
  StructuralProblem problem_;
  PathMetric metric_;
  Workspace work_;
  int factorizations_ = 0;
};

/// Corrects a state until its distance from the start is known; false when the residual does not fall so far,
/// or the number of negative eigenvalues differs.
bool MeshStates::approach(StaticState& state) {
  problem_.set_context(state.context);
  VectorXd y = state.y;
  double first = -1.0;
  for (int i = 0; i < StateRefinement::corrections; ++i) {
    const TangentReport tangent = problem_.linearise(y, state.lambda, work_.residual);
    ++factorizations_;
    if (first < 0.0) first = problem_.relative_residual(work_.residual, y, state.lambda);
    VectorXd correction = -work_.residual;
    problem_.solve(correction);
    y += correction;
    if (!y.allFinite()) return false;
    problem_.residual(y, state.lambda, work_.residual);
    const double left = problem_.relative_residual(work_.residual, y, state.lambda);
    const double rounding = std::max(Rounding::largest_residual, problem_.residual_rounding(y, state.lambda));
    if (left > std::max(StateRefinement::contraction * first, rounding)) continue;
    state.y = std::move(y);
    return count_next_to(state.negative, tangent) == state.negative;
  }
  return false;
}

/// Corrects a state to rounding; false when Newton's method does not converge to one with the same number of
/// negative eigenvalues. A state on a coarser mesh has softer rigid foundations: where Newton's method fails
/// it starts with softer one-sided supports.
bool MeshStates::settle(StaticState& state) {
  if (settle_with(1.0, state)) return true;
  if (!structure_->traits.one_sided) return false;
  StaticState at = state;
  double softness = 1.0;
  for (int i = 0; i < StateRefinement::most_halvings; ++i) softness /= StateRefinement::hardening;
  for (; softness <= 1.0; softness *= StateRefinement::hardening)
    if (!settle_with(softness, at)) return false;
  state = std::move(at);
  return true;
}

/// settle() with a factor on the stiffness of one-sided supports.
bool MeshStates::settle_with(double softness, StaticState& state) {
  problem_.set_context(state.context);
  VectorXd y = state.y;
  double lambda = state.lambda;
  const double size = metric_.norm(y, 0.0);
  CorrectorOptions options;
  options.regime.softness = softness;
  const CorrectorOutcome outcome = correct(problem_, metric_, {}, size, options, y, lambda, work_);
  factorizations_ += outcome.factorisations;
  if (outcome.status != CorrectorStatus::converged) return false;
  if (count_next_to(state.negative, outcome.tangent) != state.negative) return false;
  state.y = std::move(y);
  return true;
}

/// Halves elements of a mesh. @param halvings how often, one entry per element
Mesh with_halved(const Mesh& mesh, const std::vector<int>& halvings) {
  Mesh out = mesh;
  out.elements.clear();
  for (std::size_t m = 0; m + 1 < mesh.first.size(); ++m) {
    out.first[m] = static_cast<int>(out.elements.size());
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      const MeshElement& cell = mesh.elements[static_cast<std::size_t>(e)];
      const int parts = 1 << halvings[static_cast<std::size_t>(e)];
      const double width = (cell.to - cell.from) / parts;
      for (int k = 0; k < parts; ++k)
        out.elements.push_back({cell.member, k == 0 ? cell.from : out.elements.back().to,
                                k + 1 == parts ? cell.to : cell.from + (k + 1) * width});
    }
  }
  out.first.back() = static_cast<int>(out.elements.size());
  return out;
}

/// How often each element is halved for local differences that exceed the accuracy.
std::vector<int> halvings_for(const std::vector<double>& differences, double accuracy) {
  const double largest = *std::max_element(differences.begin(), differences.end());
  std::vector<int> out(differences.size(), 0);
  for (std::size_t e = 0; e < out.size(); ++e) {
    if (!(differences[e] >= StateRefinement::marked * largest)) continue;
    const double times = std::log(differences[e] / accuracy) / std::log(StateRefinement::gain);
    out[e] = std::clamp(static_cast<int>(std::ceil(times)), 1, StateRefinement::most_halvings);
  }
  return out;
}

/// Halves the longest elements of members on rigid foundations, whose stiffness follows from them.
void halve_on_rigid(const ResolvedModel& model, const Mesh& mesh, std::vector<int>& halvings) {
  for (const ResolvedFoundation& foundation : model.foundations) {
    if (std::isfinite(initial_stiffness(foundation))) continue;
    const auto m = static_cast<std::size_t>(foundation.member);
    const auto width = [&mesh](int e) {
      const MeshElement& cell = mesh.elements[static_cast<std::size_t>(e)];
      return cell.to - cell.from;
    };
    double longest = 0.0;
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) longest = std::max(longest, width(e));
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e)
      if (width(e) > 0.5 * longest) halvings[e] = std::max(halvings[e], 1);
  }
}

/// Compares states on a mesh and its halved one, and refines both.
class Refinement {
 public:
  Refinement(const Discretization& asked, const Structure& structure, const std::vector<StaticState>& states,
             const FindStates& find)
      : model_(*structure.model),
        accuracy_(asked.accuracy),
        find_(find),
        first_(structure),
        of_first_(states) {
    level_ = std::make_unique<MeshStates>(
        std::shared_ptr<const Structure>(std::shared_ptr<const Structure>(), &structure));
    out_.states = states;
  }

  [[nodiscard]] RefinedStates run();

 private:
  [[nodiscard]] bool compare();
  [[nodiscard]] bool refine();
  [[nodiscard]] bool take_all();
  [[nodiscard]] bool find_on(const MeshStates& mesh, StaticState& state);
  [[nodiscard]] std::unique_ptr<MeshStates> on(Mesh mesh) const {
    return std::make_unique<MeshStates>(std::make_shared<const Structure>(on_mesh(first_, std::move(mesh))));
  }

  const ResolvedModel& model_;
  double accuracy_;
  const FindStates& find_;
  const Structure& first_;
  const std::vector<StaticState>& of_first_;
  std::unique_ptr<MeshStates> level_;  ///< mesh of RefinedStates::states
  std::unique_ptr<MeshStates> fine_;   ///< its halved mesh
  StaticState worst_;                  ///< the state with the largest difference, on the halved mesh
  int factorizations_ = 0;             ///< on meshes that are no longer there
  RefinedStates out_;
};

/// Finds a state anew where Newton's method did not lead to it.
bool Refinement::find_on(const MeshStates& mesh, StaticState& state) {
  std::vector<StaticState> found = find_(mesh.structure(), {state});
  if (found.empty()) {
    out_.missing = state.lambda / first_.scales.load;
    return false;
  }
  state = std::move(found.front());
  return true;
}

/// Finds the error of the present states; false when no finer mesh has all of them.
bool Refinement::compare() {
  out_.error.reset();
  auto mesh = finer_mesh(level_->structure().mesh);
  if (!mesh) return false;
  if (fine_) factorizations_ += fine_->factorizations();
  fine_ = on(*std::move(mesh));
  double largest = -1.0;
  for (const StaticState& state : out_.states) {
    StaticState next = fine_->transferred(level_->structure(), state);
    if (!fine_->approach(next) && !fine_->settle(next) && !find_on(*fine_, next)) return false;
    const double difference =
        relative_error(values_of(level_->structure(), state.y, state.lambda, false),
                       values_of(fine_->structure(), next.y, next.lambda, true), accuracy_);
    if (!(difference > largest)) continue;
    largest = difference;
    worst_ = std::move(next);
  }
  out_.error = largest;
  return true;
}

/// Goes to a mesh with halved elements where the worst state needs them, with that state alone; false when
/// there is no such mesh, or it does not have the state.
bool Refinement::refine() {
  const Structure& coarse = level_->structure();
  std::vector<int> halvings =
      halvings_for(local_differences(coarse, fine_->structure(), worst_.y), accuracy_);
  halve_on_rigid(model_, coarse.mesh, halvings);
  Mesh mesh = with_halved(coarse.mesh, halvings);
  if (out_.refinements == 0)
    mesh = layered_mesh(mesh, model_, first_.axes, bending_decays(fine_->structure(), worst_.y));
  if (!finer_mesh(mesh)) return false;
  auto next = on(std::move(mesh));
  StaticState state = next->transferred(fine_->structure(), worst_);
  if (!next->settle(state) && !find_on(*next, state)) return false;
  factorizations_ += level_->factorizations();
  level_ = std::move(next);
  out_.states = {std::move(state)};
  ++out_.refinements;
  return true;
}

/// Takes the states of all rows to the present mesh; false when it does not have all of them.
bool Refinement::take_all() {
  std::vector<StaticState> all;
  for (const StaticState& state : of_first_) {
    if (state.row == out_.states.front().row) {
      all.push_back(out_.states.front());
      continue;
    }
    StaticState moved = level_->transferred(first_, state);
    if (!level_->settle(moved) && !find_on(*level_, moved)) return false;
    all.push_back(std::move(moved));
  }
  out_.states = std::move(all);
  return true;
}

RefinedStates Refinement::run() {
  const std::size_t rows = of_first_.size();
  bool goes_on = compare();
  while (goes_on && (*out_.error > accuracy_ || out_.states.size() < rows)) {
    const bool within = *out_.error <= accuracy_;
    if (!within && out_.refinements == StateRefinement::most_meshes) break;
    goes_on = (within ? take_all() : refine()) && compare();
  }
  if (out_.states.size() < rows && !take_all()) {
    // the first mesh has all states
    level_ = std::make_unique<MeshStates>(
        std::shared_ptr<const Structure>(std::shared_ptr<const Structure>(), &first_));
    out_.states = of_first_;
    out_.refinements = 0;
  }
  out_.factorizations = factorizations_ + level_->factorizations() + (fine_ ? fine_->factorizations() : 0);
  out_.structure = level_->shared();
  return std::move(out_);
}

}  // namespace

std::vector<StaticState> no_other_states(const Structure& /*structure*/,
                                         const std::vector<StaticState>& /*states*/) {
  return {};
}

void report_accuracy(const RefinedStates& refined, const Discretization& asked, Result& result) {
  report_mesh(*refined.structure, refined.refinements, result);
  result.diagnostics.factorizations += refined.factorizations;
  result.discretization.estimated_accuracy = refined.error;
  result.summary.error_estimate = refined.error;
  if (!refined.error && !refined.missing) {
    result.summary.message +=
        "; its error was not estimated, because a finer mesh would have too many elements";
    return;
  }
  if (refined.error && *refined.error <= asked.accuracy) return;
  const std::string reached = result.summary.message;
  const std::string why =
      refined.error ? "the accuracy asked for was not reached: estimated " + rounded(*refined.error)
                    : "a finer mesh has no equilibrium with as many negative eigenvalues at load factor " +
                          number(*refined.missing);
  if (result.failure) {
    result.summary.message += "; " + why;
    return;
  }
  fail(result, "not_confirmed", why + " (" + reached + ")");
}

RefinedStates refine_states(const Discretization& asked, const Structure& structure,
                            const std::vector<StaticState>& states, const FindStates& find) {
  return Refinement(asked, structure, states, find).run();
}

}  // namespace snapthrough
