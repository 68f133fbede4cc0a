#pragma once
/// @file
/// A problem that fails in a range of its first unknown.

#include <array>
#include <limits>

#include "solver/numeric/cancelled.h"
#include "tests/solver/path/small_problem.h"

namespace snapthrough::testing {

/// As another one, but whoever linearises it with the first unknown in a range gets no number, or is
/// cancelled.
class FailingProblem final : public EquilibriumProblem {
 public:
  enum class How { no_number, cancelled };
  FailingProblem(const std::function<SmallProblem()>& inner, std::array<double, 2> range, How how)
      : inner_(inner()), range_(range), how_(how) {}
  [[nodiscard]] Eigen::Index size() const override { return inner_.size(); }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return inner_.metric(); }
  void load(const Eigen::VectorXd& y, double lambda, Eigen::VectorXd& out) override {
    inner_.load(y, lambda, out);
  }
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override { inner_.solve(x); }
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd& y,
                                         double lambda) override {
    return inner_.relative_residual(f, y, lambda);
  }

 protected:
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                     Eigen::VectorXd& f) override {
    inner_.residual(y, lambda, f, regime);
  }
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                          Eigen::VectorXd& f) override {
    const TangentReport report = inner_.linearise(y, lambda, f, regime);
    if (y[0] > range_[0] && y[0] < range_[1]) {
      if (how_ == How::cancelled) throw Cancelled{};
      f.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return report;
  }
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions) override {
    return inner_.tangent_products(y, lambda, motions, regime);
  }

 private:
  SmallProblem inner_;
  std::array<double, 2> range_;
  How how_;
};

}  // namespace snapthrough::testing
