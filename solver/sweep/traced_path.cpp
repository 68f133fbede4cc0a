#include "solver/sweep/traced_path.h"

#include <cstddef>
#include <utility>

#include "solver/analysis/analyses.h"
#include "solver/analysis/held_loads.h"
#include "solver/discrete/build_structure.h"
#include "solver/discrete/free_motions.h"
#include "solver/events/touching.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/law.h"

namespace snapthrough {

bool loads_are_held(const ResolvedModel& model) {
  return !has_one_sided_supports(model) || !start_refusal(model, UnilateralBalance(FreeMotions(model)));
}

bool are_held_alike(const ResolvedModel& a, const ResolvedModel& b) {
  if (a.springs.size() != b.springs.size() || a.foundations.size() != b.foundations.size()) return false;
  ResolvedModel other = b;
  other.sections = a.sections;
  const auto take_stiffness = [](const auto& from, auto& to) {
    for (std::size_t i = 0; i < from.size(); ++i)
      if (from[i].stiffness > 0.0 && to[i].stiffness > 0.0) to[i].stiffness = from[i].stiffness;
  };
  take_stiffness(a.springs, other.springs);
  take_stiffness(a.foundations, other.foundations);
  return a == other;
}

TracedPath::TracedPath(const Model& given, const Analysis& analysis, const std::stop_token& stop,
                       const FamilyMember* like)
    : steps_(analysis.step) {
  ResolvedModel model = resolve(given);
  const ModeOffsets modes = mode_offsets(model, analysis);
  Structure structure = like != nullptr ? with_changed_model(like->structure, model, modes)
                                        : make_structure(model, analysis.discretization, analysis.geometry,
                                                         modes, MeshUse::first);
  structure.free_motions = FreeMotions(model).of_nodes();
  structure.stop = stop;
  set(std::move(structure));
}

void TracedPath::set(Structure structure) {
  member_ = std::make_shared<FamilyMember>(std::move(structure));
  follower_ = std::make_unique<PathFollower>(member_->problem);
}

PathStart TracedPath::start(Result& result) {
  return start_of_path(member_->structure, member_->problem, follower_->solver(), 1.0, {}, result);
}

TraceOutcome TracedPath::run(const TraceRules& rules) {
  if (!loads_are_held(*member_->structure.model)) {
    failure_ = "not_held";
    return {};
  }
  Result result;
  auto first = start(result);
  auto touching = with_least_piece(member_->structure, member_->problem, follower_->norm(), first, result);
  if (touching) {
    touches_ = true;
    set(std::move(*touching));
    first = start(result);
  }
  if (!first) {
    failure_ = result.failure ? result.failure->code : "no_start";
    return {};
  }
  TraceOutcome outcome = trace(*follower_, first.point, rules, steps_, {}, {});
  if (outcome.end == TraceEnd::step_underflow) failure_ = "step_underflow";
  return outcome;
}

}  // namespace snapthrough
