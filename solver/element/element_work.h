#pragma once
/// @file
/// ElementWork for one order P. Included only by the files that instantiate ElementWorkOf.
///
/// The element interior is expressed in strains. With R_q = [d1 d2] the rotation at Gauss point q, E = x'.d1,
/// G = x'.d2 and p_q = -G d1 + E d2 (x' turned by +90 degrees),
///
///   du'_q = d1 de_q + d2 dg_q + p_q db_q,     db_q = db_a + h sum_r A_qr dk_r,
///
/// a linear functional of (u_a, v) becomes one of zeta = (e_1..e_P, g_1..g_P, k_1..k_P, u_a). The second
/// derivative of the mixed functional is
///
///   sum_q h b_q [ 2 db_q (N dg_q - Q de_q) + (N E + Q G) db_q^2 ]  +  sum_j k_j (dw_j)^2  =:  zeta^T H zeta
///
/// plus the compliance terms. The strain rows read h b ds + H zeta - U^T m = tau with d eps = C ds + d, U the
/// rows of u_b. Substituting ds = y / sqrt(C) gives   S y = g,  S = h b I + sqrt(C) H sqrt(C), symmetric, of
/// size 2 P (unshearable) or 3 P, and diagonal in the limit C = 0. Factorising S together with the columns
/// that couple y to (u_a, m) gives the condensed element.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solver/element/augmented_factor.h"
#include "solver/element/element_data.h"
#include "solver/element/element_masses.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/sine_cosine.h"

namespace snapthrough {

template <int P>
class ElementWorkOf final : public ElementWork {
 public:
  explicit ElementWorkOf(const ElementData<P>& data);
  [[nodiscard]] double support_rounding() const override { return support_rounding_; }
  [[nodiscard]] std::span<const Coupling> couplings() const override { return couplings_; }
  void add_pressure_load(const Eigen::VectorXd& y, const LoadFactors& factors, bool small_displacements,
                         Eigen::VectorXd& out) override;
  void add_residual(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                    Eigen::VectorXd& residual) override;
  void linearise(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                 Eigen::VectorXd& residual, std::span<CondensedElement> condensed) override;
  void reduce(const ColumnLanes& rhs, std::span<CondensedForces> condensed) override;
  void recover(const ColumnLanes& x) override;
  void add_ground_forces(const double* motion, double* out) const override;
  void add_tangent_products(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                            const Eigen::Ref<const Eigen::MatrixXd>& directions,
                            Eigen::MatrixXd& out) override;
  void add_tangent_changes(const Eigen::VectorXd& y, const LoadFactors& rates, const Regime& regime,
                           const Eigen::VectorXd& along, const Eigen::Ref<const Eigen::MatrixXd>& directions,
                           Eigen::MatrixXd& out) override;
  void add_pressure_change(const LoadFactors& factors, const Eigen::VectorXd& along,
                           Eigen::VectorXd& out) override;

 private:
  using Data = ElementData<P>;
  using Shape = typename Data::Shape;
  using Functional = typename Data::Functional;
  using ContactDisplacement = typename Data::ContactDisplacement;
  static constexpr int kStrains = Data::kStrains;
  static constexpr int kZeta = kStrains + DofMap::components;
  using Gauss = typename Data::Gauss;
  using ZetaVector = std::array<double, kZeta>;
  using ZetaLanes = std::array<Lanes, kZeta>;
  using GaussLanes = std::array<Lanes, P>;

  /// Rotations and strains at the Gauss points.
  struct Kinematics {
    Gauss c, s, E, G;
    Gauss e, g;  ///< strains: E and G minus their stress-free values, without cancellation
  };
  /// Changes of rotation, strains e and g, and section forces N and Q at the Gauss points.
  struct StrainChange {
    Gauss b, e, g, N, Q;
  };
  /// Factors of the last linearisation from which H is applied; H itself is not stored.
  struct Tangent {
    Gauss c, s, px, py;
    Gauss n, t, w;  ///< h b_q times N, Q and N E + Q G; zero for small displacements
    /// Square roots of the compliances at the state.
    const std::array<double, kStrains>* root = nullptr;
    int first_row = 0, row_count = 0;  ///< range in rows_ of supports and pressure
  };
  /// Contribution stiffness (row.zeta)^2 / 2 to the second variation of the energy.
  struct StrainRow {
    ZetaVector row;
    double stiffness = 0.0;
  };
  /// Factored interior of an element: N active strains in the order e, (g,) k, with columns of (u_a, m).
  template <int N>
  struct Interior {
    AugmentedFactor<N> factor;     ///< factors of S
    std::array<Lanes, N> reduced;  ///< L^-1 times the last right-hand sides
  };

