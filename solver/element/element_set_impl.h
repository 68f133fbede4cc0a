#pragma once
/// @file
/// ElementSet for one order P. Included only by the files that instantiate it.
///
/// The interior of an element is written in its strains. With R_q = [d1 d2] the rotation at Gauss point q, E
/// = x'.d1, G = x'.d2 and p_q = -G d1 + E d2 (x' turned by +90 degrees),
///
///   du'_q = d1 de_q + d2 dg_q + p_q db_q,     db_q = db_a + h sum_r A_qr dk_r,
///
/// so a linear functional of (u_a, v) becomes one of zeta = (e_1..e_P, g_1..g_P, k_1..k_P, u_a). The second
/// derivative of the mixed functional is then
///
///   sum_q h b_q [ 2 db_q (N dg_q - Q de_q) + (N E + Q G) db_q^2 ]  +  sum_j k_j (dw_j)^2  =:  zeta^T H zeta
///
/// plus the compliance terms. The strain rows read h b ds + H zeta - U^T m = tau with d eps = C ds + d, U the
/// rows of u_b. Substituting ds = y / sqrt(C) gives   S y = g,  S = h b I + sqrt(C) H sqrt(C): symmetric, of
/// size 2 P or 3 P, and the identity in the limit C = 0. The columns that couple y to (u_a, m) stand beside S
/// while it is factorised, which gives the condensed element at once.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "solver/element/augmented_factor.h"
#include "solver/element/element_set.h"

namespace snapthrough {

template <int P>
class ElementSetOf final : public ElementSet {
 public:
  ElementSetOf();
  [[nodiscard]] int size() const override { return static_cast<int>(shapes_.size()); }
  void reserve(int elements) override {
    shapes_.reserve(elements);
    dofs_.reserve(elements);
    factors_.reserve(elements);
  }
  void add(const ElementShape& shape, const ElementDofs& dofs) override;
  void add_station(const Station& station) override;
  void add_strip(int element, ContactStrip strip) override;
  void set_linear_geometry(bool linear) override { linear_ = linear; }
  void set_bonded(bool bonded) override { bonded_ = bonded; }
  void set_grip(double share) override { grip_ = share; }
  void set_softness(double share) override { softness_ = share; }
  [[nodiscard]] double support_rounding() const override { return support_rounding_; }
  void freeze_contact(const Eigen::VectorXd& y, double tolerance) override;
  [[nodiscard]] double frozen_share(int element, int foundation) const override;
  void set_pressure(int element, double proportional, double constant) override;
  void set_load_factors(double proportional, double constant) override {
    proportional_ = proportional;
    constant_ = constant;
  }
  void add_pressure_load(const Eigen::VectorXd& y, double proportional, double constant,
                         Eigen::VectorXd& out) const override;
  void add_residual(const Eigen::VectorXd& y, Eigen::VectorXd& residual) override;
  void linearise(const Eigen::VectorXd& y, Eigen::VectorXd& residual,
                 std::span<CondensedElement> condensed) override;
  void reduce(const Eigen::VectorXd& rhs, std::span<CondensedElement> condensed) override;
  void recover(Eigen::VectorXd& x) override;
  void add_tangent_product(const Eigen::VectorXd& y, const Eigen::VectorXd& direction,
                           Eigen::VectorXd& out) override;

 private:
  static constexpr int kStrains = 3 * P;
  static constexpr int kZeta = 3 * P + 3;
  using Gauss = std::array<double, P>;
  static constexpr int kRow = padded(kZeta);  ///< whole blocks; what is beyond kZeta is zero
  using ZetaMatrix = Eigen::Matrix<double, kRow, kRow, Eigen::RowMajor>;
  using ZetaVector = Eigen::Matrix<double, kRow, 1>;
  using EndRows = Eigen::Matrix<double, 3, kRow, Eigen::RowMajor>;
  using Interior = AugmentedFactor<kStrains>;

