#include "solver/sweep/locus_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "solver/numeric/dense.h"
#include "solver/numeric/pseudo_random.h"

namespace snapthrough {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Row3 = Eigen::RowVector3d;

/// Limits of Newton's method for a point of the curve; ratios without unit.
struct LocusLimits {
  static constexpr int iterations = 12;  ///< most corrections
  static constexpr double chord = 1e-2;  ///< size of a correction after which the factors are used again
  static constexpr double falls = 0.1;   ///< ratio of corrections above which new factors are made
  static constexpr double aside = 1e-8;  ///< displacement off an exactly singular tangent, over the reach
  static constexpr double step = 1e-5;   ///< step of differences by the parameter, over its span
  static constexpr int other_iterations = 8;  ///< inverse iterations for the softest other motion
  static constexpr double one_null = 0.5;     ///< least share of the guess's null motion in the solution's
};

}  // namespace

std::shared_ptr<FamilyMember> LocusSolver::member_at(double t) {
  if (member_ && member_t_ == t) return member_;
  member_ = family_.at(t);
  member_t_ = t;
  ++counts_.structures;
  return member_;
}

/// -F, at a bifurcation less the unfolding force.
VectorXd LocusSolver::forces_of_residual() const {
  VectorXd out = -residual_;
  if (at_.bifurcation) out -= at_.unfolding * metric_rows_;
  return out;
}

/// Solution of the bordered equations [J, W n; n W, 0] [motion; multiplier] = [forces; 0].
/// @param share work of the forces on n
/// @param x J^-1 (forces - share W n): the factors are inaccurate for forces along W n near the singular
/// tangent
LocusSolver::Response LocusSolver::bordered(double share, const Eigen::Ref<const VectorXd>& x) const {
  const double along = border_.dot(x);
  return {x - along * solved_, share + factored_stiffness_ * along};
}

LocusSolver::Response LocusSolver::response(const VectorXd& forces) const {
  const double share = work(forces, bordering_);
  MatrixXd x = forces - share * metric_rows_;
  factored_->problem.solve(x);
  return bordered(share, x.col(0));
}

std::array<LocusSolver::Response, 2> LocusSolver::responses(const VectorXd& a, const VectorXd& b) const {
  const std::array<double, 2> share{work(a, bordering_), work(b, bordering_)};
  MatrixXd x(a.size(), 2);
  x << a - share[0] * metric_rows_, b - share[1] * metric_rows_;
  factored_->problem.solve(x);
  return {bordered(share[0], x.col(0)), bordered(share[1], x.col(1))};
}

/// Factorises the tangent and solves for the null motion, the residual and the load; false: the factors are
/// singular.
bool LocusSolver::factorise() {
  StructuralProblem& problem = member_->problem;
  factored_ = member_;
  const TangentReport report = problem.linearise(at_.y, at_.lambda, residual_);
  ++counts_.factorizations;
  bordering_ = at_.null;
  metric_rows_.resize(at_.y.size());
  problem.metric_forces(bordering_, metric_rows_);
  border_ = problem.metric().cwiseProduct(bordering_);
  problem.load(at_.y, at_.lambda, load_);
  const VectorXd forces = forces_of_residual();
  const std::array<double, 2> share{work(forces, bordering_), work(load_, bordering_)};
  MatrixXd x(at_.y.size(), 3);
  x << metric_rows_, forces - share[0] * metric_rows_, load_ - share[1] * metric_rows_;
  problem.solve(x);
  factored_stiffness_ = 1.0 / border_.dot(x.col(0));
  solved_ = x.col(0) * factored_stiffness_;
  negative_ = report.negative - (factored_stiffness_ < 0.0 ? 1 : 0);
  p_ = bordered(share[0], x.col(1));
  q_ = bordered(share[1], x.col(2));
  return std::isfinite(factored_stiffness_) && solved_.allFinite() && p_.motion.allFinite() &&
         q_.motion.allFinite();
}

