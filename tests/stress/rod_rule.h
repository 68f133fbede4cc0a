#pragma once
/// @file
/// Quadrature and the polynomials of one element, for the checker. Written anew so that the checker shares no
/// mechanics with the solver.

#include <Eigen/Core>
#include <vector>

namespace snapthrough::testing {

/// Gauss-Legendre points and weights on [0, 1].
struct Rule {
  std::vector<double> points, weights;
};
[[nodiscard]] Rule gauss(int n);
/// Gauss-Lobatto points and weights on [0, 1], n >= 2.
[[nodiscard]] Rule lobatto(int n);

/// @brief Lagrange polynomials through the P Gauss points and their integrals from 0.
class Lagrange {
 public:
  explicit Lagrange(int order);
  [[nodiscard]] int order() const { return static_cast<int>(rule_.points.size()); }
  [[nodiscard]] const Rule& rule() const { return rule_; }
  [[nodiscard]] Eigen::VectorXd values(double xi) const;
  [[nodiscard]] Eigen::VectorXd integrals(double xi) const;

 private:
  Rule rule_;
  Eigen::MatrixXd series_;  ///< of the polynomials by rows, in Legendre polynomials
};

}  // namespace snapthrough::testing
