#pragma once
/// @file
/// Errors of critical loads: estimated on finer meshes, and brought down to what was asked for.

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "solver/accuracy/polish.h"
#include "solver/hooks.h"
#include "solver/trace/path_observer.h"

namespace snapthrough {

/// Adds to a critical point what was asked for beside its load. @param event the point on that structure
using Complete =
    std::function<void(const Structure& structure, const CriticalEvent& event, CriticalPoint& point)>;

/// @brief Finds the critical points of a path again on ever finer meshes until their loads agree: only then
/// they are confirmed.
///
/// A load's error on one mesh is estimated by its difference to the next finer mesh's, which is nearer to the
/// truth by a factor: one order more on the same elements where the solution is smooth, elements halved where
/// contact ends inside them (Carstensen's saturation assumption; checked wherever three meshes were used:
/// differences must fall). The value reported is that of the coarser of the two: the finer one's error is
/// not known. With a fixed mesh the values stay and only the estimate is made.
///
/// A point that finer meshes do not have belongs to a mesh that is too coarse for the path as a whole: then
/// the path is to be followed again on a finer one. What both paths have within the accuracy is confirmed,
/// too.
class CriticalLoads final : public PathObserver {
 public:
  /// @param earlier critical points of the path on a coarser mesh; kept by reference
  /// @param follower of the path; it has to be alive and started when confirm() is called
  CriticalLoads(const Model& model, const Analysis& analysis, const Structure& structure,
                const PathFollower& follower, const std::vector<CriticalPoint>& earlier, Result& result)
      : model_(model),
        analysis_(analysis),
        structure_(structure),
        follower_(follower),
        earlier_(earlier),
        result_(result) {}

  void on_point(const PathPoint& point) override { last_ = point; }
  /// Remembers a critical point. @pre an observer before this one has added the point to the result
  void on_critical(const CriticalEvent& event) override;
  /// @brief Sets the error estimates of all critical points seen, refines where they exceed the accuracy, and
  /// reports the meshes.
  /// @param text what is to be said of it is added
  /// @return whether every point is confirmed
  /// @param complete called for each point, on the mesh that its load is from; may be empty
  [[nodiscard]] bool confirm(const std::stop_token& stop, std::string& text, const Complete& complete = {});
  /// @brief Whether the finer mesh is in equilibrium near the end of a path, with the same inertia there: so
  /// it has lost stability as often as the path has.
  [[nodiscard]] bool confirm_end(const PathPoint& end);

  /// @brief The imperfection of the same bifurcation on the finer mesh; empty where that does not have it.
  [[nodiscard]] std::optional<double> finer_imperfection(const CriticalEvent& bifurcation);

 private:
  /// A critical point of the coarse path.
  struct Target {
    CriticalEvent event;
    PathPoint before;
    std::size_t index = 0;  ///< in Result::critical_points
  };
  /// What is known of a load after some meshes.
  struct Answer {
    FoundPoint found;
    int level = 0;  ///< 0: the path's own mesh
    std::optional<double> error;
    std::vector<MeshAnswer> meshes;
  };

  [[nodiscard]] FineMesh* level(int number);
  [[nodiscard]] const Structure& structure_of(int number) const;
  [[nodiscard]] Answer answer_for(const Target& target);
  [[nodiscard]] std::optional<double> error_to_earlier(const Target& target) const;
  void report(const Target& target, const Answer& answer);
  void report_meshes(int finest, double largest, int without, std::string& text);

  const Model& model_;
  const Analysis& analysis_;
  const Structure& structure_;
  const PathFollower& follower_;
  const std::vector<CriticalPoint>& earlier_;
  Result& result_;
  PathPoint last_;
  std::vector<Target> targets_;
  std::vector<std::unique_ptr<FineMesh>> levels_;
};

}  // namespace snapthrough