  struct Shape {
    double h = 0.0;
    bool shearable = false;
    Gauss angle{}, cos0{}, sin0{}, tx{}, ty{}, e0{}, g0{}, hb{};
    std::array<double, kStrains> compliance{};
    std::array<double, kStrains> root{};  ///< sqrt of the compliance
    int first_station = 0, station_count = 0;
    int first_strip = 0, strip_count = 0;
    double pressure = 0.0, constant_pressure = 0.0;  ///< along the deformed right normal
  };
  struct Functional {
    double stiffness = 0.0;
    double gap = 0.0;
    bool one_sided = false;
    std::array<double, 3> a{};
    std::array<Gauss, 3> v{};
  };
  /// Rotations and axis derivatives at the Gauss points.
  struct Kinematics {
    Gauss c, s, xp, yp, E, G, px, py;
  };
  /// What solve needs of the last linearisation. Interior unknowns y: strains in the order e, (g,) k.
  struct Factor {
    Kinematics kin;
    ZetaMatrix H;       ///< symmetric
    EndRows U;          ///< rows of u_b
    Interior interior;  ///< of S, with the columns of (u_a, m) beside it
    alignas(32) std::array<double, Interior::kStride> reduced{};  ///< L^-1 times the last right-hand side
  };

  [[nodiscard]] Kinematics kinematics(const Shape& shape, const ElementDofs& dofs, const double* y) const;
  void add_strain_residual(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                           const double* y, double* residual) const;
  void add_strain_product(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin, const double* y,
                          const double* direction, double* out) const;
  void add_support_residual(int element, const double* y, double* residual, bool keep);
  void collect_strip(std::size_t index, const double* y, const ElementDofs& dofs, const Shape& shape);
  [[nodiscard]] Functional functional_at(const ContactStrip& strip, double h, double xi) const;
  void add_interval(std::size_t index, const Shape& shape, const ContactStrip::Interval& interval,
                    double modulus, double gap);
  void add_support_tangent(const Shape& shape, Factor& f);
  [[nodiscard]] double value(const Functional& f, const ElementDofs& dofs, const double* y) const;
  void to_strain_row(const Functional& f, const Shape& shape, const Kinematics& kin, ZetaVector& row) const;
  void add_geometric(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin, const double* y,
                     ZetaMatrix& H) const;
  [[nodiscard]] double pressure_of(const Shape& shape) const {
    return proportional_ * shape.pressure + constant_ * shape.constant_pressure;
  }
  void add_pressure(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin, double pressure,
                    const double* y, double* load) const;
  void add_pressure_tangent(const Shape& shape, const Kinematics& kin, double pressure, ZetaMatrix& H) const;
  void add_pressure_product(const Shape& shape, const ElementDofs& dofs, double pressure,
                            const double* direction, double* out) const;
  [[nodiscard]] bool acts(const Functional& f, std::size_t station, const ElementDofs& dofs,
                          const double* y) const;
  void end_rows(const Shape& shape, const Kinematics& kin, EndRows& U) const;
  void assemble(int element, const double* y, double* residual);
  void eliminate(int element, CondensedElement& out);
  template <int N>
  void eliminate_interior(const Shape& shape, Factor& f, CondensedElement& out) const;
  template <int N>
  void recover_strains(const Shape& shape, const Factor& f, const Eigen::Matrix<double, 6, 1>& ends,
                       ZetaVector& zeta, double* stress) const;
  /// Active index i of S to its position in zeta.
  [[nodiscard]] static int active(bool shearable, int i) { return shearable || i < P ? i : i + P; }
  [[nodiscard]] static int active_count(bool shearable) { return shearable ? 3 * P : 2 * P; }
  void strain_rhs(const Shape& shape, const Factor& f, const ElementDofs& dofs, const double* rhs,
                  ZetaVector& tau, Eigen::Matrix<double, kStrains, 1>& d) const;

