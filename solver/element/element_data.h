#pragma once
/// @file
/// Geometry, sections and supports of the elements of one order P, independent of any state. Included only by
/// the files that instantiate ElementSetOf.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solver/element/element_set.h"
#include "solver/element/shear_layer.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/rounding.h"

namespace snapthrough {

/// Geometry, sections and supports of elements of order P.
template <int P>
struct ElementData {
  static constexpr int kStrains = DofMap::count(P);
  using Gauss = std::array<double, P>;

  struct Shape {
    double h = 0.0;
    bool shearable = false;
    Gauss cos0{}, sin0{}, tx{}, ty{}, e0{}, g0{}, hb{};
    std::array<double, kStrains> compliance{};
    std::array<double, kStrains> root{};    ///< square root of the compliance
    const BendingCurve* bending = nullptr;  ///< null: the curvature is compliance times moment
    int first_spring = 0, spring_count = 0;
    int first_contact = 0, contact_count = 0;
    bool curved = false;  ///< some support has a law with a curve, or the surface of a medium
    /// Force per deformed length along the deformed right normal.
    LinePressure pressure, constant_pressure;
    int factor = 0;  ///< index among the unshearable or among the shearable elements
  };
  /// Linear functional of an element's displacements, with the law of the support that it drives.
  struct Functional {
    Law law;
    double tangent = 0.0;  ///< stiffness of the law at the state, where the support acts
    /// Second and third derivative of the penetration along the tangent of a surface, see SurfacePoint.
    double bend = 0.0;
    double bend_rate = 0.0;
    double size = 0.0;  ///< SurfacePoint::size
    Touch touch = Touch::none;
    int spring = -1;
    GroundPlace ground;
    std::array<double, 3> a{};
    std::array<Gauss, 3> v{};
  };
  /// Displacement relative to the ground: at the element start, and h u'_x, h u'_y at the Gauss points.
  struct ContactDisplacement {
    std::array<double, 2> start;
    Gauss dx, dy;
  };

  /// @param supports kept by reference; must outlive this object
  explicit ElementData(const ElementContacts& supports);
  [[nodiscard]] ContactDisplacement displacement_of(const FoundationContact& contact, const Shape& shape,
                                                    const ElementDofs& at, const double* y) const;
  [[nodiscard]] double value(const Functional& f, const ElementDofs& at, const double* y) const;
  [[nodiscard]] Functional functional_at(const FoundationContact& contact, double h, double xi,
                                         const ContactDisplacement* u) const;
  /// Functional of the displacement along the tangent (-d_y, d_x) of the surface under a functional's
  /// direction d, without law.
  [[nodiscard]] static Functional along_surface(const Functional& f);
  /// Functional of a row of weights of (x, y, rotation), with zero stiffness and gap.
  /// @param integrals the A_r there
  [[nodiscard]] static Functional penetration(const std::array<double, 3>& row, double h,
                                              std::span<const double> integrals);
  /// Functional of the derivative of the penetration by xi, with the stiffness of the shear layer.
  [[nodiscard]] Functional slope_functional(const FoundationContact& contact, double h, double xi) const;
  /// Whether a spring acts at the unknowns y.
  [[nodiscard]] bool acts(const Functional& f, const ElementDofs& at, const double* y) const;

  const CollocationRule* rule;
  Gauss b{};
  std::array<Gauss, P> a{};  ///< A_qr: integral of Lagrange polynomial r from 0 to point q
  /// Quadrature on contact intervals: exact for straight axes; on curved axes accurate enough that the
  /// tangent is the derivative of the residual.
  Quadrature contact_quadrature;
  std::vector<Shape> shapes;
  std::vector<ElementDofs> dofs;
  bool pressed = false;  ///< a follower pressure acts on some element
  bool bends = false;    ///< some element has a bending law
  int stiff = 0;         ///< number of unshearable elements
  int shearable = 0;     ///< number of shearable elements
  std::vector<Functional> springs;
  const ElementContacts& contacts;
  /// Functionals at the Gauss points of each contact's whole range.
  std::vector<std::vector<Functional>> whole_contacts;
};

template <int P>
class ElementSetOf final : public ElementSet {
 public:
  ElementSetOf() : ElementSet(P), data_(contacts_) {}
  void reserve(int elements) override {
    data_.shapes.reserve(elements);
    data_.dofs.reserve(elements);
  }
  void add(const ElementShape& shape, const ElementDofs& dofs) override;
  void add_like(const ElementSet& other, int element, const ElementDofs& dofs) override;
  void add_spring(const SupportSpring& support) override;
  void add_foundation(int element, FoundationContact contact, Touch touch) override;
  void set_pressure(int element, const LinePressure& proportional, const LinePressure& constant) override;
  [[nodiscard]] std::unique_ptr<ElementWork> make_work() const override;

