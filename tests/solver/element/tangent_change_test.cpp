/// The derivative of the tangent against automatic differentiation of the energy, which is written here anew.
///
/// A number carries its derivatives along three directions: x + x_1 e_1 + .. + x_123 e_1 e_2 e_3 with e_i^2 =
/// 0. The coefficient of e_1 e_2 e_3 in the energy at y + e_1 a + e_2 b + e_3 c is the third derivative along
/// a, b and c, exact to rounding: no step, no truncation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include "solver/discrete/build_structure.h"
#include "solver/problem/structural_problem.h"
#include "solver/resolve/resolved_model.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

/// Coefficients of the products of e_1, e_2 and e_3; bit i of the index stands for e_(i+1).
struct Number {
  std::array<double, 8> c{};

  Number() = default;
  Number(double value) : c{value} {}  // NOLINT: numbers and doubles mix in formulas
  Number& operator+=(const Number& o) {
    for (int i = 0; i < 8; ++i) c[i] += o.c[i];
    return *this;
  }
  friend Number operator+(Number a, const Number& b) { return a += b; }
  friend Number operator-(Number a, const Number& b) {
    for (int i = 0; i < 8; ++i) a.c[i] -= b.c[i];
    return a;
  }
  friend Number operator*(const Number& a, const Number& b) {
    Number out;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        if ((i & j) == 0) out.c[i | j] += a.c[i] * b.c[j];
    return out;
  }
};

/// f(x) from its value and three derivatives at the real part of x.
Number taylor(const Number& x, const std::array<double, 4>& f) {
  Number rest = x;
  rest.c[0] = 0.0;
  const Number square = rest * rest;
  return Number(f[0]) + f[1] * rest + 0.5 * f[2] * square + f[3] / 6.0 * (square * rest);
}
Number sine(const Number& x) {
  const double s = std::sin(x.c[0]);
  const double c = std::cos(x.c[0]);
  return taylor(x, {s, c, -s, -c});
}
Number cosine(const Number& x) {
  const double s = std::sin(x.c[0]);
  const double c = std::cos(x.c[0]);
  return taylor(x, {c, -s, -c, s});
}
using State = std::vector<Number>;

/// Integral over [0, xi] of each Lagrange polynomial, by a Gauss rule of its own points.
std::vector<Number> integrals(const CollocationRule& rule, const Number& xi) {
  static const Quadrature gauss = gauss_legendre(12);
  std::vector<Number> out(static_cast<std::size_t>(rule.order()));
  for (std::size_t g = 0; g < gauss.points.size(); ++g) {
    const Number at = gauss.points[g] * xi;
    for (int r = 0; r < rule.order(); ++r) {
      Number product = gauss.weights[g] * xi;
      for (int k = 0; k < rule.order(); ++k)
        if (k != r) product = product * (at - rule.point(k)) * (1.0 / (rule.point(r) - rule.point(k)));
      out[static_cast<std::size_t>(r)] += product;
    }
  }
  return out;
}

/// Mixed energy of an element's beam: forces times compatibility, minus half the forces times compliance.
Number beam_energy(const Structure& structure, int element, const State& y) {
  const ElementDofs& dofs = structure.dofs[element];
  const ElementShape shape = shape_of_element(structure, element);
  const CollocationRule& rule = CollocationRule::of(structure.mesh.order);
  const int p = rule.order();
  Number energy;
  std::array<Number, 3> gap;
  for (int c = 0; c < 3; ++c) gap[c] = y[dofs.b[c]] - y[dofs.a[c]];
  for (int q = 0; q < p; ++q) {
    const double hb = shape.length * rule.weight(q);
    Number turn = y[dofs.a[2]];
    for (int r = 0; r < p; ++r) turn += shape.length * rule.integral(q, r) * y[dofs.v + 2 * p + r];
    const Number c = cosine(turn + shape.angle[q]);
    const Number s = sine(turn + shape.angle[q]);
    const Number x = y[dofs.v + q] + shape.t[q][0];
    const Number z = y[dofs.v + p + q] + shape.t[q][1];
    const std::array<Number, 3> strain{x * c + z * s, z * c - x * s, y[dofs.v + 2 * p + q]};
    const std::array<double, 3> compliance{shape.axial_compliance[q], shape.shear_compliance[q],
                                           shape.bending_compliance[q]};
    for (int k = 0; k < 3; ++k) {
      const Number& force = y[dofs.s + k * p + q];
      energy += hb * (force * strain[k] - 0.5 * compliance[k] * (force * force));
      gap[k] = gap[k] - hb * y[dofs.v + k * p + q];
    }
  }
  for (int c = 0; c < 3; ++c) energy += y[dofs.m + c] * gap[c];
  return energy;
}