  void find_kinematics(const Eigen::VectorXd& y);
  void find_kinematics(const double* y, int first, int last);
  static void find_small_strains(const Shape& shape, const double* v, const double* b, Kinematics& kin);
  static void find_strains(const Shape& shape, const double* v, const double* sb, const double* cb,
                           Kinematics& kin);
  void add_strain_residual(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                           const double* y, double* residual) const;
  void add_strain_product(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin, const double* y,
                          const double* direction, double* out) const;
  [[nodiscard]] BendingCurve::Values bending_at(const Shape& shape, const ElementDofs& dofs, int q,
                                                const double* y) const;
  void add_bending_residual(const Shape& shape, const ElementDofs& dofs, const double* y,
                            double* residual) const;
  void add_bending_product(const Shape& shape, const ElementDofs& dofs, const double* y,
                           const double* direction, double* out) const;
  void add_bending_rate(const Shape& shape, const ElementDofs& dofs, const double* y, const double* along,
                        const double* direction, double* out) const;
  [[nodiscard]] const std::array<double, kStrains>& roots_at(int element, const double* y);
  [[nodiscard]] StrainChange strain_change(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin,
                                           const double* along) const;
  void add_strain_rate(const Shape& shape, const ElementDofs& dofs, const Kinematics& kin, const double* y,
                       const StrainChange& change, const double* direction, double* out) const;
  void collect_support_rates(int element, const double* y, const double* along);
  void add_surface_rates(const Functional& n, const Law::Response& response, double into,
                         const ElementDofs& dofs, const double* along);
  void find_layers(const double* y);
  [[nodiscard]] LayerParts parts_of_layer(const ElementContacts::Layer& layer,
                                          const std::vector<LayerCell>& cells);
  void add_row(const Functional& f, int element, double factor, Coupling& out) const;
  [[nodiscard]] Coupling coupling_of(std::size_t layer, const LayerEdge& edge) const;
  [[nodiscard]] Functional edge_functional(std::size_t layer, const LayerEdge& edge) const;
  void add_layer(std::size_t index, const Shape& shape, double share);
  void add_coupling_forces(const double* y, double* residual);
  void add_layer_changes(const double* along, const Eigen::Ref<const Eigen::MatrixXd>& directions,
                         Eigen::MatrixXd& out) const;
  void add_moving_ends(const Shape& shape, const ElementDofs& dofs, const double* y, const double* along);
  void collect_supports(int element, const double* y);
  [[nodiscard]] double penetration(const Functional& f, const ElementDofs& dofs, const double* y) const;
  [[nodiscard]] Law::Response curved_response(const Functional& f, const ElementDofs& dofs, double w) const;
  void add_support_residual(int element, const double* y, double* residual, bool keep);
  void collect_contact(std::size_t index, const double* y, const ElementDofs& dofs, const Shape& shape);
  [[nodiscard]] const std::vector<ElementPart>& parts_in_contact(std::size_t index, const Shape& shape,
                                                                 const ElementDofs& dofs, const double* y);
  void add_pieces(std::size_t index, const Shape& shape, const ElementPart& interval, double share,
                  const ContactDisplacement* u);
  void add_interval(std::size_t index, const Shape& shape, const FoundationContact::Interval& interval,
                    double share, const ContactDisplacement* u);
  void to_strain_row(const Functional& f, const Shape& shape, const Tangent& t, ZetaVector& row) const;
  template <int N>
  void add_end_columns(const Shape& shape, const Tangent& t, AugmentedMatrix<N>& S) const;
  template <int N>
  void add_geometric(const Shape& shape, const Tangent& t, AugmentedMatrix<N>& S) const;
  template <int N>
  void add_rows(const Tangent& t, AugmentedMatrix<N>& S);
  void collect_rows(int element, const double* y, double* residual);
  void collect_masses(int element);
  [[nodiscard]] LinePressure pressure_of(const Shape& shape) const {
    const LinePressure& p = shape.pressure;
    const LinePressure& c = shape.constant_pressure;
    return {factors_.proportional * p.middle + factors_.constant * c.middle,
            factors_.proportional * p.change + factors_.constant * c.change};
  }
  void add_pressure(const Shape& shape, const ElementDofs& dofs, const LinePressure& pressure,
                    const double* y, double* load) const;
  void collect_pressure(const Shape& shape, const LinePressure& pressure);
  void add_acting_product(const ElementDofs& dofs, const double* direction, double* out) const;
  void add_pressure_product(const Shape& shape, const ElementDofs& dofs, const LinePressure& pressure,
                            const double* direction, double* out) const;
  [[nodiscard]] bool acts(const Functional& f, std::size_t support, const ElementDofs& dofs,
                          const double* y) const;
  template <int N>
  void linearise_element(int element, const double* y, double* residual, Interior<N>& interior,
                         CondensedElement& out);
  template <int N>
  void reduce_element(int element, const ColumnLanes& rhs, Interior<N>& interior, CondensedForces& out) const;
  template <int N>
  void recover_element(int element, const Interior<N>& interior, const ColumnLanes& x) const;
  [[nodiscard]] ZetaLanes to_strains(const ColumnLanes& rhs, const ElementDofs& dofs, const Shape& shape,
                                     const Tangent& t) const;
  void subtract_strains(const Shape& shape, const Tangent& t, const ZetaLanes& d, ZetaLanes& tau,
                        Lanes3& rm) const;
  /// Maps the active strain index i of S to its index in zeta.
  template <int N>
  [[nodiscard]] static constexpr int active(int i) {
    return N == kStrains || i < P ? i : i + P;
  }

