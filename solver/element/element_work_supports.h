#pragma once
/// @file
/// Foundations, springs and follower pressure of ElementWorkOf. Included by element_work.h only.

namespace snapthrough {

/// Parts of an element on which a foundation acts at y. They are searched for once for each y.
/// @pre find_kinematics() was called at y
template <int P>
auto ElementWorkOf<P>::parts_in_contact(std::size_t index, const Shape& shape, const ElementDofs& dofs,
                                        const double* y) -> const std::vector<ElementPart>& {
  if (parts_known_[index] == 0) {
    const ContactDisplacement u = data_.displacement_of(contacts_[index], shape, dofs, y);
    data_.contacts.acting_parts(index, u.start, u.dx, u.dy, parts_[index]);
    parts_known_[index] = 1;
  }
  return parts_[index];
}

/// Appends the Gauss points of the intervals on which a foundation acts to acting_.
template <int P>
void ElementWorkOf<P>::collect_contact(std::size_t index, const double* y, const ElementDofs& dofs,
                                       const Shape& shape) {
  const FoundationContact& contact = contacts_[index];
  const ElementPart whole{contact.range()[0], contact.range()[1]};
  const bool one_sided = contact.law().one_sided;
  const double share = one_sided ? regime_.softness : 1.0;
  ContactDisplacement u;  // only supports whose tangent changes ask for it
  knots_.clear();
  if (contact.is_curved()) {
    const auto* at = regime_.linearised_at();
    u = data_.displacement_of(contact, shape, dofs, at != nullptr ? at->data() : y);
    contact.knot_places(u.start, u.dx, u.dy, knots_);
  }
  if (regime_.bilateral() || !one_sided) {
    add_pieces(index, shape, whole, share, nullptr);
  } else {
    const auto& parts =
        regime_.is_frozen() ? regime_.frozen->contacts[index] : parts_in_contact(index, shape, dofs, y);
    for (const ElementPart& part : parts) add_pieces(index, shape, part, share, &u);
  }
  if (contact.has_layer()) add_layer(index, shape, share);
  if (regime_.grip > 0.0 && one_sided) add_interval(index, shape, whole, regime_.grip, nullptr);
}

/// Appends the Gauss points of an interval, on the halves between the knots in knots_ if the foundation is
/// curved.
template <int P>
void ElementWorkOf<P>::add_pieces(std::size_t index, const Shape& shape, const ElementPart& interval,
                                  double share, const ContactDisplacement* u) {
  if (!contacts_[index].is_curved()) {
    add_interval(index, shape, interval, share, u);
    return;
  }
  FoundationContact::for_each_half(
      knots_, interval, [&](const ElementPart& half) { add_interval(index, shape, half, share, u); });
}

/// Appends the Gauss points of an interval with a share of the stiffness. Functionals of the whole range, the
/// most frequent case, are precomputed.
/// @param u displacements; null: without gap, in the directions on the initial axis
template <int P>
void ElementWorkOf<P>::add_interval(std::size_t index, const Shape& shape,
                                    const FoundationContact::Interval& interval, double share,
                                    const ContactDisplacement* u) {
  const FoundationContact& contact = contacts_[index];
  const double width = interval.to - interval.from;
  const bool whole = interval.from == contact.range()[0] && interval.to == contact.range()[1];
  const bool is_known = whole && (u == nullptr || !contact.follows_surface());
  for (std::size_t i = 0; i < data_.contact_quadrature.points.size(); ++i) {
    if (is_known)
      acting_.push_back(data_.whole_contacts[index][i]);
    else
      acting_.push_back(data_.functional_at(contact, shape.h,
                                            interval.from + width * data_.contact_quadrature.points[i], u));
    Law& law = acting_.back().law;
    if (u == nullptr) law.gap = 0.0;
    law.scale(share);
    law.scale(width);
    law.scale(data_.contact_quadrature.weights[i]);
  }
}

template <int P>
bool ElementWorkOf<P>::acts(const Functional& f, std::size_t support, const ElementDofs& dofs,
                            const double* y) const {
  if (!f.law.one_sided || regime_.bilateral()) return true;
  if (regime_.is_frozen()) return regime_.frozen->element_springs[support] != 0;
  return data_.acts(f, dofs, y);
}

/// Collects the functionals of the supports that act on an element in acting_.
template <int P>
void ElementWorkOf<P>::collect_supports(int element, const double* y) {
  const Shape& shape = shapes_[element];
  const ElementDofs& dofs = dofs_[element];
  acting_.clear();
  for (int i = 0; i < shape.contact_count; ++i) collect_contact(shape.first_contact + i, y, dofs, shape);
  for (int i = 0; i < shape.spring_count; ++i) {
    const std::size_t support = shape.first_spring + i;
    if (regime_.grip > 0.0 && springs_[support].law.one_sided) {
      acting_.push_back(springs_[support]);
      acting_.back().law.scale(regime_.grip);
      acting_.back().law.gap = 0.0;
    }
    if (!acts(springs_[support], support, dofs, y)) continue;
    acting_.push_back(springs_[support]);
    if (springs_[support].law.one_sided) acting_.back().law.scale(regime_.softness);
    if (regime_.bilateral()) acting_.back().law.gap = 0.0;
  }
}

/// Penetration of a functional at the unknowns y.
template <int P>
double ElementWorkOf<P>::penetration(const Functional& f, const ElementDofs& dofs, const double* y) const {
  return data_.value(f, dofs, y) - f.law.gap;
}

/// Force and stiffness of a law with a curve at a penetration w.
template <int P>
Law::Response ElementWorkOf<P>::curved_response(const Functional& f, const ElementDofs& dofs,
                                                double w) const {
  const auto* at = regime_.linearised_at();
  if (at == nullptr) return f.law.response_at(w);
  const double stiffness = f.law.stiffness_at(penetration(f, dofs, at->data()));
  return {stiffness * w, stiffness, 0.0};
}

template <int P>
void ElementWorkOf<P>::add_ground_forces(const double* motion, double* out) const {
  for (const auto& [element, f] : on_ground_) {
    const ElementDofs& dofs = dofs_[element];
    const double force = -f.tangent * f.ground.along(f.a, motion);
    for (int c = 0; c < 3; ++c) {
      out[dofs.a[c]] += force * f.a[c];
      for (int q = 0; q < P; ++q) out[dofs.v + c * P + q] += force * f.v[c][q];
    }
  }
}

template <int P>
void ElementWorkOf<P>::add_support_residual(int element, const double* y, double* residual, bool keep) {
  collect_supports(element, y);
  const ElementDofs& dofs = dofs_[element];
  std::array<double, kStrains> v;  // local copy of y: lets the compiler reorder the loops
  std::array<double, kStrains> forces{};
  double at_start[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < kStrains; ++i) v[i] = y[dofs.v + i];
  double rounding = 0.0;
  const std::size_t count = acting_.size();
  for (std::size_t k = 0; k < count; ++k) {
    Functional& f = acting_[k];
    double size = std::abs(f.law.gap) + f.size;
    for (int c = 0; c < 3; ++c) size += std::abs(f.a[c] * y[dofs.a[c]]);
    const double moved = f.ground.along(f.a, y);
    size += std::abs(moved);
    double w = -f.law.gap - moved;
    for (int c = 0; c < 3; ++c) w += f.a[c] * y[dofs.a[c]];
    const double* row = f.v[0].data();
    for (int i = 0; i < kStrains; ++i) w += row[i] * v[i];
    double force = f.law.stiffness * w;
    f.tangent = f.law.stiffness;
    if (f.law.curve != nullptr) {
      const Law::Response response = curved_response(f, dofs, w);
      force = response.force;
      f.tangent = response.stiffness;
    }
    rounding += f.tangent * size * std::numeric_limits<double>::epsilon();
    for (int c = 0; c < 3; ++c) at_start[c] += force * f.a[c];
    for (int i = 0; i < kStrains; ++i) forces[i] += force * row[i];
    f.ground.push(force, f.a, residual);
    if (f.bend != 0.0 && regime_.linearised_at() == nullptr) {
      Functional tangential = data_.along_surface(f);
      tangential.tangent = force * f.bend;
      acting_.push_back(tangential);
    }
  }
  for (int c = 0; c < 3; ++c) residual[dofs.a[c]] += at_start[c];
  for (int i = 0; i < kStrains; ++i) residual[dofs.v + i] += forces[i];
  support_rounding_ = std::max(support_rounding_, rounding);
  if (!keep) acting_.clear();
}

/// Adds the force  pressure * (y', -x') ds  (right normal times stretch) to a load vector.
///
/// The force is the derivative of pressure times the area 1/2 int (x y' - y x') ds swept by the element,
/// minus the surplus of that derivative at the element ends: nodal forces, which cancel between neighbours
/// with equal pressure or are carried by supports. Where the pressure changes, 1/2 p' (-y, x) is added: with
/// u = (x, y) and the variation v, int p (y' v_x - x' v_y) = d(area) - 1/2 [p (x v_y - y v_x)] + 1/2 int p'
/// (x v_y
/// - y v_x). The tangent of the last term is skew and not among the element's (discrete/follower_loads.h).
template <int P>
void ElementWorkOf<P>::add_pressure(const Shape& shape, const ElementDofs& dofs, const LinePressure& pressure,
                                    const double* y, double* load) const {
  Gauss xp;  // derivative of the axis
  Gauss yp;
  for (int q = 0; q < P; ++q) {
    xp[q] = shape.tx[q] + (linear_ ? 0.0 : y[dofs.v + q]);
    yp[q] = shape.ty[q] + (linear_ ? 0.0 : y[dofs.v + P + q]);
  }
  double place[2][P];  // position relative to the element's stress-free start
  double chord[2] = {0.0, 0.0};
  for (int q = 0; q < P; ++q) {
    chord[0] += shape.hb[q] * shape.tx[q];
    chord[1] += shape.hb[q] * shape.ty[q];
    for (int c = 0; c < 2; ++c) place[c][q] = linear_ ? 0.0 : y[dofs.a[c]];
    for (int r = 0; r < P; ++r) {
      place[0][q] += shape.h * a_[q][r] * xp[r];
      place[1][q] += shape.h * a_[q][r] * yp[r];
    }
  }
  for (int q = 0; q < P; ++q) {
    const double w = 0.5 * pressure.at(data_.rule->point(q)) * shape.hb[q];
    const double skew = 0.5 * pressure.change * data_.b[q];
    const double fx = w * yp[q] - skew * place[1][q];
    const double fy = -w * xp[q] + skew * place[0][q];
    load[dofs.a[0]] += fx;
    load[dofs.a[1]] += fy;
    load[dofs.v + q] -= w * place[1][q];
    load[dofs.v + P + q] += w * place[0][q];
    for (int r = 0; r < P; ++r) {
      load[dofs.v + r] += fx * shape.h * a_[q][r];
      load[dofs.v + P + r] += fy * shape.h * a_[q][r];
    }
  }
  for (const double sign : {-1.0, 1.0}) {  // element start, element end
    const auto& node = sign < 0.0 ? dofs.a : dofs.b;
    const double x = (linear_ ? 0.0 : y[node[0]]) + (sign < 0.0 ? 0.0 : chord[0]);
    const double z = (linear_ ? 0.0 : y[node[1]]) + (sign < 0.0 ? 0.0 : chord[1]);
    const double half = 0.5 * sign * pressure.at(sign < 0.0 ? 0.0 : 1.0);
    load[node[0]] += half * z;
    load[node[1]] -= half * x;
  }
}

template <int P>
void ElementWorkOf<P>::add_pressure_load(const Eigen::VectorXd& y, const LoadFactors& factors,
                                         bool small_displacements, Eigen::VectorXd& out) {
  Regime regime;
  regime.small_displacements = small_displacements;
  begin(factors, regime);
  if (!data_.pressed) return;
  for (int e = 0; e < size(); ++e)
    if (const LinePressure pressure = pressure_of(shapes_[e]); pressure.acts())
      add_pressure(shapes_[e], dofs_[e], pressure, y.data(), out.data());
}

/// Appends the symmetric part of the follower tangent, minus pressure times the second derivative of the area
/// 1/2 int (x y' - y x') ds, to acting_ as squares: 4 a b = (a + b)^2 - (a - b)^2. The remaining part belongs
/// to the element ends, cancels between neighbours with equal pressure, and vanishes at fixed ends.
template <int P>
void ElementWorkOf<P>::collect_pressure(const Shape& shape, const LinePressure& pressure) {
  for (int q = 0; q < P; ++q) {
    const double at_q = pressure.at(data_.rule->point(q));
    for (const int c : {0, 1}) {
      for (const double sign : {1.0, -1.0}) {
        Functional f;
        f.a[c] = 1.0;
        for (int r = 0; r < P; ++r) f.v[c][r] = shape.h * a_[q][r];
        f.v[1 - c][q] = sign;
        f.tangent = (c == 0 ? -0.25 : 0.25) * sign * at_q * shape.hb[q];
        acting_.push_back(f);
      }
    }
  }
}

/// Appends the masses of an element to acting_, as supports of the stiffness -shift times mass.
template <int P>
void ElementWorkOf<P>::collect_masses(int element) {
  const ElementMasses& masses = *regime_.masses;
  const double h = shapes_[element].h;
  for (int i = masses.first[element]; i < masses.first[element + 1]; ++i) {
    const MassPlace& place = masses.places[i];
    const auto integrals = std::span(place.integrals).first(P);
    for (const std::array<double, 3> along : {std::array{1.0, 0.0, 0.0}, std::array{0.0, 1.0, 0.0}}) {
      acting_.push_back(data_.penetration(along, h, integrals));
      acting_.back().tangent = -regime_.shift * place.mass;
    }
    if (place.rotary == 0.0) continue;
    Functional& turn = acting_.emplace_back();
    turn.a[2] = 1.0;
    for (int r = 0; r < P; ++r) turn.v[2][r] = h * integrals[r];
    turn.tangent = -regime_.shift * place.rotary;
  }
}

template <int P>
void ElementWorkOf<P>::add_pressure_product(const Shape& shape, const ElementDofs& dofs,
                                            const LinePressure& pressure, const double* direction,
                                            double* out) const {
  const double* dv = direction + dofs.v;
  double* fv = out + dofs.v;
  for (int q = 0; q < P; ++q) {
    double u[2] = {direction[dofs.a[0]], direction[dofs.a[1]]};
    for (int r = 0; r < P; ++r)
      for (int c = 0; c < 2; ++c) u[c] += shape.h * a_[q][r] * dv[c * P + r];
    const double w = -0.5 * pressure.at(data_.rule->point(q)) * shape.hb[q];
    const double place[2] = {w * dv[P + q], -w * dv[q]};
    fv[q] -= w * u[1];
    fv[P + q] += w * u[0];
    for (int c = 0; c < 2; ++c) {
      out[dofs.a[c]] += place[c];
      for (int r = 0; r < P; ++r) fv[c * P + r] += place[c] * shape.h * a_[q][r];
    }
  }
}

/// Adds the tangent products of the supports in acting_, as left by add_support_residual().
template <int P>
void ElementWorkOf<P>::add_acting_product(const ElementDofs& dofs, const double* direction,
                                          double* out) const {
  for (const Functional& f : acting_) {
    const double force = f.tangent * data_.value(f, dofs, direction);
    for (int k = 0; k < 3; ++k) {
      out[dofs.a[k]] += force * f.a[k];
      for (int q = 0; q < P; ++q) out[dofs.v + k * P + q] += force * f.v[k][q];
    }
    f.ground.push(force, f.a, out);
  }
}

}  // namespace snapthrough
