/// One-sided foundations with a shear layer: forces against the obstacle problem of the ground's surface on a
/// fine grid; tangent and its derivative against central differences.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/discrete/element_reader.h"
#include "solver/discrete/foundation_springs.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/central_differences.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using Eigen::VectorXd;
using testing::fixed_mesh;

struct Ground {
  std::string name;
  double curve = 0.0;  ///< opening angle of the axis, degrees
  double shear = 0.0;
  GroundEnd end = GroundEnd::free;
  std::array<double, 2> range{0.0, 1.0};
};

constexpr double kModulus = 90.0;
constexpr int kElements = 12;

Model on_ground(const Ground& ground) {
  Model model;
  model.nodes = {{"a", 0.0, 0.0}, {"b", 1.0, 0.0}};
  model.sections = {{"s", 1e3, 1.0, {}}};
  Member member{"m", "a", "b", "s", LineCurve{}, false, false};
  if (ground.curve != 0.0) member.curve = ArcCurve{ground.curve};
  model.members = {member};
  model.supports = {{"a", true, true, false, 0.0, {}}};
  model.loads = {PointLoad{{"b", "", 0.0}, {0.5, -1.0}, 0.0, Pattern::proportional}};
  Foundation soil;
  soil.id = "soil";
  soil.member = "m";
  soil.stiffness = kModulus;
  soil.shear_stiffness = ground.shear;
  soil.reaction = Reaction::compression_only;
  soil.gap = 0.004;
  soil.range = ground.range;
  soil.ground_end = ground.end;
  model.foundations = {soil};
  return model;
}

std::vector<Ground> grounds() {
  return {{"short_decay", 0.0, 0.02, GroundEnd::free, {0.0, 1.0}},
          {"long_decay", 0.0, 2.0, GroundEnd::free, {0.0, 1.0}},
          {"endless", 0.0, 1.0, GroundEnd::endless, {0.0, 1.0}},
          {"under_part", 0.0, 0.5, GroundEnd::endless, {0.15, 0.85}},
          {"arch", -80.0, 0.5, GroundEnd::free, {0.0, 1.0}},
          {"endless_arch", 80.0, 0.1, GroundEnd::endless, {0.1, 0.9}}};
}

class LayerTangent : public ::testing::TestWithParam<Ground> {
 protected:
  static constexpr double kStep = 1e-7;
  const Structure structure_ =
      make_structure(resolve(on_ground(GetParam())), fixed_mesh(kElements, 4), Geometry::nonlinear);
  StructuralProblem problem_{structure_};
};

/// A wave along the member, with an amplitude of several gaps, and smaller random displacements.
VectorXd state_of(const Structure& structure) {
  VectorXd y = 2e-4 * VectorXd::Random(structure.size);
  const double waves = 1.5 + 2.5 * std::rand() / RAND_MAX;
  const double phase = 6.0 * std::rand() / RAND_MAX;
  const double amplitude = 0.03;
  const int p = structure.mesh.order;
  const auto height = [&](double s) { return amplitude * (std::sin(waves * 3.14 * s + phase) + 0.3); };
  double at = height(0.0);
  for (std::size_t e = 0; e < structure.dofs.size(); ++e) {
    const MeshElement& cell = structure.mesh.elements[e];
    const double h = length_of_element(structure, static_cast<int>(e));
    const ElementDofs& dofs = structure.dofs[e];
    y[dofs.a[1]] = at;
    for (int q = 0; q < p; ++q) {
      const double s = cell.from + CollocationRule::of(p).point(q) * (cell.to - cell.from);
      const double slope =
          amplitude * waves * 3.14 * std::cos(waves * 3.14 * s + phase) * (cell.to - cell.from) / h;
      y[dofs.v + p + q] = slope + 2e-3 * std::rand() / RAND_MAX;
      at += h * CollocationRule::of(p).weight(q) * y[dofs.v + p + q];
    }
  }
  if (structure.dofs.empty()) return y;
  y[structure.dofs.back().b[1]] = at;
  return y;
}

/// The ground's surface on a grid of linear elements of a string on springs, above the penetrations w. The
/// active set of each grid starts from that of a grid with half the elements.
class Surface {
 public:
  Surface(const FoundationLaw& law, const VectorXd& w, double ds) : law_(law), w_(w) {
    for (Eigen::Index stride = w.size() / 64; stride > 0; stride /= 2)
      settle(stride, ds * static_cast<double>(stride));
  }
  /// Forces of the member on the nodes of the finest grid.
  [[nodiscard]] const VectorXd& forces() const { return force_; }

 private:
  void settle(Eigen::Index stride, double ds);
  void solve(const VectorXd& w, const std::vector<char>& active);

  const FoundationLaw& law_;
  const VectorXd& w_;
  std::vector<char> active_;
  VectorXd diagonal_, g_, force_;
  double off_ = 0.0;
};

void Surface::settle(Eigen::Index stride, double ds) {
  const Eigen::Index n = (w_.size() - 1) / stride + 1;
  VectorXd w(n);
  std::vector<char> active(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    w[i] = w_[i * stride];
    active[i] = active_.empty() ? w[i] > 0.0 : active_[static_cast<std::size_t>(i / 2)];
  }
  const double K = law_.law.stiffness;
  diagonal_ = VectorXd::Constant(n, 2.0 * (law_.shear / ds + K * ds / 3.0));
  off_ = K * ds / 6.0 - law_.shear / ds;
  diagonal_[0] = diagonal_[n - 1] = 0.5 * diagonal_[0] + (law_.endless ? std::sqrt(K * law_.shear) : 0.0);
  for (int round = 0; round < 100; ++round) {
    solve(w, active);
    bool changed = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      const char now = active[i] != 0 ? force_[i] > 0.0 : g_[i] < w[i];
      changed = changed || now != active[i];
      active[i] = now;
    }
    active_ = active;
    if (!changed) return;
  }
  ADD_FAILURE() << "the active set does not settle";
}