  const CollocationRule* rule_;
  Gauss b_{};
  std::array<Gauss, P> a_{};  ///< A_qr
  bool linear_ = false;
  bool bonded_ = false;
  double grip_ = 0.0;
  double softness_ = 1.0;
  double support_rounding_ = 0.0;
  double proportional_ = 0.0;  ///< factors on the pressures
  double constant_ = 0.0;
  bool frozen_ = false;  ///< contact is as in frozen_intervals_ and frozen_stations_
  std::vector<std::vector<ContactStrip::Interval>> frozen_intervals_;
  std::vector<char> frozen_stations_;
  /// On contact intervals: exact for straight axes, and near enough for turning normals that the energy's
  /// edge terms vanish as they must (the tangent then is the derivative of the residual).
  Quadrature strip_quadrature_;
  std::vector<Shape> shapes_;
  std::vector<ElementDofs> dofs_;
  std::vector<Factor> factors_;
  std::vector<Functional> stations_;
  std::vector<ContactStrip> strips_;
  std::vector<std::vector<Functional>> whole_strips_;  ///< Gauss points of each strip's whole range
  // scratch
  std::vector<Functional> acting_;  ///< supports of the current element that act
  std::vector<ZetaVector> rows_;    ///< of them, in strains
  std::vector<ContactStrip::Interval> intervals_;
};

template <int P>
ElementSetOf<P>::ElementSetOf()
    : rule_(&CollocationRule::of(P)), strip_quadrature_(gauss_legendre(std::max(P + 2, 5))) {
  for (int q = 0; q < P; ++q) {
    b_[q] = rule_->weight(q);
    for (int r = 0; r < P; ++r) a_[q][r] = rule_->integral(q, r);
  }
}

template <int P>
void ElementSetOf<P>::add(const ElementShape& in, const ElementDofs& dofs) {
  Shape shape;
  shape.h = in.length;
  for (int q = 0; q < P; ++q) {
    shape.angle[q] = in.angle[q];
    shape.cos0[q] = std::cos(in.angle[q]);
    shape.sin0[q] = std::sin(in.angle[q]);
    shape.tx[q] = in.t[q][0];
    shape.ty[q] = in.t[q][1];
    shape.e0[q] = in.t[q][0] * shape.cos0[q] + in.t[q][1] * shape.sin0[q];
    shape.g0[q] = -in.t[q][0] * shape.sin0[q] + in.t[q][1] * shape.cos0[q];
    shape.hb[q] = in.length * b_[q];
    shape.compliance[q] = in.axial_compliance[q];
    shape.compliance[P + q] = in.shear_compliance[q];
    shape.compliance[2 * P + q] = in.bending_compliance[q];
    shape.shearable = shape.shearable || in.shear_compliance[q] > 0.0;
  }
  for (int i = 0; i < kStrains; ++i) shape.root[i] = std::sqrt(shape.compliance[i]);
  shape.first_station = static_cast<int>(stations_.size());
  shape.first_strip = static_cast<int>(strips_.size());
  shapes_.push_back(shape);
  dofs_.push_back(dofs);
  factors_.emplace_back();
}

/// Stations and strips belong to the element added last, so that each element's are contiguous.
template <int P>
void ElementSetOf<P>::add_station(const Station& station) {
  Functional f;
  f.stiffness = station.stiffness;
  f.gap = station.gap;
  f.one_sided = station.one_sided;
  f.a = station.a;
  for (int q = 0; q < P; ++q)
    for (int c = 0; c < 3; ++c) f.v[c][q] = station.v[q][c];
  stations_.push_back(f);
  ++shapes_[station.element].station_count;
}

template <int P>
void ElementSetOf<P>::add_strip(int element, ContactStrip strip) {
  std::vector<Functional>& whole = whole_strips_.emplace_back();
  const auto [from, to] = strip.range();
  for (const double point : strip_quadrature_.points)
    whole.push_back(functional_at(strip, shapes_[element].h, from + (to - from) * point));
  strips_.push_back(std::move(strip));
  ++shapes_[element].strip_count;
}

template <int P>
auto ElementSetOf<P>::kinematics(const Shape& shape, const ElementDofs& dofs, const double* y) const
    -> Kinematics {
  Kinematics kin;
  const double* v = y + dofs.v;
  const double ba = y[dofs.a[2]];
  for (int q = 0; q < P; ++q) {
    double b = 0.0;
    for (int r = 0; r < P; ++r) b += a_[q][r] * v[2 * P + r];
    b = ba + shape.h * b;
    if (linear_) {
      kin.c[q] = shape.cos0[q];
      kin.s[q] = shape.sin0[q];
      kin.xp[q] = shape.tx[q];
      kin.yp[q] = shape.ty[q];
      kin.E[q] = shape.cos0[q] * v[q] + shape.sin0[q] * v[P + q] + shape.g0[q] * b + shape.e0[q];
      kin.G[q] = -shape.sin0[q] * v[q] + shape.cos0[q] * v[P + q] - shape.e0[q] * b + shape.g0[q];
      kin.px[q] = -shape.ty[q];
      kin.py[q] = shape.tx[q];
      continue;
    }
    const double cb = std::cos(b);
    const double sb = std::sin(b);
    kin.c[q] = shape.cos0[q] * cb - shape.sin0[q] * sb;
    kin.s[q] = shape.sin0[q] * cb + shape.cos0[q] * sb;
    kin.xp[q] = shape.tx[q] + v[q];
    kin.yp[q] = shape.ty[q] + v[P + q];
    kin.E[q] = kin.xp[q] * kin.c[q] + kin.yp[q] * kin.s[q];
    kin.G[q] = -kin.xp[q] * kin.s[q] + kin.yp[q] * kin.c[q];
    kin.px[q] = -kin.yp[q];
    kin.py[q] = kin.xp[q];
  }
  return kin;
}

template <int P>
void ElementSetOf<P>::add_strain_residual(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
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
    fs[q] += hb * (kin.E[q] - shape.e0[q] - shape.compliance[q] * N);
    fs[P + q] += hb * (kin.G[q] - shape.g0[q] - shape.compliance[P + q] * Q);
    fs[2 * P + q] += hb * (v[2 * P + q] - shape.compliance[2 * P + q] * s[2 * P + q]);
    fv[q] += hb * (N * kin.c[q] - Q * kin.s[q] - m[0]);
    fv[P + q] += hb * (N * kin.s[q] + Q * kin.c[q] - m[1]);
    fv[2 * P + q] += hb * (s[2 * P + q] - m[2]);
    // N G - Q E, the moment of the section force about the axis' tangent; linear geometry keeps the initial
    // tangent
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
}

template <int P>
double ElementSetOf<P>::value(const Functional& f, const ElementDofs& dofs, const double* y) const {
  double w = f.a[0] * y[dofs.a[0]] + f.a[1] * y[dofs.a[1]] + f.a[2] * y[dofs.a[2]];
  const double* v = y + dofs.v;
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < P; ++q) w += f.v[c][q] * v[c * P + q];
  return w;
}

