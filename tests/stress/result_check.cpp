#include "tests/stress/result_check.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "tests/index_of.h"
#include "tests/reaction_sum.h"
#include "tests/stress/inertia.h"
#include "tests/stress/rod_state.h"
#include "tests/stress/rod_tangent.h"
#include "tests/stress/strength_check.h"

namespace snapthrough::testing {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

std::string text(double value) {
  char out[32];
  std::snprintf(out, sizeof out, "%.6g", value);
  return out;
}

/// Shift of a tangent's eigenvalues that rounding may make.
double rounding_of(const ConstrainedTangent& t) { return 64.0 * kEps * t.matrix.norm(); }

/// Whether the tangent need not be symmetric: a follower pressure varies, or its member ends at a node that
/// no support fixes in the plane.
bool has_unsymmetric_pressure(const Model& model) {
  const auto fixed = [&model](const std::string& node) {
    return std::ranges::any_of(model.supports,
                               [&node](const Support& s) { return s.node == node && (s.x || s.y); });
  };
  return std::ranges::any_of(model.loads, [&](const Load& load) {
    const auto* pressure = std::get_if<PressureLoad>(&load);
    if (pressure == nullptr) return false;
    const Member& member = model.members[static_cast<std::size_t>(index_of(model.members, pressure->member))];
    return !pressure->value_along.empty() || !fixed(member.start) || !fixed(member.end);
  });
}

/// Largest slope of a mode over its root mean square, at least one.
double steepness(const Mode& mode) {
  double sum = 0.0;
  double length = 0.0;
  double largest = 0.0;
  for (const MemberMode& m : mode.members)
    for (std::size_t i = 1; i < m.s.size(); ++i) {
      const double ds = m.s[i] - m.s[i - 1];
      const double slope = std::hypot(m.u[i] - m.u[i - 1], m.v[i] - m.v[i - 1]) / ds;
      sum += slope * slope * ds;
      length += ds;
      largest = std::max(largest, slope);
    }
  return sum > 0.0 ? std::max(1.0, largest / std::sqrt(sum / length)) : 1.0;
}

bool has_mode_imperfection(const Model& model) {
  return std::ranges::any_of(
      model.imperfections, [](const Imperfection& i) { return std::holds_alternative<ModeImperfection>(i); });
}

/// Which state belongs to which point of which branch: critical points name theirs, the others are the
/// points.
std::vector<int> states_of_points(const Result& result) {
  std::vector<char> critical(result.states.size(), 0);
  for (const CriticalPoint& point : result.critical_points)
    if (point.state) critical[static_cast<std::size_t>(*point.state)] = 1;
  std::vector<int> out;
  for (std::size_t i = 0; i < critical.size(); ++i)
    if (critical[i] == 0) out.push_back(static_cast<int>(i));
  return out;
}

class Check {
 public:
  Check(const Model& model, const Analysis& analysis, const Result& result)
      : model_(model),
        beams_(without_bars(model)),
        analysis_(analysis),
        result_(result),
        rod_(make_rod_model(model, analysis, result.discretization)) {}
  ResultCheck run();

 private:
  void finite();
  void branch(const Branch& branch);
  void changes(const Branch& branch);
  /// Negative eigenvalues that a state may have.
  struct CountRange {
    int least = 0;
    int most = 0;
  };
  void state(std::size_t index, std::optional<CountRange> negative);
  void inertia(std::size_t index, const RodState& at, CountRange negative);
  [[nodiscard]] static CountRange count(const ConstrainedTangent& t);
  void determinant(std::size_t index, const ConstrainedTangent& t, CountRange negative);
  void contact(const State& state, const RodState& at);
  void contact_at(const FoundationState& said, const Foundation& base, std::size_t i, double noise,
                  const RodState& at);
  /// Root mean square slope of an imperfection, and its largest.
  struct Slope {
    double size = 0.0;
    double largest = 0.0;
  };
  [[nodiscard]] Slope imperfection_at(std::size_t index) const;
  void reactions();
  void finite_series(std::span<const double> values, const std::string& what);
  [[nodiscard]] double distance(const RodState& a, const RodState& b) const;
  /// @param what begins with the check's name and a colon; a few failures of each check are kept
  void fail(const std::string& what) {
    constexpr int kMost = 3;
    if (++failed_[what.substr(0, what.find(':'))] <= kMost) out_.failures.push_back(what);
  }

