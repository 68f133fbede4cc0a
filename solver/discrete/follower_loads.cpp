#include "solver/discrete/follower_loads.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using Vec2 = std::array<double, 2>;

/// Displacement of an end.
Vec2 displacement(const FollowerEnd& end, const Eigen::Ref<const VectorXd>& x) {
  Vec2 out{0.0, 0.0};
  for (const FollowerEnd::Term& term : end.terms) {
    out[0] += term.weight * x[term.x];
    out[1] += term.weight * x[term.y];
  }
  return out;
}

double rotation(const FollowerForce& force, const Eigen::Ref<const VectorXd>& x) {
  double out = 0.0;
  for (const FollowerForce::Term& term : force.terms) out += term.weight * x[term.turn];
  return out;
}

Vec2 amount(const FollowerForce& force, const LoadFactors& factors) {
  return {factors.proportional * force.proportional[0] + factors.constant * force.constant[0],
          factors.proportional * force.proportional[1] + factors.constant * force.constant[1]};
}

Vec2 turned(const Vec2& force, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * force[0] - s * force[1], s * force[0] + c * force[1]};
}

/// Derivative of turned() by the angle.
Vec2 turn_rate(const Vec2& force, double angle) {
  const Vec2 f = turned(force, angle);
  return {-f[1], f[0]};
}

double amount(const FollowerEnd& end, const LoadFactors& factors) {
  return factors.proportional * end.proportional + factors.constant * end.constant;
}

void add_at(const FollowerForce& force, double factor, const Vec2& amount, Eigen::Ref<VectorXd>& out) {
  for (const FollowerForce::Term& term : force.terms) {
    out[term.x] += factor * term.weight * amount[0];
    out[term.y] += factor * term.weight * amount[1];
  }
}

}  // namespace

/// Sets the columns of L and R.
void FollowerLoads::find_rows(const VectorXd& y, const LoadFactors& factors) {
  left_.clear();
  right_.clear();
  for (const FollowerEnd& end : ends_) {
    const double c = amount(end, factors);
    for (const bool along_x : {true, false}) {
      Row& left = left_.emplace_back();
      Row& right = right_.emplace_back();
      for (const FollowerEnd::Term& term : end.terms) {
        left.emplace_back(along_x ? term.x : term.y, term.weight);
        right.emplace_back(along_x ? term.y : term.x, (along_x ? -c : c) * term.weight);
      }
    }
  }
  for (const FollowerForce& force : forces_) {
    const Vec2 rate = turn_rate(amount(force, factors), rotation(force, y));
    Row& left = left_.emplace_back();
    Row& right = right_.emplace_back();
    for (const FollowerForce::Term& term : force.terms) {
      left.emplace_back(term.x, -rate[0] * term.weight);
      left.emplace_back(term.y, -rate[1] * term.weight);
      right.emplace_back(term.turn, term.weight);
    }
  }
}

/// R^T x.
VectorXd FollowerLoads::read(const Eigen::Ref<const VectorXd>& x) const {
  VectorXd out = VectorXd::Zero(static_cast<Index>(right_.size()));
  for (std::size_t k = 0; k < right_.size(); ++k)
    for (const auto& [index, weight] : right_[k]) out[static_cast<Index>(k)] += weight * x[index];
  return out;
}

double FollowerLoads::prepare(const VectorXd& y, const LoadFactors& factors,
                              const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve) {
  find_rows(y, factors);
  if (transposed_) std::swap(left_, right_);
  const auto n = static_cast<Index>(left_.size());
  W_.setZero(y.size(), n);
  for (Index j = 0; j < n; ++j)
    for (const auto& [index, weight] : left_[static_cast<std::size_t>(j)]) W_(index, j) += weight;
  solve(W_);
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
  for (Index j = 0; j < n; ++j) M.col(j) += read(W_.col(j));
  inverse_ = inverse(M);
  return determinant(M);
}

void FollowerLoads::correct(Eigen::Ref<VectorXd> x) const { x -= W_ * (inverse_ * read(x)); }

void FollowerLoads::add_product(const VectorXd& y, const LoadFactors& factors,
                                const Eigen::Ref<const VectorXd>& direction, Eigen::Ref<VectorXd> out) const {
  for (const FollowerEnd& end : ends_) {
    const double c = amount(end, factors);
    const Vec2 u = displacement(end, direction);
    for (const FollowerEnd::Term& term : end.terms) {
      out[term.x] -= c * term.weight * u[1];
      out[term.y] += c * term.weight * u[0];
    }
  }
  for (const FollowerForce& force : forces_)
    add_at(force, -rotation(force, direction), turn_rate(amount(force, factors), rotation(force, y)), out);
}

void FollowerLoads::add_change(const VectorXd& y, const LoadFactors& factors, const LoadFactors& rates,
                               const VectorXd& along, const Eigen::Ref<const VectorXd>& direction,
                               Eigen::Ref<VectorXd> out) const {
  add_product(y, rates, direction, out);
  // the second derivative of R(b) is -R(b)
  for (const FollowerForce& force : forces_)
    add_at(force, rotation(force, direction) * rotation(force, along),
           turned(amount(force, factors), rotation(force, y)), out);
}

void FollowerLoads::add_load(const VectorXd& y, const LoadFactors& factors, Eigen::Ref<VectorXd> out) const {
  for (const FollowerForce& force : forces_) {
    const Vec2 dead = amount(force, factors);
    const Vec2 now = turned(dead, rotation(force, y));
    add_at(force, 1.0, {now[0] - dead[0], now[1] - dead[1]}, out);
  }
}

}  // namespace snapthrough
