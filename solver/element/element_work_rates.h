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

/// Collects the derivative of the foundations' tangent as functionals in acting_: with K the stiffness of the
/// law, n the functional of the penetration g at an end of contact, that end moves by n(along) / |g'|, and
/// the tangent changes by K n n^T n(along) / |g'|. Ends of a foundation do not move.
template <int P>
void ElementWorkOf<P>::collect_moving_ends(const Shape& shape, const ElementDofs& dofs, const double* y,
                                           const double* along) {
  acting_.clear();
  if (regime_.is_frozen() || regime_.bilateral()) return;
  const auto last = static_cast<std::size_t>(shape.first_contact + shape.contact_count);
  for (auto i = static_cast<std::size_t>(shape.first_contact); i < last; ++i) {
    const FoundationContact& contact = contacts_[i];
    const ContactDisplacement u = data_.displacement_of(shape, dofs, y);
    const auto add_end = [&](double xi) {
      const double slope = std::abs(contact.penetration_slope(xi, u.start, u.dx, u.dy));
      Functional f = data_.functional_at(contact, shape.h, xi);
      f.tangent = regime_.softness * contact.law().stiffness_at(0.0) * data_.value(f, dofs, along) / slope;
      if (std::isfinite(f.tangent)) acting_.push_back(f);
    };
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
  if (linear_ && contacts_.empty()) return;
  find_kinematics(y);
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    const ElementDofs& dofs = dofs_[e];
    const Kinematics& kin = kinematics_[e];
    const StrainChange change = strain_change(shape, dofs, kin, along.data());
    collect_moving_ends(shape, dofs, y.data(), along.data());
    const LinePressure pressure = linear_ ? LinePressure{} : pressure_of(shape);
    for (Eigen::Index i = 0; i < directions.cols(); ++i) {
      const double* direction = directions.col(i).data();
      double* product = out.col(i).data();
      if (!linear_) add_strain_rate(shape, dofs, kin, y.data(), change, direction, product);
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
