#pragma once
/// @file
/// The path of one value of a parameter, traced from its beginning.

#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "solver/path/path_follower.h"
#include "solver/sweep/model_family.h"
#include "solver/trace/trace.h"

namespace snapthrough {

/// Whether one-sided supports hold the loads of a model at the start of its path.
[[nodiscard]] bool loads_are_held(const ResolvedModel& model);
/// Whether loads_are_held() has the same answer for both models: they differ in nothing but the stiffness of
/// sections, and of supports that are in both.
[[nodiscard]] bool are_held_alike(const ResolvedModel& a, const ResolvedModel& b);

/// Path of a model on a fixed mesh.
class TracedPath {
 public:
  /// @param like null, or a member whose unknowns and scales the structure has
  TracedPath(const Model& model, const Analysis& analysis, const std::stop_token& stop,
             const FamilyMember* like = nullptr);

  /// @brief Traces the path from its start; the outcome is no_start, with a failure code, where it has none.
  [[nodiscard]] TraceOutcome run(const TraceRules& rules);

  /// Failure code; empty: the path was traced.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// Whether one-sided supports touch without pressure.
  [[nodiscard]] bool touches() const { return touches_; }
  [[nodiscard]] const std::shared_ptr<FamilyMember>& member() const { return member_; }
  [[nodiscard]] const PathNorm& norm() const { return follower_->norm(); }
  [[nodiscard]] int factorizations() const { return follower_->statistics().factorizations; }

 private:
  void set(Structure structure);
  [[nodiscard]] PathStart start(Result& result);

  StepOptions steps_;
  std::shared_ptr<FamilyMember> member_;
  std::unique_ptr<PathFollower> follower_;
  bool touches_ = false;
  std::string failure_;
};

}  // namespace snapthrough