  const Model& model_;
  Model beams_;  ///< the model without rods
  const Analysis& analysis_;
  const Result& result_;
  RodModel rod_;
  ResultCheck out_;
  std::optional<RodState> before_;  ///< the point before, on the same branch
  std::map<std::string, int> failed_;
};

void Check::finite_series(std::span<const double> values, const std::string& what) {
  if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) fail("nan: " + what);
}

void Check::finite() {
  for (const Branch& b : result_.branches) {
    finite_series(b.load_factor, "load_factor");
    finite_series(b.arc_length, "arc_length");
    for (const NamedSeries& m : b.monitors) finite_series(m.values, "monitor");
    for (const NamedSeries& c : b.contact_fraction) {
      finite_series(c.values, "contact_fraction");
      for (const double v : c.values)
        if (v < 0.0 || v > 1.0) fail("contact_fraction: " + text(v));
    }
  }
  for (const State& s : result_.states) {
    for (const MemberState& m : s.members)
      for (const auto* values : {&m.x, &m.y, &m.rotation, &m.axial_force, &m.shear_force, &m.bending_moment})
        finite_series(*values, "state of " + m.id);
    for (const FoundationState& f : s.foundations) finite_series(f.reaction, "reaction of " + f.id);
  }
  for (const CriticalPoint& p : result_.critical_points)
    if (!std::isfinite(p.load_factor) || !std::isfinite(p.arc_length)) fail("nan: critical point");
}

/// Root mean square over the members of the difference in displacement and displacement gradient. Rods count
/// with the displacements of their ends.
double Check::distance(const RodState& a, const RodState& b) const {
  double sum = 0.0;
  double total = 0.0;
  const auto& weights = rod_.lagrange.rule().weights;
  for (std::size_t e = 0; e < rod_.elements.size(); ++e) {
    const double h = rod_.elements[e].h;
    const MatrixXd d = (a.elements[e].u - b.elements[e].u).leftCols(2);
    Eigen::RowVector2d end = d.row(0);
    for (Eigen::Index q = 0; q + 1 < d.rows(); ++q) end += h * weights[q] * d.row(q + 1);
    sum += h * 0.5 * (d.row(0).squaredNorm() + end.squaredNorm());
    for (Eigen::Index q = 0; q + 1 < d.rows(); ++q) sum += h * weights[q] * d.row(q + 1).squaredNorm();
    total += h;
  }
  for (const RodBar& bar : rod_.bars) {
    const double length = bar.along.norm();
    for (const int node : {bar.start, bar.end}) {
      const auto n = static_cast<std::size_t>(node);
      sum += 0.5 * length * (a.nodes[n] - b.nodes[n]).head<2>().squaredNorm();
    }
    total += length;
  }
  return std::sqrt(sum / total);
}

/// The number of negative eigenvalues changes only across listed points, and they say so.
void Check::changes(const Branch& branch) {
  for (std::size_t i = 1; i < branch.arc_length.size(); ++i) {
    const double from = branch.arc_length[i - 1];
    const double to = branch.arc_length[i];
    if (!(to > from)) fail("arc_length: does not grow at point " + std::to_string(i));
    int now = branch.negative_eigenvalues[i - 1];
    bool listed = false;
    for (const CriticalPoint& c : result_.critical_points) {
      // a path may end on the point it looked for
      if (c.branch != branch.id || c.arc_length <= from || c.arc_length > to) continue;
      listed = true;
      if (c.negative_before != now)
        fail("brackets: point at arc length " + text(c.arc_length) + " has " +
             std::to_string(c.negative_before) + " before it, the path " + std::to_string(now));
      now = c.negative_after;
    }
    if (now == branch.negative_eigenvalues[i]) continue;
    const bool ends_there = listed && i + 1 == branch.arc_length.size();
    const bool leaves_bifurcation = i == 1 && branch.parent.has_value();
    if (!ends_there && !leaves_bifurcation)
      fail("unlisted_change: " + std::to_string(now) + " to " +
           std::to_string(branch.negative_eigenvalues[i]) + " negative eigenvalues at point " +
           std::to_string(i) + ", load factor " + text(branch.load_factor[i]));
  }
}

/// Negative eigenvalues that a tangent may have within the backward error of its factorisation and the
/// rounding of section forces.
Check::CountRange Check::count(const ConstrainedTangent& t) {
  const Eigen::Index free = t.matrix.rows() - t.constraints;
  MatrixXd shifted = t.matrix;
  shifted.diagonal().head(free).array() += rounding_of(t);
  // no count is below zero: what is comes from the shift itself, where constraints are nearly dependent
  const int low = std::max(negative_eigenvalues(shifted) - t.constraints, 0);
  shifted = t.matrix;
  shifted.diagonal().head(free).array() -= rounding_of(t);
  return {low, std::max(negative_eigenvalues(shifted) - t.constraints, 0)};
}

