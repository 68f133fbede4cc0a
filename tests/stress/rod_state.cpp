#include "tests/stress/rod_state.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace snapthrough::testing {
namespace {

using Eigen::Vector3d;

constexpr double kEps = std::numeric_limits<double>::epsilon();
/// Displacement gradients of a converged point: the solver's documented criterion is 1e-9 of a step, and a
/// step's norm is a root mean square, which one Gauss point may exceed tenfold.
constexpr double kConverged = 1e-8;
/// What the same criterion leaves of a force or a lever arm, relative: a residual is the tangent times the
/// error of the displacements, and the tangent holds the section forces.
constexpr double kConvergedForce = 1e-9;
/// Positions are a sum of three terms each rounded; a few units in the last place.
constexpr double kUlps = 4.0;

class Evaluation {
 public:
  Evaluation(const RodModel& rod, const State& state, double closer, double imperfection)
      : rod_(rod), state_(state), closer_(closer), force_share_(kConvergedForce + imperfection) {}
  RodState run();

 private:
  void shape(const RodElement& element, ElementState& out);
  void collect(const RodElement& element, ElementState& out) const;
  void collect_strip(const RodElement& element, const RodStrip& strip, ElementState& out) const;
  [[nodiscard]] double penetration(const RodElement& element, const RodStrip& strip, double xi,
                                   const ElementState& at) const;
  [[nodiscard]] double rounding_of(const RodElement& element, const Functional& row) const;
  [[nodiscard]] Functional actions(const RodElement& element, const ElementState& at) const;
  void reported_force(int m);
  void member(int m);
  void pass();
  void fit_end_forces();
  void forces(const RodElement& element, ElementState& at, Vector3d& m);
  void strains(const RodElement& element, const ElementState& at, int index);
  void joints();
  void note(double value, double tolerance, const std::string& what);

  const RodModel& rod_;
  const State& state_;
  double closer_;       ///< to one-sided supports, in roundings
  double force_share_;  ///< of a force or a lever arm that may be left
  RodState out_;
  double noise_ = 0.0;  ///< of a displacement
  double turn_noise_ = 0.0;
  double largest_force_ = 0.0;
  std::vector<double> values_, tolerances_;  ///< of all equations in turn
};

void Evaluation::note(double value, double tolerance, const std::string& what) {
  values_.push_back(value);
  tolerances_.push_back(tolerance);
  const double ratio = std::isfinite(value) ? std::abs(value) / tolerance : 1e300;
  if (ratio <= out_.residual) return;
  out_.residual = ratio;
  out_.worst = what + " off by " + std::to_string(std::log10(std::abs(value))) + " (log10), tolerance " +
               std::to_string(std::log10(tolerance));
}

double value_of(const Functional& f, const MatrixXd& u) {
  double w = f.a.dot(u.row(0));
  for (Eigen::Index q = 0; q < f.v.cols(); ++q) w += f.v.col(q).dot(u.row(q + 1));
  return w;
}

void Evaluation::shape(const RodElement& element, ElementState& out) {
  const MemberState& m = state_.members[element.member];
  const auto& axis = rod_.members[element.member].sampled;
  const auto n = static_cast<Eigen::Index>(element.samples.size());
  MatrixXd sampled(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int k = element.samples[i];
    sampled(i, 0) = (m.x[k] - rod_.origin[0] - axis[k].x) / rod_.length;
    sampled(i, 1) = (m.y[k] - rod_.origin[1] - axis[k].y) / rod_.length;
    sampled(i, 2) = m.rotation[k];
  }
  out.u = element.fit * sampled;
  const MatrixXd off = element.basis * out.u - sampled;
  const VectorXd gain = element.fit.cwiseAbs().rowwise().sum();
  const double fit_gain = element.basis.cwiseAbs().rowwise().sum().maxCoeff() * gain.maxCoeff();
  for (int c = 0; c < 3; ++c)
    out_.roughness = std::max(out_.roughness, off.col(c).cwiseAbs().maxCoeff() /
                                                  ((c < 2 ? noise_ : turn_noise_) * (1.0 + fit_gain)));
  const Eigen::Index p = rod_.lagrange.order();
  out.gradient_noise = noise_ * gain.tail(p);
  out.turn_noise = turn_noise_ * gain.tail(p);
  out.cos.resize(p);
  out.sin.resize(p);
  for (Eigen::Index q = 0; q < p; ++q) {
    const VectorXd a = element.h * rod_.lagrange.integrals(rod_.lagrange.rule().points[q]);
    const double th = element.angle[q] + out.u(0, 2) + a.dot(out.u.col(2).tail(p));
    out.cos[q] = std::cos(th);
    out.sin[q] = std::sin(th);
  }
  const VectorXd x = element.tx + out.u.col(0).tail(p);
  const VectorXd y = element.ty + out.u.col(1).tail(p);
  out.E = x.cwiseProduct(out.cos) + y.cwiseProduct(out.sin);
  out.G = y.cwiseProduct(out.cos) - x.cwiseProduct(out.sin);
}

double Evaluation::penetration(const RodElement& element, const RodStrip& strip, double xi,
                               const ElementState& at) const {
  const Functional row = functional_at(rod_, element, xi, direction_of(rod_, element, strip, xi));
  const double depth = value_of(row, at.u) - strip.gap;
  return closer_ == 0.0 ? depth : depth + closer_ * rounding_of(element, row);
}

/// Where f is extreme in [a, b] on the side of `toward` zero, by golden sections.
template <class Function>
double extremum(const Function& f, double a, double b, bool from_above) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const double sign = from_above ? 1.0 : -1.0;
  for (int it = 0; it < 60; ++it) {
    const double left = b - ratio * (b - a);
    const double right = a + ratio * (b - a);
    (sign * f(left) < sign * f(right) ? b : a) = sign * f(left) < sign * f(right) ? right : left;
  }
  return 0.5 * (a + b);
}