 private:
  void append(typename ElementData<P>::Shape shape, const ElementDofs& dofs);

  ElementData<P> data_;
};

template <int P>
ElementData<P>::ElementData(const ElementContacts& supports)
    : rule(&CollocationRule::of(P)),
      contact_quadrature(FoundationContact::quadrature(P)),
      contacts(supports) {
  for (int q = 0; q < P; ++q) {
    b[q] = rule->weight(q);
    for (int r = 0; r < P; ++r) a[q][r] = rule->integral(q, r);
  }
}

template <int P>
auto ElementData<P>::displacement_of(const FoundationContact& contact, const Shape& shape,
                                     const ElementDofs& at, const double* y) const -> ContactDisplacement {
  ContactDisplacement u{{y[at.a[0]], y[at.a[1]]}, {}, {}};
  if (contact.is_rotational()) {
    u.start = {y[at.a[2]], 0.0};
    for (int q = 0; q < P; ++q) u.dx[q] = shape.h * y[at.v + 2 * P + q];
    return u;
  }
  for (int q = 0; q < P; ++q) {
    u.dx[q] = shape.h * y[at.v + q];
    u.dy[q] = shape.h * y[at.v + P + q];
  }
  contact.ground().subtract_from(y, u.start, u.dx, u.dy);
  return u;
}

template <int P>
double ElementData<P>::value(const Functional& f, const ElementDofs& at, const double* y) const {
  double w = f.a[0] * y[at.a[0]] + f.a[1] * y[at.a[1]] + f.a[2] * y[at.a[2]];
  const double* v = y + at.v;
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < P; ++q) w += f.v[c][q] * v[c * P + q];
  return w - f.ground.along(f.a, y);
}

template <int P>
bool ElementData<P>::acts(const Functional& f, const ElementDofs& at, const double* y) const {
  if (!f.law.one_sided) return true;
  const double w = value(f, at, y) - f.law.gap;
  return f.touch != Touch::none && std::abs(w) <= Rounding::touching ? f.touch == Touch::acts : w > 0.0;
}

/// Functional of the penetration at xi of a contact, with the law there. For a surface it is that of its
/// tangent plane under the displaced axis, and the gap is the distance of the initial axis from that plane.
/// @param u displacements; null: as seen from the initial axis
template <int P>
auto ElementData<P>::functional_at(const FoundationContact& contact, double h, double xi,
                                   const ContactDisplacement* u) const -> Functional {
  Gauss integrals;
  rule->integrals_at(xi, integrals);
  const auto along = [&](std::array<double, 2> d) {
    Functional f = penetration(contact.row(d), h, integrals);
    f.law = contact.law_at(xi);
    f.ground = contact.ground().at(xi);
    return f;
  };
  if (u == nullptr || !contact.follows_surface()) return along(contact.direction_at(xi));
  const auto moved = contact.displacement(xi, u->start, u->dx, u->dy);
  const SurfacePoint at = contact.penetration_at(xi, moved);
  Functional f = along(at.into);
  f.law.gap = at.into[0] * moved[0] + at.into[1] * moved[1] - at.depth;
  f.bend = at.bend;
  f.bend_rate = at.bend_rate;
  f.size = at.size;
  return f;
}

template <int P>
auto ElementData<P>::along_surface(const Functional& f) -> Functional {
  Functional out;
  out.ground = f.ground;
  out.a = {-f.a[1], f.a[0], 0.0};
  for (int q = 0; q < P; ++q) {
    out.v[0][q] = -f.v[1][q];
    out.v[1][q] = f.v[0][q];
    out.v[2][q] = 0.0;
  }
  return out;
}

template <int P>
auto ElementData<P>::penetration(const std::array<double, 3>& row, double h,
                                 std::span<const double> integrals) -> Functional {
  Functional f;
  f.a = row;
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < P; ++q) f.v[c][q] = row[c] * h * integrals[q];
  return f;
}

template <int P>
auto ElementData<P>::slope_functional(const FoundationContact& contact, double h, double xi) const
    -> Functional {
  const auto d = contact.direction_at(xi);
  const auto rate = contact.direction_rate(xi);
  Gauss integrals;
  Gauss values;
  rule->integrals_at(xi, integrals);
  rule->values_at(xi, values);
  Functional f = penetration({rate[0], rate[1], 0.0}, h, integrals);
  for (int c = 0; c < 2; ++c)
    for (int q = 0; q < P; ++q) f.v[c][q] += h * values[q] * d[c];
  f.law.stiffness = contact.shear() / h;
  return f;
}

