#include "solver/events/damped_motions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "solver/numeric/dense.h"
#include "solver/numeric/gauss_rule.h"

namespace snapthrough {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Imaginary part of s over its magnitude below which a vibration counts as not oscillating.
constexpr double kOscillates = 1e-6;

/// Y^T K X: section forces of the motions times their strains, and moments of joints times their rotations.
/// Laws of sections and joints have their slope at the origin, so that damping never excites.
MatrixXd elastic_work(const Structure& structure, const MatrixXd& Y, const MatrixXd& X) {
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const int p = rule.order();
  MatrixXd out = MatrixXd::Zero(Y.cols(), X.cols());
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
    const ElementShape shape = shape_of_element(structure, static_cast<int>(e));
    const Index s = structure.dofs[e].s;
    const Index v = structure.dofs[e].v;
    for (int q = 0; q < p; ++q) {
      const double hb = shape.length * rule.weight(q);
      const double compliance[] = {shape.axial_compliance[q], shape.shear_compliance[q],
                                   shape.bending_compliance[q]};
      // with a bending law, moments are those of the slope at the state: curvatures take their place
      const bool bends = shape.bending != nullptr;
      if (bends) out += hb / compliance[2] * Y.row(v + 2 * p + q).transpose() * X.row(v + 2 * p + q);
      for (int c = 0; c < (bends ? 2 : 3); ++c)
        out += hb * compliance[c] * Y.row(s + c * p + q).transpose() * X.row(s + c * p + q);
    }
  }
  for (const JointSpring& joint : structure.joints)
    out += joint.law.stiffness * (Y.row(joint.node_rotation) - Y.row(joint.end_rotation)).transpose() *
           (X.row(joint.node_rotation) - X.row(joint.end_rotation));
  return out;
}

/// B of J X = M X B for the columns of natural motions.
MatrixXd action_of(const NaturalMotions& motions) {
  const auto n = static_cast<Index>(motions.squares.size());
  MatrixXd out = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    const std::complex<double> mu = motions.squares[static_cast<std::size_t>(i)];
    out(i, i) = mu.real();
    const bool first =
        i + 1 < n && mu.imag() != 0.0 && motions.squares[static_cast<std::size_t>(i) + 1] == std::conj(mu);
    if (!first) continue;
    // x = a + i b: J a = Re(mu) M a - Im(mu) M b, J b = Im(mu) M a + Re(mu) M b
    out(i + 1, i + 1) = mu.real();
    out(i + 1, i) = -mu.imag();
    out(i, i + 1) = mu.imag();
    ++i;
  }
  return out;
}

}  // namespace

GrowingMotion most_growing(const Structure& structure, const MassMatrix& masses, const NaturalMotions& right,
                           const NaturalMotions& left) {
  const ResolvedModel& model = *structure.model;
  const MatrixXd& X = right.motions;
  const MatrixXd& Y = left.motions;
  const Index n = X.cols();
  const double unit = std::sqrt(masses.square);  // unit of frequencies
  const MatrixXd M = Y.transpose() * mass_products(structure, masses, X);
  const MatrixXd C =
      model.damping.mass / unit * M + model.damping.stiffness * unit * elastic_work(structure, Y, X);
  MatrixXd companion = MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -action_of(right);
  companion.bottomRightCorner(n, n) = -solve_row_pivoting(M, C);
  const ComplexEigen found = complex_eigen(companion);
  GrowingMotion out{-std::numeric_limits<double>::infinity(), 0.0};
  for (const std::complex<double>& s : found.values) {
    const double growth = s.real() / std::abs(s);
    if (std::abs(s.imag()) > kOscillates * std::abs(s) && growth > out.growth) out = {growth, std::norm(s)};
  }
  return out;
}

}  // namespace snapthrough
