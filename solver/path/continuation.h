#pragma once
/// @file
/// Pseudo-arc-length continuation with step control.

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "solver/model/analysis.h"
#include "solver/newton/contact_state.h"
#include "solver/newton/corrector.h"
#include "solver/path/contact_forecast.h"
#include "solver/path/path_point.h"

namespace snapthrough {

/// Constants of the step control. Dimensionless: the metric is scaled by the model's own length and load.
struct ContinuationOptions {
  double min_step = 1e-13;  ///< in arc length
  double max_step = 1e12;   ///< in arc length; a path that no longer turns soon meets the bound on its load
  double target_correction = 0.08;  ///< wanted ratio of the first correction to the step
  double target_angle = 0.30;       ///< wanted angle between successive tangents, rad
  double max_angle = 0.9;           ///< a larger angle rejects the step, rad
  double max_growth = 2.5;
  /// Load factor that the first state on one-sided supports must stay below.
  double largest_first_load = std::numeric_limits<double>::infinity();
  CorrectorOptions corrector;
};

struct ContinuationStatistics {
  int steps = 0;
  int rejected_steps = 0;
  int iterations = 0;  ///< Newton corrections
  int factorizations = 0;
  double max_relative_residual = 0.0;
  /// Entry i: accepted steps that took i corrections (the last one, on 31, stands for more).
  std::array<int, 32> corrections{};
};

/// Size of the step that was taken, and of the one to try next.
struct StepSize {
  double taken = 0.0;
  double wanted = 0.0;
};

/// Unit direction from one point of a path to another. Where the load turns within a displacement too small
/// for the path's norm, that of the displacement alone, without load.
struct Chord {
  Eigen::VectorXd y;
  double lambda = 0.0;
  bool displacement_only = false;
};

/// What a step met. `kinked`: the path turns sharply at the step's start, because a support begins or ceases
/// to act there, and the step leads on in the new direction.
enum class StepOutcome { advanced, kinked, step_underflow };

/// @brief Follows F(y, lambda) = 0 from a known point.
///
/// Holds the immutable configuration; the state that changes is the PathPoint and step size that the caller
/// keeps.
class Continuation {
 public:
  Continuation(EquilibriumProblem& problem, ContinuationOptions options);

  /// @brief First point of the path: y = 0 at lambda = 0, with the tangent towards growing load (or falling,
  /// when `direction` is -1).
  ///
  /// Where supports act on one side only, the tangent is that of the structure in the contact it takes under
  /// a very small load (solved from the glued structure), because there is no derivative at zero load.
  /// A structure that moves freely until a gap closes starts where it comes to rest under that load.
  /// @return empty when the structure is singular or no contact state was found
  [[nodiscard]] std::optional<PathPoint> start(double direction = 1.0);
  /// @brief First point of a path that starts from a known equilibrium y at lambda = 0 (under constant
  /// actions).
  /// @param holds of that state
  [[nodiscard]] std::optional<PathPoint> start_at(const Eigen::VectorXd& y, double direction = 1.0,
                                                  const SharedHolds& holds = {});

  /// @brief The start of a path at the equilibrium next to given unknowns.
  /// @param y scaled unknowns near an equilibrium at the scaled load factor `lambda`
  /// @return empty when Newton's method finds none there, or the tangent is singular
  [[nodiscard]] std::optional<PathPoint> start_from(const Eigen::VectorXd& y, double lambda,
                                                    double direction);

  /// @brief Corrects a point at its load, as far as rounding allows.
  /// @return whether that converged; else the point is what the last correction left
  [[nodiscard]] bool correct_at_load(double scale, PathPoint& at);
  /// @brief Holds the structure against the motions that nothing resists at a point, more than are held
  /// there, where they were at `from`; corrects the point at its load.
  /// @return whether there are such motions; else the point stays as it is
  [[nodiscard]] bool hold_neutral(const PathPoint& from, PathPoint& at);
  /// @brief Whether `to` lies so near to a singular tangent, seen from `from`, that hold_neutral() is worth
  /// asking.
  [[nodiscard]] bool may_be_neutral(const PathPoint& from, const PathPoint& to) const;
  /// @brief Lets go of what is held at `from` and has a stiffness or carries a force at `to`.
  /// @return false when `from` keeps all its holds: they are idle
  [[nodiscard]] bool release(PathPoint& from, const PathPoint& to);