  [[nodiscard]] int size() const { return static_cast<int>(shapes_.size()); }
  void begin(const LoadFactors& factors, const Regime& regime);

  const Data& data_;
  const std::array<Gauss, P>& a_;  ///< a_, shapes_, dofs_, springs_ and contacts_ refer to members of data_
  const std::vector<Shape>& shapes_;
  const std::vector<ElementDofs>& dofs_;
  const std::vector<Functional>& springs_;
  const std::vector<FoundationContact>& contacts_;
  Regime regime_;        ///< regime of the current call
  bool linear_ = false;  ///< true: small displacements in the current call
  LoadFactors factors_;  ///< factors on the pressures in the current call
  double support_rounding_ = 0.0;
  Angles turns_;                        ///< rotations of some elements' Gauss points, one after the other
  std::vector<Kinematics> kinematics_;  ///< at kinematics_at_
  Eigen::VectorXd kinematics_at_;       ///< unknowns of the last find_kinematics()
  std::vector<std::vector<ElementPart>> parts_;  ///< in contact at kinematics_at_, where parts_known_
  std::vector<char> parts_known_;
  bool kinematics_linear_ = false;  ///< whether these were for small displacements
  std::vector<Tangent> tangents_;
  std::vector<std::array<double, kStrains>> roots_;  ///< Tangent::root of elements with a bending law
  std::vector<StrainRow> rows_;                      ///< rows of all elements from the last linearisation
  /// Element and functional of each support on moving ground that acted at the last linearisation.
  std::vector<std::pair<int, Functional>> on_ground_;
  std::vector<Interior<2 * P>> stiff_;  ///< unshearable elements; allocated by the first linearisation
  std::vector<Interior<kStrains>> shearable_;
  /// Contact of one layer at the last evaluation.
  struct LayerContact {
    std::vector<LayerCell> cells;
    LayerParts parts;
    std::vector<LayerEdge> edges;
  };
  std::vector<LayerContact> layers_;
  std::vector<Coupling> couplings_;  ///< resistances of the ground between two zones of contact
  // scratch
  std::vector<FoundationContact::KnotPlace> knots_;  ///< knots of the current contact's law
  std::vector<Functional> acting_;  ///< functionals of the acting supports of the current element
  std::vector<typename AugmentedMatrix<2 * P>::Weighted> stiff_rows_;  ///< scaled rows of the current element
  std::vector<typename AugmentedMatrix<kStrains>::Weighted> shearable_rows_;
};

template <int P>
ElementWorkOf<P>::ElementWorkOf(const ElementData<P>& data)
    : data_(data),
      a_(data.a),
      shapes_(data.shapes),
      dofs_(data.dofs),
      springs_(data.springs),
      contacts_(data.contacts.contacts()),
      parts_(contacts_.size()) {}

template <int P>
void ElementWorkOf<P>::begin(const LoadFactors& factors, const Regime& regime) {
  regime_ = regime;
  linear_ = regime.small_displacements;
  factors_ = factors;
}

template <int P>
void ElementWorkOf<P>::to_strain_row(const Functional& f, const Shape& shape, const Tangent& t,
                                     ZetaVector& row) const {
  Gauss turn;
  Gauss bend = f.v[2];
  double turn_a = f.a[2];
  for (int q = 0; q < P; ++q) {
    const double vx = f.v[0][q];
    const double vy = f.v[1][q];
    row[q] = vx * t.c[q] + vy * t.s[q];
    row[P + q] = -vx * t.s[q] + vy * t.c[q];
    turn[q] = vx * t.px[q] + vy * t.py[q];
    turn_a += turn[q];
    turn[q] *= shape.h;
  }
  for (int q = 0; q < P; ++q)
    for (int r = 0; r < P; ++r) bend[r] += turn[q] * a_[q][r];
  for (int r = 0; r < P; ++r) row[2 * P + r] = bend[r];
  row[kStrains] = f.a[0];
  row[kStrains + 1] = f.a[1];
  row[kStrains + 2] = turn_a;
}

/// Adds the columns of m beside S and u_a: minus the rows of u_b.
template <int P>
template <int N>
void ElementWorkOf<P>::add_end_columns(const Shape& shape, const Tangent& t, AugmentedMatrix<N>& S) const {
  constexpr int K = N - P;  // index of the first curvature
  constexpr int A = N;      // index of u_a
  constexpr int M = N + 3;
  for (int q = 0; q < P; ++q) {
    const double e = shape.hb[q] * (*t.root)[q];
    S(q, M) = -e * t.c[q];
    S(q, M + 1) = -e * t.s[q];
    if constexpr (N == kStrains) {
      const double g = shape.hb[q] * (*t.root)[P + q];
      S(P + q, M) = g * t.s[q];
      S(P + q, M + 1) = -g * t.c[q];
    }
    S(K + q, M + 2) = -shape.hb[q] * (*t.root)[2 * P + q];
  }
  double x = 0.0;
  double y = 0.0;
  Gauss kx{};
  Gauss ky{};
  for (int q = 0; q < P; ++q) {
    const double px = shape.hb[q] * t.px[q];
    const double py = shape.hb[q] * t.py[q];
    x += px;
    y += py;
    for (int r = 0; r < P; ++r) {
      kx[r] += px * a_[q][r];
      ky[r] += py * a_[q][r];
    }
  }
  for (int r = 0; r < P; ++r) {
    const double f = -shape.h * (*t.root)[2 * P + r];
    S(K + r, M) = f * kx[r];
    S(K + r, M + 1) = f * ky[r];
  }
  S(A + 2, M) = -x;
  S(A + 2, M + 1) = -y;
  for (int c = 0; c < 3; ++c) S(A + c, M + c) = -1.0;
}

template <int P>
template <int N>
void ElementWorkOf<P>::add_geometric(const Shape& shape, const Tangent& t, AugmentedMatrix<N>& S) const {
  constexpr int K = N - P;
  using Weighted = typename AugmentedMatrix<N>::Weighted;
  std::array<Weighted, P> turn;  // rows of db_q, the change of rotation at Gauss point q
  for (int q = 0; q < P; ++q) {
    turn[q].x.fill(0.0);
    turn[q].weight = t.w[q];
    for (int r = 0; r < P; ++r) turn[q].x[K + r] = shape.h * a_[q][r] * (*t.root)[2 * P + r];
    turn[q].x[N + 2] = 1.0;
    const auto add = [&](int row, double f) {
      for (int b = K / kBlock * kBlock; b < AugmentedMatrix<N>::kWidth; b += kBlock)
        store(ConstBlock(&S(row, b)) + f * ConstBlock(&turn[q].x[b]), &S(row, b));
    };
    add(q, -t.t[q] * (*t.root)[q]);
    if constexpr (N == kStrains) add(P + q, t.n[q] * (*t.root)[P + q]);
  }
  S.template add_squares<K>(turn.data(), P);
}

/// Adds the scaled rows of supports and pressure.
template <int P>
template <int N>
void ElementWorkOf<P>::add_rows(const Tangent& t, AugmentedMatrix<N>& S) {
  auto& scaled = [this]() -> auto& {
    if constexpr (N == kStrains)
      return shearable_rows_;
    else
      return stiff_rows_;
  }
  ();
  const auto count = static_cast<std::size_t>(t.row_count);
  if (scaled.size() < count) scaled.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const StrainRow& in = rows_[t.first_row + k];
    auto& x = scaled[k].x;
    scaled[k].weight = in.stiffness;
    for (int i = 0; i < N; ++i) x[i] = (*t.root)[active<N>(i)] * in.row[active<N>(i)];
    for (int c = 0; c < 3; ++c) x[N + c] = in.row[kStrains + c];
    for (int i = N + 3; i < AugmentedMatrix<N>::kWidth; ++i) x[i] = 0.0;
  }
  S.template add_squares<0>(scaled.data(), count);
}