/// Places in [lo, hi] where f changes its sign, ascending; pairs between samples are found by the extrema.
template <class Function>
std::vector<double> sign_changes(const Function& f, double lo, double hi, int cells) {
  // cosine spacing: beside an end an extremum has samples on one side only
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i)
    x.push_back(lo + (hi - lo) * (0.5 - 0.5 * std::cos(std::numbers::pi * i / cells)));
  x.back() = hi;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double g = f(x[i]);
    const bool above = g > 0.0;
    if (std::abs(g) > std::min(std::abs(f(x[i - 1])), std::abs(f(x[i + 1])))) continue;
    if ((f(x[i - 1]) > 0.0) != above || (f(x[i + 1]) > 0.0) != above) continue;
    const double at = extremum(f, x[i - 1], x[i + 1], above);
    if ((f(at) > 0.0) == above) continue;
    x.insert(x.begin() + static_cast<std::ptrdiff_t>(i) + (at > x[i] ? 1 : 0), at);
    i += 2;
  }
  std::vector<double> out;
  for (std::size_t i = 1; i < x.size(); ++i) {
    double a = x[i - 1];
    double b = x[i];
    const bool before = f(a) > 0.0;
    if ((f(b) > 0.0) == before) continue;
    for (int it = 0; it < 60; ++it) {
      const double mid = 0.5 * (a + b);
      ((f(mid) > 0.0) == before ? a : b) = mid;
    }
    out.push_back(a);
  }
  return out;
}

/// Springs at the Gauss points of the intervals in which the strip is pressed.
void Evaluation::collect_strip(const RodElement& element, const RodStrip& strip, ElementState& out) const {
  const int p = rod_.lagrange.order();
  const auto depth = [&](double xi) { return penetration(element, strip, xi, out); };
  const bool first = depth(strip.lo) > 0.0;
  std::vector<double> edges = sign_changes(depth, strip.lo, strip.hi, 12 * p + 12);
  edges.insert(edges.begin(), strip.lo);
  edges.push_back(strip.hi);
  const Rule rule = gauss(std::max(p + 2, 5));
  for (std::size_t k = first ? 0 : 1; k + 1 < edges.size(); k += 2) {
    const double width = edges[k + 1] - edges[k];
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const double xi = edges[k] + width * rule.points[i];
      RodSpring spring;
      spring.row = functional_at(rod_, element, xi, direction_of(rod_, element, strip, xi));
      spring.stiffness = strip.modulus * element.h * width * rule.weights[i];
      spring.gap = strip.gap;
      out.acting.push_back(spring);
    }
  }
}

void Evaluation::collect(const RodElement& element, ElementState& out) const {
  for (const RodSpring& spring : element.springs)
    if (!spring.one_sided ||
        value_of(spring.row, out.u) + closer_ * rounding_of(element, spring.row) > spring.gap)
      out.acting.push_back(spring);
  for (const RodStrip& strip : element.strips) collect_strip(element, strip, out);
}