/// Energy K g^2 / 2 of a one-sided foundation on an element, over the zones where g > 0.
class Contact {
 public:
  Contact(const Structure& structure, int element, const State& y)
      : structure_(structure),
        law_(law_on(structure, structure.foundation_laws[0], element)),
        dofs_(structure.dofs[element]),
        cell_(structure.mesh.elements[element]),
        rule_(CollocationRule::of(structure.mesh.order)),
        length_(length_of_element(structure, element)),
        y_(y) {}

  [[nodiscard]] Number energy() const {
    constexpr int kSamples = 400;
    Number sum;
    Number from = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const double left = static_cast<double>(i) / kSamples;
      const double right = static_cast<double>(i + 1) / kSamples;
      const bool inside = gap(left).c[0] > 0.0;
      if (inside != (gap(right).c[0] > 0.0)) {
        const Number end = root(left, right);
        if (inside) sum += over(from, end);
        from = end;
      }
    }
    if (gap(1.0).c[0] > 0.0) sum += over(from, 1.0);
    return sum;
  }
  /// Number of ends of contact inside the element.
  [[nodiscard]] int ends() const {
    int count = 0;
    for (int i = 0; i < 400; ++i)
      count += (gap(i / 400.0).c[0] > 0.0) != (gap((i + 1) / 400.0).c[0] > 0.0) ? 1 : 0;
    return count;
  }

 private:
  [[nodiscard]] Number gap(const Number& xi) const {
    const AxisCurve& axis = *structure_.axes[cell_.member];
    const double curvature = axis.at(0.0).curvature;
    const Number s = (cell_.from + (cell_.to - cell_.from) * xi) * axis.length();
    const Number angle = axis.at(0.0).angle + curvature * s;
    const double sign = law_.direction.sign;
    const Number dx = law_.direction.turns ? Number(-sign) * sine(angle) : Number(law_.direction.fixed[0]);
    const Number dz = law_.direction.turns ? Number(sign) * cosine(angle) : Number(law_.direction.fixed[1]);
    Number x = y_[dofs_.a[0]];
    Number z = y_[dofs_.a[1]];
    const std::vector<Number> a = integrals(rule_, xi);
    for (int r = 0; r < rule_.order(); ++r) {
      x += length_ * a[static_cast<std::size_t>(r)] * y_[dofs_.v + r];
      z += length_ * a[static_cast<std::size_t>(r)] * y_[dofs_.v + rule_.order() + r];
    }
    return x * dx + z * dz - law_.law.gap;
  }
  /// End of contact between two places: bisection, then corrections with its slope.
  [[nodiscard]] Number root(double left, double right) const {
    const bool inside = gap(left).c[0] > 0.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (left + right);
      ((gap(middle).c[0] > 0.0) == inside ? left : right) = middle;
    }
    Number at = 0.5 * (left + right);
    // the slope's real part is exact to 1e-10 only, so each correction gains that factor
    constexpr double kStep = 1e-5;
    const double slope = (gap(at.c[0] + kStep).c[0] - gap(at.c[0] - kStep).c[0]) / (2.0 * kStep);
    for (int k = 0; k < 40; ++k) at = at - gap(at) * (1.0 / slope);
    return at;
  }
  [[nodiscard]] Number over(const Number& from, const Number& to) const {
    static const Quadrature gauss = gauss_legendre(16);
    Number sum;
    for (std::size_t g = 0; g < gauss.points.size(); ++g) {
      const Number value = gap(from + gauss.points[g] * (to - from));
      sum += gauss.weights[g] * (to - from) * value * value;
    }
    return 0.5 * law_.law.stiffness * length_ * sum;
  }

  const Structure& structure_;
  FoundationLaw law_;
  const ElementDofs& dofs_;
  const MeshElement& cell_;
  const CollocationRule& rule_;
  double length_;
  const State& y_;
};

