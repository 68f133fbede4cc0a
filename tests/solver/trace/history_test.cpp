/// A path of a problem whose support remembers: a spring with a ratchet, in closed form.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "solver/problem/equilibrium_problem.h"
#include "solver/trace/trace.h"
#include "tests/solver/trace/follow.h"

namespace snapthrough {
namespace {

/// What the ratchet remembers: the largest displacement a that it has passed.
class Passed final : public History {
 public:
  explicit Passed(double value) : value_(value) {}
  [[nodiscard]] double value() const { return value_; }

 private:
  double value_;
};

/// Two displacements a and b. A spring of the stiffness 1 acts on b, which the load pushes; one of the
/// stiffness 2 holds a to sin b; and a ratchet lets a grow freely, and resists with the stiffness 3 where a
/// goes back below its largest value so far, h. The energy is b^2/2 - lambda b + (a - sin b)^2 + 3/2 min(a -
/// h, 0)^2.
class RatchetProblem final : public EquilibriumProblem {
 public:
  static constexpr double kSpring = 2.0;
  static constexpr double kRatchet = 3.0;

  RatchetProblem() {
    traits_.remembers = true;
    traits_.has_curves = true;  // the path bends where the ratchet begins to resist
  }

  [[nodiscard]] Eigen::Index size() const override { return 2; }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return metric_; }
  [[nodiscard]] const ModelTraits& traits() const override { return traits_; }
  void set_history(const SharedHistory& history) override { history_ = history; }
  [[nodiscard]] SharedHistory remembered(const Eigen::VectorXd& y, double) override {
    return std::make_shared<const Passed>(std::max(passed(), y[0]));
  }
  void load(const Eigen::VectorXd&, double, Eigen::VectorXd& out) override {
    out = Eigen::Vector2d(0.0, 1.0);
  }
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override { x = tangent_.partialPivLu().solve(x).eval(); }
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd&, double) override {
    return f.norm();
  }

 protected:
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime&, Eigen::VectorXd& f) override {
    const double stretch = kSpring * (y[0] - std::sin(y[1]));
    f = Eigen::Vector2d(stretch + kRatchet * std::min(y[0] - passed(), 0.0),
                        y[1] - stretch * std::cos(y[1]) - lambda);
  }
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                          Eigen::VectorXd& f) override {
    find_residual(y, lambda, regime, f);
    tangent_ = tangent_at(y);
    const Eigen::Vector2d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(tangent_).eigenvalues();
    return {static_cast<int>((values.array() < 0.0).count()), values.array().abs().log().sum()};
  }
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double, const Regime&,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions) override {
    return tangent_at(y) * motions;
  }

 private:
  [[nodiscard]] double passed() const {
    return history_ ? static_cast<const Passed&>(*history_).value() : 0.0;
  }
  [[nodiscard]] Eigen::Matrix2d tangent_at(const Eigen::VectorXd& y) const {
    const double s = std::sin(y[1]);
    const double c = std::cos(y[1]);
    const double coupling = -kSpring * c;
    return Eigen::Matrix2d{{kSpring + (y[0] < passed() ? kRatchet : 0.0), coupling},
                           {coupling, 1.0 + kSpring * (c * c + (y[0] - s) * s)}};
  }

  ModelTraits traits_;
  Eigen::VectorXd metric_ = Eigen::VectorXd::Ones(2);
  Eigen::Matrix2d tangent_ = Eigen::Matrix2d::Identity();
  SharedHistory history_;
};

std::vector<PathPoint> points_to(double load) {
  RatchetProblem problem;
  TraceRules rules;
  rules.load = {{-1.0, load}};
  std::vector<PathPoint> points;
  testing::Observed observed;
  observed.point = [&points](const PathPoint& point) { points.push_back(point); };
  const TraceOutcome outcome = testing::follow(problem, rules, {&observed});
  EXPECT_EQ(outcome.end, TraceEnd::load_factor);
  // the end of the path is the last point whole
  EXPECT_EQ(outcome.last.context.history, points.back().context.history);
  return points;
}

/// With h as the points before remember it, the state at the load of each point is a closed form: a = sin b
/// on the way up, a = (2 sin b + 3 h) / 5 on the way back.
TEST(History, TravelsWithThePointsOfAPath) {
  const std::vector<PathPoint> points = points_to(2.6);
  double h = 0.0;
  double widest = 0.0;
  int back = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double a = points[i].y[0];
    const double b = points[i].y[1];
    if (i > 0) widest = std::max(widest, b - points[i - 1].y[1]);
    const double free = std::sin(b);
    const bool returns = free < h;
    back += returns ? 1 : 0;
    EXPECT_NEAR(a, returns ? (2.0 * free + 3.0 * h) / 5.0 : free, 1e-9) << "b = " << b;
    EXPECT_NEAR(points[i].lambda, b - 2.0 * (a - free) * std::cos(b), 1e-9) << "b = " << b;
    h = std::max(h, a);
    if (i > 0) {
      ASSERT_NE(points[i].context.history, nullptr);
      EXPECT_EQ(static_cast<const Passed&>(*points[i].context.history).value(), h);
    }
  }
  EXPECT_GE(back, 3);
  // the largest value lies between two points, where a is 1
  EXPECT_NEAR(h, 1.0, 0.125 * widest * widest);
}

/// A point is whole: a path that goes on from it goes on as the path that it is of.
TEST(History, LetsAPathGoOnFromAnyOfItsPoints) {
  const std::vector<PathPoint> points = points_to(2.6);
  const auto middle =
      std::find_if(points.begin(), points.end(), [](const PathPoint& point) { return point.y[1] > 1.9; });
  ASSERT_NE(middle, points.end());
  RatchetProblem problem;
  PathFollower follower(problem);
  TraceRules rules;
  rules.load = {{-1.0, 2.6}};
  const TraceOutcome outcome = trace(follower, *middle, rules, {}, {}, {});
  ASSERT_EQ(outcome.end, TraceEnd::load_factor);
  EXPECT_NEAR(outcome.last.y[0], points.back().y[0], 1e-9);
  EXPECT_NEAR(outcome.last.y[1], points.back().y[1], 1e-9);
  // without what it remembers, the same point is the beginning of another path
  PathPoint forgetful = *middle;
  forgetful.context.history = nullptr;
  RatchetProblem fresh;
  PathFollower other(fresh);
  const TraceOutcome without = trace(other, forgetful, rules, {}, {}, {});
  // its largest value is sin 1.9 at most, not 1, of which a has the share 3/5
  EXPECT_LT(without.last.y[0], points.back().y[0] - 0.5 * (1.0 - std::sin(1.9)));
}

}  // namespace
}  // namespace snapthrough
