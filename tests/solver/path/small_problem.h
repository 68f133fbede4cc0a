#pragma once
/// @file
/// Equilibrium problems of one or two unknowns, written by hand: no structure, no mesh.

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <utility>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough::testing {

/// F(y) = g(y) - lambda q with a given gradient g and Hessian.
class SmallProblem final : public EquilibriumProblem {
 public:
  using Gradient = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
  using Hessian = std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>;
  /// @param one_sided whether the Hessian jumps, as where a support begins to act
  SmallProblem(Gradient g, Hessian h, Eigen::VectorXd load, bool one_sided = false)
      : gradient_(std::move(g)),
        hessian_(std::move(h)),
        load_(std::move(load)),
        metric_(Eigen::VectorXd::Ones(load_.size())) {
    traits_.one_sided = one_sided;
  }

  [[nodiscard]] Eigen::Index size() const override { return load_.size(); }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return metric_; }
  [[nodiscard]] const ModelTraits& traits() const override { return traits_; }
  void load(const Eigen::VectorXd&, double, Eigen::VectorXd& out) override { out = load_; }
  /// A pivot of zero counts as rounding's, as it does in a structure's factors.
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override {
    constexpr double kTiny = 1e-16;
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(size(), size());
    Eigen::FullPivLU<Eigen::MatrixXd> factor(tangent_ + kTiny * unit);
    factor.setThreshold(1e-6 * kTiny);
    x = factor.solve(x).eval();
  }
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd&,
                                         double lambda) override {
    return f.norm() / std::max(std::abs(lambda) * load_.norm(), 1e-300);
  }

 protected:
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime&, Eigen::VectorXd& f) override {
    f = gradient_(y) - lambda * load_;
  }
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                          Eigen::VectorXd& f) override {
    find_residual(y, lambda, regime, f);
    tangent_ = hessian_(y);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tangent_).eigenvalues();
    return {static_cast<int>((values.array() < 0.0).count()), values.array().abs().log().sum()};
  }
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double, const Regime&,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions) override {
    return hessian_(y) * motions;
  }

 private:
  Gradient gradient_;
  Hessian hessian_;
  Eigen::VectorXd load_;
  ModelTraits traits_;
  Eigen::VectorXd metric_;
  Eigen::MatrixXd tangent_;
};

/// Energy a^2/2 - a^3/6 + (c - a) b^2/2 + b^4/4 - e b, load on a. With e = 0 the primary path is b = 0,
/// lambda = a - a^2/2: a limit point at a = 1 (lambda 1/2), a bifurcation at a = c.
inline SmallProblem pitchfork(double c, double imperfection) {
  return {[c, imperfection](const Eigen::VectorXd& y) {
            return Eigen::VectorXd(Eigen::Vector2d(y[0] - 0.5 * y[0] * y[0] - 0.5 * y[1] * y[1],
                                                   (c - y[0]) * y[1] + y[1] * y[1] * y[1] - imperfection));
          },
          [c](const Eigen::VectorXd& y) {
            Eigen::Matrix2d h;
            h << 1.0 - y[0], -y[1], -y[1], c - y[0] + 3.0 * y[1] * y[1];
            return Eigen::MatrixXd(h);
          },
          Eigen::Vector2d(1.0, 0.0)};
}

/// Energy a^2/2 + ((a - c)^2 - d^2) b^2/2 + b^4/4, load on a: on the primary path b = 0, lambda = a,
/// bifurcations at a = c - d and c + d.
inline SmallProblem two_bifurcations(double c, double d) {
  return {[c, d](const Eigen::VectorXd& y) {
            const double x = y[0] - c;
            return Eigen::VectorXd(
                Eigen::Vector2d(y[0] + x * y[1] * y[1], (x * x - d * d) * y[1] + y[1] * y[1] * y[1]));
          },
          [c, d](const Eigen::VectorXd& y) {
            const double x = y[0] - c;
            Eigen::Matrix2d h;
            h << 1.0 + y[1] * y[1], 2.0 * x * y[1], 2.0 * x * y[1], x * x - d * d + 3.0 * y[1] * y[1];
            return Eigen::MatrixXd(h);
          },
          Eigen::Vector2d(1.0, 0.0)};
}

/// F = (a - c)^3 / 3 - d^2 (a - c) - F(0), one unknown: limit points at a = c - d and c + d.
inline SmallProblem two_folds(double c, double d) {
  const auto f = [c, d](double a) { return (a - c) * (a - c) * (a - c) / 3.0 - d * d * (a - c); };
  return {[f](const Eigen::VectorXd& y) {
            return Eigen::VectorXd(Eigen::VectorXd::Constant(1, f(y[0]) - f(0.0)));
          },
          [c, d](const Eigen::VectorXd& y) {
            return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, (y[0] - c) * (y[0] - c) - d * d));
          },
          Eigen::VectorXd::Ones(1)};
}

/// Rate of the load on the way to a knee at 1, which is this wide: between two limit points before the knee
/// the load rises a little.
inline double rate_before_knee(double a, double width) {
  return -1.0 + 2.0 * a * a - 4.0 * std::exp((a - 1.0) / width);
}
/// Load of the same path, which begins at zero.
inline double load_before_knee(double a, double width) {
  return -a + 2.0 / 3.0 * a * a * a - 4.0 * width * (std::exp((a - 1.0) / width) - std::exp(-1.0 / width));
}
inline SmallProblem knee(double width) {
  return {[width](const Eigen::VectorXd& y) {
            return Eigen::VectorXd(Eigen::VectorXd::Constant(1, load_before_knee(y[0], width)));
          },
          [width](const Eigen::VectorXd& y) {
            return Eigen::MatrixXd(Eigen::MatrixXd::Constant(1, 1, rate_before_knee(y[0], width)));
          },
          Eigen::VectorXd::Ones(1)};
}

}  // namespace snapthrough::testing
