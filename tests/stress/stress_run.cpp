#include "tests/stress/stress_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <variant>

#include "solver/discrete/mechanism.h"
#include "solver/resolve/resolved_model.h"
#include "solver/solve.h"
#include "tests/index_of.h"
#include "tests/stress/broad_model.h"
#include "tests/stress/laws_model.h"
#include "tests/stress/media_model.h"
#include "tests/stress/members_model.h"
#include "tests/stress/random_model.h"
#include "tests/stress/soil_model.h"

namespace snapthrough::testing {
namespace {

/// Processor time of this process so far, in seconds: other work on the machine does not count.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Asks for a stop when the processor time is over, unless it is destroyed before.
class Bound {
 public:
  explicit Bound(double seconds)
      : thread_([this, end = processor_time() + seconds](const std::stop_token& over) {
          std::unique_lock lock(mutex_);
          while (!over.stop_requested() && processor_time() < end) {
            const double rest = std::max(0.01, end - processor_time());
            ended_.wait_for(lock, over, std::chrono::duration<double>(rest), [] { return false; });
          }
          if (!over.stop_requested()) source_.request_stop();
        }) {}
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread thread_;
};

/// The rules that an analysis may end by: those asked for, and the bounds beyond which nothing is of
/// interest, which always hold (a path to infinity meets no other; a search for a loss of stability that gets
/// there has its answer).
bool reached(const Analysis& analysis, const std::string& termination) {
  // a structure that can't carry its constant actions, or has a part that nothing holds, has no path to
  // follow: that is the answer
  constexpr std::array<std::string_view, 5> kBounds{"load_bound", "displacement_bound",
                                                    "constant_actions_limit", "loose_part", "not_held"};
  constexpr std::array<std::string_view, 5> kPath{"limit_points", "load_factor", "monitor", "monitor_turned",
                                                  "steps"};
  constexpr std::array<std::string_view, 2> kCritical{"critical_point", "unstable_at_start"};
  if (std::ranges::count(kBounds, termination) > 0) return true;
  if (analysis.type == AnalysisType::critical) return std::ranges::count(kCritical, termination) > 0;
  return std::ranges::count(kPath, termination) > 0;
}

/// Whether the structure is a mechanism without its one-sided supports, as it must be for a part to be loose.
bool needs_one_sided_supports(RandomRequest request) {
  std::erase_if(request.model.springs, [](const Spring& s) { return s.reaction != Reaction::bilateral; });
  std::erase_if(request.model.foundations,
                [](const Foundation& f) { return f.reaction != Reaction::bilateral; });
  std::erase_if(request.model.members, is_rod);
  return can_move(resolve(request.model));
}

/// Curves, joints and sections of the members.
std::string features_of_members(const Model& m) {
  std::string text;
  constexpr std::array kCurves{"line", "arc", "parabola", "sine", "points"};
  for (const Member& member : m.members) {
    if (is_rod(member)) {
      text += member.cable ? " cable" : " rod";
      if (member.pretension) text += "(pretension)";
      continue;
    }
    text += std::string(" ") + kCurves.at(member.curve.index());
    if (member.release_start_rotation || member.release_end_rotation) text += "(released)";
    if (member.release_start_stiffness > 0.0 || member.release_end_stiffness > 0.0) text += "(joint)";
    if (member.release_start_law || member.release_end_law) text += "(joint with a law)";
    if (member.pretension) text += "(pretension)";
    const Section& section = m.sections[static_cast<std::size_t>(index_of(m.sections, member.section))];
    if (std::isinf(section.EA.constant)) text += "(rigid EA)";
    if (std::isinf(section.EI.constant)) text += "(rigid EI)";
    if (section.strength) text += "(strength)";
    if (section.bending) {
      const bool is_table = section.bending->type == BendingLaw::Type::table;
      text += is_table ? "(bending table)" : "(bending power)";
    }
  }
  return text;
}

/// What a reader of a failure wants to know first.
std::string features_of(const RandomRequest& request) {
  const Model& m = request.model;
  const Discretization& d = request.analysis.discretization;
  std::string text = request.analysis.type == AnalysisType::critical ? "critical" : "path";
  text += d.fixed_mesh ? " order " + std::to_string(d.order) + " x " + std::to_string(d.elements)
                       : " default mesh";
  if (d.foundation == FoundationRule::lumped) text += " lumped";
  text += "; members" + features_of_members(m);
  constexpr std::array kReactions{"bilateral", "compression", "tension"};
  const auto law_of = [](const std::optional<ReactionLaw>& law) {
    constexpr std::array kLaws{" along", " tanh", " hyperbolic", " power", " table"};
    return std::string(law ? kLaws.at(static_cast<std::size_t>(law->type)) : "");
  };
  for (const Foundation& f : m.foundations) {
    text += std::string("; base ") + kReactions.at(static_cast<std::size_t>(f.reaction)) + law_of(f.law);
    if (f.component == FoundationComponent::tangent) text += " tangent";
    if (f.component == FoundationComponent::rotation) text += " rotation";
    if (f.direction) text += " fixed direction";
    if (f.gap > 0.0) text += " gap";
    if (!f.gap_along.empty()) text += " gap along";
    if (std::isinf(f.stiffness)) text += " rigid";
    constexpr std::array kOutlines{" circle", " line", " spline", " polyline"};
    if (f.outline) text += kOutlines.at(f.outline->index());
    if (f.shear_stiffness > 0.0) text += " shear layer";
  }
  for (const Spring& s : m.springs) {
    text += std::string("; spring ") + kReactions.at(static_cast<std::size_t>(s.reaction)) + law_of(s.law);
    if (std::isinf(s.stiffness)) text += " rigid";
    text += s.to ? " between nodes" : s.at.member.empty() ? " at node" : " in member";
    if (s.pretension) text += "(pretension)";
  }
  constexpr std::array kLoads{"point",          "distributed", "pressure",
                              "initial strain", "self weight", "temperature"};
  for (const Load& load : m.loads) {
    text += std::string("; ") + kLoads.at(load.index());
    if (std::visit([](const auto& l) { return l.pattern == Pattern::constant; }, load)) text += " constant";
  }
  const auto varies = [](const Section& s) { return s.EI.varies() || s.EA.varies(); };
  if (std::ranges::any_of(m.sections, varies)) text += "; tapers";
  for (const Support& s : m.supports)
    if (s.displacement) text += "; prescribed displacement";
  return text;
}

}  // namespace

StressOutcome run_request(RandomRequest request, double time_bound_s) {
  StressOutcome out;
  out.features = features_of(request);
  if (const auto findings = check(request.model, request.analysis); !findings.empty()) {
    out.termination = "invalid";
    out.check.failures.push_back("invalid: " + findings.front().pointer + " " + findings.front().detail);
    return out;
  }
  request.analysis.output.states = StateOutput::all;
  request.analysis.output.points_per_member = std::max(2, points_needed(request.model, request.analysis));
  const double start = processor_time();
  Result result;
  {
    const Bound bound(time_bound_s);
    result = solve(request.model, request.analysis, {bound.token(), {}});
  }
  out.seconds = processor_time() - start;
  // a path that was followed anew has more elements than could be known: once more, sampled finely enough for
  // them
  constexpr int kMostPoints = 5000;
  const MeshReport& mesh = result.discretization;
  const bool is_followed_anew = mesh.paths > 1 && result.summary.termination != "cancelled";
  const int points = is_followed_anew ? points_needed(request.model, request.analysis, mesh) : 0;
  if (points > 0 && points <= kMostPoints) {
    request.analysis.output.points_per_member = points;
    result = solve(request.model, request.analysis);
  }
  out.termination = result.summary.termination;
  out.reached = reached(request.analysis, out.termination);
  out.detail = result.summary.message;
  out.said_where = !out.termination.empty() && !out.detail.empty();
  out.critical_points = result.critical_points;
  if (!result.branches.empty()) out.end_load_factor = result.branches.front().load_factor.back();
  out.check = check_result(request.model, request.analysis, result);
  if (out.termination == "cancelled") out.check.failures.push_back("time: over the bound");
  const bool refused = out.termination == "loose_part" || out.termination == "not_held";
  if (refused && !needs_one_sided_supports(request))
    out.check.failures.push_back("loose: supports that act both ways hold every part");
  if (!out.said_where) out.check.failures.push_back("silent: no termination or message");
  return out;
}

std::optional<Draw> draw_named(std::string_view name) {
  if (name == "first") return Draw::first;
  if (name == "broad") return Draw::broad;
  if (name == "laws") return Draw::laws;
  if (name == "media") return Draw::media;
  if (name == "soil") return Draw::soil;
  return name == "members" ? std::optional(Draw::members) : std::nullopt;
}

RandomRequest draw_request(Draw draw, std::uint64_t seed) {
  if (draw == Draw::laws) return laws_request(seed);
  if (draw == Draw::media) return media_request(seed);
  if (draw == Draw::soil) return soil_request(seed);
  if (draw == Draw::members) return members_request(seed);
  return draw == Draw::broad ? broad_request(seed) : random_request(seed);
}

StressOutcome run_seed(Draw draw, std::uint64_t seed, double time_bound_s) {
  return run_request(draw_request(draw, seed), time_bound_s);
}

}  // namespace snapthrough::testing