void Check::inertia(std::size_t index, const RodState& at, CountRange negative) {
  const State& s = result_.states[index];
  const ConstrainedTangent t = tangent_of(rod_, at, s.load_factor);
  ++out_.inertia;
  if (has_unsymmetric_pressure(model_)) {
    determinant(index, t, negative);
    return;
  }
  CountRange counted = count(t);
  if (counted.least != counted.most) ++out_.undecided;
  const auto agree = [&] { return negative.most >= counted.least && negative.least <= counted.most; };
  // contact that the digits of the state do not decide, with room for the corrector's own error
  constexpr double kRoundings = 16.0;
  for (const double closer : {-kRoundings, kRoundings}) {
    if (agree()) return;
    const CountRange other = count(tangent_of(rod_, evaluate(rod_, s, closer), s.load_factor));
    counted = {std::min(counted.least, other.least), std::max(counted.most, other.most)};
  }
  if (!agree())
    fail("inertia: state " + std::to_string(index) + " at load factor " + text(s.load_factor) + " says " +
         std::to_string(negative.least) + ", counted " + std::to_string(counted.least) +
         (counted.least == counted.most ? "" : " to " + std::to_string(counted.most)));
}

/// Where a pressed line ends free the tangent is not symmetric: negative real eigenvalues come and go with
/// the sign of its determinant.
void Check::determinant(std::size_t index, const ConstrainedTangent& t, CountRange negative) {
  const Eigen::Index free = t.matrix.rows() - t.constraints;
  const auto is_odd = [&](double shift) {
    MatrixXd shifted = t.matrix + t.rest;
    shifted.diagonal().head(free).array() += shift;
    const Eigen::PartialPivLU<MatrixXd> factors(shifted);
    auto minus = static_cast<Eigen::Index>(factors.permutationP().determinant() < 0);
    minus += (factors.matrixLU().diagonal().array() < 0.0).count();
    return (minus + t.constraints) % 2 == 1;
  };
  const bool odd = is_odd(rounding_of(t));
  if (odd != is_odd(-rounding_of(t))) {
    ++out_.undecided;
    return;
  }
  if (negative.least == negative.most && (negative.least % 2 == 1) != odd)
    fail("determinant: state " + std::to_string(index) + " at load factor " +
         text(result_.states[index].load_factor) + " says " + std::to_string(negative.least) +
         " negative eigenvalues, the determinant's sign says an " + (odd ? "odd" : "even") + " number");
}

/// What acts on the structure adds up to nothing, on whatever mesh a state is.
void Check::reactions() {
  constexpr double kBalance = 1e-9;
  constexpr double kNoForce = 1e-9;  // of EI / length^2: where nothing acts, stiff bases press by rounding
  double length = 0.0;
  const double bending = largest_bending(model_);
  for (const auto& axis : rod_.axes) length = std::max(length, axis->length());
  for (std::size_t i = 0; i < result_.states.size(); ++i) {
    const State& state = result_.states[i];
    const ReactionSum sum = reaction_sum(model_, state, analysis_.geometry);
    if (sum.largest_force <= kNoForce * bending / (length * length)) continue;
    const double imbalance = sum.imbalance();
    out_.imbalance = std::max(out_.imbalance, imbalance);
    if (!(imbalance <= kBalance + imperfection_at(i).size))
      fail("reactions: at load factor " + text(state.load_factor) + " they add up to " + text(imbalance) +
           " of the largest");
  }
}

/// The reported reaction of a foundation that is one-sided or not linear is that of its displacement.
/// One-sided ones react in one sense, and not outside their contact.
void Check::contact(const State& state, const RodState& at) {
  for (std::size_t f = 0; f < state.foundations.size(); ++f) {
    const Foundation& base = model_.foundations[f];
    const bool one_sided = base.reaction != Reaction::bilateral;
    const bool turns = base.component == FoundationComponent::rotation;
    if (base.shear_stiffness > 0.0 || !(base.law || turns || (one_sided && base.stiffness > 0.0))) continue;
    const FoundationState& said = state.foundations[f];
    const int m = index_of(beams_.members, base.member);
    const MemberState& member = state.members[rod_.members[m].place];
    double x = turns ? 1.0 : rod_.extent * rod_.length;
    for (const double v : turns ? member.rotation : member.x) x = std::max(x, std::abs(v));
    const double noise = 1e3 * kEps * x;  // of a fitted displacement or rotation
    for (std::size_t i = 0; i < said.s.size(); ++i) contact_at(said, base, i, noise, at);
  }
}