/// Surface and forces with given contact: elimination from one end of the grid to the other.
void Surface::solve(const VectorXd& w, const std::vector<char>& active) {
  const Eigen::Index n = w.size();
  VectorXd d = diagonal_;
  VectorXd r = VectorXd::Zero(n);
  VectorXd u = VectorXd::Constant(n, off_);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (active[i] != 0) {
      d[i] = 1.0;
      u[i] = 0.0;
      r[i] = w[i];
    } else if (i > 0) {
      const double f = off_ / d[i - 1];
      d[i] -= f * u[i - 1];
      r[i] -= f * r[i - 1];
    }
  }
  g_.resize(n);
  for (Eigen::Index i = n - 1; i >= 0; --i) g_[i] = (r[i] - (i + 1 < n ? u[i] * g_[i + 1] : 0.0)) / d[i];
  force_ = diagonal_.cwiseProduct(g_);
  force_.head(n - 1) += off_ * g_.tail(n - 1);
  force_.tail(n - 1) += off_ * g_.head(n - 1);
}

/// The work of the ground's forces on a motion is that of the obstacle problem's.
TEST_P(LayerTangent, BelongsToTheSurfaceAboveTheMember) {
  constexpr int kGrid = 8192;
  Model model = on_ground(GetParam());
  model.supports.clear();
  const Structure with = make_structure(resolve(model), fixed_mesh(kElements, 4), Geometry::nonlinear);
  const FoundationLaw law = with.foundation_laws[0];
  model.foundations[0].stiffness = model.foundations[0].shear_stiffness = 0.0;
  const Structure without = make_structure(resolve(model), fixed_mesh(kElements, 4), Geometry::nonlinear);
  StructuralProblem ground(with);
  StructuralProblem none(without);
  std::srand(11u);
  for (int draw = 0; draw < 12; ++draw) {
    const VectorXd y = state_of(with);
    VectorXd f;
    VectorXd rest;
    ground.residual(y, 0.0, f);
    none.residual(y, 0.0, rest);
    VectorXd w(kGrid + 1);
    VectorXd motion(kGrid + 1);
    const VectorXd d = state_of(with);
    const auto range = GetParam().range;
    double length = 0.0;
    for (int e = 0; e < static_cast<int>(with.dofs.size()); ++e) length += length_of_element(with, e);
    for (int i = 0; i <= kGrid; ++i) {
      const MeshPlace place = place_of(with.mesh, 0, range[0] + (range[1] - range[0]) * i / kGrid);
      const auto read = [&](const VectorXd& state, const PlaceOnAxis& at) {
        const auto u = ElementReader(with, state, place.element).displacement(place.xi);
        return law.penetration(at, {u[0], u[1]}).depth;
      };
      const PlaceOnAxis at = place_on_axis(with, place.element, place.xi);
      w[i] = read(y, at);
      motion[i] = read(d, at) + law.law.gap;
    }
    const double ds = (range[1] - range[0]) * length / kGrid;
    const VectorXd forces = Surface(law, w, ds).forces();
    const double size = forces.cwiseAbs().dot(motion.cwiseAbs());
    EXPECT_NEAR((f - rest).dot(d), forces.dot(motion), 2e-3 * size) << draw;
  }
}

TEST_P(LayerTangent, IsTheDerivativeOfTheResidual) {
  std::srand(3u);
  for (int draw = 0; draw < 12; ++draw) {
    const VectorXd y = state_of(structure_);
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::residual_difference(problem_, y, 0.3, d, kStep);
    const VectorXd product = problem_.tangent_product(y, 0.3, d);
    EXPECT_LT((product - difference).norm(), 2e-6 * difference.norm()) << draw;
  }
}

/// linearise() factorises the tangent that tangent_products() multiplies with, and counts its negative
/// eigenvalues.
TEST_P(LayerTangent, IsTheOneThatIsFactorised) {
  std::srand(5u);
  for (int draw = 0; draw < 12; ++draw) {
    const VectorXd y = state_of(structure_);
    VectorXd f;
    problem_.linearise(y, 0.3, f);
    VectorXd x = VectorXd::Random(problem_.size());
    const VectorXd right = x;
    problem_.solve(x);
    EXPECT_LT((problem_.tangent_product(y, 0.3, x) - right).norm(), 1e-8 * right.norm());
  }
}

TEST_P(LayerTangent, ChangesByItsDerivative) {
  std::srand(7u);
  for (int draw = 0; draw < 12; ++draw) {
    const VectorXd y = state_of(structure_);
    const VectorXd a = VectorXd::Random(problem_.size());
    const VectorXd d = VectorXd::Random(problem_.size());
    const VectorXd difference = testing::tangent_difference(problem_, y, 0.3, a, d, kStep);
    const VectorXd change = problem_.tangent_change(y, 0.3, {a, 0.0}, d);
    EXPECT_LT((change - difference).norm(), 1e-3 * difference.norm()) << draw;
  }
}

INSTANTIATE_TEST_SUITE_P(Grounds, LayerTangent, ::testing::ValuesIn(grounds()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace snapthrough