  /// @brief One accepted step from `from`: `step.wanted` is tried first, then smaller ones; sets both fields.
  [[nodiscard]] StepOutcome step(const PathPoint& from, StepSize& step, PathPoint& to);
  /// @brief The next step from `from` is predicted, at its first size, by the cubic through both points and
  /// tangents: where the path does not turn sharply between them.
  void extrapolate(const PathPoint& before, const PathPoint& from);
  /// The next step is predicted by its tangent.
  void extrapolate_nothing() {
    bend_ = {};
    forecast_.forget();
  }
  /// @brief The last point before a kink that is within `size` of `from`, to the smallest step: found by
  /// halving steps, which may be taken before the kink and not over it.
  [[nodiscard]] PathPoint last_before_kink(const PathPoint& from, double size);
  /// @brief Bounds the step sizes from now on by the caller's, which are fractions of the load scale.
  /// @param load_rate d lambda / ds at the start, positive
  void limit_steps(const StepOptions& steps, double load_rate);
  /// @brief Measures paths in the norm of another follower, which has started, of the same structure on
  /// another mesh: points can then be corrected and stepped from without a start.
  void measure_as(const Continuation& other) {
    load_scale_ = other.load_scale_;
    load_bound_ = other.load_bound_;
    metric_.load_weight = other.metric_.load_weight;
    arc_weight_ = other.arc_weight_;
  }
  /// @brief Weighs the load anew in the path's norm where it dwarfs the displacement there: a structure that
  /// carries far more than its members' scale says would meet its limit load as a kink. Arc lengths stay in
  /// the norm that the path began with.
  /// @param to_limit whether the path is on the way to a limit; one that is followed beyond for its own sake
  /// would go by smaller steps, so there it is done only where steps have become far shorter than they were
  /// (a thin member between immovable ends turns within gradients that the norm did not see), and where
  /// contact changes with displacements that the norm would not see
  /// @param at the point to go on from; its tangent is normalised again
  void weigh_load(bool to_limit, PathPoint& at, StepSize& step);
  /// @brief Takes the last step back, because it jumped to another path: the next one will be shorter.
  void reject(StepSize& step);
  /// @brief Corrects a point as far as rounding allows where it was corrected for its tangent only, so that
  /// its inertia is that of the path: on a plateau the point before the last correction may be across a
  /// singularity.
  void settle(const PathPoint& from, PathPoint& point);

  /// @brief Finds the softest motions at a point and how fast they change along the path.
  /// @pre the problem was factorised last at the point, or so near that it makes no difference
  /// @param start modes of a neighbouring point; null: there are none
  void find_modes(PathPoint& at, const SharedModes& start);
  /// @brief The same at the beginning of a path, factorised just beyond it. Without rates on one-sided
  /// supports: there contact changes within the first step.
  void find_first_modes(PathPoint& start);
  /// @brief Negative eigenvalues at a point, factorised there.
  [[nodiscard]] int negative_at(const PathPoint& at);
  void count_factorisations(int number) { statistics_.factorizations += number; }