/// Factors, responses and second derivatives at the point.
bool LocusSolver::find_responses() {
  if (!factorise()) {
    at_.y += LocusLimits::aside * options_.reach * at_.null;
    if (!factorise()) return false;
  }
  v_ = solved_;
  stiffness_ = work(member_->problem.tangent_product(at_.y, at_.lambda, v_), v_);
  differentiate();
  if (in_plane_) {
    find_parameter_rates();
    differentiate_by_parameter();
  }
  return true;
}

/// Offsets and weights of a difference by the coordinate, of second order, between the family's bounds.
std::vector<std::pair<double, double>> LocusSolver::stencil() const {
  const double d = LocusLimits::step * family_.span();
  if (at_.t - d < family_.lowest()) return {{0.0, -1.5 / d}, {d, 2.0 / d}, {2.0 * d, -0.5 / d}};
  if (at_.t + d > family_.highest()) return {{0.0, 1.5 / d}, {-d, -2.0 / d}, {-2.0 * d, 0.5 / d}};
  return {{-d, -0.5 / d}, {d, 0.5 / d}};
}

/// Derivatives of the equations by the parameter.
void LocusSolver::find_parameter_rates() {
  MatrixXd motions(v_.size(), 2);
  motions << v_, q_.motion;
  rate_forces_.setZero(v_.size());
  rate_products_.setZero(v_.size(), 2);
  VectorXd column;
  for (const auto& [offset, weight] : stencil()) {
    const auto member = offset == 0.0 ? member_ : family_.at(at_.t + offset);
    if (!member) continue;
    ++counts_.structures;
    member->problem.residual(at_.y, at_.lambda, column);
    rate_forces_ += weight * column;
    rate_products_ += weight * member->problem.tangent_products(at_.y, at_.lambda, motions);
    member->problem.load(at_.y, at_.lambda, column);
    rate_products_.col(1) -= weight * column;
  }
  h_ = response(-rate_forces_);
}

void LocusSolver::differentiate() {
  StructuralProblem& problem = member_->problem;
  MatrixXd motions(v_.size(), 2);
  motions << v_, q_.motion;
  null_change_ = problem.tangent_change(at_.y, at_.lambda, {v_, 0.0}, v_);
  const MatrixXd along_z = problem.tangent_change(at_.y, at_.lambda, {q_.motion, 1.0}, motions);
  load_change_ = along_z.col(0);
  A_ = work(null_change_, v_);
  B_ = work(load_change_, v_);
  C_ = work(along_z.col(1), v_) - work(problem.load_change(at_.y, at_.lambda, {q_.motion, 1.0}), v_);
}

/// P and R by the differences of find_parameter_rates().
void LocusSolver::differentiate_by_parameter() {
  StructuralProblem& problem = member_->problem;
  MatrixXd motions(v_.size(), 2);
  motions << v_, q_.motion;
  const MatrixXd along_h = problem.tangent_change(at_.y, at_.lambda, {h_.motion, 0.0}, motions);
  P_ = work(along_h.col(0), v_) + work(rate_products_.col(0), v_);
  R_ = work(along_h.col(1), v_) - work(problem.load_change(at_.y, at_.lambda, {h_.motion, 0.0}), v_) +
       work(rate_products_.col(1), v_);
}

/// Residuals at the point with the factors and second derivatives of an earlier one.
void LocusSolver::refresh() {
  StructuralProblem& problem = member_->problem;
  problem.residual(at_.y, at_.lambda, residual_);
  MatrixXd motions(v_.size(), 2);
  motions << at_.null, q_.motion;
  const MatrixXd products = problem.tangent_products(at_.y, at_.lambda, motions);
  const double quotient = work(products.col(0), at_.null);
  const VectorXd left = quotient * metric_rows_ - products.col(0);
  const auto [of_null, of_residual] = responses(left, forces_of_residual());
  const VectorXd& correction = of_null.motion;
  // quotient of the corrected motion, up to terms of third order
  stiffness_ = quotient - work(left, correction);
  v_ = at_.null + correction;
  problem.load(at_.y, at_.lambda, load_);
  q_.multiplier = work(load_ - products.col(1), v_);
  p_ = {of_residual.motion, work(forces_of_residual(), v_)};
}