template <int P>
void ElementSetOf<P>::to_strain_row(const Functional& f, const Shape& shape, const Kinematics& kin,
                                    ZetaVector& row) const {
  double turn_a = f.a[2];
  for (int r = 0; r < P; ++r) row[2 * P + r] = f.v[2][r];
  for (int q = 0; q < P; ++q) {
    const double vx = f.v[0][q];
    const double vy = f.v[1][q];
    row[q] = vx * kin.c[q] + vy * kin.s[q];
    row[P + q] = -vx * kin.s[q] + vy * kin.c[q];
    const double turn = vx * kin.px[q] + vy * kin.py[q];
    turn_a += turn;
    for (int r = 0; r < P; ++r) row[2 * P + r] += turn * shape.h * a_[q][r];
  }
  row[3 * P] = f.a[0];
  row[3 * P + 1] = f.a[1];
  row[3 * P + 2] = turn_a;
  for (int i = kZeta; i < kRow; ++i) row[i] = 0.0;
}

/// Adds the upper triangle.
template <int P>
void ElementSetOf<P>::add_geometric(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                                    const double* y, ZetaMatrix& H) const {
  const double* s = y + dofs.s;
  constexpr int T = 3 * P + 2;  // rotation at the start
  for (int q = 0; q < P; ++q) {
    const double n = shape.hb[q] * s[q];
    const double t = shape.hb[q] * s[P + q];
    const double w = n * kin.E[q] + t * kin.G[q];
    H(P + q, T) += n;
    H(q, T) -= t;
    H(T, T) += w;
    double ha[P];
    for (int r = 0; r < P; ++r) ha[r] = shape.h * a_[q][r];
    for (int r = 0; r < P; ++r) {
      const int k = 2 * P + r;
      H(P + q, k) += n * ha[r];
      H(q, k) -= t * ha[r];
      H(k, T) += w * ha[r];
      for (int u = 0; u < P; ++u) H(k, 2 * P + u) += w * ha[r] * ha[u];
    }
  }
}

