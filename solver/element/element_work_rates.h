#pragma once
/// @file
/// Derivative of the tangent of ElementWorkOf along a direction. Included by element_work.h only.

namespace snapthrough {

/// Adds the beam's part of the derivative of the tangent along `along`, times `direction`: the derivative of
/// add_strain_product() at fixed `direction`. Zero for small displacements.
template <int P>
void ElementWorkOf<P>::add_strain_rate(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                                       const double* y, const StrainChange& change, const double* direction,
                                       double* out) const {
  const double* s = y + dofs.s;
  const double* dv = direction + dofs.v;
  const double* ds = direction + dofs.s;
  double* fv = out + dofs.v;
  double* fs = out + dofs.s;
  Gauss moment;
  double moment_a = 0.0;
  for (int q = 0; q < P; ++q) {
    double db = 0.0;
    for (int r = 0; r < P; ++r) db += a_[q][r] * dv[2 * P + r];
    db = direction[dofs.a[2]] + shape.h * db;
    const double c = kin.c[q];
    const double sn = kin.s[q];
    const double along = c * dv[q] + sn * dv[P + q];
    const double across = c * dv[P + q] - sn * dv[q];
    const double de = along + kin.G[q] * db;
    const double dg = across - kin.E[q] * db;
    const double e_rate = across * change.b[q] + change.g[q] * db;
    const double g_rate = -along * change.b[q] - change.e[q] * db;
    const double hb = shape.hb[q];
    fs[q] += hb * e_rate;
    fs[P + q] += hb * g_rate;
    // change of the section force (N, Q) in the axes d1, d2
    const double n = change.b[q] * -ds[P + q] + db * -(change.Q[q] + s[q] * change.b[q]);
    const double t = change.b[q] * ds[q] + db * (change.N[q] - s[P + q] * change.b[q]);
    fv[q] += hb * (c * n - sn * t);
    fv[P + q] += hb * (sn * n + c * t);
    moment[q] = hb * (ds[q] * change.g[q] - ds[P + q] * change.e[q] + change.N[q] * dg - change.Q[q] * de +
                      s[q] * g_rate - s[P + q] * e_rate);
    moment_a += moment[q];
  }
  out[dofs.a[2]] += moment_a;
  for (int q = 0; q < P; ++q)
    for (int r = 0; r < P; ++r) fv[2 * P + r] += moment[q] * shape.h * a_[q][r];
}

/// Changes of rotation, strains and section forces along a direction.
template <int P>
auto ElementWorkOf<P>::strain_change(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                                     const double* along) const -> StrainChange {
  StrainChange out;
  const double* v = along + dofs.v;
  const double* s = along + dofs.s;
  for (int q = 0; q < P; ++q) {
    double sum = 0.0;
    for (int r = 0; r < P; ++r) sum += a_[q][r] * v[2 * P + r];
    out.b[q] = along[dofs.a[2]] + shape.h * sum;
    out.e[q] = kin.c[q] * v[q] + kin.s[q] * v[P + q] + kin.G[q] * out.b[q];
    out.g[q] = kin.c[q] * v[P + q] - kin.s[q] * v[q] - kin.E[q] * out.b[q];
    out.N[q] = s[q];
    out.Q[q] = s[P + q];
  }
  return out;
}

/// Collects the derivative of the supports' tangent along `along` as functionals in acting_: n n^T p''(w)
/// n(along) for laws with a curve, what the turning normals of surfaces change, and what moving ends of
/// contact change.
template <int P>
void ElementWorkOf<P>::collect_support_rates(int element, const double* y, const double* along) {
  const Shape& shape = shapes_[element];
  const ElementDofs& dofs = dofs_[element];
  acting_.clear();
  if (shape.curved && regime_.linearised_at() == nullptr) {
    collect_supports(element, y);
    std::erase_if(acting_, [](const Functional& f) { return f.law.curve == nullptr && f.bend == 0.0; });
    const std::size_t count = acting_.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Functional f = acting_[k];
      const Law::Response response = f.law.response_at(penetration(f, dofs, y));
      const double into = data_.value(f, dofs, along);
      acting_[k].tangent = response.rate * into;
      if (f.bend != 0.0) add_surface_rates(f, response, into, dofs, along);
    }
  }
  if (!regime_.is_frozen() && !regime_.bilateral()) add_moving_ends(shape, dofs, y, along);
}

/// Adds the change of the tangent p' n n^T + p b t t^T at a surface by its turning normal to acting_. With n
/// and t the functionals along normal and tangent, the motion changes n by b t(along) t, t by -b t(along) n,
/// and the bend b by b' t(along) - b^2 n(along).
/// @param into n(along)
template <int P>
void ElementWorkOf<P>::add_surface_rates(const Functional& n, const Law::Response& response, double into,
                                         const ElementDofs& dofs, const double* along) {
  Functional t = data_.along_surface(n);
  const double across = data_.value(t, dofs, along);
  // factor of n t^T + t n^T
  const double mixed = (response.stiffness * n.bend - response.force * n.bend * n.bend) * across;
  t.tangent =
      response.stiffness * into * n.bend + response.force * (n.bend_rate * across - n.bend * n.bend * into);
  acting_.push_back(t);
  for (const double sign : {1.0, -1.0}) {  // 2 (n t^T + t n^T) = (n + t)(n + t)^T - (n - t)(n - t)^T
    Functional both = n;
    for (int c = 0; c < 3; ++c) {
      both.a[c] += sign * t.a[c];
      for (int q = 0; q < P; ++q) both.v[c][q] += sign * t.v[c][q];
    }
    both.tangent = 0.5 * sign * mixed;
    acting_.push_back(both);
  }
}

