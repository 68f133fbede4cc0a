#pragma once
/// @file
/// Quadrature on [0, 1] and the polynomials of the beam element.

#include <array>
#include <span>
#include <vector>

#include "solver/numeric/max_order.h"

namespace snapthrough {

/// Quadrature points and weights on [0, 1], points ascending.
struct Quadrature {
  std::vector<double> points;
  std::vector<double> weights;
};

/// @brief Gauss-Legendre rule with n >= 1 points, exact for polynomials up to degree 2n - 1.
[[nodiscard]] Quadrature gauss_legendre(int n);

/// @brief Gauss-Lobatto rule with n >= 2 points (both ends included), exact up to degree 2n - 3.
[[nodiscard]] Quadrature gauss_lobatto(int n);

/// @brief P-point Gauss collocation (Runge-Kutta) rule of a beam element of order P.
///
/// Displacements in an element are u(xi) = u_a + h sum_r A_r(xi) u'_r, with u'_r the derivatives at the Gauss
/// points and A_r(xi) the integral from 0 to xi of the Lagrange polynomial l_r through those points: the same
/// space as Lagrange elements of order P (Hairer, Norsett and Wanner, Solving ODE I, II.7).
class CollocationRule {
 public:
  /// @pre 1 <= order <= kMaxOrder
  explicit CollocationRule(int order);

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] double point(int q) const { return c_[q]; }
  [[nodiscard]] double weight(int q) const { return b_[q]; }
  /// A_r(c_q), row q.
  [[nodiscard]] double integral(int q, int r) const { return a_[q][r]; }

  /// @brief A_r(xi) for all r; `out` has size order().
  void integrals_at(double xi, std::span<double> out) const;
  /// @brief l_r(xi) for all r; `out` has size order().
  void values_at(double xi, std::span<double> out) const;

  /// @brief Rule of an order, cached. Thread safe.
  [[nodiscard]] static const CollocationRule& of(int order);

 private:
  int order_;
  std::array<double, kMaxOrder> c_{};
  std::array<double, kMaxOrder> b_{};
  std::array<std::array<double, kMaxOrder>, kMaxOrder> a_{};
  /// l_r = sum_k coefficient_[k][r] P_k, P_k the Legendre polynomials shifted to [0, 1].
  std::array<std::array<double, kMaxOrder>, kMaxOrder> coefficient_{};
};

}  // namespace snapthrough