  /// @brief The straight line from one point of the path to another: places between are told by their
  /// distance along it.
  [[nodiscard]] Chord chord(const PathPoint& a, const PathPoint& b) const;
  [[nodiscard]] Chord displacement_chord(const PathPoint& a, const PathPoint& b) const;
  /// @brief The point of the path between lo and hi, in the plane normal to the chord at a share (0 to 1) of
  /// the way.
  /// @return empty when the correction failed
  [[nodiscard]] std::optional<PathPoint> between(const Chord& chord, const PathPoint& lo, const PathPoint& hi,
                                                 double share);
  /// @brief A guess of the path at a share of the way from lo to hi: cubic where the tangents allow it. Sets
  /// y and lambda only.
  void interpolate(const Chord& chord, const PathPoint& lo, const PathPoint& hi, double share,
                   PathPoint& at) const;
  /// Distance of two points in the norm that the path began with: of their arc lengths.
  [[nodiscard]] double arc(const PathPoint& a, const PathPoint& b) const;
  /// The way from the path's beginning to a point, as a measure of places next to it: no longer than the
  /// straight one, nor than gradients at which a structure has changed its shape for good.
  [[nodiscard]] double path_length_to(const PathPoint& at) const;
  /// Distance of two points in the path's norm, in a chord's, and along a chord.
  [[nodiscard]] double distance(const PathPoint& a, const PathPoint& b) const;
  [[nodiscard]] double distance_in(const Chord& chord, const PathPoint& a, const PathPoint& b) const;
  [[nodiscard]] double distance_along(const Chord& chord, const PathPoint& a, const PathPoint& b) const;
  /// d lambda by distance along the chord.
  [[nodiscard]] double load_rate(const Chord& chord, const PathPoint& at) const;

  [[nodiscard]] const ContinuationOptions& options() const { return options_; }
  [[nodiscard]] const ContinuationStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const PathMetric& metric() const { return metric_; }
  /// @brief Motion that nothing resists under the first small load, which start() found no path from: a part
  /// of the structure that one-sided supports touch without pressure, or not at all. Empty: none.
  [[nodiscard]] const Eigen::VectorXd& loose_motion() const { return loose_motion_; }
  /// A first state, at rest under the first small load, that start() refused because it lies too far from the
  /// unloaded one: displacement gradients (root mean square) there, and those of small displacements under
  /// the same load, which gaps and elastic strains explain.
  struct FarStart {
    double moved = 0.0;
    double explained = 0.0;
  };
  [[nodiscard]] const std::optional<FarStart>& far_start() const { return far_start_; }
  /// Size of the response to the first small load over that of the structure glued to its supports: what
  /// rounding presses against stiff supports moves far more.
  [[nodiscard]] double loosening() const { return loosening_; }
  /// Scale of the first critical load factor that the load is measured by.
  [[nodiscard]] double load_scale() const { return load_scale_; }
  /// Load that tolerances are relative to where a load is less.
  [[nodiscard]] double least_load() const { return 1e-6 * load_scale_; }
  /// Load beyond which nothing of interest can be: far above what buckles the weakest member, and above what
  /// buckles the strongest with its foundations helping.
  [[nodiscard]] double load_bound() const { return load_bound_; }
  [[nodiscard]] EquilibriumProblem& problem() { return problem_; }

