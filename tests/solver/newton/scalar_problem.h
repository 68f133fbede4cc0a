#pragma once
/// @file
/// One equation in one unknown, whose every property can be set: what forces the corrector's each end.

#include <cmath>
#include <functional>
#include <utility>

#include "solver/problem/equilibrium_problem.h"

namespace snapthrough::testing {

/// f(y) = lambda. The relative residual is |f(y) - lambda| itself.
class ScalarProblem final : public EquilibriumProblem {
 public:
  using Function = std::function<double(double)>;
  ScalarProblem(Function f, Function derivative) : f_(std::move(f)), derivative_(std::move(derivative)) {}

  ModelTraits kind;                 ///< what traits() says
  double rounding = 0.0;            ///< what residual_rounding() says
  std::function<void(int)> before;  ///< told the number of each linearisation, from 1 on
  int linearisations = 0;

  [[nodiscard]] Eigen::Index size() const override { return 1; }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return metric_; }
  [[nodiscard]] const ModelTraits& traits() const override { return kind; }
  void load(const Eigen::VectorXd&, double, Eigen::VectorXd& out) override { out = Eigen::VectorXd::Ones(1); }
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override { x /= tangent_; }
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd&, double) override {
    return f.norm();
  }
  [[nodiscard]] double residual_rounding(const Eigen::VectorXd&, double) const override { return rounding; }

 protected:
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime&, Eigen::VectorXd& f) override {
    f = Eigen::VectorXd::Constant(1, f_(y[0]) - lambda);
  }
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                          Eigen::VectorXd& f) override {
    ++linearisations;
    if (before) before(linearisations);
    find_residual(y, lambda, regime, f);
    tangent_ = derivative_(y[0]);
    return {tangent_ < 0.0 ? 1 : 0, std::log(std::abs(tangent_))};
  }
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double, const Regime&,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions) override {
    return derivative_(y[0]) * motions;
  }

 private:
  Function f_;
  Function derivative_;
  Eigen::VectorXd metric_ = Eigen::VectorXd::Ones(1);
  double tangent_ = 1.0;
};

}  // namespace snapthrough::testing
