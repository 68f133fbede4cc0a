#include "tests/stress/rod_state.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "tests/stress/sign_changes.h"

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
/// Depth in a stop, over the longest member, under a force of EI / length^2: a hundred times what it gives
/// way where that force moves members by their length.
constexpr double kStopGivesWay = 1e-6;
/// Positions are a sum of three terms each rounded; a few units in the last place.
constexpr double kUlps = 4.0;

/// Part [from, to] of a strip on which it acts and its law is smooth.
struct StripPiece {
  const RodElement& element;
  const RodStrip& strip;
  double from, to;
  Rule rule;
};

/// End of a member with a rotation of its own.
struct TurningEnd {
  int node;
  const RodJoint& joint;
  double& stiffness;  ///< of the joint in this state
  double rotation;
  double moment;  ///< derivative of the member's energy by the rotation
  double noise;   ///< of the moment
};

/// What members and springs bring to the nodes.
struct NodeSums {
  std::vector<Vector3d> force;
  std::vector<TurningEnd> ends;
  double noise = 0.0;
};

class Evaluation {
 public:
  Evaluation(const RodModel& rod, const State& state, double closer, double imperfection)
      : rod_(rod), state_(state), closer_(closer), force_share_(kConvergedForce + imperfection) {}
  RodState run();