/// Gradient of supports' energy less loads' work by u_a and u'_q.
Functional Evaluation::actions(const RodElement& element, const ElementState& at) const {
  const Eigen::Index p = rod_.lagrange.order();
  Functional r{Vector3d::Zero(), MatrixXd::Zero(3, p)};
  double pressure = 0.0;
  for (int k = 0; k < 2; ++k) {
    r.a -= factor(k, state_.load_factor) * element.load[k].a;
    r.v -= factor(k, state_.load_factor) * element.load[k].v;
    pressure += factor(k, state_.load_factor) * element.pressure[k];
  }
  for (const RodSpring& spring : at.acting) {
    const double force = spring.stiffness * (value_of(spring.row, at.u) - spring.gap);
    r.a += force * spring.row.a;
    r.v += force * spring.row.v;
  }
  if (pressure == 0.0) return r;
  const Rule& rule = rod_.lagrange.rule();
  for (Eigen::Index q = 0; q < p; ++q) {
    const double w = pressure * element.h * rule.weights[q];
    const Vector3d push(w * (element.ty[q] + at.u(q + 1, 1)), -w * (element.tx[q] + at.u(q + 1, 0)), 0.0);
    const Functional f = functional_at(rod_, element, rule.points[q], push);
    r.a -= f.a;
    r.v -= f.v;
  }
  return r;
}

/// What the rounding of the samples leaves of a displacement that is read from the fitted polynomials.
double Evaluation::rounding_of(const RodElement& element, const Functional& row) const {
  double rounding = 0.0;
  for (Eigen::Index c = 0; c < 3; ++c) {
    Eigen::RowVectorXd share = row.a[c] * element.fit.row(0);
    share += row.v.row(c) * element.fit.bottomRows(row.v.cols());
    rounding += (c < 2 ? noise_ : turn_noise_) * share.lpNorm<1>();
  }
  return rounding;
}

/// Section forces at the Gauss points from the force m through the end; m becomes that at the start.
void Evaluation::forces(const RodElement& element, ElementState& at, Vector3d& m) {
  const Functional r = actions(element, at);
  const Eigen::Index p = rod_.lagrange.order();
  const Rule& rule = rod_.lagrange.rule();
  at.N.resize(p);
  at.Q.resize(p);
  VectorXd turn(p);
  for (Eigen::Index q = 0; q < p; ++q) {
    const double hb = element.h * rule.weights[q];
    const double fx = m[0] - r.v(0, q) / hb;
    const double fy = m[1] - r.v(1, q) / hb;
    at.N[q] = fx * at.cos[q] + fy * at.sin[q];
    at.Q[q] = fy * at.cos[q] - fx * at.sin[q];
    turn[q] = hb * (at.N[q] * at.G[q] - at.Q[q] * at.E[q]);
  }
  at.M = VectorXd::Constant(p, m[2]);
  for (Eigen::Index s = 0; s < p; ++s) {
    const VectorXd a = element.h * rod_.lagrange.integrals(rule.points[s]);
    for (Eigen::Index q = 0; q < p; ++q) at.M[q] -= turn[s] * a[q] / (element.h * rule.weights[q]);
  }
  for (Eigen::Index q = 0; q < p; ++q) at.M[q] -= r.v(2, q) / (element.h * rule.weights[q]);
  double noise = 0.0;
  for (const RodSpring& spring : at.acting) noise += spring.stiffness * rounding_of(element, spring.row);
  at.force_noise += noise + force_share_ * (m.head<2>().norm() + r.a.head<2>().norm());
  at.moment_noise += at.force_noise * element.h + force_share_ * std::abs(m[2]) +
                     m.head<2>().norm() * (noise_ + element.h * at.gradient_noise.maxCoeff());
  m -= r.a;
  m[2] -= turn.sum();
  largest_force_ = std::max(largest_force_, m.head<2>().norm());
}

