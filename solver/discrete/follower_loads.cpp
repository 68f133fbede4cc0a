#include "solver/discrete/follower_loads.h"

#include <cmath>
#include <utility>

#include "solver/numeric/dense.h"

namespace snapthrough {

using Eigen::VectorXd;

namespace {

using Vec2 = std::array<double, 2>;
using Vec3 = Eigen::Vector3d;  ///< motion (u, v, b) of a place, or force and moment on it

/// Displacement of an end.
Vec2 displacement(const FollowerEnd& end, const Eigen::Ref<const VectorXd>& x) {
  Vec2 out{0.0, 0.0};
  for (const FollowerEnd::Term& term : end.terms) {
    out[0] += term.weight * x[term.x];
    out[1] += term.weight * x[term.y];
  }
  return out;
}

/// Motion of the place of a force.
Vec3 motion(const FollowerForce& force, const Eigen::Ref<const VectorXd>& x) {
  Vec3 out = Vec3::Zero();
  for (const FollowerForce::Term& term : force.terms)
    out += term.weight * Vec3(x[term.x], x[term.y], x[term.turn]);
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

/// Force and moment (x, y, rotation) that a force which follows its place, or stays on its line, exerts on
/// the place beyond the dead force F.
/// @param at displacement and rotation of the place
Vec3 added(const FollowerForce& force, const Vec2& F, const Vec3& at) {
  if (force.fixed_line) return {0.0, 0.0, at[1] * F[0] - at[0] * F[1]};
  const Vec2 now = turned(F, at[2]);
  return {now[0] - F[0], now[1] - F[1], 0.0};
}

/// Derivative of the force that a following load adds by the displacement and rotation of its place, a matrix
/// of rank one: left right^T.
struct Derivative {
  Vec3 left, right;
};

Derivative derivative(const FollowerForce& force, const Vec2& F, const Vec3& at) {
  if (force.fixed_line) return {{0.0, 0.0, 1.0}, {-F[1], F[0], 0.0}};
  const Vec2 now = turned(F, at[2]);
  return {{-now[1], now[0], 0.0}, {0.0, 0.0, 1.0}};
}

/// Derivative of `left` by the motion along a direction; `right` is constant.
Vec3 change_of_left(const FollowerForce& force, const Vec2& F, const Vec3& at, const Vec3& along) {
  if (force.fixed_line) return Vec3::Zero();
  const Vec2 now = turned(F, at[2]);
  return -along[2] * Vec3(now[0], now[1], 0.0);
}

double amount(const FollowerEnd& end, const LoadFactors& factors) {
  return factors.proportional * end.proportional + factors.constant * end.constant;
}

void add_at(const FollowerForce& force, const Vec3& amount, Eigen::Ref<VectorXd>& out) {
  for (const FollowerForce::Term& term : force.terms) {
    out[term.x] += term.weight * amount[0];
    out[term.y] += term.weight * amount[1];
    out[term.turn] += term.weight * amount[2];
  }
}

SparseColumn column_of(const FollowerForce& force, const Vec3& amount) {
  SparseColumn out;
  for (const FollowerForce::Term& term : force.terms)
    for (const auto& [row, value] :
         {std::pair{term.x, amount[0]}, std::pair{term.y, amount[1]}, std::pair{term.turn, amount[2]}})
      if (value != 0.0) out.emplace_back(row, term.weight * value);
  return out;
}

/// Columns of L and R.
struct Columns {
  std::vector<SparseColumn> left, right;
};

void append(const FollowerEnd& end, double c, Columns& out) {
  for (const bool along_x : {true, false}) {
    SparseColumn& left = out.left.emplace_back();
    SparseColumn& right = out.right.emplace_back();
    for (const FollowerEnd::Term& term : end.terms) {
      left.emplace_back(along_x ? term.x : term.y, term.weight);
      right.emplace_back(along_x ? term.y : term.x, (along_x ? -c : c) * term.weight);
    }
  }
}

/// The residual is minus the load.
void append(const FollowerForce& force, const Derivative& load, Columns& out) {
  out.left.push_back(column_of(force, -load.left));
  out.right.push_back(column_of(force, load.right));
}

}  // namespace

double FollowerLoads::prepare(const VectorXd& y, const LoadFactors& factors,
                              const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve) {
  Columns columns;
  for (const FollowerEnd& end : ends_) append(end, amount(end, factors), columns);
  for (const FollowerForce& force : forces_)
    append(force, derivative(force, amount(force, factors), motion(force, y)), columns);
  if (transposed_) std::swap(columns.left, columns.right);
  return determinant(part_.prepare(columns.left, std::move(columns.right), y.size(), solve));
}

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
  for (const FollowerForce& force : forces_) {
    const Derivative load = derivative(force, amount(force, factors), motion(force, y));
    add_at(force, -load.right.dot(motion(force, direction)) * load.left, out);
  }
}

void FollowerLoads::add_change(const VectorXd& y, const LoadFactors& factors, const LoadFactors& rates,
                               const VectorXd& along, const Eigen::Ref<const VectorXd>& direction,
                               Eigen::Ref<VectorXd> out) const {
  add_product(y, rates, direction, out);
  for (const FollowerForce& force : forces_) {
    const Vec2 F = amount(force, factors);
    const Vec3 at = motion(force, y);
    const double moved = derivative(force, F, at).right.dot(motion(force, direction));
    add_at(force, -moved * change_of_left(force, F, at, motion(force, along)), out);
  }
}

void FollowerLoads::add_load(const VectorXd& y, const LoadFactors& factors, Eigen::Ref<VectorXd> out) const {
  for (const FollowerForce& force : forces_)
    add_at(force, added(force, amount(force, factors), motion(force, y)), out);
}

}  // namespace snapthrough