/// Collects acting supports and pressure at y as rows in strains, and adds their forces to the residual.
template <int P>
void ElementWorkOf<P>::collect_rows(int element, const double* y, double* residual) {
  const Shape& shape = shapes_[element];
  acting_.clear();
  if (shape.spring_count > 0 || shape.contact_count > 0) add_support_residual(element, y, residual, true);
  if (const LinePressure pressure = pressure_of(shape); pressure.acts()) {
    add_pressure(shape, dofs_[element], pressure.times(-1.0), y, residual);
    if (!linear_) collect_pressure(shape, pressure);
  }
  if (regime_.masses != nullptr) collect_masses(element);
  Tangent& t = tangents_[element];
  t.first_row = static_cast<int>(rows_.size());
  t.row_count = static_cast<int>(acting_.size());
  for (const Functional& f : acting_) {
    StrainRow& out = rows_.emplace_back();
    to_strain_row(f, shape, t, out.row);
    out.stiffness = f.tangent;
    if (f.ground.moves()) on_ground_.emplace_back(element, f);
  }
}

template <int P>
template <int N>
void ElementWorkOf<P>::linearise_element(int element, const double* y, double* residual,
                                         Interior<N>& interior, CondensedElement& out) {
  const Shape& shape = shapes_[element];
  const ElementDofs& dofs = dofs_[element];
  const Kinematics& kin = kinematics_[element];
  add_strain_residual(shape, dofs, kin, y, residual);
  Tangent& t = tangents_[element];
  t.root = shape.bending != nullptr ? &roots_at(element, y) : &shape.root;
  t.c = kin.c;
  t.s = kin.s;
  for (int q = 0; q < P; ++q) {
    const double moves = linear_ ? 0.0 : 1.0;
    t.px[q] = -(shape.ty[q] + moves * y[dofs.v + P + q]);
    t.py[q] = shape.tx[q] + moves * y[dofs.v + q];
    t.n[q] = linear_ ? 0.0 : shape.hb[q] * y[dofs.s + q];
    t.t[q] = linear_ ? 0.0 : shape.hb[q] * y[dofs.s + P + q];
    t.w[q] = t.n[q] * kin.E[q] + t.t[q] * kin.G[q];
  }
  collect_rows(element, y, residual);
  AugmentedMatrix<N> S;
  S.set_zero();
  for (int i = 0; i < N; ++i) S(i, i) = shape.hb[i % P];
  add_end_columns<N>(shape, t, S);
  if (!linear_) add_geometric<N>(shape, t, S);
  if (t.row_count > 0) add_rows<N>(t, S);
  std::array<double, N> pivots;
  interior.factor.factorise(S, pivots);
  out.negative = 0;
  double det = 1.0;
  for (int i = 0; i < N; ++i) {
    if (pivots[i] < 0.0) ++out.negative;
    det *= std::abs(pivots[i]) / shape.hb[i % P];
  }
  out.log_det = std::log(det);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      out.K(i, j) = S(N + std::min(i, j), N + std::max(i, j));
      out.X(i, j) = S(N + j, N + 3 + i);
      out.F(i, j) = -S(N + 3 + std::min(i, j), N + 3 + std::max(i, j));
    }
}