/// Adds the change of the tangent by moving ends of contact and knots of laws to acting_: with K the change
/// of stiffness there and n the functional of the penetration g, the place moves by n(along) / |g'|, and the
/// tangent changes by K n n^T n(along) / |g'|. At the seam of a surface the bend b jumps: with t the
/// functional along the surface, a' the slope of the distance ahead of the seam and p the reaction, the
/// tangent changes by p [b] t t^T t(along) / |a'|. Ends of a foundation do not move.
template <int P>
void ElementWorkOf<P>::add_moving_ends(const Shape& shape, const ElementDofs& dofs, const double* y,
                                       const double* along) {
  const auto last = static_cast<std::size_t>(shape.first_contact + shape.contact_count);
  for (auto i = static_cast<std::size_t>(shape.first_contact); i < last; ++i) {
    const FoundationContact& contact = contacts_[i];
    if (contact.has_layer()) continue;  // add_layer_changes()
    const ContactDisplacement u = data_.displacement_of(contact, shape, dofs, y);
    const double share = contact.law().one_sided ? regime_.softness : 1.0;
    const auto add = [&](Functional f, double stiffness, double slope) {
      f.tangent = share * stiffness * data_.value(f, dofs, along) / std::abs(slope);
      if (std::isfinite(f.tangent)) acting_.push_back(f);
    };
    const auto add_end = [&](double xi) {
      const Functional f = data_.functional_at(contact, shape.h, xi, &u);
      add(f, f.law.stiffness, contact.penetration_slope(xi, u.start, u.dx, u.dy));
    };
    if (contact.is_curved()) {
      contact.knot_places(u.start, u.dx, u.dy, knots_);
      for (const auto& knot : knots_) {
        if (knot.stiffness_change == 0.0 && knot.bend_change == 0.0) continue;
        const Functional f = data_.functional_at(contact, shape.h, knot.xi, &u);
        add(f, knot.stiffness_change, knot.slope);
        const double depth = std::max(penetration(f, dofs, y), 0.0);
        add(data_.along_surface(f), f.law.force_at(depth) * knot.bend_change, knot.slope);
      }
    }
    if (!contact.law().one_sided) continue;
    for (const ElementPart& part : parts_in_contact(i, shape, dofs, y)) {
      if (part.from != contact.range()[0]) add_end(part.from);
      if (part.to != contact.range()[1]) add_end(part.to);
    }
  }
}

template <int P>
void ElementWorkOf<P>::add_tangent_changes(const Eigen::VectorXd& y, const LoadFactors& rates,
                                           const Regime& regime, const Eigen::VectorXd& along,
                                           const Eigen::Ref<const Eigen::MatrixXd>& directions,
                                           Eigen::MatrixXd& out) {
  begin(rates, regime);
  if (linear_ && contacts_.empty() && springs_.empty() && !data_.bends) return;
  find_kinematics(y);
  find_layers(y.data());
  if (!regime_.is_frozen() && !regime_.bilateral()) add_layer_changes(along.data(), directions, out);
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    const ElementDofs& dofs = dofs_[e];
    const Kinematics& kin = kinematics_[e];
    const StrainChange change = strain_change(shape, dofs, kin, along.data());
    collect_support_rates(e, y.data(), along.data());
    const LinePressure pressure = linear_ ? LinePressure{} : pressure_of(shape);
    for (Eigen::Index i = 0; i < directions.cols(); ++i) {
      const double* direction = directions.col(i).data();
      double* product = out.col(i).data();
      if (!linear_) add_strain_rate(shape, dofs, kin, y.data(), change, direction, product);
      if (shape.bending != nullptr) add_bending_rate(shape, dofs, y.data(), along.data(), direction, product);
      if (pressure.acts()) add_pressure_product(shape, dofs, pressure, direction, product);
      add_acting_product(dofs, direction, product);
    }
  }
}

template <int P>
void ElementWorkOf<P>::add_pressure_change(const LoadFactors& factors, const Eigen::VectorXd& along,
                                           Eigen::VectorXd& out) {
  begin(factors, {});
  if (!data_.pressed) return;
  for (int e = 0; e < size(); ++e)
    if (const LinePressure pressure = pressure_of(shapes_[e]); pressure.acts())
      add_pressure_product(shapes_[e], dofs_[e], pressure.times(-1.0), along.data(), out.data());
}

}  // namespace snapthrough