void Evaluation::strains(const RodElement& element, const ElementState& at, int index) {
  const std::string where = " in element " + std::to_string(index);
  double strain = 0.0;
  double curvature = 0.0;
  for (int k = 0; k < 2; ++k) {
    strain += factor(k, state_.load_factor) * element.strain[k];
    curvature += factor(k, state_.load_factor) * element.curvature[k];
  }
  for (Eigen::Index q = 0; q < at.N.size(); ++q) {
    const double j = element.stretch[q];
    const double size = std::hypot(element.tx[q], element.ty[q]);
    const double rounding = at.gradient_noise[q] + 10.0 * kEps * size + turn_noise_ * size;
    note(at.E[q] - element.e0[q] - j * element.axial * at.N[q] - size * strain,
         kConverged + rounding + j * element.axial * at.force_noise, "axial strain" + where);
    note(at.G[q] - element.g0[q] - j * element.shear * at.Q[q],
         kConverged + rounding + j * element.shear * at.force_noise, "shear strain" + where);
    note(at.u(q + 1, 2) - j * element.bending * at.M[q] - size * curvature,
         kConverged / element.h + at.turn_noise[q] + j * element.bending * at.moment_noise,
         "bending strain" + where);
  }
}

void Evaluation::reported_force(int m) {
  const MemberState& s = state_.members[m];
  const std::size_t i = s.x.size() - 1;
  const double th = rod_.members[m].sampled[i].angle + s.rotation[i];
  out_.end_force[m] = Vector3d(s.axial_force[i] * std::cos(th) - s.shear_force[i] * std::sin(th),
                               s.axial_force[i] * std::sin(th) + s.shear_force[i] * std::cos(th),
                               s.bending_moment[i] / rod_.length) /
                      rod_.force;
}

void Evaluation::member(int m) {
  Vector3d force = out_.end_force[m];
  largest_force_ = std::max(largest_force_, force.head<2>().norm());
  double force_noise = 0.0;
  double moment_noise = 0.0;
  for (int e = rod_.mesh.first[m + 1] - 1; e >= rod_.mesh.first[m]; --e) {
    ElementState& at = out_.elements[e];
    at.force_noise = force_noise;
    at.moment_noise = moment_noise;
    forces(rod_.elements[e], at, force);
    force_noise = at.force_noise;
    moment_noise = at.moment_noise;
    strains(rod_.elements[e], at, e);
  }
  out_.start_force[m] = force;
}

/// All equations with the end forces at hand.
void Evaluation::pass() {
  values_.clear();
  tolerances_.clear();
  out_.residual = 0.0;
  for (std::size_t m = 0; m < rod_.members.size(); ++m) member(static_cast<int>(m));
  joints();
}

/// End forces with which the equations, all affine in them, are met best.
void Evaluation::fit_end_forces() {
  pass();
  const auto count = static_cast<Eigen::Index>(values_.size());
  const VectorXd base = Eigen::Map<VectorXd>(values_.data(), count);
  const VectorXd weight = Eigen::Map<VectorXd>(tolerances_.data(), count).cwiseInverse();
  if (!base.allFinite()) return;
  const double unit = 1.0 + largest_force_;
  const double largest = largest_force_;
  MatrixXd slope(base.size(), static_cast<Eigen::Index>(3 * rod_.members.size()));
  for (Eigen::Index k = 0; k < slope.cols(); ++k) {
    double& force = out_.end_force[static_cast<std::size_t>(k / 3)][k % 3];
    const double before = force;
    force += unit;
    pass();
    slope.col(k) = weight.cwiseProduct(Eigen::Map<VectorXd>(values_.data(), count) - base);
    force = before;
  }
  const VectorXd change = slope.colPivHouseholderQr().solve(-weight.cwiseProduct(base));
  for (Eigen::Index k = 0; k < slope.cols(); ++k)
    out_.end_force[static_cast<std::size_t>(k / 3)][k % 3] += unit * change[k];
  largest_force_ = largest;
  pass();
}

