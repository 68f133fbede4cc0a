#include "solver/events/critical_system.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "solver/numeric/dense.h"
#include "solver/numeric/pseudo_random.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Limits of Newton's method for critical points; ratios. Source: docs/decisions/0010 and 0022.
struct CriticalLimits {
  static constexpr int most_iterations = 8;  ///< Newton iterations on a critical point
  static constexpr double refinement = 0.1;  ///< largest refinement, relative to the null motions
  /// Difference of the stiffnesses by factors and by quotients, above which solutions are refined.
  static constexpr double sure = 0.1;
  /// Largest sum of squared norms of the null motions, which start with norm one.
  static constexpr double null_norm = 1e6;
  /// Corrections that no longer fall count as rounding below this share of the reach and of the load factor.
  static constexpr double stagnant = 1e-6;
  static constexpr double aside = 1e-8;  ///< displacement off a singular tangent, over the reach
  static constexpr int settling = 3;     ///< iterations until the unfolding force measures the imperfection
  /// Largest distance in the load factor at which the stiffness of another motion counts as vanishing.
  static constexpr double near = 1e-3;
  /// Distance in the load factor from a count of negative eigenvalues, relative, up to which it holds.
  static constexpr double count_holds = 1e-2;
  static constexpr int null_iterations = 2;  ///< inverse iterations for another null motion
  /// Distance from the point of the factors that find another null motion, over the load factor.
  static constexpr double beside = 1e-6;
};

VectorXd eigenvalues(const MatrixXd& m) { return symmetric_eigenvalues(symmetric_part(m)); }

/// Newton's method for a bifurcation or a limit point, with the bordered matrix [J, W n; n W, 0].
class CriticalNewton {
 public:
  CriticalNewton(EquilibriumProblem& problem, const PathMetric& metric, const CriticalGuess& guess,
                 const CriticalOptions& options, bool bifurcation)
      : problem_(problem), metric_(metric), guess_(guess), options_(options), bifurcation_(bifurcation) {
    at_.y = guess.y;
    at_.lambda = guess.lambda;
    at_.null = guess.null;
    if (bifurcation) at_.unfolding = VectorXd::Zero(guess.null.cols());
  }
  [[nodiscard]] std::optional<CriticalSolution> run(int& factorisations);
  /// @brief The last iterate whose load was corrected by less than CriticalLimits::near and that was no
  /// solution: state, load factor, null motions and load response. Empty: no iterate came that near.
  [[nodiscard]] const std::optional<CriticalSolution>& nearest() const { return nearest_; }
  [[nodiscard]] VectorXd another_null_motion(const CriticalSolution& at);

 private:
  void refine(const MatrixXd& rows, const MatrixXd& border);
  [[nodiscard]] bool factorise();
  void take_quotients(const MatrixXd& right);
  void keep_better(const MatrixXd& rows, const MatrixXd& border);
  [[nodiscard]] MatrixXd works(const Eigen::Ref<const MatrixXd>& forces,
                               const Eigen::Ref<const MatrixXd>& motions) const;
  void differentiate();
  [[nodiscard]] bool step();
  [[nodiscard]] bool converged();
  [[nodiscard]] bool balances();
  void keep_nearest();
  /// Load factor to which differences of load factors are relative.
  [[nodiscard]] double load_size(double lambda) const {
    return std::max(std::abs(lambda), options_.least_load);
  }
  [[nodiscard]] MatrixXd share_of_target() const;
  [[nodiscard]] VectorXd small_step() const;

  EquilibriumProblem& problem_;
  const PathMetric& metric_;
  const CriticalGuess& guess_;
  const CriticalOptions& options_;
  bool bifurcation_;
  CriticalSolution at_;
  MatrixXd v_;      ///< null motions of this iteration: J v = W n G, n.W v = 1
  VectorXd p_, q_;  ///< response to the residual and to the load
  VectorXd pi_, rho_;
  MatrixXd along_p_;   ///< second derivatives n_i.F''[n_j, p]
  VectorXd along_zp_;  ///< second derivatives n_i.F''[z, p]
  VectorXd residual_;
  // scratch of factorise() and differentiate()
  MatrixXd rows_, border_, solved_, motions_;
  VectorXd load_;
  double dlambda_ = 0.0;
  double moved_ = 0.0;
  double previous_ = 0.0;                                  ///< norm of the last correction
  double left_ = std::numeric_limits<double>::infinity();  ///< relative residual of settled_
  std::optional<CriticalSolution> nearest_;
  std::optional<CriticalSolution> settled_;  ///< a converged solution whose residual may still decrease
  bool stalled_ = false;                     ///< corrections no longer decrease
  /// Relative difference between stiffnesses from the factors and from Rayleigh quotients, where
  /// CriticalSolution::others was counted.
  double doubt_of_count_ = std::numeric_limits<double>::infinity();
  double counted_at_ = 0.0;  ///< load factor at which CriticalSolution::others was counted
};