/// The two equations of a correction, without right sides: coefficients of alpha, dlambda, dt.
std::array<Row3, 2> LocusSolver::equations() const {
  const double by_parameter = by_parameter_ ? 1.0 : 0.0;
  const Row3 stiffness(A_, B_, by_parameter * P_);
  if (at_.bifurcation) return {stiffness, Row3(B_, C_, by_parameter * R_)};
  return {stiffness, Row3(-stiffness_, q_.multiplier, by_parameter * h_.multiplier)};
}

/// Motions by a unit of alpha (0), of the load factor (1) and of the coordinate (2).
LocusDirection LocusSolver::part(int i) const {
  if (i == 0) return {v_, 0.0, 0.0};
  if (i == 1) return {q_.motion, 1.0, 0.0};
  return {by_parameter_ ? h_.motion : VectorXd::Zero(v_.size()).eval(), 0.0, 1.0};
}

/// Norms of the three parts, with the load and the coordinate.
std::array<double, 3> LocusSolver::sizes() const {
  const double along = by_parameter_ ? metric_.path.inner(h_.motion, 0.0, h_.motion, 0.0) : 0.0;
  return {metric_.path.norm(v_, 0.0), metric_.path.norm(q_.motion, 1.0),
          std::sqrt(along + metric_.parameter_weight)};
}

bool LocusSolver::step() {
  const auto rows = equations();
  MatrixXd all(3, 3);
  VectorXd right(3);
  all.row(0) = rows[0];
  all.row(1) = rows[1];
  right[0] = -(stiffness_ + work(null_change_, p_.motion));
  right[1] = at_.bifurcation ? q_.multiplier - work(load_change_, p_.motion) : -p_.multiplier;
  all.row(2) = Row3(0.0, 0.0, 1.0);
  right[2] = 0.0;
  if (in_plane_) {
    const LocusDirection start{at_.y - guess_.y + p_.motion, at_.lambda - guess_.lambda, at_.t - guess_.t};
    for (int i = 0; i < 3; ++i) all(2, i) = metric_.inner(guess_.direction, part(i));
    right[2] = -metric_.inner(guess_.direction, start);
  }
  // each unknown in the size of its motion
  const auto size = sizes();
  for (int i = 0; i < 3; ++i) all.col(i) /= size[i];
  VectorXd x = solve_full_pivoting(all, right);
  if (!x.allFinite()) return false;
  for (int i = 0; i < 3; ++i) x[i] /= size[i];
  LocusDirection change{p_.motion + x[0] * v_ + x[1] * q_.motion, x[1], x[2]};
  if (by_parameter_) change.y += x[2] * h_.motion;
  const double before = moved_;  // zero in the first correction
  const double load_before = moved_load_;
  moved_ = std::sqrt(metric_.inner(change, change));
  moved_load_ = std::abs(x[1]);
  ratio_ = before > 0.0 ? moved_ / before : 1.0;
  load_ratio_ = load_before > 0.0 ? moved_load_ / load_before : 1.0;
  if (!std::isfinite(moved_)) return false;
  at_.y += change.y;
  at_.lambda += x[1];
  at_.t += x[2];
  if (at_.bifurcation)
    at_.unfolding += p_.multiplier + x[1] * q_.multiplier + (by_parameter_ ? x[2] * h_.multiplier : 0.0) -
                     x[0] * stiffness_;
  at_.null = v_ / metric_.path.norm(v_, 0.0);
  const LocusDirection away{at_.y - guess_.y, at_.lambda - guess_.lambda, at_.t - guess_.t};
  return metric_.inner(away, away) <= options_.reach * options_.reach;
}