/// Least and largest reaction of a law that the rounding of its depth and of its place on the member allows.
/// The law is monotone between its kinks, so that both lie at an end of the range of depths or at a kink
/// inside.
/// @param noise rounding of the depth, in the model's units
std::array<double, 2> reactions_near(const LawAlong& law, double fraction, bool one_sided, double depth,
                                     double noise) {
  constexpr double kPlace = 1e-14;  // rounding of a fraction
  const auto force = [&](double at, double moved) {
    return law.at(at).force(one_sided ? std::max(depth + moved, 0.0) : depth + moved);
  };
  std::array<double, 2> out{force(fraction, 0.0), force(fraction, 0.0)};
  const auto widen = [&](double at, double moved) {
    const double reaction = force(at, moved);
    out = {std::min(out[0], reaction), std::max(out[1], reaction)};
  };
  for (const double at : {fraction - kPlace, fraction, fraction + kPlace}) {
    for (const double moved : {-noise, noise}) widen(at, moved);
    for (const double kink : law.at(at).kinks())
      for (const double moved : {kink - depth, -kink - depth})
        if (std::abs(moved) < noise) widen(at, moved);
  }
  return out;
}

/// @param i sample of the foundation; noise: rounding of a displacement
void Check::contact_at(const FoundationState& said, const Foundation& base, std::size_t i, double noise,
                       const RodState& at) {
  const int m = index_of(beams_.members, base.member);
  const double length = rod_.axes[m]->length();
  const double fraction = std::min(1.0, said.s[i] / length);
  int e = rod_.mesh.first[m];
  const double last = std::min(fraction + 1e-9, base.range[1] - 1e-9);  // of two that meet, the further
  while (e + 1 < rod_.mesh.first[m + 1] && rod_.elements[e].to <= last) ++e;
  const RodElement& element = rod_.elements[e];
  const double xi = (fraction - element.from) / (element.to - element.from);
  const RodStrip strip = strip_of(rod_, base);
  const double depth = depth_at(strip, site_of(rod_, element, strip, xi), at.elements[e].u) * strip.unit;
  const double reaction = (base.reaction == Reaction::tension_only ? -1.0 : 1.0) * said.reaction[i];
  const auto [least, most] =
      reactions_near(acting_law(rod_, element, base), fraction, strip.one_sided, depth, noise);
  if (base.component == FoundationComponent::rotation && std::abs(said.displacement[i] - depth) > noise)
    fail("complementarity: base " + base.id + " says the rotation " + text(said.displacement[i]) + " for " +
         text(depth));
  const double rounding = 16.0 * kEps * std::abs(reaction);
  if (reaction < least - rounding || reaction > most + rounding)
    fail("complementarity: base " + base.id + " reacts with " + text(reaction) + " at depth " + text(depth));
  if (!strip.one_sided) return;
  const double near = 1e-6 * length;
  const auto is_inside = [&](double margin) {
    return std::ranges::any_of(
        said.contact, [&](const auto& c) { return said.s[i] > c[0] + margin && said.s[i] < c[1] - margin; });
  };
  if (reaction < 0.0) fail("complementarity: base " + base.id + " pulls");
  if (depth < -noise - near && is_inside(near)) fail("contact: base " + base.id + " is open in contact");
  if (depth > noise + near && reaction > 0.0 && !is_inside(-near))
    fail("contact: base " + base.id + " is pressed outside its contact");
}

/// The imperfection that a state is in equilibrium without: that of the bifurcation that it is, or that the
/// point's first mesh had where the path ended.
Check::Slope Check::imperfection_at(std::size_t index) const {
  const State& state = result_.states[index];
  Slope out;
  for (const CriticalPoint& c : result_.critical_points) {
    const auto is_here = [&](const MeshAnswer& mesh) { return mesh.load_factor == state.load_factor; };
    if (c.branch != state.branch || !c.imperfection ||
        !(c.load_factor == state.load_factor || std::ranges::any_of(c.meshes, is_here)))
      continue;
    out.size = std::max(out.size, *c.imperfection);
    out.largest = std::max(out.largest, *c.imperfection * (c.mode ? steepness(*c.mode) : 1.0));
  }
  return out;
}

