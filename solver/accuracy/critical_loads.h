#pragma once
/// @file
/// Error estimates of critical loads on finer meshes, and refinement to the requested accuracy.

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

/// Function that adds what was asked for beside the load to a critical point: sensitivities, Koiter's
/// coefficients.
/// @param structure on the mesh that gave the load of the point
/// @param norm of paths on that mesh
/// @param event the critical point as that mesh has it
using Complete = std::function<void(const Structure& structure, const PathNorm& norm,
                                    const CriticalEvent& event, CriticalPoint& point)>;

/// @brief Locates the critical points of a path on finer and finer meshes until their loads agree, which
/// confirms them.
///
/// The error on one mesh is estimated by the difference from the next finer mesh, with one order more on the
/// same elements where the solution is smooth, or halved elements where contact ends inside them. This relies
/// on Carstensen's saturation assumption, which is checked if three meshes are used: differences must
/// decrease. The reported value is that of the coarser mesh, because the error of the finer one is unknown.
/// On a fixed mesh only the estimate is made.
///
/// A point that finer meshes do not have shows that the mesh is too coarse for the path, which must then be
/// followed on a finer mesh. Points that agree between both paths within the accuracy are confirmed, too.
class CriticalLoads final : public PathObserver {
 public:
  /// @param earlier critical points of the path on a coarser mesh; kept by reference
  /// @param follower of the path; it has to be alive and started when confirm() is called
  CriticalLoads(const Analysis& analysis, const Structure& structure, const PathFollower& follower,
                const std::vector<CriticalPoint>& earlier, Result& result)
      : analysis_(analysis), structure_(structure), follower_(follower), earlier_(earlier), result_(result) {}

  void on_point(const PathPoint& point) override { last_ = point; }
  /// Remembers a critical point. @pre an observer before this one has added the point to the result
  void on_critical(const CriticalEvent& event) override;
  /// @brief Sets the error estimates of all recorded points, refines where they exceed the accuracy, and
  /// reports the meshes.
  /// @param text the message of the mesh report is appended
  /// @param complete called for each point on the mesh of its load; may be empty
  /// @return whether every point is confirmed
  [[nodiscard]] bool confirm(const std::stop_token& stop, std::string& text, const Complete& complete = {});
  /// @brief Whether the finer mesh has an equilibrium near the end of a path with the same inertia, hence the
  /// same number of losses of stability.
  [[nodiscard]] bool confirm_end(const PathPoint& end);

  /// @brief Imperfection of a bifurcation on the finer mesh; empty when that mesh does not have it.
  [[nodiscard]] std::optional<double> finer_imperfection(const CriticalEvent& bifurcation);

 private:
  /// Critical point of the path on its own mesh.
  struct Target {
    CriticalEvent event;
    PathPoint before;
    std::size_t index = 0;  ///< index in Result::critical_points
  };
  /// Load of a critical point after comparing meshes.
  struct Answer {
    FoundPoint found;
    int level = 0;  ///< refinements; 0: the path's own mesh
    std::optional<double> error;
    std::vector<MeshAnswer> meshes;
  };

  [[nodiscard]] FineMesh* level(int number);
  [[nodiscard]] const Structure& structure_of(int number) const;
  [[nodiscard]] const PathNorm& norm_of(int number) const;
  [[nodiscard]] Answer answer_for(const Target& target);
  [[nodiscard]] std::optional<double> error_to_earlier(const Target& target) const;
  void report(const Target& target, const Answer& answer);
  void report_meshes(int finest, double largest, int without, std::string& text);

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