 private:
  void shape(const RodElement& element, ElementState& out);
  void collect(const RodElement& element, ElementState& out);
  void collect_strip(const RodElement& element, const RodStrip& strip, ElementState& out) const;
  void collect_piece(const StripPiece& piece, int halvings, ElementState& out) const;
  [[nodiscard]] std::vector<ActingSupport> supports_on(const StripPiece& piece, const ElementState& at) const;
  [[nodiscard]] double penetration(const RodElement& element, const RodStrip& strip, const RodSite& site,
                                   const ElementState& at) const;
  [[nodiscard]] ActingSupport stopped(const RodReaction& reaction, double w, double moved) const;
  void node_springs(NodeSums& sums);
  void reported_spring(const NodeSpring& spring, double w, double force);
  void bars(NodeSums& sums);
  void anchors();
  [[nodiscard]] double rounding_of(const RodElement& element, const Functional& row) const;
  [[nodiscard]] Functional actions(const RodElement& element, const ElementState& at) const;
  void push(const RodElement& element, const ElementState& at, const RodPressure& pressure,
            Functional& r) const;
  void meet_nodes(int m, NodeSums& sums);
  void turn_nodes(const NodeSums& sums);
  void joint_moments(const NodeSums& sums);
  void node_equations(std::size_t n, const NodeSums& sums);
  [[nodiscard]] Vector3d load_of(const std::array<Vector3d, 2>& patterns) const {
    return state_.load_factor * patterns[0] + patterns[1];
  }
  void reported_force(int m);
  void member(int m);
  void pass();
  void fit_end_forces();
  void forces(const RodElement& element, ElementState& at, Vector3d& m);
  void strains(const RodElement& element, ElementState& at, int index);
  void expand();
  /// A bending law in a state.
  struct Bending {
    VectorXd curvature;
    VectorXd noise;       ///< of the curvature, from that of the moment
    VectorXd compliance;  ///< derivative by the moment
  };
  [[nodiscard]] Bending bending(const RodElement& element, const ElementState& at, int index) const;
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
  std::vector<double> entered_;  ///< depths in the stops on elements
  /// Of elements with a bending law: moments about which the law is taken as a line; empty: it is not.
  std::vector<VectorXd> expanded_at_;
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
  const MemberState& m = state_.members[rod_.members[element.member].place];
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

double Evaluation::penetration(const RodElement& element, const RodStrip& strip, const RodSite& site,
                               const ElementState& at) const {
  if (closer_ == 0.0) return depth_at(strip, site, at.u);
  const StripDepth depth = depth_with_derivatives(strip, site, at.u);
  return depth.value + closer_ * rounding_of(element, depth.row);
}

/// Penetration of a law's kink at a fraction; without one, farther than displacements reach.
double kink_at(const LawAlong& law, double fraction, std::size_t kink) {
  const std::vector<double> at = law.at(fraction).kinks();
  return kink < at.size() ? at[kink] : 1e300;
}

/// Parts of a strip between the places at which it begins or ceases to act or its law has a kink.
/// @param depth displacement into the medium beyond the gap, at xi of the element; depths: at the strip's
/// samples
template <class Depth>
std::vector<std::array<double, 2>> smooth_parts(const RodElement& element, const RodStrip& strip,
                                                const Samples& depths, const Depth& depth) {
  std::vector<double> ends{strip.lo, strip.hi};
  const auto add = [&ends](const std::vector<double>& found) {
    ends.insert(ends.end(), found.begin(), found.end());
  };
  if (strip.one_sided) add(sign_changes(depth, depths));
  std::size_t kinks = 0;
  for (const double xi : depths.x)
    kinks = std::max(kinks, strip.law.at(fraction_at(element, xi)).kinks().size());
  for (std::size_t k = 0; k < kinks; ++k)
    for (const double sense : {1.0, -1.0}) {
      if (strip.one_sided && sense < 0.0) continue;
      const auto beyond = [&](double at, double xi) {
        return sense * at - kink_at(strip.law, fraction_at(element, xi), k) / strip.unit;
      };
      Samples moved = depths;
      for (std::size_t i = 0; i < moved.x.size(); ++i) moved.g[i] = beyond(depths.g[i], moved.x[i]);
      add(sign_changes([&](double xi) { return beyond(depth(xi), xi); }, std::move(moved)));
    }
  std::ranges::sort(ends);
  std::vector<std::array<double, 2>> out;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (ends[i + 1] > ends[i] && (!strip.one_sided || depth(0.5 * (ends[i] + ends[i + 1])) > 0.0))
      out.push_back({ends[i], ends[i + 1]});
  return out;
}

/// Supports at the Gauss points of the parts on which a strip acts. On a linear law the Gauss points are
/// exact; on others the parts are halved until their forces and stiffnesses do not change.
void Evaluation::collect_strip(const RodElement& element, const RodStrip& strip, ElementState& out) const {
  const int p = rod_.lagrange.order();
  const auto depth = [&](double xi) {
    return penetration(element, strip, site_of(rod_, element, strip, xi), out);
  };
  Samples depths;
  for (const RodSite& site : strip.sites) {
    depths.x.push_back(site.xi);
    depths.g.push_back(penetration(element, strip, site, out));
  }
  constexpr int kMostHalvings = 12;
  const bool is_linear = strip.law.is_linear() && !strip.surface;
  const Rule rule = is_linear ? gauss(std::max(p + 2, 5)) : gauss(p + 6);
  for (const auto& [from, to] : smooth_parts(element, strip, depths, depth))
    collect_piece({element, strip, from, to, rule}, is_linear ? 0 : kMostHalvings, out);
}

std::vector<ActingSupport> Evaluation::supports_on(const StripPiece& piece, const ElementState& at) const {
  const RodElement& element = piece.element;
  std::vector<ActingSupport> out;
  for (std::size_t i = 0; i < piece.rule.points.size(); ++i) {
    const double width = piece.to - piece.from;
    const double xi = piece.from + width * piece.rule.points[i];
    const StripDepth depth =
        depth_with_derivatives(piece.strip, site_of(rod_, element, piece.strip, xi), at.u);
    const double share = element.h * width * piece.rule.weights[i] * piece.strip.share;
    const RodReaction reaction{piece.strip.law.at(fraction_at(element, xi)), piece.strip.unit, share, 0.0,
                               piece.strip.one_sided};
    const double force = reaction.force(depth.value);
    const double near = depth.value + closer_ * rounding_of(element, depth.row);
    out.push_back({depth.row, force, reaction.slope(near)});
    if (depth.bend != 0.0) out.push_back({depth.across, 0.0, force * depth.bend});
  }
  return out;
}

/// Sums of sizes of forces and of stiffnesses.
std::array<double, 2> sums_of(const std::vector<ActingSupport>& supports) {
  std::array<double, 2> out{};
  for (const ActingSupport& s : supports) {
    out[0] += std::abs(s.force);
    out[1] += std::abs(s.stiffness);
  }
  return out;
}

void Evaluation::collect_piece(const StripPiece& piece, int halvings, ElementState& out) const {
  constexpr double kSame = 1e-11;
  std::vector<ActingSupport> whole = supports_on(piece, out);
  if (halvings > 0) {
    const double middle = 0.5 * (piece.from + piece.to);
    const StripPiece left{piece.element, piece.strip, piece.from, middle, piece.rule};
    const StripPiece right{piece.element, piece.strip, middle, piece.to, piece.rule};
    const std::array<double, 2> once = sums_of(whole);
    const std::array<double, 2> a = sums_of(supports_on(left, out));
    const std::array<double, 2> b = sums_of(supports_on(right, out));
    if (std::abs(a[0] + b[0] - once[0]) > kSame * once[0] ||
        std::abs(a[1] + b[1] - once[1]) > kSame * once[1]) {
      collect_piece(left, halvings - 1, out);
      collect_piece(right, halvings - 1, out);
      return;
    }
  }
  std::ranges::move(whole, std::back_inserter(out.acting));
}

/// Depth by which a displacement w enters a stop, per force; a length where the stop pulls.
double entered(const RodReaction& stop, const ActingSupport& acting, double w) {
  return acting.force < 0.0 ? 1.0 : std::max(w - stop.gap, 0.0) / (1.0 + acting.force);
}

/// Force of a stop, taken from the state under test, and its stiffness.
/// @param moved displacement w of the stop, moved towards contact by the rounding that the check allows
ActingSupport Evaluation::stopped(const RodReaction& reaction, double w, double moved) const {
  ActingSupport out;
  out.is_stop = true;
  out.force = reaction.share * reaction.stop->sense * state_.springs[reaction.stop->spring].force;
  const bool acts = closer_ == 0.0 ? out.force > 0.0 : moved > reaction.gap;
  out.stiffness = acts ? reaction.slope(w) : 0.0;
  return out;
}

void Evaluation::collect(const RodElement& element, ElementState& out) {
  for (const RodSpring& spring : element.springs) {
    const double w = value_of(spring.row, out.u);
    const double moved = w + closer_ * rounding_of(element, spring.row);
    if (spring.reaction.stop) {
      out.acting.push_back(stopped(spring.reaction, w, moved));
      out.acting.back().row = spring.row;
      entered_.push_back(entered(spring.reaction, out.acting.back(), w));
    } else if (spring.reaction.acts(moved)) {
      out.acting.push_back({spring.row, spring.reaction.force(w), spring.reaction.slope(moved)});
    }
  }
  for (const RodStrip& strip : element.strips) collect_strip(element, strip, out);
}

/// @brief Subtracts the work of a follower pressure p from the left, per unit of the displacements (v, w).
///
/// p (y' v - x' w) per length is the derivative of p times the swept area 1/2 (x y' - y x'), less its values
/// at the element's ends, and 1/2 p' (x w - y v). The integrals are sums over the Gauss points, as the
/// discretisation defines them; places are relative to the element's deformed start.
void Evaluation::push(const RodElement& element, const ElementState& at, const RodPressure& pressure,
                      Functional& r) const {
  const Rule& rule = rod_.lagrange.rule();
  const Eigen::Index p = rod_.lagrange.order();
  const VectorXd dx = element.tx + at.u.col(0).tail(p);
  const VectorXd dy = element.ty + at.u.col(1).tail(p);
  const auto act = [&](double xi, const Vector3d& force) {
    const Functional f = functional_at(rod_, element, xi, force);
    r.a -= f.a;
    r.v -= f.v;
  };
  for (Eigen::Index q = 0; q < p; ++q) {
    const double xi = rule.points[q];
    const VectorXd a = element.h * rod_.lagrange.integrals(xi);
    const double x = a.dot(dx);
    const double y = a.dot(dy);
    const double half = 0.5 * element.h * rule.weights[q] * pressure.at(xi);
    const double change = 0.5 * rule.weights[q] * (pressure.to - pressure.from);
    act(xi, {half * dy[q] - change * y, change * x - half * dx[q], 0.0});
    r.v(0, q) += half * y;
    r.v(1, q) -= half * x;
  }
  const VectorXd whole = element.h * Eigen::Map<const VectorXd>(rule.weights.data(), p);
  act(1.0, 0.5 * pressure.to * Vector3d(whole.dot(dy), -whole.dot(dx), 0.0));
}

/// Gradient of supports' energy less loads' work by u_a and u'_q.
Functional Evaluation::actions(const RodElement& element, const ElementState& at) const {
  const Eigen::Index p = rod_.lagrange.order();
  Functional r{Vector3d::Zero(), MatrixXd::Zero(3, p)};
  RodPressure pressure;
  for (int k = 0; k < 2; ++k) {
    r.a -= factor(k, state_.load_factor) * element.load[k].a;
    r.v -= factor(k, state_.load_factor) * element.load[k].v;
    pressure.from += factor(k, state_.load_factor) * element.pressure[k].from;
    pressure.to += factor(k, state_.load_factor) * element.pressure[k].to;
  }
  for (const ActingSupport& support : at.acting) {
    r.a += support.force * support.row.a;
    r.v += support.force * support.row.v;
  }
  if (pressure.from != 0.0 || pressure.to != 0.0) push(element, at, pressure, r);
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
  double couples = 0.0;
  for (const ActingSupport& support : at.acting) {
    if (support.is_stop) continue;
    const bool turns = support.row.a.head<2>().isZero(0.0) && support.row.a[2] != 0.0;
    (turns ? couples : noise) += std::abs(support.stiffness) * rounding_of(element, support.row);
  }
  at.force_noise += noise + force_share_ * (m.head<2>().norm() + r.a.head<2>().norm());
  at.moment_noise += couples + at.force_noise * element.h + force_share_ * std::abs(m[2]) +
                     m.head<2>().norm() * (noise_ + element.h * at.gradient_noise.maxCoeff());
  m -= r.a;
  m[2] -= turn.sum();
  largest_force_ = std::max(largest_force_, m.head<2>().norm());
}

/// Takes bending laws as lines through the moments that they give for the curvatures of the shape: then all
/// equations are affine in the forces, and met by the same ones.
void Evaluation::expand() {
  expanded_at_.resize(rod_.elements.size());
  for (std::size_t e = 0; e < rod_.elements.size(); ++e) {
    const RodElement& element = rod_.elements[e];
    if (!element.law) continue;
    const ElementState& at = out_.elements[e];
    VectorXd& moments = expanded_at_[e];
    moments.resize(at.M.size());
    for (Eigen::Index q = 0; q < moments.size(); ++q) {
      const double initial = state_.load_factor * element.curvature[0][q] + element.curvature[1][q];
      const double bent = at.u(q + 1, 2) - std::hypot(element.tx[q], element.ty[q]) * initial;
      moments[q] = element.law->moment_of(bent / element.stretch[q]);
    }
  }
}

/// One-sided supports that come closer stiffen the structure; so do bending laws within the noise of moments.
Evaluation::Bending Evaluation::bending(const RodElement& element, const ElementState& at, int index) const {
  if (!element.law)
    return {element.bending.cwiseProduct(at.M), element.bending * at.moment_noise, element.bending};
  const BendingCurvature& law = *element.law;
  Bending out{at.M, at.M, at.M};
  for (Eigen::Index q = 0; q < at.M.size(); ++q) {
    if (expanded_at_.empty()) {
      const auto [least, largest] = law.slopes_near(at.M[q], at.moment_noise);
      out.curvature[q] = law.at(at.M[q]);
      out.noise[q] = law.change(at.M[q], at.moment_noise);
      out.compliance[q] = closer_ == 0.0 ? law.slope(at.M[q]) : closer_ > 0.0 ? least : largest;
      continue;
    }
    const double moment = expanded_at_[static_cast<std::size_t>(index)][q];
    out.compliance[q] = law.slope(moment);
    out.curvature[q] = law.at(moment) + out.compliance[q] * (at.M[q] - moment);
    out.noise[q] = out.compliance[q] * at.moment_noise;
  }
  return out;
}

void Evaluation::strains(const RodElement& element, ElementState& at, int index) {
  const std::string where = " in element " + std::to_string(index);
  const Bending bent = bending(element, at, index);
  at.bending = bent.compliance;
  const VectorXd strain = state_.load_factor * element.strain[0] + element.strain[1];
  const VectorXd curvature = state_.load_factor * element.curvature[0] + element.curvature[1];
  for (Eigen::Index q = 0; q < at.N.size(); ++q) {
    const double j = element.stretch[q];
    const double size = std::hypot(element.tx[q], element.ty[q]);
    const double rounding = at.gradient_noise[q] + 10.0 * kEps * size + turn_noise_ * size;
    note(at.E[q] - element.e0[q] - j * element.axial[q] * at.N[q] - size * strain[q],
         kConverged + rounding + j * element.axial[q] * at.force_noise, "axial strain" + where);
    note(at.G[q] - element.g0[q] - j * element.shear[q] * at.Q[q],
         kConverged + rounding + j * element.shear[q] * at.force_noise, "shear strain" + where);
    note(at.u(q + 1, 2) - j * bent.curvature[q] - size * curvature[q],
         kConverged / element.h + at.turn_noise[q] + j * bent.noise[q], "bending strain" + where);
  }
}

void Evaluation::reported_force(int m) {
  const MemberState& s = state_.members[rod_.members[m].place];
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
  expand();
  pass();
  const auto count = static_cast<Eigen::Index>(values_.size());
  const VectorXd base = Eigen::Map<VectorXd>(values_.data(), count);
  const VectorXd weight = Eigen::Map<VectorXd>(tolerances_.data(), count).cwiseInverse();
  if (!base.allFinite()) {
    expanded_at_.clear();
    return;
  }
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
  expanded_at_.clear();
  pass();
}

/// Displacements of a member's ends meet those of its nodes, and its forces act on them.
void Evaluation::meet_nodes(int m, NodeSums& sums) {
  const RodMember& member = rod_.members[m];
  const RodElement& last = rod_.elements[rod_.mesh.first[m + 1] - 1];
  const ElementState& at = out_.elements[rod_.mesh.first[m + 1] - 1];
  const ElementState& begin = out_.elements[rod_.mesh.first[m]];
  const VectorXd weights =
      last.h * Eigen::Map<const VectorXd>(rod_.lagrange.rule().weights.data(), rod_.lagrange.order());
  const Vector3d end = at.u.row(0).transpose() + at.u.bottomRows(weights.size()).transpose() * weights;
  const auto meet = [&](int node, const Vector3d& u, bool at_end, const Vector3d& force) {
    const RodJoint& joint = at_end ? member.at_end : member.at_start;
    Vector3d& known = out_.nodes[node];
    for (int c = 0; c < (joint.turns ? 2 : 3); ++c) {
      if (std::isnan(known[c])) known[c] = u[c];
      note(known[c] - u[c], kConverged + 100.0 * (noise_ + turn_noise_), "joint " + std::to_string(node));
    }
    sums.force[node] += force;
    double& stiffness = out_.joint_stiffness[static_cast<std::size_t>(m)][at_end ? 1 : 0];
    if (joint.turns) sums.ends.push_back({node, joint, stiffness, u[2], force[2], begin.moment_noise});
  };
  meet(member.start, begin.u.row(0).transpose(), false, -out_.start_force[m]);
  meet(member.end, end, true, out_.end_force[m]);
  sums.noise = std::max(sums.noise, begin.force_noise + begin.moment_noise);
}

/// Where a falling function is zero, by halving an interval that grows around a place until it has the zero.
template <class Function>
double zero_of_falling(const Function& f, double near) {
  constexpr int kDoublings = 60;
  constexpr int kHalvings = 120;
  double width = 1e-3;
  for (int it = 0; it < kDoublings && !(f(near - width) >= 0.0 && f(near + width) <= 0.0); ++it) width *= 2.0;
  double lo = near - width;
  double hi = near + width;
  for (int it = 0; it < kHalvings; ++it) {
    const double middle = 0.5 * (lo + hi);
    (f(middle) > 0.0 ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

/// Rotations of nodes all of whose members are released: that of the support, or that with which the moments
/// of the joints carry the node's load. Where all members are hinged nothing shows the rotation.
/// @pre the laws of the joints at such a node do not fall, since the rotation would not be the only one
void Evaluation::turn_nodes(const NodeSums& sums) {
  for (std::size_t n = 0; n < rod_.nodes.size(); ++n) {
    double& rotation = out_.nodes[n][2];
    if (!std::isnan(rotation)) continue;
    std::vector<const TurningEnd*> joined;
    for (const TurningEnd& end : sums.ends)
      if (end.node == static_cast<int>(n) && end.joint.resists) joined.push_back(&end);
    const auto moment = [&](double at) {
      double sum = load_of(rod_.nodes[n].load)[2];
      for (const TurningEnd* end : joined) sum += end->joint.reaction.force(end->rotation - at);
      return sum;
    };
    if (rod_.nodes[n].fixed[2])
      rotation = load_of(rod_.nodes[n].displacement)[2];
    else if (!joined.empty())
      rotation = zero_of_falling(moment, joined.front()->rotation);
  }
}

/// Moments of the ends of members that turn against their nodes.
void Evaluation::joint_moments(const NodeSums& sums) {
  for (const TurningEnd& end : sums.ends) {
    const double relative = end.joint.resists ? end.rotation - out_.nodes[end.node][2] : 0.0;
    end.stiffness = end.joint.reaction.slope(relative);
    const double resisted = end.joint.reaction.force(relative);
    note(end.moment + resisted,
         kConverged * (1.0 + largest_force_) + end.noise + std::abs(end.stiffness) * turn_noise_ * 100.0,
         "moment of a released end");
  }
}

/// What supports hold, and equilibrium in the other directions.
void Evaluation::node_equations(std::size_t n, const NodeSums& sums) {
  const RodNode& node = rod_.nodes[n];
  const Vector3d load = load_of(node.load);
  const Vector3d held = load_of(node.displacement);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(node.angle), std::sin(node.angle), -std::sin(node.angle),
      std::cos(node.angle);
  // a node whose members are all hinged has a rotation of its own that nothing shows
  const bool turning = !std::isnan(out_.nodes[n][2]);
  if (!turning) out_.nodes[n][2] = 0.0;
  const Vector3d over = turn * (sums.force[n] - load);
  const Vector3d moved = turn * out_.nodes[n];
  for (int c = 0; c < 3; ++c) {
    if (!turning && c == 2) continue;
    if (node.fixed[c])
      note(moved[c] - held[c], kConverged + 100.0 * (noise_ + turn_noise_), "support " + std::to_string(n));
    else
      note(over[c], kConverged * (1.0 + largest_force_ + load.norm()) + sums.noise,
           "equilibrium of node " + std::to_string(n));
  }
}

void Evaluation::node_springs(NodeSums& sums) {
  out_.node_stiffness.assign(rod_.node_springs.size(), 0.0);
  const auto displacement = [this](int node) -> Vector3d {
    return out_.nodes[node].array().isNaN().select(0.0, out_.nodes[node]);
  };
  for (std::size_t i = 0; i < rod_.node_springs.size(); ++i) {
    const NodeSpring& spring = rod_.node_springs[i];
    const RodReaction& reaction = spring.reaction;
    Vector3d u = displacement(spring.node);
    if (spring.to >= 0) u -= displacement(spring.to);
    const double w = spring.row.dot(u);
    const double noise = (noise_ + turn_noise_) * 100.0;
    double force = 0.0;
    if (reaction.stop) {
      const ActingSupport acting = stopped(reaction, w, w + closer_ * noise);
      note(entered(reaction, acting, w), kStopGivesWay, "stop at node " + std::to_string(spring.node));
      force = acting.force;
      out_.node_stiffness[i] = acting.stiffness;
    } else if (reaction.acts(w)) {
      force = reaction.force(w);
      out_.node_stiffness[i] = reaction.slope(w);
      sums.noise = std::max(sums.noise, std::abs(reaction.slope(w)) * noise);
    }
    sums.force[spring.node] += force * spring.row;
    if (spring.to >= 0) sums.force[spring.to] -= force * spring.row;
    reported_spring(spring, w, force);
  }
}

/// Holds the displacement and the force that are reported of a spring against those of this state. The force
/// may jump where the law has a kink, and where a one-sided spring touches: within the rounding of its
/// displacement a steepest slope bounds the change.
void Evaluation::reported_spring(const NodeSpring& spring, double w, double force) {
  const SpringState& said = state_.springs[spring.place];
  const RodReaction& reaction = spring.reaction;
  const std::string which = " of spring " + std::to_string(spring.place);
  const double noise = 100.0 * (noise_ + turn_noise_);
  note(spring.sense * said.displacement / reaction.unit - w, noise + kConverged, "displacement" + which);
  double slope = 0.0;
  if (!reaction.stop)
    for (const double moved : {-noise, 0.0, noise})
      slope = std::max(slope, std::abs(reaction.slope(w + moved)));
  note(spring.sense * reaction.share * said.force - force,
       slope * noise + kConvergedForce * std::abs(force) + kEps, "force" + which);
}

/// Displacements of nodes that rods alone reach: those of their supports.
void Evaluation::anchors() {
  for (std::size_t n = 0; n < rod_.nodes.size(); ++n) {
    if (!std::isnan(out_.nodes[n][0])) continue;
    const Vector3d held = load_of(rod_.nodes[n].displacement);
    out_.nodes[n].head<2>() = Eigen::Rotation2Dd(rod_.nodes[n].angle) * Eigen::Vector2d(held.head<2>());
  }
}

/// Forces of rods, which are also reported.
void Evaluation::bars(NodeSums& sums) {
  for (const RodBar& bar : rod_.bars) {
    const Eigen::Vector2d now = bar.along + (out_.nodes[bar.end] - out_.nodes[bar.start]).head<2>();
    const BarPull pull = bar.pull(now, state_.load_factor);
    const double noise = bar.stiffness * 100.0 * noise_;
    const double reported = state_.members[bar.member].axial_force.front() / rod_.force;
    note(reported - pull.at_start, noise + kConvergedForce * std::abs(pull.at_start),
         "force of rod " + std::to_string(bar.member));
    if (pull.at_start != 0.0) sums.noise = std::max(sums.noise, noise);
    sums.force[bar.end].head<2>() += pull.force;
    sums.force[bar.start].head<2>() -= pull.force;
  }
}

/// Nodes: displacements of the members that meet and of supports, equilibrium in the free directions.
void Evaluation::joints() {
  out_.nodes.assign(rod_.nodes.size(), Vector3d::Constant(std::nan("")));
  NodeSums sums;
  sums.force.assign(rod_.nodes.size(), Vector3d::Zero());
  for (std::size_t m = 0; m < rod_.members.size(); ++m) meet_nodes(static_cast<int>(m), sums);
  anchors();
  turn_nodes(sums);
  joint_moments(sums);
  for (const double depth : entered_) note(depth, kStopGivesWay, "stop in a member");
  node_springs(sums);
  bars(sums);
  for (std::size_t n = 0; n < rod_.nodes.size(); ++n) node_equations(n, sums);
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
  out_.joint_stiffness.assign(rod_.members.size(), {0.0, 0.0});
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
