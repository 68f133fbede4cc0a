#pragma once
/// @file
/// Kinematics and strains of ElementWorkOf. Included by element_work.h only.

namespace snapthrough {

/// Finds the kinematics of all elements at y, unless they are those of the last call.
template <int P>
void ElementWorkOf<P>::find_kinematics(const Eigen::VectorXd& y) {
  const auto bytes = sizeof(double) * static_cast<std::size_t>(y.size());
  if (kinematics_linear_ == linear_ && kinematics_at_.size() == y.size() &&
      std::memcmp(kinematics_at_.data(), y.data(), bytes) == 0)
    return;
  kinematics_at_ = y;
  parts_known_.assign(contacts_.size(), 0);
  kinematics_linear_ = linear_;
  kinematics_.resize(shapes_.size());
  constexpr int kAtOnce = 64;  // elements whose sines are found together
  for (int first = 0; first < size(); first += kAtOnce)
    find_kinematics(y.data(), first, std::min(first + kAtOnce, size()));
}

/// Finds the kinematics of the elements from `first` to before `last`.
template <int P>
void ElementWorkOf<P>::find_kinematics(const double* y, int first, int last) {
  const std::size_t count = lanes_for(static_cast<std::size_t>(last - first) * P);
  for (auto* list : {&turns_.angle, &turns_.sine, &turns_.cosine}) list->resize(count, Lanes::Zero());
  double* turn = turns_.angle.front().data();
  for (int e = first; e < last; ++e) {
    const double* curvature = y + dofs_[e].v + 2 * P;
    for (int q = 0; q < P; ++q) {
      double sum = 0.0;
      for (int r = 0; r < P; ++r) sum += a_[q][r] * curvature[r];
      *turn++ = y[dofs_[e].a[2]] + shapes_[e].h * sum;
    }
  }
  if (!linear_) find_sines(turns_);
  for (int e = first; e < last; ++e) {
    const std::size_t at = static_cast<std::size_t>(e - first) * P;
    if (linear_)
      find_small_strains(shapes_[e], y + dofs_[e].v, turns_.angle.front().data() + at, kinematics_[e]);
    else
      find_strains(shapes_[e], y + dofs_[e].v, turns_.sine.front().data() + at,
                   turns_.cosine.front().data() + at, kinematics_[e]);
  }
}

/// Strains linearised about the stress-free axis, and the directions of the stress-free section.
/// @param v (u'_x, u'_y, b')
/// @param b rotations
template <int P>
void ElementWorkOf<P>::find_small_strains(const Shape& shape, const double* v, const double* b,
                                          Kinematics& kin) {
  for (int q = 0; q < P; ++q) {
    kin.c[q] = shape.cos0[q];
    kin.s[q] = shape.sin0[q];
    kin.e[q] = shape.cos0[q] * v[q] + shape.sin0[q] * v[P + q] + shape.g0[q] * b[q];
    kin.g[q] = -shape.sin0[q] * v[q] + shape.cos0[q] * v[P + q] - shape.e0[q] * b[q];
    kin.E[q] = shape.e0[q] + kin.e[q];
    kin.G[q] = shape.g0[q] + kin.g[q];
  }
}

/// Strains of the exact theory, and the directions of the section.
/// @param v (u'_x, u'_y, b')
/// @param sb, cb sine and cosine of the rotations
template <int P>
void ElementWorkOf<P>::find_strains(const Shape& shape, const double* v, const double* sb, const double* cb,
                                    Kinematics& kin) {
  for (int q = 0; q < P; ++q) {
    // cb - 1 without cancellation
    const double less = cb[q] > 0.0 ? -sb[q] * sb[q] / (1.0 + cb[q]) : cb[q] - 1.0;
    kin.c[q] = shape.cos0[q] * cb[q] - shape.sin0[q] * sb[q];
    kin.s[q] = shape.sin0[q] * cb[q] + shape.cos0[q] * sb[q];
    kin.e[q] = v[q] * kin.c[q] + v[P + q] * kin.s[q] + less * shape.e0[q] + sb[q] * shape.g0[q];
    kin.g[q] = -v[q] * kin.s[q] + v[P + q] * kin.c[q] + less * shape.g0[q] - sb[q] * shape.e0[q];
    kin.E[q] = shape.e0[q] + kin.e[q];
    kin.G[q] = shape.g0[q] + kin.g[q];
  }
}

template <int P>
void ElementWorkOf<P>::add_strain_residual(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                                           const double* y, double* residual) const {
  const double* v = y + dofs.v;
  const double* s = y + dofs.s;
  const double* m = y + dofs.m;
  double* fv = residual + dofs.v;
  double* fs = residual + dofs.s;
  double* fm = residual + dofs.m;
  double gap[3];
  for (int c = 0; c < 3; ++c) gap[c] = y[dofs.b[c]] - y[dofs.a[c]];
  double moment_a = 0.0;
  for (int q = 0; q < P; ++q) {
    const double hb = shape.hb[q];
    const double N = s[q];
    const double Q = s[P + q];
    fs[q] += hb * (kin.e[q] - shape.compliance[q] * N);
    fs[P + q] += hb * (kin.g[q] - shape.compliance[P + q] * Q);
    fs[2 * P + q] += hb * (v[2 * P + q] - shape.compliance[2 * P + q] * s[2 * P + q]);
    fv[q] += hb * (N * kin.c[q] - Q * kin.s[q] - m[0]);
    fv[P + q] += hb * (N * kin.s[q] + Q * kin.c[q] - m[1]);
    fv[2 * P + q] += hb * (s[2 * P + q] - m[2]);
    // N G - Q E: moment of the section force about the axis tangent (the initial one in linear geometry)
    const double turn = linear_ ? N * shape.g0[q] - Q * shape.e0[q] : N * kin.G[q] - Q * kin.E[q];
    moment_a += hb * turn;
    for (int r = 0; r < P; ++r) fv[2 * P + r] += hb * turn * shape.h * a_[q][r];
    for (int c = 0; c < 3; ++c) gap[c] -= hb * v[c * P + q];
  }
  for (int c = 0; c < 3; ++c) {
    residual[dofs.a[c]] -= m[c];
    residual[dofs.b[c]] += m[c];
    fm[c] += gap[c];
  }
  residual[dofs.a[2]] += moment_a;
  if (shape.bending != nullptr) add_bending_residual(shape, dofs, y, residual);
}

/// Adds the beam's part of the tangent times a direction.
template <int P>
void ElementWorkOf<P>::add_strain_product(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                                          const double* y, const double* direction, double* out) const {
  const double* s = y + dofs.s;
  const double* dv = direction + dofs.v;
  const double* ds = direction + dofs.s;
  const double* dm = direction + dofs.m;
  double* fv = out + dofs.v;
  double* fs = out + dofs.s;
  double gap[3];
  for (int c = 0; c < 3; ++c) gap[c] = direction[dofs.b[c]] - direction[dofs.a[c]];
  for (int q = 0; q < P; ++q) {
    const double hb = shape.hb[q];
    double db = 0.0;
    for (int r = 0; r < P; ++r) db += a_[q][r] * dv[2 * P + r];
    db = direction[dofs.a[2]] + shape.h * db;
    const double c = kin.c[q];
    const double sn = kin.s[q];
    const double E = linear_ ? shape.e0[q] : kin.E[q];
    const double G = linear_ ? shape.g0[q] : kin.G[q];
    const double geo = linear_ ? 0.0 : db;
    const double along = c * dv[q] + sn * dv[P + q];
    const double across = -sn * dv[q] + c * dv[P + q];
    fs[q] += hb * (along + G * db - shape.compliance[q] * ds[q]);
    fs[P + q] += hb * (across - E * db - shape.compliance[P + q] * ds[P + q]);
    fs[2 * P + q] += hb * (dv[2 * P + q] - shape.compliance[2 * P + q] * ds[2 * P + q]);
    fv[q] += hb * (ds[q] * c - ds[P + q] * sn - geo * (s[q] * sn + s[P + q] * c) - dm[0]);
    fv[P + q] += hb * (ds[q] * sn + ds[P + q] * c + geo * (s[q] * c - s[P + q] * sn) - dm[1]);
    fv[2 * P + q] += hb * (ds[2 * P + q] - dm[2]);
    double turn = ds[q] * G - ds[P + q] * E;
    if (!linear_) turn += s[q] * (across - E * db) - s[P + q] * (along + G * db);
    out[dofs.a[2]] += hb * turn;
    for (int r = 0; r < P; ++r) fv[2 * P + r] += hb * turn * shape.h * a_[q][r];
    for (int k = 0; k < 3; ++k) gap[k] -= hb * dv[k * P + q];
  }
  for (int k = 0; k < 3; ++k) {
    out[dofs.a[k]] -= dm[k];
    out[dofs.b[k]] += dm[k];
    out[dofs.m + k] += gap[k];
  }
  if (shape.bending != nullptr) add_bending_product(shape, dofs, y, direction, out);
}

}  // namespace snapthrough