void Check::state(std::size_t index, std::optional<CountRange> negative) {
  const State& s = result_.states[index];
  if (s.refinements > 0 || rod_.points == 0 || has_mode_imperfection(model_) ||
      static_cast<int>(s.members.front().s.size()) != rod_.points) {
    ++out_.uncovered;
    return;
  }
  RodState at = evaluate(rod_, s, 0.0, imperfection_at(index).largest);
  ++out_.points;
  out_.residual = std::max(out_.residual, at.residual);
  if (at.roughness > 100.0)
    fail("shape: state " + std::to_string(index) + " is off the elements' polynomials by " +
         text(at.roughness));
  if (!(at.residual <= 1.0))
    fail("residual: state " + std::to_string(index) + " of " + std::to_string(result_.states.size()) +
         " at load factor " + text(s.load_factor) + ", " + text(at.residual) +
         " times its tolerance: " + at.worst);
  if (at.reported_force > 1.0)
    fail("section_force: state " + std::to_string(index) + " at load factor " + text(s.load_factor) +
         ", off by " + text(at.reported_force) + " tolerances (" + at.worst +
         "); the shape itself is in equilibrium");
  contact(s, at);
  constexpr int kMostUnknowns = 500;
  if (negative && tangent_size(rod_) <= kMostUnknowns) inertia(index, at, *negative);
  before_ = std::move(at);
}

/// States are those of rows, in their order; the first and the last row have one.
void Check::branch(const Branch& branch) {
  constexpr double kSameLoad = 1e-3;
  before_.reset();
  std::size_t i = 0;
  std::optional<std::size_t> row_before;
  for (const int state_index : states_of_points(result_)) {
    const auto index = static_cast<std::size_t>(state_index);
    if (result_.states[index].branch != branch.id) continue;
    while (i < branch.load_factor.size() && branch.load_factor[i] != result_.states[index].load_factor) ++i;
    if (i == branch.load_factor.size() || (!row_before && i > 0)) {
      fail("states: a state is not that of its point");
      return;
    }
    const std::optional<RodState> previous = before_;
    // a path may end on a critical point, where the count is that of either side
    CountRange counts{branch.negative_eigenvalues[i], branch.negative_eigenvalues[i]};
    // or begin or end on one that another branch told of
    const bool begins = i == 0 && branch.parent.has_value();
    const bool rejoins = i + 1 == branch.load_factor.size() && branch.termination == "rejoined";
    for (const CriticalPoint& c : result_.critical_points) {
      const double apart = std::abs(c.load_factor - branch.load_factor[i]);
      const bool here = c.branch == branch.id && c.arc_length == branch.arc_length[i];
      if (!here && !((begins || rejoins) && apart <= kSameLoad * std::abs(c.load_factor))) continue;
      counts.least = std::min({counts.least, c.negative_before, c.negative_after});
      counts.most = std::max({counts.most, c.negative_before, c.negative_after});
    }
    state(index, counts);
    if (previous && before_ && row_before) {
      const double step = branch.arc_length[i] - branch.arc_length[*row_before];
      out_.stretch = std::max(out_.stretch, (distance(*previous, *before_) - 1e-12) / step);
    }
    row_before = i++;
  }
  if (!result_.failure && i != branch.load_factor.size()) fail("states: the last point has none");
  changes(branch);
}

ResultCheck Check::run() {
  finite();
  if (!out_.failures.empty()) return out_;
  reactions();
  check_strength(model_, result_, states_of_points(result_), [this](const std::string& what) { fail(what); });
  for (const Branch& b : result_.branches) branch(b);
  for (const CriticalPoint& c : result_.critical_points)
    if (c.state) state(static_cast<std::size_t>(*c.state), std::nullopt);
  if (result_.branches.empty()) {
    // a search for the first loss of stability: all points but the last are before it
    const std::vector<int> states = states_of_points(result_);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const bool stable = i + 1 < states.size() && result_.summary.termination != "unstable_at_start";
      state(static_cast<std::size_t>(states[i]), stable ? std::optional(CountRange{}) : std::nullopt);
    }
  }
  constexpr double kApart = 1.5;
  if (out_.stretch > kApart) fail("contiguity: neighbours are " + text(out_.stretch) + " arc lengths apart");
  return out_;
}

}  // namespace

int points_needed(const Model& model, const Analysis& analysis, const MeshReport& told) {
  return make_rod_model(model, analysis, told).points;
}

ResultCheck check_result(const Model& model, const Analysis& analysis, const Result& result) {
  return Check(model, analysis, result).run();
}

}  // namespace snapthrough::testing
