#pragma once
/// @file
/// Equilibrium problems of one or two unknowns, written by hand: no structure, no mesh.

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
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
        one_sided_(one_sided),
        metric_(Eigen::VectorXd::Ones(load_.size())) {}

  [[nodiscard]] Eigen::Index size() const override { return load_.size(); }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return metric_; }
  [[nodiscard]] bool one_sided() const override { return one_sided_; }
  void load(const Eigen::VectorXd&, double, Eigen::VectorXd& out) override { out = load_; }
  void solve(Eigen::VectorXd& x) override { x = tangent_.fullPivLu().solve(x).eval(); }
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
  bool one_sided_;
  Eigen::VectorXd metric_;
  Eigen::MatrixXd tangent_;
};

}  // namespace snapthrough::testing