template <int P>
void ElementSetOf<P>::end_rows(const Shape& shape, const Kinematics& kin, EndRows& U) const {
  U.setZero();
  for (int q = 0; q < P; ++q) {
    const double hb = shape.hb[q];
    U(0, q) = hb * kin.c[q];
    U(0, P + q) = -hb * kin.s[q];
    U(1, q) = hb * kin.s[q];
    U(1, P + q) = hb * kin.c[q];
    U(2, 2 * P + q) = hb;
    U(0, 3 * P + 2) += hb * kin.px[q];
    U(1, 3 * P + 2) += hb * kin.py[q];
    for (int r = 0; r < P; ++r) {
      U(0, 2 * P + r) += hb * kin.px[q] * shape.h * a_[q][r];
      U(1, 2 * P + r) += hb * kin.py[q] * shape.h * a_[q][r];
    }
  }
  for (int c = 0; c < 3; ++c) U(c, 3 * P + c) = 1.0;
}

template <int P>
void ElementSetOf<P>::assemble(int element, const double* y, double* residual) {
  const Shape& shape = shapes_[element];
  const ElementDofs& dofs = dofs_[element];
  Factor& f = factors_[element];
  f.kin = kinematics(shape, dofs, y);
  add_strain_residual(shape, dofs, f.kin, y, residual);
  f.H.setZero();
  if (!linear_) add_geometric(shape, dofs, f.kin, y, f.H);
  if (const double pressure = pressure_of(shape); pressure != 0.0) {
    add_pressure(shape, dofs, f.kin, -pressure, y, residual);
    if (!linear_) add_pressure_tangent(shape, f.kin, pressure, f.H);
  }
  if (shape.station_count > 0 || shape.strip_count > 0) {
    add_support_residual(element, y, residual, true);
    add_support_tangent(shape, f);
  }
  for (int i = 0; i < kZeta; ++i)
    for (int j = i + 1; j < kZeta; ++j) f.H(j, i) = f.H(i, j);
  end_rows(shape, f.kin, f.U);
}

/// With N = 2 P or 3 P active strains.
template <int P>
template <int N>
void ElementSetOf<P>::eliminate_interior(const Shape& shape, Factor& f, CondensedElement& out) const {
  constexpr bool shearable = N == kStrains;
  for (int i = 0; i < N; ++i) {
    const int zi = active(shearable, i);
    const double root = shape.root[zi];
    const double* H = f.H.row(zi).data();
    f.interior.clear_row(i);
    double* row = f.interior.row(i);
    f.interior.diagonal(i) = shape.hb[zi % P] + root * H[zi] * root;
    for (int j = i + 1; j < N; ++j) {
      const int zj = active(shearable, j);
      row[j] = root * H[zj] * shape.root[zj];
    }
    for (int c = 0; c < 3; ++c) {
      row[N + c] = root * H[3 * P + c];
      row[N + 3 + c] = -root * f.U(c, zi);
    }
  }
  Eigen::Matrix<double, 6, 6> schur;
  f.interior.template factorise<N>(schur);
  out.negative = 0;
  double det = 1.0;
  for (int i = 0; i < N; ++i) {
    const double pivot = f.interior.pivot(i);
    if (pivot < 0.0) ++out.negative;
    det *= std::abs(pivot) / shape.hb[i % P];
  }
  out.log_det = std::log(det);
  out.K = f.H.template block<3, 3>(kStrains, kStrains) - schur.template topLeftCorner<3, 3>();
  out.X = -f.U.template block<3, 3>(0, kStrains) - schur.template bottomLeftCorner<3, 3>();
  out.F = schur.template bottomRightCorner<3, 3>();
}