/// Nodes: displacements of the members that meet and of supports, equilibrium in the free directions.
void Evaluation::joints() {
  std::vector<Vector3d> u(rod_.nodes.size(), Vector3d::Constant(std::nan("")));
  std::vector<Vector3d> sum(rod_.nodes.size(), Vector3d::Zero());
  double noise = 0.0;
  const auto meet = [&](int node, const Vector3d& at, bool released) {
    for (int c = 0; c < (released ? 2 : 3); ++c) {
      if (std::isnan(u[node][c])) u[node][c] = at[c];
      note(u[node][c] - at[c], kConverged + 100.0 * (noise_ + turn_noise_), "joint " + std::to_string(node));
    }
  };
  for (std::size_t m = 0; m < rod_.members.size(); ++m) {
    const RodMember& member = rod_.members[m];
    const RodElement& last = rod_.elements[rod_.mesh.first[m + 1] - 1];
    const ElementState& at = out_.elements[rod_.mesh.first[m + 1] - 1];
    const ElementState& begin = out_.elements[rod_.mesh.first[m]];
    const VectorXd weights =
        last.h * Eigen::Map<const VectorXd>(rod_.lagrange.rule().weights.data(), rod_.lagrange.order());
    const Vector3d end = at.u.row(0).transpose() + at.u.bottomRows(weights.size()).transpose() * weights;
    meet(member.start, begin.u.row(0).transpose(), member.release_start);
    meet(member.end, end, member.release_end);
    sum[member.start] -= out_.start_force[m];
    sum[member.end] += out_.end_force[m];
    noise = std::max(noise, begin.force_noise + begin.moment_noise);
    const double scale = kConverged * (1.0 + largest_force_) + begin.moment_noise;
    if (member.release_start) note(out_.start_force[m][2], scale, "released moment");
    if (member.release_end) note(out_.end_force[m][2], scale, "released moment");
  }
  for (const NodeSpring& spring : rod_.node_springs) {
    const double w = spring.row.dot(u[spring.node].array().isNaN().select(0.0, u[spring.node])) - spring.gap;
    noise = std::max(noise, spring.stiffness * (noise_ + turn_noise_) * 100.0);
    if (!spring.one_sided || w > 0.0) sum[spring.node] += spring.stiffness * w * spring.row;
  }
  for (std::size_t n = 0; n < rod_.nodes.size(); ++n) {
    const RodNode& node = rod_.nodes[n];
    Vector3d load = Vector3d::Zero();
    Vector3d held = Vector3d::Zero();
    for (int k = 0; k < 2; ++k) {
      load += factor(k, state_.load_factor) * node.load[k];
      held += factor(k, state_.load_factor) * node.displacement[k];
    }
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() << std::cos(node.angle), std::sin(node.angle), -std::sin(node.angle),
        std::cos(node.angle);
    // a node whose members are all released has a rotation of its own that nothing shows
    const bool turning = !std::isnan(u[n][2]);
    if (!turning) u[n][2] = 0.0;
    const Vector3d over = turn * (sum[n] - load);
    const Vector3d moved = turn * u[n];
    for (int c = 0; c < 3; ++c) {
      if (!turning && c == 2) continue;
      if (node.fixed[c])
        note(moved[c] - held[c], kConverged + 100.0 * (noise_ + turn_noise_), "support " + std::to_string(n));
      else
        note(over[c], kConverged * (1.0 + largest_force_ + load.norm()) + noise,
             "equilibrium of node " + std::to_string(n));
    }
  }
}

RodState Evaluation::run() {
  double x = rod_.extent;
  double b = 1.0;
  for (const MemberState& m : state_.members)
    for (std::size_t i = 0; i < m.x.size(); ++i) {
      x = std::max({x, std::abs(m.x[i]) / rod_.length, std::abs(m.y[i]) / rod_.length});
      b = std::max(b, std::abs(m.rotation[i]));
    }
  noise_ = kUlps * kEps * x;
  turn_noise_ = kUlps * kEps * b;
  out_.elements.resize(rod_.elements.size());
  out_.start_force.resize(rod_.members.size());
  out_.end_force.resize(rod_.members.size());
  for (std::size_t e = 0; e < rod_.elements.size(); ++e) {
    shape(rod_.elements[e], out_.elements[e]);
    collect(rod_.elements[e], out_.elements[e]);
  }
  for (std::size_t m = 0; m < rod_.members.size(); ++m) reported_force(static_cast<int>(m));
  pass();
  if (out_.residual > 1.0) {
    const double reported = out_.residual;
    const std::string worst = out_.worst;
    for (int round = 0; round < 2; ++round) fit_end_forces();  // tolerances move with the forces
    if (!rod_.concentrated && out_.residual <= 1.0) {
      out_.reported_force = reported;
      out_.worst = worst;
    }
  }
  return std::move(out_);
}

}  // namespace

RodState evaluate(const RodModel& rod, const State& state, double closer, double imperfection) {
  return Evaluation(rod, state, closer, imperfection).run();
}

}  // namespace snapthrough::testing