template <int P>
void ElementWorkOf<P>::add_residual(const Eigen::VectorXd& y, const LoadFactors& factors,
                                    const Regime& regime, Eigen::VectorXd& residual) {
  begin(factors, regime);
  support_rounding_ = 0.0;
  find_kinematics(y);
  find_layers(y.data());
  add_coupling_forces(y.data(), residual.data());
  for (int e = 0; e < size(); ++e) {
    const Kinematics& kin = kinematics_[e];
    add_strain_residual(shapes_[e], dofs_[e], kin, y.data(), residual.data());
    if (const LinePressure pressure = pressure_of(shapes_[e]); pressure.acts())
      add_pressure(shapes_[e], dofs_[e], pressure.times(-1.0), y.data(), residual.data());
    if (shapes_[e].spring_count > 0 || shapes_[e].contact_count > 0)
      add_support_residual(e, y.data(), residual.data(), false);
  }
}

template <int P>
void ElementWorkOf<P>::linearise(const Eigen::VectorXd& y, const LoadFactors& factors, const Regime& regime,
                                 Eigen::VectorXd& residual, std::span<CondensedElement> condensed) {
  begin(factors, regime);
  support_rounding_ = 0.0;
  find_kinematics(y);
  find_layers(y.data());
  add_coupling_forces(y.data(), residual.data());
  tangents_.resize(shapes_.size());
  if (data_.bends) roots_.resize(shapes_.size());
  stiff_.resize(static_cast<std::size_t>(data_.stiff));
  shearable_.resize(static_cast<std::size_t>(data_.shearable));
  rows_.clear();
  on_ground_.clear();
  for (int e = 0; e < size(); ++e) {
    const Shape& shape = shapes_[e];
    if (shape.shearable)
      linearise_element<kStrains>(e, y.data(), residual.data(), shearable_[shape.factor], condensed[e]);
    else
      linearise_element<2 * P>(e, y.data(), residual.data(), stiff_[shape.factor], condensed[e]);
  }
}