/// One step of iterative refinement. Elimination loses digits where the tangent is singular, or where a part
/// of a member is at a buckling load of its own (for example each half of a column in its second mode).
void CriticalNewton::refine(const MatrixXd& rows, const MatrixXd& border) {
  const Index k = v_.cols();
  MatrixXd all(rows.rows(), k + 2);
  all << v_, p_, q_;
  MatrixXd multipliers(k, k + 2);
  multipliers << -at_.stiffness, pi_, rho_;
  MatrixXd left = -problem_.tangent_products(at_.y, at_.lambda, all) - rows.leftCols(k) * multipliers;
  left.rightCols(2) += rows.rightCols(2);
  problem_.solve(left);
  left -= v_ * (border.transpose() * left);
  // without refinement after a zero pivot
  if (!(left.leftCols(k).norm() < CriticalLimits::refinement * v_.norm())) return;
  v_ += left.leftCols(k);
  p_ += left.col(k);
  q_ += left.col(k + 1);
}

/// Factorises the tangent and computes v, p and q; false when the factorisation is singular.
bool CriticalNewton::factorise() {
  const TangentReport report = problem_.linearise(at_.y, at_.lambda, residual_);
  const Index k = at_.null.cols();
  MatrixXd& rows = rows_;  // members keep their memory from one iteration to the next
  MatrixXd& border = border_;
  MatrixXd& x = solved_;
  rows.resize(at_.y.size(), k + 2);
  for (Index i = 0; i < k; ++i) problem_.metric_forces(at_.null.col(i), rows.col(i));
  rows.col(k) = -residual_;
  if (bifurcation_) rows.col(k) -= rows.leftCols(k).lazyProduct(at_.unfolding);
  problem_.load(at_.y, at_.lambda, load_);
  rows.col(k + 1) = load_;
  border = problem_.metric().asDiagonal() * at_.null;
  // remove load components along W n, for which the factors are inaccurate near the singular tangent
  const MatrixXd shares = works(rows.rightCols(2), at_.null);
  x = rows;
  x.rightCols(2) -= rows.leftCols(k).lazyProduct(shares);
  problem_.solve(x);
  at_.stiffness = inverse(border.transpose().lazyProduct(x.leftCols(k)));
  v_ = x.leftCols(k).lazyProduct(at_.stiffness);
  // solution of [J, W n; n W, 0] [x; s] = [rows; 0] for the residual and the load
  const MatrixXd along = border.transpose().lazyProduct(x.rightCols(2));
  p_ = x.col(k) - v_.lazyProduct(along.col(0));
  q_ = x.col(k + 1) - v_.lazyProduct(along.col(1));
  const VectorXd factored = eigenvalues(at_.stiffness);
  pi_ = shares.col(0) + at_.stiffness * along.col(0);
  rho_ = shares.col(1) + at_.stiffness * along.col(1);
  at_.stiffness = symmetric_part(works(problem_.tangent_products(at_.y, at_.lambda, v_), v_));
  const VectorXd exact = eigenvalues(at_.stiffness);
  const double doubt = (factored - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().minCoeff();
  const bool is_sure = doubt < CriticalLimits::sure;
  const bool is_elsewhere =
      std::abs(at_.lambda - counted_at_) > CriticalLimits::count_holds * load_size(at_.lambda);
  if (is_sure || is_elsewhere || !(doubt > doubt_of_count_)) {
    // pivots and these eigenvalues come from one factorisation, so that their signs are consistent
    doubt_of_count_ = doubt;
    counted_at_ = at_.lambda;
    at_.others = report.negative - static_cast<int>((factored.array() < 0.0).count());
  }
  if (!is_sure) {
    refine(rows, border);
    keep_better(rows, border);
    take_quotients(rows.rightCols(2));
  }
  double null_norm = 0.0;
  for (Index i = 0; i < k; ++i) null_norm += metric_.inner(v_.col(i), 0.0, v_.col(i), 0.0);
  return null_norm < CriticalLimits::null_norm && p_.allFinite() && q_.allFinite();
}

/// Keeps the null motions and the load response of the previous iteration where they have smaller residuals.
void CriticalNewton::keep_better(const MatrixXd& rows, const MatrixXd& border) {
  const Index k = v_.cols();
  const auto products = [&](const Eigen::Ref<const MatrixXd>& x) {
    return problem_.tangent_products(at_.y, at_.lambda, x);
  };
  const auto left = [&](const Eigen::Ref<const MatrixXd>& motions) {
    const MatrixXd forces = products(motions);
    return (forces - rows.leftCols(k) * symmetric_part(works(forces, motions))).norm();
  };
  if (left(v_) > left(at_.null)) {
    v_ = at_.null;
    p_ -= v_ * (border.transpose() * p_);
    q_ -= v_ * (border.transpose() * q_);
  }
  if (at_.response.size() == 0) return;
  const auto left_of_load = [&](const VectorXd& response) {
    const MatrixXd forces = rows.col(k + 1) - products(response);
    return (forces - rows.leftCols(k) * works(forces, v_)).norm();
  };
  const VectorXd before = at_.response - v_ * (border.transpose() * at_.response);
  if (left_of_load(q_) > left_of_load(before)) q_ = before;
}

/// Replaces stiffness and multipliers by Rayleigh quotients, whose errors are of second order.
void CriticalNewton::take_quotients(const MatrixXd& right) {
  const Index k = v_.cols();
  MatrixXd all(v_.rows(), k + 2);
  all << v_, p_, q_;
  MatrixXd forces = problem_.tangent_products(at_.y, at_.lambda, all);
  forces.rightCols(2) = right - forces.rightCols(2);
  at_.stiffness = symmetric_part(works(forces.leftCols(k), v_));
  // v alone leaves the prescribed displacements of the load in place
  const MatrixXd multipliers = works(forces.rightCols(2), v_);
  pi_ = multipliers.col(0);
  rho_ = multipliers.col(1);
}

/// Work of each column of forces on each motion: one row per motion.
MatrixXd CriticalNewton::works(const Eigen::Ref<const MatrixXd>& forces,
                               const Eigen::Ref<const MatrixXd>& motions) const {
  MatrixXd out(motions.cols(), forces.cols());
  for (Index i = 0; i < motions.cols(); ++i)
    for (Index j = 0; j < forces.cols(); ++j) out(i, j) = problem_.work(forces.col(j), motions.col(i));
  return out;
}

void CriticalNewton::differentiate() {
  const Index k = v_.cols();
  at_.A.assign(static_cast<std::size_t>(k), MatrixXd(k, k));
  at_.B.resize(k, k);
  at_.C.resize(k);
  along_p_.resize(k, k);
  along_zp_.resize(k);
  for (Index j = 0; j < k; ++j) {
    const MatrixXd z = problem_.tangent_change(at_.y, at_.lambda, {v_.col(j), 0.0}, v_);
    for (Index i = 0; i < k; ++i) {
      for (Index l = 0; l < k; ++l)
        at_.A[static_cast<std::size_t>(j)](i, l) = problem_.work(z.col(i), v_.col(l));
      along_p_(i, j) = problem_.work(z.col(i), p_);
    }
  }
  const PathDirection along_z{q_, 1.0};
  motions_.resize(q_.size(), k + 1);
  motions_ << v_, q_;
  const MatrixXd z = problem_.tangent_change(at_.y, at_.lambda, along_z, motions_);
  const VectorXd of_load = problem_.load_change(at_.y, at_.lambda, along_z);
  for (Index i = 0; i < k; ++i) {
    for (Index l = 0; l < k; ++l) at_.B(i, l) = problem_.work(z.col(i), v_.col(l));
    along_zp_[i] = problem_.work(z.col(i), p_);
    at_.C[i] = problem_.work(z.col(k), v_.col(i)) - problem_.work(of_load, v_.col(i));
  }
}

/// Matrix S such that the target's distance in the load factor is -trace(S stiffness) / trace(S B).
MatrixXd CriticalNewton::share_of_target() const {
  const auto spectrum = at_.spectrum();
  if (!spectrum) return inverse(at_.B);  // gives the mean distance of all null motions
  const VectorXd w = spectrum->shares.col(guess_.target);
  return w * w.transpose() / w.dot(at_.B * w);
}

/// Newton corrections of the load factor and of the amplitudes along the null motions.
VectorXd CriticalNewton::small_step() const {
  const Index k = v_.cols();
  MatrixXd equations(k + 1, k + 1);
  VectorXd right(k + 1);
  if (bifurcation_) {
    const MatrixXd share = share_of_target();
    equations(0, 0) = (share * at_.B).trace();
    for (Index j = 0; j < k; ++j) equations(0, j + 1) = (share * at_.A[static_cast<std::size_t>(j)]).trace();
    right[0] = -(share * (at_.stiffness + along_p_)).trace();
    equations.block(1, 0, k, 1) = at_.C;
    equations.block(1, 1, k, k) = at_.B;
    right.tail(k) = rho_ - along_zp_;
  } else {
    equations << at_.B(0, 0), at_.A[0](0, 0), rho_[0], -at_.stiffness(0, 0);
    right << -at_.stiffness(0, 0) - along_p_(0, 0), -pi_[0];
  }
  return solve_full_pivoting(equations, right);
}

bool CriticalNewton::step() {
  const VectorXd change = small_step();
  if (!change.allFinite()) return false;
  dlambda_ = change[0];
  const VectorXd amplitudes = change.tail(v_.cols());
  const VectorXd dy = p_ + dlambda_ * q_ + v_.lazyProduct(amplitudes);
  moved_ = metric_.norm(dy, dlambda_);
  if (!std::isfinite(moved_)) return false;
  at_.y += dy;
  at_.lambda += dlambda_;
  if (bifurcation_) at_.unfolding += pi_ + dlambda_ * rho_ - at_.stiffness * amplitudes;
  at_.stiffness += dlambda_ * at_.B + along_p_;
  for (Index j = 0; j < v_.cols(); ++j) at_.stiffness += amplitudes[j] * at_.A[static_cast<std::size_t>(j)];
  at_.response = q_;
  // orthonormalisation in the metric, span unchanged
  border_ = problem_.metric().asDiagonal() * v_;
  const MatrixXd gram = v_.transpose().lazyProduct(border_);
  at_.null = orthonormal_by_gram(v_, gram);
  return metric_.norm(at_.y - guess_.y, at_.lambda - guess_.lambda) <= options_.reach;
}

/// Whether the next correction, predicted by quadratic convergence, is below the tolerances, or whether
/// stagnating corrections are at rounding level.
bool CriticalNewton::converged() {
  const bool falls = previous_ == 0.0 || moved_ < 0.5 * previous_;
  const double ratio = falls && previous_ > 0.0 ? moved_ / previous_ : 1.0;
  const double size = load_size(at_.lambda);
  const bool stagnant = stalled_ && !falls &&
                        std::max(moved_, previous_) <= CriticalLimits::stagnant * options_.reach &&
                        std::abs(dlambda_) <= CriticalLimits::stagnant * size;
  previous_ = moved_;
  stalled_ = stalled_ || !falls;
  return stagnant || (moved_ * ratio <= options_.place * options_.reach &&
                      std::abs(dlambda_) * ratio <= options_.tolerance * size);
}

/// Whether the solution satisfies equilibrium. Tested when the state is reported (to rounding), or when
/// one-sided supports exist, because even a small last correction may change the contact.
bool CriticalNewton::balances() {
  if (!problem_.traits().one_sided && !options_.to_rounding) return true;
  problem_.residual(at_.y, at_.lambda, residual_);
  VectorXd column(at_.y.size());
  for (Index i = 0; i < at_.unfolding.size(); ++i) {
    problem_.metric_forces(at_.null.col(i), column);
    residual_ += at_.unfolding[i] * column;
  }
  const double size = problem_.relative_residual(residual_, at_.y, at_.lambda);
  const double rounding = std::max(Rounding::largest_residual, problem_.residual_rounding(at_.y, at_.lambda));
  if (problem_.traits().one_sided && size > std::max(options_.largest_residual, rounding)) return false;
  const bool falls = size <= 0.5 * left_;
  left_ = size;
  if (!options_.to_rounding || !falls || size <= rounding) return true;
  settled_ = at_;
  return false;
}

void CriticalNewton::keep_nearest() {
  if (!nearest_) nearest_.emplace();
  nearest_->y = at_.y;
  nearest_->lambda = at_.lambda;
  nearest_->null = at_.null;
  nearest_->response = at_.response;
}

std::optional<CriticalSolution> CriticalNewton::run(int& factorisations) {
  for (int it = 1; it <= CriticalLimits::most_iterations; ++it) {
    ++factorisations;
    if (!factorise()) {
      // a tangent that is exactly singular can be factorised at a neighbouring state
      at_.y += CriticalLimits::aside * options_.reach * at_.null.col(0);
      ++factorisations;
      if (!factorise()) break;
    }
    differentiate();
    if (!step()) break;
    const bool broken = bifurcation_ && at_.imperfection() > options_.largest_imperfection;
    if (broken && it >= CriticalLimits::settling) break;
    if (converged() && balances()) return std::move(at_);
    if (bifurcation_ && std::abs(dlambda_) <= CriticalLimits::near * load_size(at_.lambda)) keep_nearest();
  }
  return std::move(settled_);
}

/// Finds a further motion that loses its stiffness at the bifurcation, by inverse iteration with factors
/// beside it on the path; empty when there is none. Factors at the bifurcation itself have no digits left
/// once it is found to rounding.
VectorXd CriticalNewton::another_null_motion(const CriticalSolution& at) {
  const Index k = at.null.cols();
  if (k == (problem_.metric().array() > 0.0).count()) return {};
  const double step = CriticalLimits::beside * load_size(at.lambda);
  problem_.linearise(at.y + step * at.response, at.lambda + step, residual_);
  const MatrixXd border = problem_.metric().asDiagonal() * at.null;
  VectorXd x = pseudo_random(at.y.size(), static_cast<unsigned>(k + 1));
  VectorXd force(x.size());
  for (int it = 0; it < CriticalLimits::null_iterations; ++it) {
    x -= at.null * (border.transpose() * x);
    problem_.metric_forces(x, force);
    problem_.solve(force);
    x = force - at.null * (border.transpose() * force);
    x /= metric_.norm(x, 0.0);
  }
  if (!x.allFinite()) return {};
  const PathDirection along_z{at.response, 1.0};
  const double rate = works(problem_.tangent_change(at.y, at.lambda, along_z, x), x)(0, 0);
  const double stiffness = works(problem_.tangent_products(at.y, at.lambda, x), x)(0, 0);
  // a motion that the load drives belongs to a limit point
  problem_.load(at.y, at.lambda, force);
  const bool driven = std::abs(problem_.work(force, x)) > options_.largest_imperfection * std::abs(rate);
  return !driven && std::abs(stiffness) <= CriticalLimits::near * std::abs(at.lambda * rate) ? x : VectorXd();
}

}  // namespace