template <int P>
void ElementSetOf<P>::eliminate(int element, CondensedElement& out) {
  const Shape& shape = shapes_[element];
  if (shape.shearable)
    eliminate_interior<3 * P>(shape, factors_[element], out);
  else
    eliminate_interior<2 * P>(shape, factors_[element], out);
}

template <int P>
void ElementSetOf<P>::add_residual(const Eigen::VectorXd& y, Eigen::VectorXd& residual) {
  support_rounding_ = 0.0;
  for (int e = 0; e < size(); ++e) {
    const Kinematics kin = kinematics(shapes_[e], dofs_[e], y.data());
    add_strain_residual(shapes_[e], dofs_[e], kin, y.data(), residual.data());
    if (const double pressure = pressure_of(shapes_[e]); pressure != 0.0)
      add_pressure(shapes_[e], dofs_[e], kin, -pressure, y.data(), residual.data());
    if (shapes_[e].station_count > 0 || shapes_[e].strip_count > 0)
      add_support_residual(e, y.data(), residual.data(), false);
  }
}

template <int P>
void ElementSetOf<P>::linearise(const Eigen::VectorXd& y, Eigen::VectorXd& residual,
                                std::span<CondensedElement> condensed) {
  support_rounding_ = 0.0;
  for (int e = 0; e < size(); ++e) {
    assemble(e, y.data(), residual.data());
    eliminate(e, condensed[e]);
  }
}

/// tau = interior rows of a right-hand side in the strain basis (the start's entries included), d = strain
/// rows.
template <int P>
void ElementSetOf<P>::strain_rhs(const Shape& shape, const Factor& f, const ElementDofs& dofs,
                                 const double* rhs, ZetaVector& tau,
                                 Eigen::Matrix<double, kStrains, 1>& d) const {
  Functional row;
  for (int c = 0; c < 3; ++c)
    for (int q = 0; q < P; ++q) {
      row.v[c][q] = rhs[dofs.v + c * P + q];
      d[c * P + q] = rhs[dofs.s + c * P + q] / shape.hb[q];
    }
  to_strain_row(row, shape, f.kin, tau);
}

template <int P>
void ElementSetOf<P>::reduce(const Eigen::VectorXd& rhs, std::span<CondensedElement> condensed) {
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    Factor& f = factors_[e];
    ZetaVector tau;
    Eigen::Matrix<double, kStrains, 1> d;
    strain_rhs(shape, f, dofs_[e], rhs.data(), tau, d);
    CondensedElement& out = condensed[e];
    for (int c = 0; c < 3; ++c) out.rm[c] = rhs[dofs_[e].m + c];
    if (!d.isZero(0.0)) {
      for (int z = 0; z < kStrains; ++z) subtract_scaled<kRow>(tau.data(), f.H.row(z).data(), d[z], 0);
      out.rm += f.U.template leftCols<kStrains>() * d;
    }
    const int n = active_count(shape.shearable);
    f.reduced.fill(0.0);
    for (int i = 0; i < n; ++i) {
      const int z = active(shape.shearable, i);
      f.reduced[i] = shape.root[z] * tau[z];
    }
    if (shape.shearable)
      f.interior.template forward<3 * P>(f.reduced.data());
    else
      f.interior.template forward<2 * P>(f.reduced.data());
    for (int c = 0; c < 3; ++c) {
      out.ra[c] = tau[kStrains + c] + f.reduced[n + c];
      out.rm[c] += f.reduced[n + 3 + c];
    }
  }
}