/// Adds tangent products from the second derivative of the mixed functional, without the condensed form, so
/// that each form checks the other.
template <int P>
void ElementWorkOf<P>::add_tangent_products(const Eigen::VectorXd& y, const LoadFactors& factors,
                                            const Regime& regime,
                                            const Eigen::Ref<const Eigen::MatrixXd>& directions,
                                            Eigen::MatrixXd& out) {
  begin(factors, regime);
  Eigen::VectorXd unused;  // support forces, not needed here
  if (!springs_.empty() || !contacts_.empty()) unused.setZero(y.size());
  find_kinematics(y);
  find_layers(y.data());
  for (const Coupling& coupling : couplings_)
    for (Eigen::Index i = 0; i < directions.cols(); ++i)
      coupling.push(coupling.value(directions.col(i).data()) / coupling.compliance, out.col(i).data());
  for (int e = 0; e < size(); ++e) {
    const ElementDofs& dofs = dofs_[e];
    const Kinematics& kin = kinematics_[e];
    const LinePressure pressure = linear_ ? LinePressure{} : pressure_of(shapes_[e]);
    acting_.clear();
    if (unused.size() > 0) add_support_residual(e, y.data(), unused.data(), true);
    for (Eigen::Index i = 0; i < directions.cols(); ++i) {
      const double* direction = directions.col(i).data();
      double* product = out.col(i).data();
      add_strain_product(shapes_[e], dofs, kin, y.data(), direction, product);
      if (pressure.acts()) add_pressure_product(shapes_[e], dofs, pressure, direction, product);
      add_acting_product(dofs, direction, product);
    }
  }
}

template <int P>
std::unique_ptr<ElementWork> ElementSetOf<P>::make_work() const {
  return std::make_unique<ElementWorkOf<P>>(data_);
}

}  // namespace snapthrough

#include "solver/element/element_work_bending.h"
#include "solver/element/element_work_layers.h"
#include "solver/element/element_work_rates.h"
#include "solver/element/element_work_solve.h"
#include "solver/element/element_work_strains.h"
#include "solver/element/element_work_supports.h"