template <int P>
void ElementSetOf<P>::add(const ElementShape& in, const ElementDofs& dofs) {
  typename ElementData<P>::Shape shape;
  shape.h = in.length;
  for (int q = 0; q < P; ++q) {
    shape.cos0[q] = std::cos(in.angle[q]);
    shape.sin0[q] = std::sin(in.angle[q]);
    shape.tx[q] = in.t[q][0];
    shape.ty[q] = in.t[q][1];
    shape.e0[q] = in.t[q][0] * shape.cos0[q] + in.t[q][1] * shape.sin0[q];
    shape.g0[q] = -in.t[q][0] * shape.sin0[q] + in.t[q][1] * shape.cos0[q];
    shape.hb[q] = in.length * data_.b[q];
    shape.compliance[q] = in.axial_compliance[q];
    shape.compliance[P + q] = in.shear_compliance[q];
    shape.compliance[2 * P + q] = in.bending_compliance[q];
    shape.shearable = shape.shearable || in.shear_compliance[q] > 0.0;
  }
  shape.bending = in.bending;
  for (int i = 0; i < ElementData<P>::kStrains; ++i) shape.root[i] = std::sqrt(shape.compliance[i]);
  append(shape, dofs);
}

template <int P>
void ElementSetOf<P>::add_like(const ElementSet& other, int element, const ElementDofs& dofs) {
  append(static_cast<const ElementSetOf&>(other).data_.shapes[element], dofs);
}

/// Adds a shape without supports and pressure.
template <int P>
void ElementSetOf<P>::append(typename ElementData<P>::Shape shape, const ElementDofs& dofs) {
  shape.first_spring = static_cast<int>(data_.springs.size());
  shape.first_contact = static_cast<int>(contacts_.contacts().size());
  shape.spring_count = shape.contact_count = 0;
  shape.pressure = shape.constant_pressure = LinePressure{};
  data_.bends = data_.bends || shape.bending != nullptr;
  shape.factor = shape.shearable ? data_.shearable++ : data_.stiff++;
  contacts_.add_element(shape.h, dofs);
  data_.shapes.push_back(shape);
  data_.dofs.push_back(dofs);
}

/// Adds a spring to the element added last, so that the springs of an element are contiguous.
template <int P>
void ElementSetOf<P>::add_spring(const SupportSpring& support) {
  typename ElementData<P>::Functional f;
  f.law = support.law;
  f.touch = support.touch;
  f.spring = support.spring;
  f.ground = support.ground;
  f.a = support.a;
  for (int q = 0; q < P; ++q)
    for (int c = 0; c < 3; ++c) f.v[c][q] = support.v[q][c];
  data_.springs.push_back(f);
  contacts_.add_spring(support);
  auto& shape = data_.shapes[support.element];
  ++shape.spring_count;
  shape.curved = shape.curved || f.law.curve != nullptr;
}

template <int P>
void ElementSetOf<P>::add_foundation(int element, FoundationContact contact, Touch touch) {
  auto& whole = data_.whole_contacts.emplace_back();
  whole.reserve(data_.contact_quadrature.points.size());
  for (std::size_t i = 0; i < data_.contact_quadrature.points.size(); ++i) {
    const auto at = contact.at_point(i);
    const double xi =
        contact.range()[0] + (contact.range()[1] - contact.range()[0]) * data_.contact_quadrature.points[i];
    whole.push_back(data_.penetration(contact.row({at[0], at[1]}), data_.shapes[element].h, at.subspan(2)));
    whole.back().law = contact.law_at(xi);
    whole.back().ground = contact.ground().at(xi);
  }
  auto& shape = data_.shapes[element];
  ++shape.contact_count;
  shape.curved = shape.curved || contact.law().curve != nullptr || contact.follows_surface();
  contacts_.add_contact(element, std::move(contact), touch);
}

template <int P>
void ElementSetOf<P>::set_pressure(int element, const LinePressure& proportional,
                                   const LinePressure& constant) {
  auto& shape = data_.shapes[element];
  shape.pressure.middle += proportional.middle;
  shape.pressure.change += proportional.change;
  shape.constant_pressure.middle += constant.middle;
  shape.constant_pressure.change += constant.change;
  data_.pressed = true;
}

}  // namespace snapthrough