/// Strains and stresses of the active ones, added to zeta and put into `stress`.
template <int P>
template <int N>
void ElementSetOf<P>::recover_strains(const Shape& shape, const Factor& f,
                                      const Eigen::Matrix<double, 6, 1>& ends, ZetaVector& zeta,
                                      double* stress) const {
  alignas(32) std::array<double, Interior::kStride> y{};
  for (int c = 0; c < 6; ++c) y[N + c] = ends[c];
  f.interior.template backward<N>(f.reduced.data(), y.data());
  for (int i = 0; i < N; ++i) {
    const int z = active(N == kStrains, i);
    zeta[z] += shape.root[z] * y[i];
    stress[z] = y[i] / shape.root[z];
  }
}

template <int P>
void ElementSetOf<P>::recover(Eigen::VectorXd& x) {
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    const Factor& f = factors_[e];
    const ElementDofs& dofs = dofs_[e];
    ZetaVector tau;
    ZetaVector zeta = ZetaVector::Zero();
    Eigen::Matrix<double, kStrains, 1> d;
    strain_rhs(shape, f, dofs, x.data(), tau, d);
    Eigen::Matrix<double, 6, 1> ends;
    for (int c = 0; c < 3; ++c) {
      ends[c] = x[dofs.a[c]];
      ends[3 + c] = x[dofs.m + c];
    }
    zeta.template head<kStrains>() = d;
    zeta.template segment<3>(kStrains) = ends.template head<3>();
    if (shape.shearable) {
      recover_strains<3 * P>(shape, f, ends, zeta, &x[dofs.s]);
    } else {
      recover_strains<2 * P>(shape, f, ends, zeta, &x[dofs.s]);
      for (int z = P; z < 2 * P; ++z) {
        const double row = tau[z] - dot_from<kRow>(f.H.row(z).data(), zeta.data(), 0) +
                           f.U.col(z).dot(ends.template tail<3>());
        x[dofs.s + z] = row / shape.hb[z - P];
      }
    }
    for (int q = 0; q < P; ++q) {
      double b = 0.0;
      for (int r = 0; r < P; ++r) b += a_[q][r] * zeta[2 * P + r];
      b = ends[2] + shape.h * b;
      x[dofs.v + q] = f.kin.c[q] * zeta[q] - f.kin.s[q] * zeta[P + q] + f.kin.px[q] * b;
      x[dofs.v + P + q] = f.kin.s[q] * zeta[q] + f.kin.c[q] * zeta[P + q] + f.kin.py[q] * b;
      x[dofs.v + 2 * P + q] = zeta[2 * P + q];
    }
  }
}

/// The beam's part of the tangent as an operator.
template <int P>
void ElementSetOf<P>::add_strain_product(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
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
}

/// The tangent as an operator, written from the second derivative of the mixed functional itself (not from
/// the eliminated form), so that the two can be held against one another.
template <int P>
void ElementSetOf<P>::add_tangent_product(const Eigen::VectorXd& y, const Eigen::VectorXd& direction,
                                          Eigen::VectorXd& out) {
  Eigen::VectorXd unused = Eigen::VectorXd::Zero(y.size());
  for (int e = 0; e < size(); ++e) {
    const ElementDofs& dofs = dofs_[e];
    add_strain_product(shapes_[e], dofs, kinematics(shapes_[e], dofs, y.data()), y.data(), direction.data(),
                       out.data());
    if (const double pressure = pressure_of(shapes_[e]); pressure != 0.0 && !linear_)
      add_pressure_product(shapes_[e], dofs, pressure, direction.data(), out.data());
    add_support_residual(e, y.data(), unused.data(), true);
    for (const Functional& f : acting_) {
      const double force = f.stiffness * value(f, dofs, direction.data());
      for (int k = 0; k < 3; ++k) {
        out[dofs.a[k]] += force * f.a[k];
        for (int q = 0; q < P; ++q) out[dofs.v + k * P + q] += force * f.v[k][q];
      }
    }
  }
}

}  // namespace snapthrough

#include "solver/element/element_set_supports.h"