/// Whether the next correction, which falls at least as the last one, is below the tolerances.
bool LocusSolver::converged() const {
  const double load = options_.load * std::max(std::abs(at_.lambda), options_.least_load);
  return moved_ * std::min(ratio_, 1.0) <= options_.place &&
         moved_load_ * std::min(std::max(ratio_, load_ratio_), 1.0) <= load;
}

/// Tangent of the curve: the null vector of the two equations, in the sense of the guess's direction.
void LocusSolver::find_direction() {
  const auto rows = equations();
  const auto size = sizes();
  std::array<double, 3> share{};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    share[i] = (rows[0][j] * rows[1][k] - rows[0][k] * rows[1][j]) / (size[0] * size[1] * size[2]);
  }
  LocusDirection& out = at_.direction;
  out.y = share[0] * v_ + share[1] * q_.motion + share[2] * h_.motion;
  out.lambda = share[1];
  out.t = share[2];
  double norm = std::sqrt(metric_.inner(out, out));
  if (guess_.direction.y.size() > 0 && metric_.inner(out, guess_.direction) < 0.0) norm = -norm;
  out = {out.y / norm, out.lambda / norm, out.t / norm};
}

/// Sets what a caller reads of the point besides its state; false: not the point that was asked for.
bool LocusSolver::finish() {
  const bool perfect =
      !at_.bifurcation || std::abs(at_.unfolding) <= options_.imperfection * std::abs(at_.lambda * B_);
  if (!perfect || metric_.path.inner(at_.null, 0.0, guess_.null, 0.0) < LocusLimits::one_null) return false;
  at_.load_work = q_.multiplier;
  if (!options_.directions) return true;
  StructuralProblem& problem = member_->problem;
  if (!in_plane_) {
    find_parameter_rates();
    differentiate_by_parameter();
    by_parameter_ = true;
  }
  at_.bend = A_ = work(problem.tangent_change(at_.y, at_.lambda, {at_.null, 0.0}, at_.null), at_.null);
  find_direction();
  return true;
}

/// Inverse iteration with the bordered equations, whose solutions are orthogonal to the null motion.
double LocusSolver::softest_other() {
  StructuralProblem& problem = member_->problem;
  VectorXd motion = pseudo_random(at_.y.size(), 1U);
  VectorXd forces(at_.y.size());
  for (int it = 0; it < LocusLimits::other_iterations; ++it) {
    problem.metric_forces(motion, forces);
    motion = response(forces).motion;
    motion /= metric_.path.norm(motion, 0.0);
  }
  forces = problem.tangent_product(at_.y, at_.lambda, motion);
  return work(forces, motion);
}

bool LocusSolver::iterate(bool fresh) {
  moved_ = moved_load_ = 0.0;
  for (int it = 0; it < LocusLimits::iterations; ++it) {
    if (!member_at(at_.t)) return false;
    if (fresh && !find_responses()) return false;
    if (!fresh) refresh();
    if (!step()) return false;
    if (converged()) return finish();
    fresh = !(moved_ <= LocusLimits::chord && (it == 0 || ratio_ <= LocusLimits::falls));
  }
  return false;
}

bool LocusSolver::solve(LocusSide side, const LocusOptions& options, LocusPoint& point) {
  in_plane_ = side == LocusSide::in_plane;
  options_ = options;
  by_parameter_ = in_plane_;
  guess_ = point;
  at_ = point;
  if (!iterate(true)) return false;
  at_.others = negative_;
  at_.bend = A_;
  point = at_;
  return true;
}

bool LocusSolver::solve_with_last_factors(const LocusOptions& options, LocusPoint& point) {
  in_plane_ = false;
  options_ = options;
  options_.directions = by_parameter_ = false;
  guess_ = point;
  at_ = point;
  if (!iterate(factored_ == nullptr)) return false;
  point = at_;
  return true;
}

}  // namespace snapthrough