/// Random motion that keeps constrained displacements.
Eigen::VectorXd motion(const Structure& structure) {
  Eigen::VectorXd out = Eigen::VectorXd::Random(structure.size);
  for (int j = 0; j < structure.nodes; ++j)
    for (int c = 0; c < 3; ++c)
      if (structure.supports[j].fixed[c]) out[3 * j + c] = 0.0;
  return out;
}

struct Case {
  double sweep;  ///< degrees; 0: straight
  bool shearable;
  bool contact;
};

class TangentChange : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, TangentChange,
                         ::testing::Values(Case{0.0, false, false}, Case{0.0, true, true},
                                           Case{70.0, false, true}, Case{150.0, true, true}));

Model model_of(const Case& with) {
  Model model =
      with.sweep > 0.0 ? testing::arch(with.sweep, 900.0, 2.0) : testing::column(1.0, 2.0, 900.0, 0.0);
  for (Support& support : model.supports) support.x = support.y = support.rotation = true;
  model.loads = {PressureLoad{model.members[0].id, 0.3, Side::left, Pattern::proportional}};
  if (with.shearable) model.sections[0].GA = 70.0;
  if (with.contact) {
    Foundation soil;
    soil.id = "soil";
    soil.member = model.members[0].id;
    soil.stiffness = 40.0 / (with.sweep > 0.0 ? 1e4 : 1.0);
    soil.reaction = Reaction::compression_only;
    soil.side = Side::left;
    model.foundations.push_back(soil);
  }
  return model;
}

TEST_P(TangentChange, IsTheThirdDerivativeOfTheEnergy) {
  constexpr double kRounding = 1e-12;  // some thousand roundings of sums of some hundred terms
  std::srand(7u);
  int ends = 0;
  for (int order = 1; order <= kMaxOrder; ++order) {
    const Model model = model_of(GetParam());
    const Structure structure =
        make_structure(resolve(model), testing::fixed_mesh(4, order), Geometry::nonlinear);
    StructuralProblem problem(structure);
    const Eigen::VectorXd y = 0.3 * motion(structure);
    const std::array<Eigen::VectorXd, 3> along{motion(structure), motion(structure), motion(structure)};
    State numbers(static_cast<std::size_t>(y.size()));
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      numbers[i] = y[i];
      for (int k = 0; k < 3; ++k) numbers[i].c[1 << k] = along[k][i];
    }
    Number energy;
    double size = 0.0;  // of the terms whose sum is compared
    const auto add = [&](const Number& part) {
      energy += part;
      size += std::abs(part.c[7]);
    };
    for (int e = 0; e < 4; ++e) {
      add(beam_energy(structure, e, numbers));
      if (!GetParam().contact) continue;
      const Contact contact(structure, e, numbers);
      add(contact.energy());
      ends += contact.ends();
    }
    constexpr double kLambda = 0.7;
    constexpr double kRate = 1.3;  // of the load factor along the first direction
    const auto found = [&](double rate) {
      const Eigen::MatrixXd change = problem.tangent_change(y, kLambda, {along[0], rate}, along[1]);
      return problem.work(change.col(0), along[2]);
    };
    EXPECT_NEAR(found(0.0), energy.c[7], kRounding * size) << "order " << order;
    // the tangent is linear in the load factor, and its difference at a large one has all digits
    constexpr double kLarge = 0x1p30;
    const auto by_load = [&](const Eigen::VectorXd& direction) {
      const Eigen::VectorXd difference = problem.tangent_product(y, kLambda + kLarge, direction) -
                                         problem.tangent_product(y, kLambda, direction);
      return problem.work(difference, along[2]) / kLarge;
    };
    const double expected = energy.c[7] + kRate * by_load(along[1]);
    EXPECT_NEAR(found(kRate), expected, kRounding * size) << "order " << order;
    // so is the load, whose derivative is minus that of the tangent by the load factor
    EXPECT_NEAR(problem.work(problem.load_change(y, kLambda, {along[0], kRate}), along[2]),
                -by_load(along[0]), kRounding * size)
        << "order " << order;
  }
  EXPECT_EQ(ends > 0, GetParam().contact) << "an end of contact lies inside some element";
}

}  // namespace
}  // namespace snapthrough
