#pragma once
/// @file
/// Solutions with the factors of ElementWorkOf, four right-hand sides at a time. Included by element_work.h
/// only.

namespace snapthrough {

/// Right-hand sides of the displacement rows as forces on zeta. The rows of the element start are not
/// included.
template <int P>
auto ElementWorkOf<P>::to_strains(const ColumnLanes& rhs, const ElementDofs& dofs, const Shape& shape,
                                  const Tangent& t) const -> ZetaLanes {
  ZetaLanes out;
  Lanes turn_a = Lanes::Zero();
  for (int r = 0; r < P; ++r) out[2 * P + r] = rhs[dofs.v + 2 * P + r];
  for (int q = 0; q < P; ++q) {
    const Lanes vx = rhs[dofs.v + q];
    const Lanes vy = rhs[dofs.v + P + q];
    out[q] = t.c[q] * vx + t.s[q] * vy;
    out[P + q] = t.c[q] * vy - t.s[q] * vx;
    const Lanes turn = t.px[q] * vx + t.py[q] * vy;
    turn_a += turn;
    for (int r = 0; r < P; ++r) out[2 * P + r] += (shape.h * a_[q][r]) * turn;
  }
  out[kStrains] = Lanes::Zero();
  out[kStrains + 1] = Lanes::Zero();
  out[kStrains + 2] = turn_a;
  return out;
}

/// Subtracts the effect of given strains d from right-hand sides: tau - H d (strains) and rm + U d (m).
template <int P>
void ElementWorkOf<P>::subtract_strains(const Shape& shape, const Tangent& t, const ZetaLanes& d,
                                        ZetaLanes& tau, Lanes3& rm) const {
  for (int q = 0; q < P; ++q) {
    const Lanes& e = d[q];
    const Lanes& g = d[P + q];
    Lanes b = Lanes::Zero();
    for (int r = 0; r < P; ++r) b += (shape.h * a_[q][r]) * d[2 * P + r];
    tau[q] += t.t[q] * b;
    tau[P + q] -= t.n[q] * b;
    const Lanes turn = t.n[q] * g - t.t[q] * e + t.w[q] * b;
    for (int r = 0; r < P; ++r) tau[2 * P + r] -= (shape.h * a_[q][r]) * turn;
    tau[kStrains + 2] -= turn;
    rm[0] += shape.hb[q] * (t.c[q] * e - t.s[q] * g + t.px[q] * b);
    rm[1] += shape.hb[q] * (t.s[q] * e + t.c[q] * g + t.py[q] * b);
    rm[2] += shape.hb[q] * d[2 * P + q];
  }
  for (int k = t.first_row; k < t.first_row + t.row_count; ++k) {
    const StrainRow& row = rows_[k];
    Lanes force = Lanes::Zero();
    for (int i = 0; i < kStrains; ++i) force += row.row[i] * d[i];
    force *= row.stiffness;
    for (int i = 0; i < kZeta; ++i) tau[i] -= row.row[i] * force;
  }
}

template <int P>
template <int N>
void ElementWorkOf<P>::reduce_element(int element, const ColumnLanes& rhs, Interior<N>& interior,
                                      CondensedForces& out) const {
  const Shape& shape = shapes_[element];
  const ElementDofs& dofs = dofs_[element];
  ZetaLanes tau = to_strains(rhs, dofs, shape, tangents_[element]);
  ZetaLanes d;  // strains of the rows of section forces
  bool strained = false;
  for (int i = 0; i < kStrains; ++i) {
    d[i] = rhs[dofs.s + i] / shape.hb[i % P];
    strained = strained || (d[i] != 0.0).any();
  }
  for (int c = 0; c < 3; ++c) out.rm[c] = rhs[dofs.m + c];
  if (strained) subtract_strains(shape, tangents_[element], d, tau, out.rm);
  typename AugmentedFactor<N>::Vectors x;
  for (int i = 0; i < N; ++i) x[i] = (*tangents_[element].root)[active<N>(i)] * tau[active<N>(i)];
  for (int i = N; i < N + 6; ++i) x[i] = Lanes::Zero();
  interior.factor.forward(x);
  for (int c = 0; c < 3; ++c) {
    out.ra[c] = tau[kStrains + c] + x[N + c];
    out.rm[c] += x[N + 3 + c];
  }
  std::copy_n(x.begin(), N, interior.reduced.begin());
}

template <int P>
void ElementWorkOf<P>::reduce(const ColumnLanes& rhs, std::span<CondensedForces> condensed) {
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    if (shape.shearable)
      reduce_element<kStrains>(e, rhs, shearable_[shape.factor], condensed[e]);
    else
      reduce_element<2 * P>(e, rhs, stiff_[shape.factor], condensed[e]);
  }
}

template <int P>
template <int N>
void ElementWorkOf<P>::recover_element(int element, const Interior<N>& interior, const ColumnLanes& x) const {
  const Shape& shape = shapes_[element];
  const ElementDofs& dofs = dofs_[element];
  const Tangent& t = tangents_[element];
  ZetaLanes zeta;
  typename AugmentedFactor<N>::Vectors y;
  for (int i = 0; i < kStrains; ++i) zeta[i] = x[dofs.s + i] / shape.hb[i % P];
  for (int c = 0; c < 3; ++c) {
    zeta[kStrains + c] = y[N + c] = x[dofs.a[c]];
    y[N + 3 + c] = x[dofs.m + c];
  }
  interior.factor.backward(interior.reduced, y);
  for (int i = 0; i < N; ++i) {
    const int z = active<N>(i);
    zeta[z] += (*t.root)[z] * y[i];
    x.store(dofs.s + z, y[i] / (*t.root)[z]);
  }
  GaussLanes b;
  for (int q = 0; q < P; ++q) {
    b[q] = zeta[kStrains + 2];
    for (int r = 0; r < P; ++r) b[q] += (shape.h * a_[q][r]) * zeta[2 * P + r];
  }
  if constexpr (N < kStrains) {  // unshearable: shear forces follow from their equilibrium rows
    GaussLanes row;
    for (int q = 0; q < P; ++q)
      row[q] = t.c[q] * (x[dofs.v + P + q] + shape.hb[q] * y[N + 4]) -
               t.s[q] * (x[dofs.v + q] + shape.hb[q] * y[N + 3]) - t.n[q] * b[q];
    for (int k = t.first_row; k < t.first_row + t.row_count; ++k) {
      Lanes force = Lanes::Zero();
      for (int i = 0; i < kZeta; ++i) force += rows_[k].row[i] * zeta[i];
      force *= rows_[k].stiffness;
      for (int q = 0; q < P; ++q) row[q] -= rows_[k].row[P + q] * force;
    }
    for (int q = 0; q < P; ++q) x.store(dofs.s + P + q, row[q] / shape.hb[q]);
  }
  for (int q = 0; q < P; ++q) {
    x.store(dofs.v + q, t.c[q] * zeta[q] - t.s[q] * zeta[P + q] + t.px[q] * b[q]);
    x.store(dofs.v + P + q, t.s[q] * zeta[q] + t.c[q] * zeta[P + q] + t.py[q] * b[q]);
    x.store(dofs.v + 2 * P + q, zeta[2 * P + q]);
  }
}

template <int P>
void ElementWorkOf<P>::recover(const ColumnLanes& x) {
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    if (shape.shearable)
      recover_element<kStrains>(e, shearable_[shape.factor], x);
    else
      recover_element<2 * P>(e, stiff_[shape.factor], x);
  }
}

}  // namespace snapthrough
