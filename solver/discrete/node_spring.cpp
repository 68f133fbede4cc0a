#include "solver/discrete/node_spring.h"

#include <cmath>

#include "solver/numeric/rounding.h"

namespace snapthrough {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

NodeSpring::Chord NodeSpring::chord(const Vector3d& r) const {
  Vector3d along = length * sense * direction() - r;
  along[2] = 0.0;
  const double now = along.norm();
  along /= now;
  return {along, {-along[1], along[0], 0.0}, now};
}

/// With e along the rod and n across it, dl/dr = -e and d2l/dr2 = n n^T / l.
SpringMotion NodeSpring::motion(const Eigen::Ref<const VectorXd>& y, bool small_displacements) const {
  const Vector3d r = relative(y);
  SpringMotion out{linear(y), direction(), Matrix3d::Zero()};
  if (!is_rod() || small_displacements) return out;
  const auto [e, n, l] = chord(r);
  // the shortening L - l as (L^2 - l^2) / (L + l), with the initial length L and the present length l, has
  // all digits of small displacements
  const double along = direction().dot(r);
  out.w = (2.0 * length * along - sense * r.head<2>().squaredNorm()) / (length + l) + pretensioned(y);
  out.gradient = sense * e;
  out.curvature = -sense / l * n * n.transpose();
  return out;
}

/// With a the change of r, e turns at the rate -n.a / l, and l changes at the rate -e.a.
Matrix3d NodeSpring::curvature_change(const Eigen::Ref<const VectorXd>& y,
                                      const Eigen::Ref<const VectorXd>& along) const {
  const auto [e, n, l] = chord(relative(y));
  const Vector3d a = relative(along);
  const Matrix3d mixed = e * n.transpose();
  return -sense / (l * l) * (e.dot(a) * (n * n.transpose()) + n.dot(a) * (mixed + mixed.transpose()));
}

Catenary::Ends NodeSpring::change_of_ends(const Eigen::Ref<const VectorXd>& along) const {
  return {-relative(along).head<2>(), without_force >= 0 ? -along[without_force] : 0.0};
}

Catenary::Ends NodeSpring::ends(const Eigen::Ref<const VectorXd>& y) const {
  Catenary::Ends out = change_of_ends(y);
  out.chord += length * direction().head<2>();
  return out;
}

bool NodeSpring::acts(double w) const {
  if (!law.one_sided) return true;
  const bool is_known = touch != Touch::none && std::abs(w - law.gap) <= Rounding::touching;
  return is_known ? touch == Touch::acts : w > law.gap;
}

NodeSpring node_spring(const SpringLaw& law, int node, int to) {
  NodeSpring out;
  out.node = node;
  out.to = to;
  out.row = law.row;
  out.sense = law.sense;
  out.length = law.length;
  out.law = law.law;
  out.force_unknown = law.force_unknown;
  out.give = law.give;
  out.cable = law.cable;
  out.drawn_pull = {law.drawn_pull[0], law.drawn_pull[1]};
  out.without_force = law.without_force;
  return out;
}

}  // namespace snapthrough