std::optional<CriticalSolution> solve_bifurcation(EquilibriumProblem& problem, const PathMetric& metric,
                                                  const CriticalGuess& guess, const CriticalOptions& options,
                                                  int& factorisations) {
  CriticalGuess wider = guess;
  std::optional<CriticalSolution> best;
  for (;;) {
    CriticalNewton newton(problem, metric, wider, options, true);
    auto found = newton.run(factorisations);
    // factors bordered by too few null motions lose their digits before the iteration has converged
    const std::optional<CriticalSolution>& at = found ? found : newton.nearest();
    if (!at) return best;
    ++factorisations;
    const VectorXd another = newton.another_null_motion(*at);
    if (another.size() == 0) return found ? found : best;
    // restart from the guess: at a multiple bifurcation the factors have no accurate digits
    const Index k = at->null.cols();
    wider.null.resize(Eigen::NoChange, k + 1);
    wider.null << at->null, another;
    if (found) best = std::move(found);
  }
}

std::optional<CriticalSolution> solve_limit_point(EquilibriumProblem& problem, const PathMetric& metric,
                                                  const CriticalGuess& guess, const CriticalOptions& options,
                                                  int& factorisations) {
  return CriticalNewton(problem, metric, guess, options, false).run(factorisations);
}

}  // namespace snapthrough