 private:
  [[nodiscard]] bool unit_response(const Eigen::VectorXd& at, double lambda, Regime::Contact contact,
                                   Eigen::VectorXd& response, TangentReport& report);
  [[nodiscard]] std::optional<PathPoint> one_sided_start(double direction);
  [[nodiscard]] std::optional<PathPoint> softly_held_start(const SharedHolds& soft, double direction,
                                                           SoftlyHeld& held, PathPoint& loaded);
  [[nodiscard]] NeutralBounds neutral_bounds(const Holds& holds, const PathPoint& at);
  [[nodiscard]] bool is_loose();
  [[nodiscard]] std::optional<PathPoint> start_at_rest(PathPoint rest, double direction);
  [[nodiscard]] std::optional<PathPoint> near_start(double lambda, double direction);
  [[nodiscard]] std::optional<PathPoint> begin_at(const PathPoint& equilibrium, double direction);
  [[nodiscard]] bool is_far(const PathPoint& rest);
  void turn_where_supports_touch(PathPoint& start, double direction, const Eigen::VectorXd& response);
  [[nodiscard]] PathPoint first_point(const Eigen::VectorXd& y, double lambda,
                                      const Eigen::VectorXd& response, double direction,
                                      const TangentReport& report);
  void set_load_scale(const Eigen::VectorXd& response);
  /// @param before negative eigenvalues of a point next to it
  void set_tangent(PathPoint& point, int before, const CorrectorOutcome& outcome,
                   const Eigen::VectorXd& direction, double direction_lambda);
  /// What came of one attempt at a step.
  struct Trial {
    bool converged = false;
    double angle = 0.0;          ///< between the tangents
    double correction = 0.0;     ///< first correction over the step
    double unexplained = 0.0;    ///< of the displacement, by both ends' rates
    double largest_angle = 0.0;  ///< that the tangents may have
    double missed = 0.0;         ///< contact that was not forecast, in elements
    double growth = 0.3;         ///< wanted factor to the next step size
    int corrections = 0;
  };
  [[nodiscard]] CorrectorOutcome correct_step(const PathPoint& from, double step, double displacement,
                                              PathPoint& to, ContactForecast* forecast);
  /// Arc length by length of a step, which is measured with the load as it is weighed now.
  [[nodiscard]] double arc_per_step(const PathPoint& at) const;
  void begin_forecast(const PathPoint& from);
  void predict(const PathPoint& from, double step, PathPoint& to) const;
  /// @brief Share of a step's displacement that is not some mean of what its ends' rates give. A path that
  /// turns one way, or has one kink, leaves little; a snap in between, or an end on another path, does.
  /// @param rise what the tangent at `from` alone misses of the displacement
  [[nodiscard]] double unexplained(const PathPoint& from, double step, const Eigen::VectorXd& rise,
                                   const PathPoint& to) const;
  [[nodiscard]] bool step_round_kink(const PathPoint& from, double size, PathPoint& to);
  [[nodiscard]] std::optional<PathPoint> beyond_kink(const PathPoint& from, double depth);
  [[nodiscard]] bool step_from_beyond(const PathPoint& from, const PathPoint& beyond, double step,
                                      PathPoint& to);
  /// Angle between the tangents, rad.
  [[nodiscard]] double angle_between(const PathPoint& a, const PathPoint& b) const;
  [[nodiscard]] bool settle_beyond(const PathPoint& from, const PathPoint& beyond, double size,
                                   PathPoint& to);
  /// @param forecast begun at `from`; null: contact is taken from the predicted displacement
  [[nodiscard]] Trial try_step(const PathPoint& from, double step, PathPoint& to,
                               ContactForecast* forecast = nullptr);
  /// Whether a step may be taken: its end is on the path that it started on, as far as both ends tell.
  [[nodiscard]] bool is_smooth(const Trial& trial) const;
  /// Corrects y downhill in the energy at its load.
  [[nodiscard]] CorrectorOutcome correct_downhill(double scale, int iterations, PathPoint& at);
  void count(const CorrectorOutcome& outcome);

  EquilibriumProblem& problem_;
  ContinuationOptions options_;
  ContinuationStatistics statistics_;
  PathMetric metric_;
  ContactForecast forecast_;
  double load_scale_ = 1.0;
  double load_bound_ = 1.0;
  double loosening_ = 1.0;
  double arc_weight_ = 1.0;  ///< of the load in arc lengths
  Eigen::VectorXd loose_motion_;
  std::optional<FarStart> far_start_;
  bool symmetric_ = true;   ///< the tangent is, so that stiffnesses of motions are real
  bool easy_ = false;       ///< the last step was accepted at its first size
  double easy_size_ = 0.0;  ///< of the last step that was accepted at its first size
  /// Second and third derivative of the path at the point that is stepped from, by arc length; empty: not
  /// used.
  struct Bend {
    Eigen::VectorXd y2, y3;
    double lambda2 = 0.0, lambda3 = 0.0;
  };
  Bend bend_;
  Workspace work_;
  SideCondition side_;
};

}  // namespace snapthrough
